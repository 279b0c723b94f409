// SPDX-License-Identifier: Apache-2.0
#include "compensate/error_bends.hpp"

#include <algorithm>
#include <cmath>

namespace trueaxis {
namespace {

constexpr double lever_mm = 1000.0;

double length_of(const ErrorFunction& function) {
  double least = INFINITY;
  if (const auto* polynomial = std::get_if<PolynomialError>(&function)) {
    if (polynomial->coefficients.size() > 2)
      least = std::abs(polynomial->scale) / static_cast<double>(polynomial->coefficients.size());
  } else if (const auto* waves = std::get_if<FourierError>(&function)) {
    for (const FourierError::Term& term : waves->terms)
      if (term.order != 0.0) least = std::min(least, 0.25 * std::abs(waves->period / term.order));
  } else if (const auto* table = std::get_if<TableError>(&function)) {
    for (std::size_t i = 1; i < table->at.size(); ++i)
      least = std::min(least, table->at[i] - table->at[i - 1]);
  }
  return least;
}

/// Beyond a table's ends its value is held, or the table begins again: with a step, where its ends
/// differ.
double corner_of(const TableError& table) {
  if (table.at.size() < 2) return 0.0;
  if (table.periodic && table.values.front() != table.values.back()) return INFINITY;
  double largest = 0.0, before = 0.0;
  for (std::size_t i = 1; i < table.at.size(); ++i) {
    const double slope = (table.values[i] - table.values[i - 1]) / (table.at[i] - table.at[i - 1]);
    largest = std::max(largest, std::abs(slope - before));
    before = slope;
  }
  const double first = (table.values[1] - table.values[0]) / (table.at[1] - table.at[0]);
  return std::max(largest, table.periodic ? std::abs(first - before) : std::abs(before));
}

}  // namespace

double ErrorBends::off_mm(std::size_t axis, double from, double to) const {
  if (from == to || corner_mm[axis] == 0.0) return 0.0;
  const auto& at = corners[axis];
  const auto first = std::ranges::lower_bound(at, std::min(from, to));
  const bool some = corner_everywhere[axis] || (first != at.end() && *first <= std::max(from, to));
  return some ? 0.25 * corner_mm[axis] * std::abs(to - from) : 0.0;
}

ErrorBends bends_of(const ErrorModel& errors) {
  ErrorBends bends;
  bends.length.fill(INFINITY);
  bends.corner_mm.fill(0.0);
  for (const ErrorTerm& term : errors.terms) {
    if (!term.name.component) continue;
    const std::size_t axis = term.name.body;
    bends.length[axis] = std::min(bends.length[axis], length_of(term.function));
    const auto* table = std::get_if<TableError>(&term.function);
    if (table == nullptr) continue;
    bends.corner_mm[axis] += corner_of(*table) * (term.name.angular() ? lever_mm : 1.0);
    bends.corners[axis].insert(bends.corners[axis].end(), table->at.begin(), table->at.end());
    bends.corner_everywhere[axis] = bends.corner_everywhere[axis] || table->periodic;
  }
  for (std::vector<double>& at : bends.corners) std::ranges::sort(at);
  return bends;
}

}  // namespace trueaxis
