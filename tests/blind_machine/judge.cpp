// SPDX-License-Identifier: Apache-2.0
#include "blind_machine/judge.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <stdexcept>

#include "blind_machine/catalogue.hpp"
#include "support/dense.hpp"

namespace trueaxis::blind_machine {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Times {
  double factor;
  ErrorFunction operator()(ConstantError e) const { return e.value *= factor, e; }
  ErrorFunction operator()(PolynomialError e) const {
    for (double& c : e.coefficients) c *= factor;
    return e;
  }
  ErrorFunction operator()(FourierError e) const {
    for (auto& t : e.terms) t.cos *= factor, t.sin *= factor;
    return e;
  }
  ErrorFunction operator()(TableError e) const {
    for (double& v : e.values) v *= factor;
    return e;
  }
};

}  // namespace

Fault with(const Fault& fault, const Effect& effect, const VectorXd& coefficients) {
  Fault out = fault;
  for (std::size_t j = 0; j < effect.units.size(); ++j) {
    const Fault& unit = effect.units[j];
    const double size = coefficients[static_cast<Index>(j)];
    for (ErrorTerm term : unit.errors.terms) {
      term.function = std::visit(Times{size}, term.function);
      out.errors.terms.push_back(std::move(term));
    }
    for (std::size_t k = 0; k < axis_count; ++k) out.reversal[k] += size * unit.reversal[k];
    for (std::size_t k = 0; k < 3; ++k) {
      out.drift_mm[k] += size * unit.drift_mm[k];
      out.slip_mm[k] += size * unit.slip_mm[k];
    }
    if (unit.slip_at > 0) out.slip_at = unit.slip_at;
    if (unit.of_visit)
      out.of_visit = [unit, size, before = fault.of_visit](const Visit& visit) {
        auto terms = before ? before(visit) : std::vector<ErrorTerm>{};
        for (ErrorTerm term : unit.of_visit(visit)) {
          term.function = std::visit(Times{size}, term.function);
          terms.push_back(std::move(term));
        }
        return terms;
      };
  }
  return out;
}

Judge::Judge(const Machine& machine, const Plan& plan) : machine_(machine), plan_(plan) {
  const auto read = readings(machine, plan, {});
  nominal_ = Eigen::Map<const VectorXd>(read.data(), static_cast<Index>(read.size()));
  make_base();
  effects_ = catalogue(machine, plan);
  for (const Effect& effect : effects_) {
    MatrixXd own(nominal_.size(), static_cast<Index>(effect.units.size()));
    const double step = effect.angle ? 1e-5 : 1e-3;
    for (Index j = 0; j < own.cols(); ++j)
      own.col(j) = over_sigma(with({}, {"", {effect.units[static_cast<std::size_t>(j)]}, false},
                                   VectorXd::Constant(1, step))) /
                   step;
    columns_.push_back(beside_base(own));
  }
}

VectorXd Judge::over_sigma(const Fault& fault) const {
  const auto read = readings(machine_, plan_, fault);
  return (Eigen::Map<const VectorXd>(read.data(), static_cast<Index>(read.size())) - nominal_) /
         plan_.noise_mm;
}

MatrixXd Judge::beside_base(MatrixXd columns) const {
  for (int twice = 0; twice < 2; ++twice) columns -= base_ * (base_.transpose() * columns);
  return columns;
}

// Directions of the location errors that stay below one σ at the largest plausible size do not
// count.
void Judge::make_base() {
  std::vector<VectorXd> places, errors;
  std::vector<int> balls;
  for (const Visit& visit : plan_.visits)
    if (std::ranges::find(balls, visit.ball) == balls.end()) balls.push_back(visit.ball);
  for (const int ball : balls)
    for (std::size_t k = 0; k < 3; ++k) {
      Plan moved = plan_;
      for (Visit& visit : moved.visits)
        if (visit.ball == ball) visit.centre_mm[k] += 1e-3;
      const auto read = readings(machine_, moved, {});
      places.emplace_back(Eigen::Map<const VectorXd>(read.data(), static_cast<Index>(read.size())) -
                          nominal_);
    }
  std::vector<std::size_t> bodies{spindle_body};
  for (const MachineAxis& axis : machine_.axes) bodies.push_back(index_of(axis.name));
  for (const std::size_t body : bodies)
    for (std::size_t direction = 0; direction < 6; ++direction) {
      const ErrorName name{false, direction, body};
      if (without_effect(name) || (body == spindle_body && direction == 5)) continue;
      Fault fault;
      const double step = name.angular() ? 1e-5 : 1e-3;
      fault.errors.terms.push_back({name, ConstantError{step}, 0.0});
      errors.emplace_back(over_sigma(fault) / step * (name.angular() ? largest_rad : largest_mm));
    }
  const auto packed = [&](const std::vector<VectorXd>& list) {
    MatrixXd out(nominal_.size(), static_cast<Index>(list.size()));
    for (Index j = 0; j < out.cols(); ++j) out.col(j) = list[static_cast<std::size_t>(j)];
    return out;
  };
  base_ = dense::basis(packed(places), 0.0);
  const MatrixXd more = dense::directions_above(beside_base(packed(errors)), 1.0);
  base_.conservativeResize(Eigen::NoChange, base_.cols() + more.cols());
  base_.rightCols(more.cols()) = more;
}

std::size_t Judge::index(const std::string& name) const {
  const auto found = std::ranges::find(effects_, name, &Effect::name);
  return static_cast<std::size_t>(found - effects_.begin());
}

VectorXd Judge::effect_of(const Fault& fault) const { return beside_base(over_sigma(fault)); }

MatrixXd Judge::slip_columns(std::size_t visit) const {
  MatrixXd out(nominal_.size(), 3);
  for (Index k = 0; k < 3; ++k) {
    Fault fault;
    fault.slip_mm[static_cast<std::size_t>(k)] = 1e-3;
    fault.slip_at = visit + 1;
    out.col(k) = over_sigma(fault) / 1e-3;
  }
  return beside_base(out);
}

double Judge::left(const VectorXd& mu, const MatrixXd& beside) {
  const MatrixXd q = dense::basis(beside, 1e-6);
  return (mu - q * (q.transpose() * mu)).squaredNorm();
}

double Judge::distance(const VectorXd& mu, const std::string& name, const MatrixXd& beside) const {
  const auto left_of = [&](const MatrixXd& own) {
    MatrixXd all(mu.size(), own.cols() + beside.cols());
    all.leftCols(own.cols()) = own;
    if (beside.cols() > 0) all.rightCols(beside.cols()) = beside;
    return left(mu, all);
  };
  if (name != "ball.slip") {
    const std::size_t at = index(name);
    if (at == effects_.size()) throw std::runtime_error("the judge knows no " + name);
    return std::sqrt(left_of(columns_[at]));
  }
  double least = mu.squaredNorm();
  for (std::size_t visit = 1; visit < plan_.visits.size(); ++visit)
    least = std::min(least, left_of(slip_columns(visit)));
  return std::sqrt(least);
}

double Judge::left_by_two(const VectorXd& mu) const {
  double least = mu.squaredNorm();
  std::size_t first = 0;
  for (std::size_t t = 0; t < effects_.size(); ++t)
    if (const double now = left(mu, columns_[t]); now < least) least = now, first = t;
  for (std::size_t t = 0; t < effects_.size(); ++t) {
    MatrixXd both(mu.size(), columns_[first].cols() + columns_[t].cols());
    both << columns_[first], columns_[t];
    least = std::min(least, left(mu, both));
  }
  return least;
}

}  // namespace trueaxis::blind_machine
