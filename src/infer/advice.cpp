// SPDX-License-Identifier: Apache-2.0
#include "infer/advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace trueaxis::infer {
namespace {

constexpr double share_of_best = 0.8;  // of the largest rise: among these the fastest wins
constexpr double worth_taking = 0.02;

Separating nothing_helps(double before, const std::string& why) {
  return {"", "", before, before, 0.0, why, {}};
}

}  // namespace

Separating choose(std::span<const Measure> measures, double before,
                  const std::vector<double>& after, double sure, const std::string& nothing) {
  const auto top = std::ranges::max_element(after);
  const double most = std::max(0.0, (top == after.end() ? before : *top) - before);
  if (most < worth_taking) return nothing_helps(before, nothing);
  if (*top < sure) {
    const Measure& m = measures[static_cast<std::size_t>(top - after.begin())];
    return nothing_helps(
        before, fmt::format("{} for sure: the best, {}, raises the probability to {:.2f}", nothing,
                            m.code, *top));
  }
  const auto helps = [&](std::size_t m) {
    return after[m] >= sure && after[m] - before >= share_of_best * most;
  };
  std::size_t best = measures.size();
  for (std::size_t m = 0; m < measures.size(); ++m)
    if (helps(m) && (best == measures.size() || measures[m].minutes < measures[best].minutes))
      best = m;
  Separating out{measures[best].code,
                 measures[best].what,
                 before,
                 after[best],
                 measures[best].minutes,
                 "",
                 {}};
  for (std::size_t m = 0; m < measures.size(); ++m)
    if (m != best && helps(m))
      out.others.push_back({measures[m].code, measures[m].what, after[m], measures[m].minutes});
  std::ranges::stable_sort(out.others, {}, &Separating::Other::minutes);
  return out;
}

void Ranking::count(double before, const std::vector<double>& after, double sure, double weight) {
  weights_ += weight, before_ += weight * before;
  for (std::size_t m = 0; m < measures_.size(); ++m) {
    if (after[m] >= sure) gains_[m] += weight * (after[m] - before);
    after_[m] += weight * after[m];
  }
}

bool Ranking::any() const {
  return std::ranges::any_of(gains_, [](double gain) { return gain > 0.0; });
}

std::vector<std::size_t> Ranking::order() const {
  std::vector<std::size_t> order(measures_.size());
  std::iota(order.begin(), order.end(), 0U);
  double most = 0.0;
  for (const double g : gains_) most = std::max(most, g);
  const auto rank = [&](std::size_t m) {
    const bool less = gains_[m] < share_of_best * most;
    return std::pair(less, less ? -gains_[m] : measures_[m].minutes);
  };
  std::ranges::stable_sort(order, {}, rank);
  return order;
}

}  // namespace trueaxis::infer
