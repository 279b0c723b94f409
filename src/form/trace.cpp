// SPDX-License-Identifier: Apache-2.0
#include "form/trace.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "trueaxis/error.hpp"

namespace trueaxis::form {
namespace {

constexpr double one_place = 0.1;  // of the step of one turn: angles that jitter or are rounded

/// One place that rounding set down before the end of the turn and after its beginning.
void join_ends(const std::vector<std::size_t>& counts, Trace& trace) {
  const auto first = static_cast<double>(counts.front()), last = static_cast<double>(counts.back());
  const double share = last / (first + last);
  const double place = trace.at.front() - share * trace.step(trace.size() - 1);
  trace.value_mm.front() = (1.0 - share) * trace.value_mm.front() + share * trace.value_mm.back();
  trace.at.pop_back();
  trace.value_mm.pop_back();
  trace.at.front() = place;
  if (place >= 0.0) return;
  std::ranges::rotate(trace.at, trace.at.begin() + 1);
  std::ranges::rotate(trace.value_mm, trace.value_mm.begin() + 1);
  trace.at.back() += trace.period;
}

}  // namespace

double Trace::step(std::size_t i) const {
  return i + 1 < at.size() ? at[i + 1] - at[i] : at.front() + period - at.back();
}

std::vector<Gap> gaps_of(const Trace& trace, double longest) {
  std::vector<Gap> gaps;
  const std::size_t steps = trace.closed() ? trace.size() : trace.size() - 1;
  for (std::size_t i = 0; i < steps; ++i)
    if (trace.step(i) > longest) gaps.push_back({i, trace.at[i], trace.step(i)});
  return gaps;
}

std::vector<double> shares_of(const Trace& trace, double longest_step) {
  const std::size_t n = trace.size();
  std::vector<double> shares(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const bool first = i == 0, last = i + 1 == n;
    double before = first ? (trace.closed() ? trace.step(n - 1) : 0.0) : trace.step(i - 1);
    double behind = last && !trace.closed() ? 0.0 : trace.step(i);
    if (before > longest_step) before = 0.0;
    if (behind > longest_step) behind = 0.0;
    shares[i] = before > 0.0 && behind > 0.0 ? 0.5 * (before + behind) : std::max(before, behind);
    if (shares[i] == 0.0) shares[i] = longest_step;  // alone between two gaps
  }
  return shares;
}

Trace sorted_trace(std::span<const double> at, std::span<const double> value_mm, double period,
                   double turns, std::size_t most) {
  expects(at.size() == value_mm.size(), "a value for every place");
  std::vector<double> places(at.begin(), at.end());
  if (period > 0.0)
    for (double& place : places) {
      place -= period * std::floor(place / period);
      if (place >= period) place = 0.0;
    }
  std::vector<std::size_t> order(at.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return places[i]; });
  const double extent = order.empty() ? 0.0 : places[order.back()] - places[order.front()];
  const double step = extent * turns / static_cast<double>(std::max<std::size_t>(1, order.size()));
  const double together =
      std::max(one_place * step, most > 0 ? extent / static_cast<double>(most) : 0.0);
  Trace trace;
  trace.period = period;
  std::vector<std::size_t> counts;
  for (std::size_t k = 0; k < order.size();) {
    double at_sum = 0.0, sum = 0.0;
    std::size_t count = 0;
    const double place = places[order[k]];
    for (; k < order.size() && places[order[k]] - place <= together; ++k, ++count) {
      at_sum += places[order[k]] - place;
      sum += value_mm[order[k]];
    }
    trace.at.push_back(place + at_sum / static_cast<double>(count));
    trace.value_mm.push_back(sum / static_cast<double>(count));
    counts.push_back(count);
  }
  if (trace.closed() && trace.size() > 1 && trace.step(trace.size() - 1) <= together)
    join_ends(counts, trace);
  return trace;
}

}  // namespace trueaxis::form
