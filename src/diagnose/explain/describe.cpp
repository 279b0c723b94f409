// SPDX-License-Identifier: Apache-2.0
#include "diagnose/explain/describe.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "diagnose/search/causes.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double highest_alias = 60.0;  // no cause makes so many undulations

void add_shape(const Hypothesis& h, std::vector<NamedValue>& out) {
  const auto& refined = h.effect->refinement;
  // A shape that none of the free parameters reads is not told.
  const bool unread =
      refined && refined->reader && std::ranges::find(h.free, *refined->reader) == h.free.end();
  for (const std::string& name : shape_parameters(h.effect->term)) {
    const EffectParameter* told = parameter_for(*h.effect, name);
    if (!told || unread) continue;
    out.push_back({std::string(told->name), std::string(told->unit), shape_value(h.shape, name)});
  }
}

/// Neighbours in the one continuous shape parameter, `step` either way; empty: there is none, or it
/// is a step that has no derivative.
std::vector<Hypothesis> either_side(const Hypothesis& h, const LinearisationPoint& point) {
  if (is_line(h)) {
    const double f = frequency_of(h), df = 1e-3 * f;
    return {at_frequency(h, f - df), at_frequency(h, f + df)};
  }
  if (!h.effect || is_step(h.effect->term)) return {};
  return neighbours(h, point, 0.01);
}

double scanned_value(const Hypothesis& h) {
  return is_line(h) ? frequency_of(h) : h.shape.*h.effect->refinement->parameter;
}

}  // namespace

std::vector<double> linear_of(const Hypothesis& h, const Eigen::VectorXd& coefficients) {
  if (!h.effect || h.free.empty())
    return {coefficients.data(), coefficients.data() + coefficients.size()};
  std::vector<double> all(linear_parameters(h.effect->term, h.shape).size(), 0.0);
  for (std::size_t j = 0; j < h.free.size(); ++j)
    all[h.free[j]] = coefficients(static_cast<Eigen::Index>(j));
  return all;
}

std::vector<NamedValue> values_of(const Hypothesis& h, const Eigen::VectorXd& coefficients) {
  std::vector<NamedValue> out;
  const auto names = linear_parameters(h.effect->term, h.shape);
  const std::vector<double> linear = linear_of(h, coefficients);
  const auto free = [&](std::size_t j) {
    return h.free.empty() || std::ranges::find(h.free, j) != h.free.end();
  };
  for (std::size_t j = 0; j < names.size(); ++j) {
    if (!free(j)) continue;
    const std::string& name = names[j].name;
    if (!name.ends_with("_cos")) {
      const EffectParameter* told = parameter_for(*h.effect, name);
      out.push_back({told ? std::string(told->name) : name, names[j].unit, linear[j]});
      continue;
    }
    const std::string of = name.substr(0, name.size() - 4);
    const double c = linear[j], s = linear[j + 1];
    out.push_back({of, names[j].unit, std::hypot(c, s)});
    const double phase = std::atan2(h.effect->line ? -s : s, c);
    if (has_two_orders(h.effect->term) && of == "amplitude") {
      out.push_back({"jaw_angle", "rad", phase / h.shape.order});
    } else {
      out.push_back({of == "amplitude" ? "phase" : of + "_phase", "rad", phase});
    }
    ++j;
  }
  add_shape(h, out);
  return out;
}

std::vector<FitParameter> parameters_of(const Problem& problem, const Model& model,
                                        const Joint& joint, std::size_t term) {
  const Hypothesis& h = model.terms[term];
  const Eigen::VectorXd coefficients = joint.of(term);
  const std::vector<NamedValue> values = values_of(h, coefficients);
  const auto count = static_cast<Eigen::Index>(coefficients.size());
  auto at = static_cast<Eigen::Index>(joint.equations.base().size());
  for (std::size_t t = 0; t < term; ++t) at += static_cast<Eigen::Index>(joint.places[t].size());
  const Eigen::MatrixXd covariance =
      joint.sigma_mm * joint.sigma_mm * joint.solution.inverse.block(at, at, count, count);

  const auto difference = [](const NamedValue& a, const NamedValue& b) {
    return a.unit == "rad" ? std::remainder(a.value - b.value, two_pi) : a.value - b.value;
  };
  std::vector<double> variance(values.size(), 0.0);
  Eigen::MatrixXd slope(static_cast<Eigen::Index>(values.size()), count);
  for (Eigen::Index j = 0; j < count; ++j) {
    const double step = 1e-4 * std::max(coefficients.norm(), 1e-12);
    Eigen::VectorXd up = coefficients, down = coefficients;
    up(j) += step, down(j) -= step;
    const auto above = values_of(h, up), below = values_of(h, down);
    for (std::size_t v = 0; v < values.size(); ++v)
      slope(static_cast<Eigen::Index>(v), j) = difference(above[v], below[v]) / (2.0 * step);
  }
  for (std::size_t v = 0; v < values.size(); ++v) {
    const Eigen::VectorXd g = slope.row(static_cast<Eigen::Index>(v));
    variance[v] = g.dot(covariance * g);
  }
  const std::vector<Hypothesis> sides = either_side(h, problem.point);
  if (sides.size() == 2) {
    std::vector<Hypothesis> terms = model.terms;
    const auto at_side = [&](const Hypothesis& side) {
      terms[term] = side;
      return Joint(problem, model.phi, terms, terms.size());
    };
    const Joint low = at_side(sides[0]), high = at_side(sides[1]);
    const double x0 = scanned_value(h), x1 = scanned_value(sides[0]), x2 = scanned_value(sides[1]);
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
      const auto below = values_of(sides[0], low.of(term)),
                 above = values_of(sides[1], high.of(term));
      for (std::size_t v = 0; v < values.size(); ++v) {
        const double g = difference(above[v], below[v]) / (x2 - x1);
        variance[v] += g * g * u * u;
      }
    }
  }
  std::vector<FitParameter> out;
  for (std::size_t v = 0; v < values.size(); ++v) {
    const bool angle = values[v].unit == "rad";
    const double factor = angle ? 1.0 / rad_per_deg : 1.0;
    FitParameter p{values[v].name,
                   {values[v].value * factor, std::sqrt(variance[v]) * factor,
                    angle ? "deg" : values[v].unit, ""}};
    if (p.name == "onset")
      p.estimate.u = 1.0 / std::sqrt(12.0) *
                     (problem.point.time.back() - problem.point.time.front()) /
                     static_cast<double>(problem.point.size());
    out.push_back(std::move(p));
  }
  return out;
}

Unexplained unexplained_of(const Joint& joint, std::size_t term) {
  const Pattern& p = joint.terms[term].pattern;
  const Eigen::VectorXd c = joint.of(term);
  auto at = static_cast<Eigen::Index>(joint.equations.base().size());
  for (std::size_t t = 0; t < term; ++t) at += static_cast<Eigen::Index>(joint.places[t].size());
  Unexplained out;
  out.order = p.order;
  out.degree = p.kind == Pattern::Kind::line ? -1 : p.degree;
  out.z_frequency = p.in_time ? 0.0 : p.frequency;
  out.in_time = p.in_time;
  out.part_frame = !p.spindle;
  out.linear.assign(c.data(), c.data() + c.size());
  char text[160];
  std::snprintf(text, sizeof text, "%.4g UPR", p.order);
  out.harmonic = text;
  const char* along = p.in_time ? "time" : "Z";
  if (p.kind == Pattern::Kind::bump) {
    out.harmonic = "local form";
    std::snprintf(text, sizeof text, "at %.1f° (± %.1f°)", p.angle_rad / rad_per_deg,
                  p.width_rad / rad_per_deg);
    out.dependence = text;
    if (p.length_mm > 0.0) {
      std::snprintf(text, sizeof text, ", Z %.2f mm (± %.2f mm)", p.position_mm, p.length_mm);
      out.dependence += text;
    }
  } else if (p.kind == Pattern::Kind::line) {
    std::snprintf(text, sizeof text,
                  p.in_time ? "turning with %.4g Hz" : "turning along Z, %.4g per mm", p.frequency);
    out.dependence = text;
  } else if (p.degree == 0) {
    out.dependence = std::string("constant along ") + along;
  } else {
    if (p.degree == 1)
      std::snprintf(text, sizeof text, "linear in %s", along);
    else
      std::snprintf(text, sizeof text, "P%d in %s", p.degree, along);
    out.dependence = text;
  }
  const double amplitude = c.norm();
  const Eigen::MatrixXd inverse = joint.solution.inverse.block(at, at, c.size(), c.size());
  const double u =
      amplitude > 0.0 ? joint.sigma_mm * std::sqrt(c.dot(inverse * c)) / amplitude : 0.0;
  out.amplitude = {c.size() == 1 ? c(0) : amplitude, u, "mm", ""};
  return out;
}

std::string alias_of(const Hypothesis& h, const Resolution& resolution) {
  if (!h.effect || !resolution.whole) return "";
  const auto* harmonic = std::get_if<Harmonic>(&h.effect->term);
  if (!harmonic) return "";
  const double order = harmonic->fixed_order > 0.0 ? harmonic->fixed_order : h.shape.order;
  const double m = std::round(resolution.per_turn), other = m - order;
  if (other <= 0.0 || other == order || other > highest_alias) return "";
  char text[160];
  std::snprintf(text, sizeof text,
                "%g: with %g readings a revolution orders n and %g - n are one column; take an "
                "asynchronous rate",
                other, m, m);
  return text;
}

}  // namespace trueaxis::diagnose_detail
