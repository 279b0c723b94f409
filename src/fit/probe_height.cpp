// SPDX-License-Identifier: Apache-2.0
#include "fit/probe_height.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fit/describe.hpp"

namespace trueaxis {

void add_square_of_height(std::span<const Influence> influences, FitResult& fit) {
  const auto height =
      std::ranges::find(influences, Influence::Kind::probe_height, &Influence::kind);
  const double radius_mm = fit.shape.radius_mm, tan = fit.shape.tan_half_angle;
  if (height == influences.end() || !(radius_mm > 0.0) || fit.parameters.empty() ||
      std::ranges::find(fit.budget, square_of_height, &BudgetLine::source) != fit.budget.end())
    return;
  // The root mean square of h²/2R over a normal h.
  const double off_mm = std::sqrt(3.0) * height->u * height->u / (2.0 * radius_mm);
  const auto off = [&](const std::string& name) {
    return name.starts_with("radius") ? off_mm : name == "k" && tan != 0.0 ? -off_mm / tan : 0.0;
  };
  const auto widen = [&](std::vector<FitParameter>& list) {
    for (FitParameter& one : list) one.estimate.u = std::hypot(one.estimate.u, off(one.name));
  };
  BudgetLine line{square_of_height, 'B', {}};
  for (std::size_t p = 0; p < fit.parameters.size(); ++p) {
    line.u.push_back(std::abs(off(fit.parameters[p].name)));
    for (std::size_t q = 0; q < fit.parameters.size(); ++q)
      fit.covariance(p, q) += off(fit.parameters[p].name) * off(fit.parameters[q].name);
  }
  if (std::ranges::max(line.u) == 0.0) return;
  fit.budget.push_back(std::move(line));
  widen(fit.parameters), widen(fit.derived);
  for (SetUpFit& one : fit.set_ups) widen(one.parameters);
  add_apex_interval(fit.parameters, fit.covariance, fit.coverage_factor);
}

bool holds_on_centre_height(const FitResult& fit) {
  const bool has_height = std::ranges::any_of(fit.budget, [](const BudgetLine& line) {
    return line.source.starts_with(info_of(Influence::Kind::probe_height).name);
  });
  return !fit.budget.empty() && !has_height && radius_U_mm(fit) > 0.0;
}

}  // namespace trueaxis
