// SPDX-License-Identifier: Apache-2.0
#include "diagnose/geometry/resolution.hpp"

#include <algorithm>
#include <cmath>

namespace trueaxis::diagnose_detail {
namespace {

constexpr int most_harmonics = 12, most_degrees = 4;

}  // namespace

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
  out.sections = mask.block == "a section";
  if (out.sections)
    out.per_turn = static_cast<double>(point.size()) / static_cast<double>(mask.folds());
  out.whole = std::abs(out.per_turn - std::round(out.per_turn)) < 1e-4;
  // Turns that end between two readings are never at the same angles again: aliases come apart.
  const double most = out.whole || out.turns < 2.0 ? (out.per_turn - 1.0) / 2.0 : most_harmonics;
  out.harmonics = static_cast<int>(std::min<double>(most_harmonics, std::floor(most)));
  out.degrees = point.has_position ? most_degrees : 0;
  if (out.sections) out.degrees = std::min<int>(most_degrees, static_cast<int>(mask.folds()) - 2);
  std::size_t moving = 0;
  for (const Pass& pass : point.passes) moving += pass.end - pass.begin > 8;
  out.one_variable = moving <= 1 && !out.sections;
  return out;
}

}  // namespace trueaxis::diagnose_detail
