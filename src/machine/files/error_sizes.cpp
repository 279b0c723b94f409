// SPDX-License-Identifier: Apache-2.0
#include "machine/files/error_sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "machine/files/toml_parts.hpp"

namespace trueaxis {
namespace {

constexpr double least_travel_mm = 500.0;

struct Size {
  PositionRange range;

  double operator()(const ConstantError& error) const { return std::abs(error.value); }
  double operator()(const PolynomialError& error) const {
    constexpr int points = 64;
    double most = 0.0;
    for (int i = 0; i <= points; ++i)
      most = std::max(most,
                      std::abs(value_at(error, range.low + (range.high - range.low) * i / points)));
    return most;
  }
  double operator()(const FourierError& error) const {
    double sum = 0.0;
    for (const FourierError::Term& term : error.terms) sum += std::hypot(term.cos, term.sin);
    return sum;
  }
  double operator()(const TableError& error) const {
    double most = 0.0;
    for (const double value : error.values) most = std::max(most, std::abs(value));
    return most;
  }
};

std::string shown(const ErrorName& name, double size) {
  return name.angular() ? fmt::format("{:.4g}°", size / rad_per_deg)
                        : fmt::format("{:.4g} mm", size);
}

}  // namespace

double largest_size(const ErrorName& name) {
  if (name.body == workpiece_body) return name.angular() ? 5.0 * rad_per_deg : 10.0;
  if (name.component) return name.angular() ? 2e-3 : 1.0;
  return name.angular() ? 10e-3 : 5.0;
}

double size_of(const ErrorFunction& function, const PositionRange& range) {
  return std::visit(Size{range}, function);
}

PositionRange range_of(const ErrorFunction& function, const ErrorName& name,
                       const Machine& machine) {
  const auto* const polynomial = std::get_if<PolynomialError>(&function);
  if (polynomial == nullptr || name.body >= axis_count) return {};
  const auto axis = static_cast<AxisName>(name.body);
  const double around = polynomial->origin;
  if (polynomial->scale != edge_unit(axis))
    return {around - std::abs(polynomial->scale), around + std::abs(polynomial->scale)};
  const MachineAxis* const found = machine.find(axis);
  if (found != nullptr && std::isfinite(found->low) && std::isfinite(found->high))
    return {found->low, found->high};
  const double half = is_rotary(axis) ? 0.5 * two_pi : 0.5 * least_travel_mm;
  return {around - half, around + half};
}

std::string size_trouble(const ErrorName& name, double size) {
  const double most = largest_size(name);
  if (!(std::abs(size) > most)) return "";
  return fmt::format(
      "makes {} {}, and {} beyond {} is probably in another unit: correct the unit, or confirm the "
      "size with large_errors = true (on the command line --large-errors)",
      to_string(name), shown(name, size),
      name.body == workpiece_body ? "an error of a workpiece"
      : name.component            ? "a component error"
                                  : "a location error",
      shown(name, most));
}

bool has_large_errors(const ErrorModel& errors, const Machine& machine) {
  const bool term = std::ranges::any_of(errors.terms, [&](const ErrorTerm& one) {
    const double size = size_of(one.function, range_of(one.function, one.name, machine));
    return std::max(size, one.u) > largest_size(one.name);
  });
  const ErrorCovariance& of = errors.covariance;
  for (std::size_t i = 0; i < of.size(); ++i)
    if (of.u(i) > largest_size(of.names()[i].name)) return true;
  return term;
}

}  // namespace trueaxis
