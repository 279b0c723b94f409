// SPDX-License-Identifier: Apache-2.0
#include "compensate/tally.hpp"

namespace trueaxis {
namespace {

template <class List>
void append(List& list, const List& later) {
  for (const auto& one : later)
    if (list.empty() || list.back().line != one.line) list.push_back(one);
}

}  // namespace

void Tally::add(const Tally& later) {
  for (std::size_t k = 0; k < axis_count; ++k) {
    take(sums.largest_change[k], later.sums.largest_change[k]);
    take(sums.exact_minus_differential[k], later.sums.exact_minus_differential[k]);
  }
  take(sums.before, later.sums.before);
  take(sums.after, later.sums.after);
  take(sums.rounding, later.sums.rounding);
  take(sums.between_before, later.sums.between_before);
  take(sums.between_after, later.sums.between_after);
  take(sums.about_tool_axis, later.sums.about_tool_axis);
  append(sums.singular, later.sums.singular);
  append(sums.unreachable, later.sums.unreachable);
  if (by_error.size() < later.by_error.size()) by_error.resize(later.by_error.size());
  for (std::size_t i = 0; i < later.by_error.size(); ++i) take(by_error[i], later.by_error[i]);
  take(u_tip, later.u_tip);
}

}  // namespace trueaxis
