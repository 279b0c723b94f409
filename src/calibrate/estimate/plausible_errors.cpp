// SPDX-License-Identifier: Apache-2.0
#include "calibrate/estimate/plausible_errors.hpp"

#include <algorithm>
#include <cmath>

namespace trueaxis::calibrate_detail {
namespace {

constexpr int last_degree = 3, last_order = 4;
constexpr double least_travel_mm = 500.0;  // of an axis without limits

/// Limits of a linear axis, or without them the travel of the data, 500 mm at least.
AxisRange travel_of(const Problem& problem, const MachineAxis& axis) {
  AxisRange range = axis_range(problem, axis.name);
  const double more = 0.5 * std::max(0.0, least_travel_mm - range.length());
  range.low -= more;
  range.high += more;
  if (std::isfinite(axis.low)) range.low = axis.low;
  if (std::isfinite(axis.high)) range.high = axis.high;
  return range;
}

/// An amount of the given order whose share of the variance falls off as its square; `sum` is that
/// over all orders.
void add(PlausibleError& error, const UncertainAmount& amount, double sum) {
  error.amounts.push_back(amount);
  error.shares.push_back(1.0 / (amount.order * amount.order * sum * mean_square(amount)));
}

void add_polynomials(const AxisRange& travel, int first, PlausibleError& error) {
  double sum = 0.0;
  for (int k = first; k <= last_degree; ++k) sum += 1.0 / (k * k);
  for (int k = first; k <= last_degree; ++k)
    add(error, {error.name, UncertainAmount::Shape::legendre, k, travel.low, travel.high}, sum);
}

void add_harmonics(PlausibleError& error) {
  double sum = 0.0;
  for (int n = 1; n <= last_order; ++n) sum += 2.0 / (n * n);
  for (int n = 1; n <= last_order; ++n) {
    add(error, {error.name, UncertainAmount::Shape::cosine, n, 0.0, two_pi}, sum);
    add(error, {error.name, UncertainAmount::Shape::sine, n, 0.0, two_pi}, sum);
  }
}

/// Whether two errors are of one rotary axis across it, both lengths or both angles.
bool are_radial_pair(const ErrorName& a, const ErrorName& b) {
  constexpr std::size_t first_rotary = 3;
  return a.body == b.body && b.body >= first_rotary && a.angular() == b.angular() &&
         a.direction % 3 != a.body % 3 && b.direction % 3 != b.body % 3;
}

}  // namespace

double mean_square(const UncertainAmount& amount) {
  if (amount.shape == UncertainAmount::Shape::legendre) return 1.0 / (2.0 * amount.order + 1.0);
  return amount.shape == UncertainAmount::Shape::constant ? 1.0 : 0.5;
}

std::vector<PlausibleError> plausible_errors(const Problem& problem,
                                             const std::vector<ErrorName>& known,
                                             const std::vector<ErrorName>& polynomials,
                                             const PlausibleSizes& sizes) {
  std::vector<PlausibleError> out;
  for (const MachineAxis& axis : problem.machine->axes)
    for (std::size_t i = 0; i < 6; ++i) {
      const bool rotary = is_rotary(axis.name);
      // Of a rotary axis the two directions across it follow each other: they share a size.
      const std::size_t first = rotary ? index_of(axis.name) % 3 + 1 : 0;
      PlausibleError error;
      error.name = {true, i / 3 * 3 + (first + i) % 3, index_of(axis.name)};
      if (std::ranges::find(known, error.name) != known.end()) continue;
      error.plausible = sizes.of(rotary, error.name.angular());
      if (rotary)
        add_harmonics(error);
      else
        add_polynomials(travel_of(problem, axis),
                        !error.name.angular() && error.name.direction != error.name.body ? 2 : 1,
                        error);
      if (rotary && std::ranges::find(polynomials, error.name) != polynomials.end()) {
        add_polynomials(axis_range(problem, axis.name), 1, error);
        for (double& share : error.shares) share *= 0.5;
      }
      out.push_back(std::move(error));
    }
  return out;
}

std::vector<RandomGroup> groups_of(std::vector<PlausibleError>& errors) {
  std::vector<RandomGroup> out;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const auto& [name, size, amounts, shares, group] = errors[i];
    const Eigen::Map<const VectorXd> own(shares.data(), static_cast<Index>(shares.size()));
    if (i > 0 && are_radial_pair(errors[i - 1].name, name)) {
      VectorXd& of_both = out.back().shares;
      of_both.conservativeResize(of_both.size() + own.size());
      of_both.tail(own.size()) = own;
    } else {
      out.push_back({size, own});
    }
    errors[i].group = out.size() - 1;
  }
  return out;
}

MatrixXd amount_columns(const Problem& problem, const Geometry& geometry,
                        const std::vector<UncertainAmount>& amounts) {
  MatrixXd out(problem.equations, static_cast<Index>(amounts.size()));
  for (std::size_t i = 0; i < amounts.size(); ++i)
    out.col(static_cast<Index>(i)) =
        error_column(problem, geometry, {amounts[i].name, amounts[i].unit(), 0.0});
  return out;
}

}  // namespace trueaxis::calibrate_detail
