// SPDX-License-Identifier: Apache-2.0
#include "diagnose/geometry/observation_mask.hpp"

#include <algorithm>
#include <cmath>

#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr std::size_t blocks_wanted = 30;  // Eq. 82: few blocks lose slow effects
constexpr double few_turns =
    6.0;  // fewer revolutions than this cannot be blocks of a cross-validation
constexpr unsigned char longest_run = 8;

/// Where Z stands still for a section and then steps: the first reading of every section. A helix
/// moves by little from reading to reading, and by much from its start.
std::vector<std::size_t> section_starts(const LinearisationPoint& point) {
  const double still_mm = 1e-3 * point.z_half_mm;
  std::vector<std::size_t> starts{0};
  for (std::size_t i = 1; i < point.size(); ++i) {
    if (std::abs(point.z[i] - point.z[i - 1]) > still_mm)
      starts.push_back(i);
    else if (std::abs(point.z[i] - point.z[starts.back()]) > still_mm)
      return {};
  }
  const bool sections = starts.size() >= 3 && starts.size() * 4 <= point.size();
  return sections ? starts : std::vector<std::size_t>{};
}

constexpr int most_harmonics = 12, most_degrees = 4;
constexpr double most_by_hand = 36.0;  // angles of a section
constexpr double even = 0.02;          // of the step: what an angle is off

/// Whether each section has as many angles, all the same step apart.
bool are_even(const LinearisationPoint& point, const ObservationMask& mask, double per_turn) {
  const double step = two_pi / per_turn;
  for (std::size_t f = 0; f < mask.folds(); ++f) {
    const std::size_t begin = mask.fold_begin[f], end = mask.fold_begin[f + 1];
    if (static_cast<double>(end - begin) != per_turn) return false;
    for (std::size_t i = begin + 1; i < end; ++i)
      if (std::abs(std::abs(point.c[i] - point.c[i - 1]) - step) > even * step) return false;
  }
  return true;
}

}  // namespace

void ObservationMask::find_runs(const LinearisationPoint& point) {
  run.assign(point.size(), 0);
  for (const Pass& pass : point.passes) {
    std::vector<double> steps;
    const auto clock = [&](std::size_t i) { return point.has_time ? point.time[i] : point.c[i]; };
    for (std::size_t i = pass.begin + 1; i < pass.end; ++i)
      steps.push_back(std::abs(clock(i) - clock(i - 1)));
    if (steps.empty()) continue;
    const double usual = median(steps);
    for (std::size_t i = pass.begin + 1; i < pass.end; ++i) {
      const bool regular = std::abs(clock(i) - clock(i - 1)) <= 1.8 * usual;
      if (used[i] && used[i - 1] && regular)
        run[i] = static_cast<unsigned char>(std::min<int>(run[i - 1] + 1, longest_run));
    }
  }
}

ObservationMask make_observation_mask(const LinearisationPoint& point) {
  ObservationMask mask;
  mask.used.assign(point.size(), 1);
  mask.find_runs(point);
  mask.fold_begin = section_starts(point);
  if (!mask.fold_begin.empty()) {
    mask.fold_begin.push_back(point.size());
    mask.block = "a section";
    return mask;
  }
  double turns = 0.0;
  for (const Pass& pass : point.passes)
    turns += std::abs(point.c[pass.end - 1] - point.c[pass.begin]) / two_pi;
  if (turns < few_turns) {
    const std::size_t blocks = std::min(blocks_wanted, point.size() / 2);
    for (std::size_t b = 0; b <= blocks; ++b) mask.fold_begin.push_back(b * point.size() / blocks);
    mask.block = "an arc";
    return mask;
  }
  const double per_block = std::max(1.0, std::floor(turns / static_cast<double>(blocks_wanted)));
  for (const Pass& pass : point.passes) {
    const double own = std::abs(point.c[pass.end - 1] - point.c[pass.begin]) / two_pi;
    const double share =
        static_cast<double>(pass.end - pass.begin) / static_cast<double>(point.size());
    const double blocks = own > 0.5 ? std::max(1.0, std::round(own / per_block))
                                    : std::max(1.0, std::round(share * blocks_wanted));
    for (double b = 0.0; b < blocks; ++b) {
      const auto begin = pass.begin + static_cast<std::size_t>(
                                          b / blocks * static_cast<double>(pass.end - pass.begin));
      if (mask.fold_begin.empty() || begin > mask.fold_begin.back())
        mask.fold_begin.push_back(begin);
    }
  }
  mask.fold_begin.push_back(point.size());
  mask.block = per_block == 1.0 ? "a revolution"
                                : std::to_string(static_cast<int>(per_block)) + " revolutions";
  return mask;
}

Resolution resolution_of(const LinearisationPoint& point, const ObservationMask& mask) {
  Resolution out;
  out.per_turn = 1e9;
  for (const Pass& pass : point.passes) {
    if (pass.c_sign == 0 || pass.readings_per_revolution <= 0.0) continue;
    out.turns += static_cast<double>(pass.end - pass.begin) / pass.readings_per_revolution;
    if (pass.end - pass.begin > 8)
      out.per_turn = std::min(out.per_turn, pass.readings_per_revolution);
  }
  if (out.per_turn == 1e9) out.per_turn = static_cast<double>(point.size());
  out.sections = !section_starts(point).empty();
  if (out.sections)
    out.per_turn = static_cast<double>(point.size()) / static_cast<double>(mask.folds());
  out.whole = std::abs(out.per_turn - std::round(out.per_turn)) < 1e-4;
  // Turns that end between two readings are never at the same angles again: aliases come apart.
  const double most = out.whole || out.turns < 2.0 ? (out.per_turn - 1.0) / 2.0 : most_harmonics;
  out.harmonics = static_cast<int>(std::min<double>(most_harmonics, std::floor(most)));
  out.degrees = point.has_position ? most_degrees : 0;
  if (out.sections) out.degrees = std::min<int>(most_degrees, static_cast<int>(mask.folds()) - 2);
  out.sparse = out.sections && out.per_turn <= most_by_hand &&
               are_even(point, mask, out.per_turn) && point.clampings.size() == 1 &&
               !point.base.face;
  const int half = static_cast<int>(std::lround(out.per_turn)) / 2;
  if (out.sparse && half > out.harmonics && half <= most_harmonics) out.half_seen = half;
  std::size_t moving = 0;
  for (const Pass& pass : point.passes) moving += pass.end - pass.begin > 8;
  out.one_variable = moving <= 1 && !out.sections;
  return out;
}

}  // namespace trueaxis::diagnose_detail
