// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "trueaxis/error.hpp"
#include "trueaxis/influence.hpp"

namespace trueaxis {
namespace {

using Kind = Influence::Kind;

constexpr std::array<InfluenceInfo, 9> all{{
    {Kind::probe_height, "probe height", "height_mm", "height_mm", "mm", true},
    {Kind::probe_gain, "probe gain", "gain", "gain", "1", true},
    {Kind::c_offset, "spindle angle datum", "c_rad", "c_deg", "rad", false},
    {Kind::z_offset, "position datum", "z_mm", "z_mm", "mm", false},
    {Kind::ball_radius, "ball radius", "ball_radius_mm", "ball_radius_mm", "mm", false},
    {Kind::probe_tilt, "probe tilt", "tilt_rad", "tilt_deg", "rad", true},
    {Kind::probe_delay, "probe delay", "delay_s", "delay_ms", "s", true},
    {Kind::probe_lag, "probe lag", "lag_s", "lag_ms", "s", true},
    {Kind::xz_parallelism, "parallelism of Z slide and spindle", "parallelism_rad",
     "parallelism_deg", "rad", true},
}};

}  // namespace

std::span<const InfluenceInfo> influence_catalogue() { return all; }

const InfluenceInfo& info_of(Influence::Kind kind) {
  const auto found = std::ranges::find(all, kind, &InfluenceInfo::kind);
  expects(found != all.end(), "a kind of influence");
  return *found;
}

}  // namespace trueaxis
