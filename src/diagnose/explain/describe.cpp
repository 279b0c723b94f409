// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnose/explain/explanation.hpp"
#include "diagnose/explain/named_values.hpp"
#include "diagnose/search/causes.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double highest_alias = 60.0;  // no cause makes so many undulations

/// Neighbours in each continuous shape parameter, a pair of either way; empty: there is none, or it
/// is a step that has no derivative.
std::vector<Hypothesis> either_side(const Hypothesis& h, const LinearisationPoint& point) {
  if (is_line(h)) {
    const double f = frequency_of(h), df = 1e-3 * f;
    return {at_frequency(h, f - df), at_frequency(h, f + df)};
  }
  if (!h.effect || (is_step(h.effect->term) && h.shape.duration_s == 0.0)) return {};
  return neighbours(h, point, 0.01);
}

/// What differs within a pair; a slip that lasts has a second one.
double scanned_value(const Hypothesis& h, std::size_t pair) {
  if (is_line(h)) return frequency_of(h);
  if (pair > 0) return h.shape.duration_s;
  const auto& refined = h.effect->refinement;
  return refined ? h.shape.*refined->parameter : h.shape.time_constant_s;
}

/// The covariance of the term's coefficients, in the joint solution.
Eigen::MatrixXd inverse_of(const Joint& joint, std::size_t term) {
  auto at = static_cast<Eigen::Index>(joint.equations.base().size());
  for (std::size_t t = 0; t < term; ++t) at += static_cast<Eigen::Index>(joint.places[t].size());
  const auto count = static_cast<Eigen::Index>(joint.places[term].size());
  return joint.solution.inverse.block(at, at, count, count);
}

/// Whether base and other terms leave all columns of a term: else its sizes share the rest.
bool is_determined(const Joint& joint, std::size_t term) {
  return score(project(joint.equations.total(), joint.besides(term)), joint.places[term]).rank ==
         joint.places[term].size();
}

}  // namespace

TermValue fitted(const Hypothesis& h, const Eigen::VectorXd& coefficients,
                 const Eigen::MatrixXd& covariance) {
  TermValue out = h;
  const auto free = static_cast<std::size_t>(coefficients.size());
  std::vector<std::string> names;
  for (const LinearParameter& one : h.parameters()) names.push_back(one.name);
  const std::size_t count = names.size();
  const auto place = [&](std::size_t j) { return count == free ? j : h.free[j]; };
  out.linear.assign(count, 0.0);
  for (std::size_t j = 0; j < free; ++j)
    out.linear[place(j)] = coefficients(static_cast<Eigen::Index>(j));
  if (covariance.size() == 0) return out;
  out.covariance = Covariance(std::move(names));
  for (std::size_t i = 0; i < free; ++i) {
    for (std::size_t j = 0; j < free; ++j)
      out.covariance(place(i), place(j)) =
          covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }
  return out;
}

Eigen::MatrixXd covariance_of(const Joint& joint, std::size_t term) {
  return joint.sigma_mm * joint.sigma_mm * inverse_of(joint, term);
}

std::vector<FitParameter> parameters_of(const Problem& problem, const Model& model,
                                        const Joint& joint, std::size_t term) {
  const Hypothesis& h = model.terms[term];
  const Eigen::VectorXd coefficients = joint.of(term);
  const std::vector<NamedValue> values = values_of(fitted(h, coefficients));
  const auto count = static_cast<Eigen::Index>(coefficients.size());
  const Eigen::MatrixXd covariance = covariance_of(joint, term);

  const auto difference = [](const NamedValue& a, const NamedValue& b) {
    return a.unit == "rad" ? std::remainder(a.value - b.value, two_pi) : a.value - b.value;
  };
  std::vector<double> variance(values.size(), 0.0);
  Eigen::MatrixXd slope(static_cast<Eigen::Index>(values.size()), count);
  for (Eigen::Index j = 0; j < count; ++j) {
    const double step = 1e-4 * std::max(coefficients.norm(), 1e-12);
    Eigen::VectorXd up = coefficients, down = coefficients;
    up(j) += step, down(j) -= step;
    const auto above = values_of(fitted(h, up)), below = values_of(fitted(h, down));
    for (std::size_t v = 0; v < values.size(); ++v)
      slope(static_cast<Eigen::Index>(v), j) = difference(above[v], below[v]) / (2.0 * step);
  }
  for (std::size_t v = 0; v < values.size(); ++v) {
    const Eigen::VectorXd g = slope.row(static_cast<Eigen::Index>(v));
    variance[v] = g.dot(covariance * g);
  }
  const std::vector<Hypothesis> sides = either_side(h, problem.point);
  std::vector<Hypothesis> terms = model.terms;
  const auto at_side = [&](const Hypothesis& side) {
    terms[term] = side;
    return Joint(problem, model.phi, terms, terms.size());
  };
  for (std::size_t pair = 0; 2 * pair + 1 < sides.size(); ++pair) {
    const Hypothesis &before = sides[2 * pair], &after = sides[2 * pair + 1];
    const Joint low = at_side(before), high = at_side(after);
    const double x0 = scanned_value(h, pair), x1 = scanned_value(before, pair),
                 x2 = scanned_value(after, pair);
    const double d1 = x1 - x0, d2 = x2 - x0;
    // RSS = RSS₀ + ½ c (x − x₀)² near the minimum: u² = 2 σ²/c.
    const double curvature = d1 != 0.0 && d2 != 0.0 && d1 != d2
                                 ? 2.0 *
                                       ((high.solution.rss - joint.solution.rss) / d2 -
                                        (low.solution.rss - joint.solution.rss) / d1) /
                                       (d2 - d1)
                                 : 0.0;
    if (curvature > 0.0) {
      const double u = joint.sigma_mm * std::sqrt(2.0 / curvature);
      const auto below = values_of(fitted(before, low.of(term))),
                 above = values_of(fitted(after, high.of(term)));
      for (std::size_t v = 0; v < values.size(); ++v) {
        const double g = difference(above[v], below[v]) / (x2 - x1);
        variance[v] += g * g * u * u;
      }
    }
  }
  std::vector<FitParameter> out;
  const bool determined = is_determined(joint, term);
  const double interval = (problem.point.time.back() - problem.point.time.front()) /
                          static_cast<double>(problem.point.size());
  for (std::size_t v = 0; v < values.size(); ++v) {
    FitParameter p{values[v].name, {values[v].value, std::sqrt(variance[v]), values[v].unit, ""}};
    if (is_step(h.effect->term) && p.estimate.unit == "s") {       // a date or a duration
      if (p.name != "onset" && p.estimate.value == 0.0) continue;  // a step, an even creep
      if (!problem.point.has_time) p.estimate.unit = "reading";
      p.estimate.u = std::hypot(p.estimate.u, interval / std::sqrt(12.0));
    } else if (!determined) {
      p.estimate = {.unit = p.estimate.unit,
                    .why_not = "the readings after it do not show all that moved"};
    }
    out.push_back(std::move(p));
  }
  return out;
}

Unexplained unexplained_of(const Joint& joint, std::size_t term) {
  const Eigen::VectorXd c = joint.of(term);
  Unexplained out;
  out.term = fitted(joint.terms[term], c, covariance_of(joint, term));
  const double amplitude = c.norm();
  const double spread = std::sqrt(c.dot(inverse_of(joint, term) * c));
  const double u = amplitude > 0.0 ? joint.sigma_mm * spread / amplitude : 0.0;
  out.amplitude = {c.size() == 1 ? c(0) : amplitude, u, "mm", ""};
  return out;
}

std::string alias_of(const Hypothesis& h, const Resolution& resolution) {
  if (!h.effect || !resolution.whole) return "";
  const auto* harmonic = std::get_if<Harmonic>(&h.effect->term);
  if (!harmonic) return "";
  const double order = harmonic->fixed_order > 0.0 ? harmonic->fixed_order : h.shape.order;
  const double m = std::round(resolution.per_turn), other = m - order;
  if (other == order)
    return fmt::format(
        "{:g} of another phase: {:g} readings per revolution show one phase of order {:g}, at "
        "least this much; use an asynchronous rate",
        other, m, order);
  if (other <= 0.0 || other > highest_alias) return "";
  return fmt::format(
      "{:g} or {:g}: with {:g} readings per revolution, orders n and k {:g} ± n look alike; use "
      "{:g}, which separate all orders up to {:g}, or an asynchronous rate",
      other, m + order, m, m, 2.0 * other + 1.0, other);
}

}  // namespace trueaxis::diagnose_detail
