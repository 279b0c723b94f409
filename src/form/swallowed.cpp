// SPDX-License-Identifier: Apache-2.0
#include "form/swallowed.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>
#include <string_view>

#include "form/sampling.hpp"
#include "math/linear_algebra.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::form {
namespace {

constexpr double least_standard_upr = 15.0;
constexpr double taken = 0.05;      // share of an amplitude
constexpr double by_chance = 1e-4;  // of an order that is not there
constexpr std::array<std::string_view, 8> resting_on_lobes{
    "RONt", "RONp", "RONv", "RONq", "CYLt", "CONt", "runout_circular", "runout_total"};

/// An order of every section: a line along Z of its coefficients, by weighted least squares.
class OrderAlongZ {
 public:
  OrderAlongZ(const std::vector<SectionModel>& sections, int order) {
    const auto z_of = [](const SectionModel& one) { return one.z_mm().value_or(0.0); };
    const auto [low, high] = std::ranges::minmax(sections | std::views::transform(z_of));
    const bool grows = sections.size() > 2 && high > low;
    const Eigen::Index count = grows ? 2 : 1;
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(count, 2);
    for (const SectionModel& one : sections) {
      const auto found = std::ranges::find(one.orders(), order, &Order::order);
      if (found == one.orders().end()) return;
      const double u = std::max(one.noise_mm() * found->u_per_sigma, 1e-12);
      Eigen::VectorXd row = Eigen::VectorXd::Ones(count);
      if (grows) row(1) = (2.0 * one.z_mm().value_or(0.0) - low - high) / (high - low);
      normal += row * row.transpose() / (u * u);
      right += row * Eigen::RowVector2d(found->cos_mm, found->sin_mm) / (u * u);
    }
    const Eigen::MatrixXd inverse = linear::inverse(normal);
    const Eigen::MatrixXd found = inverse * right;
    for (Eigen::Index j = 0; j < count; ++j) {
      amplitude_mm += found.row(j).norm();
      u_mm = std::hypot(u_mm, std::sqrt(inverse(j, j)));
    }
    // Squares over the variance of `count` pairs: a chi-squared sum of 2 count.
    chi_squared = (found.transpose() * normal * found).trace();
    degrees = 2 * static_cast<int>(count);
  }

  double amplitude_mm = 0.0, u_mm = 0.0;

  /// In noise less often than 1 in 10^4: the tail of chi-squared with 2 or 4 degrees.
  bool is_there() const {
    const double half = 0.5 * chi_squared;
    return degrees > 0 &&
           (degrees == 2 ? std::exp(-half) : (1.0 + half) * std::exp(-half)) < by_chance;
  }

 private:
  double chi_squared = 0.0;
  int degrees = 0;
};

}  // namespace

bool is_swallowed(const FormOptions& options, double passed) {
  return options.filter != ProfileFilter::none && options.high_upr < least_standard_upr &&
         1.0 - passed > taken;
}

std::vector<SwallowedLobes> swallowed_lobes(const std::vector<SectionModel>& sections,
                                            const FormOptions& options) {
  std::vector<SwallowedLobes> out;
  if (sections.empty()) return out;
  const double step_rad = two_pi / static_cast<double>(sections.front().raw().size());
  for (const Order& one : sections.front().orders()) {
    if (one.order < 2) continue;
    const double passed = passed_by_low_pass(options, one.order, step_rad);
    if (!is_swallowed(options, passed)) continue;
    const OrderAlongZ order(sections, one.order);
    if (order.is_there()) out.push_back({one.order, order.amplitude_mm, order.u_mm, passed});
  }
  return out;
}

void withhold_swallowed(FormResult& result) {
  if (result.swallowed.empty()) return;
  const double k = result.options.coverage_factor;
  double lost_mm = 0.0;
  for (const SwallowedLobes& one : result.swallowed)
    lost_mm += 2.0 * (1.0 - one.passed) * (one.amplitude_mm + k * one.u_mm);
  bound_values(result, lost_mm,
               fmt::format("the filter of {:g} UPR suppresses part of the lobes found",
                           result.options.high_upr));
}

void bound_values(FormResult& result, double lost_mm, const std::string& why) {
  const double k = result.options.coverage_factor;
  const auto withhold = [&](std::vector<FormValue>& values) {
    for (FormValue& one : values) {
      if (std::ranges::find(resting_on_lobes, one.name) == resting_on_lobes.end()) continue;
      Estimate& e = one.estimate;
      if (e.interval) {
        e.interval->front() = std::max(0.0, e.interval->front() - lost_mm);
        e.interval->back() += lost_mm;
        continue;
      }
      const double U_mm = k * e.u + lost_mm;
      e = {.unit = e.unit,
           .why_not = why,
           .interval = std::array{std::max(0.0, e.value - U_mm), e.value + U_mm}};
    }
  };
  for (SectionForm& section : result.sections) withhold(section.values);
  for (FormGroup& group : result.groups) withhold(group.values);
}

}  // namespace trueaxis::form
