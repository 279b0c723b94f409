// SPDX-License-Identifier: Apache-2.0
#include "fit/place_set_ups.hpp"

#include <algorithm>
#include <limits>

#include "math/statistics.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Extent nothing{infinity, -infinity};

std::vector<Extent> find_extremes(const ProbeStream& stream, const std::vector<SetUp>& set_ups,
                                  const std::vector<double>& column) {
  if (set_ups.size() == 1) return {range_of(column)};
  std::vector<Extent> extremes(set_ups.size(), nothing);
  std::size_t at = 0;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    if (stream.setup[i] != set_ups[at].number) {
      const auto found = std::ranges::lower_bound(set_ups, stream.setup[i], {}, &SetUp::number);
      at = static_cast<std::size_t>(found - set_ups.begin());
    }
    extremes[at].low = std::min(extremes[at].low, column[i]);
    extremes[at].high = std::max(extremes[at].high, column[i]);
  }
  return extremes;
}

std::string of_set_up(const ProbeStream& stream, const SetUp& set_up) {
  return stream.setup.empty() ? "" : " of " + set_up_name(set_up);
}

Root find_root(const ProbeStream& stream, const SetUp& set_up, const Extent& x) {
  if (stream.kind == StreamKind::face) return Root::front;
  if (stream.indication == Indication::relative) return set_up.rear ? Root::rear : Root::front;
  if (x.high < 0.0) return Root::rear;
  if (x.low > 0.0 && !set_up.rear) return Root::front;
  if (x.low > 0.0) {
    throw InputError(stream.source, "X_M" + of_set_up(stream, set_up) +
                                        " is positive, but the stated side is rear: on the rear "
                                        "side of the spindle axis X_M is negative; correct one");
  }
  std::size_t row = 0;
  const auto elsewhere = [&] {
    return !stream.setup.empty() && stream.setup[row] != set_up.number;
  };
  while (elsewhere()) ++row;
  const bool positive = stream.reading_mm[row] > 0.0;
  while (row < stream.size() && (elsewhere() || (stream.reading_mm[row] > 0.0) == positive)) ++row;
  throw InputError(stream.source,
                   "X_M" + of_set_up(stream, set_up) + " changes sign or is zero at data row " +
                       std::to_string(row + 1) +
                       ": the spindle axis must lie inside the part, X_M is its distance to the "
                       "contact (for a gauge write '# reading: relative')");
}

}  // namespace

std::string set_up_name(const SetUp& set_up) { return "set-up " + std::to_string(set_up.number); }

std::vector<PlacedSetUp> place_set_ups(const ProbeStream& stream) {
  const std::vector<SetUp> set_ups = list_set_ups(stream);
  const std::vector<Extent> extremes = find_extremes(stream, set_ups, stream.reading_mm);
  std::vector<PlacedSetUp> placed;
  for (std::size_t i = 0; i < set_ups.size(); ++i) {
    const bool moved = i > 0 && !set_ups[i].clamped_as(set_ups[i - 1]);
    placed.push_back({set_ups[i], i == 0 ? 0 : placed.back().clamping + (moved ? 1 : 0),
                      find_root(stream, set_ups[i], extremes[i])});
  }
  if (stream.kind == StreamKind::face || placed.back().clamping == 0) return placed;
  for (PlacedSetUp& one : placed) one.z_shift_mm = one.set_up.z_shift_mm;
  return placed;
}

std::vector<std::array<double, 2>> probed_ranges(const ProbeStream& stream,
                                                 const std::vector<PlacedSetUp>& set_ups) {
  std::vector<SetUp> stated;
  for (const PlacedSetUp& placed : set_ups) stated.push_back(placed.set_up);
  const std::vector<Extent> extremes = find_extremes(stream, stated, stream.position_mm);
  std::vector<Extent> of_clamping(set_ups.back().clamping + 1, nothing);
  for (std::size_t i = 0; i < set_ups.size(); ++i) {
    Extent& range = of_clamping[set_ups[i].clamping];
    range.low = std::min(range.low, extremes[i].low - set_ups[i].z_shift_mm);
    range.high = std::max(range.high, extremes[i].high - set_ups[i].z_shift_mm);
  }
  std::vector<std::array<double, 2>> ranges;
  for (const Extent& range : of_clamping) ranges.push_back({range.low, range.high});
  return ranges;
}

}  // namespace trueaxis
