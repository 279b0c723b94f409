// SPDX-License-Identifier: Apache-2.0
#include "calibrate/estimate/total_uncertainty.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "calibrate/estimate/geometry.hpp"
#include "calibrate/estimate/plausible_errors.hpp"
#include "math/covariance.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::calibrate_detail {
namespace {

constexpr double shown = 3.0;  // u of an amount
// Of the size that machines have: one error in 2000 is more, by Eq. 210 at this machine's ξ.
constexpr double beyond = 10.0;

bool is_kept(const TipFit& fit, const ErrorName& name) {
  return std::ranges::any_of(fit.solution.determined.kept,
                             [&](std::size_t k) { return fit.unknowns[k].unit.name == name; });
}

/// The covariance that was given, without what the fit estimates anew: component errors stay
/// random as they were given, constants that are kept are free.
struct Given {
  std::vector<UncertainAmount> components;
  MatrixXd root;           ///< of their covariance
  ErrorCovariance others;  ///< what no reading of this measurement changes

  explicit Given(const TipFit& fit) {
    const ErrorCovariance& all = fit.given.covariance;
    const MatrixXd matrix = matrix_of(all);
    std::vector<Index> of_components, of_others;
    std::vector<UncertainAmount> rest;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const UncertainAmount& amount = all.names()[i];
      if (amount.name.component) {
        of_components.push_back(static_cast<Index>(i));
        components.push_back(amount);
      } else if (!is_kept(fit, amount.name)) {
        of_others.push_back(static_cast<Index>(i));
        rest.push_back(amount);
      }
    }
    root.resize(static_cast<Index>(components.size()), static_cast<Index>(components.size()));
    if (!components.empty()) {
      const linear::Spectrum of = linear::spectrum(matrix(of_components, of_components));
      root = linear::scaled_columns(of.vectors, of.values.cwiseMax(0.0).cwiseSqrt());
    }
    others = with_names(std::move(rest), matrix(of_others, of_others));
  }
};

bool add_to(ErrorFunction& sum, const ErrorFunction& more) {
  if (auto* fourier = std::get_if<FourierError>(&sum)) {
    const auto* one = std::get_if<FourierError>(&more);
    if (one == nullptr || one->period != fourier->period) return false;
    const FourierError::Term& term = one->terms.front();
    const auto order = std::ranges::find(fourier->terms, term.order, &FourierError::Term::order);
    if (order == fourier->terms.end())
      fourier->terms.push_back(term);
    else
      order->cos += term.cos, order->sin += term.sin;
    return true;
  }
  auto* polynomial = std::get_if<PolynomialError>(&sum);
  const auto* one = std::get_if<PolynomialError>(&more);
  if (polynomial == nullptr || one == nullptr || one->origin != polynomial->origin ||
      one->scale != polynomial->scale)
    return false;
  auto& c = polynomial->coefficients;
  c.resize(std::max(c.size(), one->coefficients.size()), 0.0);
  for (std::size_t i = 0; i < one->coefficients.size(); ++i) c[i] += one->coefficients[i];
  return true;
}

/// Component errors that a value is known of, by the files or as unknowns of the fit.
std::vector<ErrorName> known_of(const TipFit& fit) {
  std::vector<ErrorName> known;
  for (const ErrorTerm& term : fit.given.terms)
    if (term.name.component) known.push_back(term.name);
  for (const Unknown& one : fit.unknowns)
    if (one.unit.name.component) known.push_back(one.unit.name);
  return known;
}

/// Location errors that nobody gave and that the fit held, with the sizes that machines have.
std::vector<Unknown> held_of(const TipFit& fit) {
  constexpr PlausibleSizes sizes;
  std::vector<Unknown> out;
  for (const Held& held : fit.solution.determined.held) {
    Unknown one = fit.unknowns[held.unknown];
    const ErrorName& name = one.unit.name;
    if (name.component ||
        std::ranges::find(fit.given.terms, name, &ErrorTerm::name) != fit.given.terms.end() ||
        std::ranges::find(fit.given.covariance.names(), name, &UncertainAmount::name) !=
            fit.given.covariance.names().end())
      continue;
    one.largest = name.angular() ? sizes.location_angle_rad : sizes.location_length_mm;
    out.push_back(std::move(one));
  }
  return out;
}

/// Everything that is estimated together: kept unknowns, places, component errors that were given
/// with their covariance, and those that nobody gave.
class Together {
 public:
  Together(const TipFit& fit, const ErrorModel& errors, const CalibrationOptions& options)
      : fit_(fit),
        given_(fit),
        plausible_(plausible_errors(fit.problem, known_of(fit), options.polynomials)),
        held_(options.counts_held ? held_of(fit) : std::vector<Unknown>()) {
    amounts_ = given_.components;
    for (const PlausibleError& error : plausible_)
      amounts_.insert(amounts_.end(), error.amounts.begin(), error.amounts.end());
    const Geometry geometry = geometry_of(fit.problem, errors, fit.solution.places);
    MatrixXd columns = amount_columns(fit.problem, geometry, amounts_);
    weigh(fit.problem, columns);
    const auto known = given_.root.cols();
    columns.leftCols(known) = linear::product(columns.leftCols(known), given_.root);
    effects_ = regress(fit.solution.residuals, fit.solution.jacobian, columns, groups(),
                       fit.problem.noise_stated);
    MatrixXd all(columns.rows(), fit.solution.jacobian.cols() + columns.cols());
    all << fit.solution.jacobian, columns;
    const MatrixXd of_held = weighted_jacobian(fit.problem, errors, held_, fit.solution.places)
                                 .leftCols(static_cast<Index>(held_.size()));
    by_held_ = linear::product(effects_.covariance, linear::transposed_product(all, of_held)) /
               effects_.variance;
    give_back_units();
  }

  void write(Calibration& out) const {
    write_parameters(out);
    write_errors(out);
    write_components(out);
    out.size_of_components = effects_.times_all;
    out.noise_basis = fit_.problem.noise_stated && effects_.variance == 1.0 ? NoiseBasis::stated
                                                                            : NoiseBasis::residuals;
    out.noise_mm =
        std::sqrt(effects_.variance) * fit_.problem.rms_mm(fit_.problem.weights.cwiseInverse());
  }

  VectorXd places() const {
    return fit_.solution.places + mean_.segment(kept(), fit_.problem.places);
  }

 private:
  Index kept() const { return static_cast<Index>(fit_.solution.determined.kept.size()); }
  const Unknown& unknown(Index k) const {
    return fit_.unknowns[fit_.solution.determined.kept[static_cast<std::size_t>(k)]];
  }

  std::vector<RandomGroup> groups() {
    std::vector<RandomGroup> out{{1.0, VectorXd::Ones(given_.root.cols()), true}};
    const auto plausible = groups_of(plausible_);
    out.insert(out.end(), plausible.begin(), plausible.end());
    return out;
  }

  /// From sizes and roots to mm and rad.
  void give_back_units() {
    const Index fixed = effects_.fixed.size(), known = given_.root.cols();
    MatrixXd back = MatrixXd::Identity(effects_.covariance.rows(), effects_.covariance.cols());
    for (Index k = 0; k < kept(); ++k) back(k, k) = unknown(k).largest;
    back.block(fixed, fixed, known, known) = given_.root;
    mean_.resize(back.rows());
    mean_ << effects_.fixed, effects_.random;
    mean_ = back * mean_;
    covariance_ = linear::propagated(back, effects_.covariance);
    by_held_ = back * by_held_;
    for (Index k = 0; k < kept(); ++k)
      mean_[k] += fit_.solution.unknowns[static_cast<Index>(
          fit_.solution.determined.kept[static_cast<std::size_t>(k)])];
  }

  void write_parameters(Calibration& out) const {
    const MatrixXd noise =
        effects_.variance * linear::pseudo_inverse(linear::gram(fit_.solution.jacobian));
    std::vector<std::string> names;
    for (Index k = 0; k < kept(); ++k) {
      CalibratedParameter& one = out.parameters[static_cast<std::size_t>(k)];
      one.estimate.value = mean_[k];
      one.estimate.u = std::sqrt(covariance_(k, k));
      one.u_noise = std::sqrt(noise(k, k)) * unknown(k).largest;
      names.push_back(one.name);
    }
    out.covariance = with_names(std::move(names), covariance_.topLeftCorner(kept(), kept()));
  }

  /// What was given, the kept unknowns and the component errors, with what is unknown of them all.
  void write_errors(Calibration& out) const {
    ErrorModel errors = fit_.given;
    for (ErrorTerm& term : errors.terms)
      if (is_kept(fit_, term.name)) term.u = 0.0;
    errors.covariance = given_.others;
    std::vector<UncertainAmount> found;
    std::vector<Index> which;
    for (Index k = 0; k < kept(); ++k) {
      ErrorTerm term = unknown(k).unit;
      found.push_back(amount_of(term));
      which.push_back(k);
      term.function = scaled(term.function, mean_[k]);
      errors.terms.push_back(std::move(term));
    }
    const Index first = effects_.fixed.size();
    std::vector<ErrorTerm> components;
    for (std::size_t i = 0; i < amounts_.size(); ++i) {
      const Index at = first + static_cast<Index>(i);
      found.push_back(amounts_[i]);
      which.push_back(at);
      add_amount(components, amounts_[i], mean_[at]);
    }
    for (ErrorTerm& term : components) {
      const auto given = std::ranges::find(fit_.given.terms, term.name, &ErrorTerm::name);
      if (given != fit_.given.terms.end())
        term.known_over = given->known_over;
      else if (shows(term.name))
        term.known_over = measured_over(fit_.problem, term);
      errors.terms.push_back(std::move(term));
    }
    for (std::size_t i = 0; i < held_.size(); ++i) {
      found.push_back(amount_of(held_[i].unit));
      which.push_back(covariance_.rows() + static_cast<Index>(i));
    }
    add_covariance(errors.covariance, with_names(std::move(found), with_held()(which, which)));
    gather_uncertainty(errors);
    out.errors = std::move(errors);
  }

  /// Whether the readings show an error. Others are of plausible sizes, which U counts everywhere.
  bool shows(const ErrorName& name) const {
    const Index first = effects_.fixed.size();
    for (std::size_t i = 0; i < amounts_.size(); ++i) {
      const Index at = first + static_cast<Index>(i);
      if (amounts_[i].name == name && std::abs(mean_[at]) > shown * std::sqrt(covariance_(at, at)))
        return true;
    }
    return false;
  }

  /// The covariance of all, and of the held ones after it: an estimate is off by `by_held_` for
  /// each of them (Eq. 330).
  MatrixXd with_held() const {
    const Index n = covariance_.rows(), held = static_cast<Index>(held_.size());
    MatrixXd root(n + held, held), out = MatrixXd::Zero(n + held, n + held);
    root.topRows(n) = -by_held_;
    root.bottomRows(held).setZero();
    for (Index k = 0; k < held; ++k) root(n + k, k) = held_[static_cast<std::size_t>(k)].largest;
    out.topLeftCorner(n, n) = covariance_;
    return out + linear::product_transposed(root, root);
  }

  void write_components(Calibration& out) const {
    Index at = effects_.fixed.size() + given_.root.cols();
    for (const PlausibleError& error : plausible_) {
      CalibratedComponent one{to_string(error.name), {}, 0.0, false, false};
      double square = 0.0, unknown = 0.0;
      for (const UncertainAmount& amount : error.amounts) {
        const double variance = covariance_(at, at), share = mean_square(amount);
        square += mean_[at] * mean_[at] * share;
        unknown += variance * share;
        one.shown = one.shown || std::abs(mean_[at]) > shown * std::sqrt(variance);
        ++at;
      }
      one.rms = {std::sqrt(square), std::sqrt(unknown), error.name.angular() ? "rad" : "mm", ""};
      // The first group is what was given.
      one.plausible = error.plausible * effects_.times[error.group + 1];
      one.beyond = one.rms.value - 2.0 * one.rms.u >
                   beyond * error.plausible * std::max(1.0, effects_.times_all);
      out.components.push_back(std::move(one));
    }
  }

  const TipFit& fit_;
  Given given_;
  std::vector<PlausibleError> plausible_;
  std::vector<Unknown> held_;
  std::vector<UncertainAmount> amounts_;
  RandomEffects effects_;
  VectorXd mean_;
  MatrixXd covariance_;
  MatrixXd by_held_;  ///< what a held one of its size does to every estimate
};

}  // namespace

void add_amount(std::vector<ErrorTerm>& terms, const UncertainAmount& amount, double value) {
  ErrorTerm term{amount.name, scaled(amount.unit(), value), 0.0};
  const auto same = std::ranges::find_if(terms, [&](ErrorTerm& other) {
    return other.name == term.name && add_to(other.function, term.function);
  });
  if (same == terms.end()) terms.push_back(std::move(term));
}

UncertainAmount amount_of(const ErrorTerm& unit) {
  UncertainAmount out{.name = unit.name};
  if (const auto* polynomial = std::get_if<PolynomialError>(&unit.function)) {
    out.shape = UncertainAmount::Shape::legendre;
    out.order = static_cast<int>(polynomial->coefficients.size()) - 1;
    out.low = polynomial->origin - polynomial->scale;
    out.high = polynomial->origin + polynomial->scale;
  } else if (const auto* fourier = std::get_if<FourierError>(&unit.function)) {
    const FourierError::Term& term = fourier->terms.front();
    out.shape = term.sin == 0.0 ? UncertainAmount::Shape::cosine : UncertainAmount::Shape::sine;
    out.order = static_cast<int>(term.order);
    out.high = fourier->period;
  }
  return out;
}

void state_covariance(const TipFit& fit, std::span<const FoundColumns> found,
                      const MatrixXd& of_columns, ErrorModel& errors) {
  std::vector<UncertainAmount> amounts;
  std::vector<Index> which;
  std::vector<double> unit;
  for (const std::size_t k : fit.solution.determined.kept) {
    amounts.push_back(amount_of(fit.unknowns[k].unit));
    unit.push_back(fit.unknowns[k].largest);
    which.push_back(static_cast<Index>(which.size()));
  }
  Index at = fit.solution.jacobian.cols();
  for (const FoundColumns& one : found) {
    for (std::size_t k = 0; k < one.errors.size(); ++k) {
      amounts.push_back(amount_of(one.errors[k]));
      unit.push_back(1.0);
      which.push_back(at + static_cast<Index>(k));
    }
    at += one.count;
  }
  const auto back =
      Eigen::Map<const VectorXd>(unit.data(), static_cast<Index>(unit.size())).asDiagonal();
  const ErrorCovariance covariance =
      with_names(std::move(amounts), back * MatrixXd(of_columns(which, which)) * back);
  const Given given(fit);
  errors.covariance = given.others;
  const ErrorCovariance components =
      with_names(given.components, given.root * given.root.transpose());
  for (ErrorTerm& term : errors.terms)
    if (is_kept(fit, term.name)) term.u = 0.0;
  add_covariance(errors.covariance, components);
  add_covariance(errors.covariance, covariance);
  gather_uncertainty(errors);
}

VectorXd take_component_errors(const TipFit& fit, const CalibrationOptions& options,
                               Calibration& out) {
  const Together together(fit, out.errors, options);
  together.write(out);
  return together.places();
}

}  // namespace trueaxis::calibrate_detail
