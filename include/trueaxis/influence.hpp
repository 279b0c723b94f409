// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace trueaxis {

/// An influence quantity (GUM) that is known apart from the readings: it enters the budget as type
/// B. A diagnosis takes it as the prior of the cause that it is, in place of the typical sizes.
struct Influence {
  enum class Kind {
    probe_height,    ///< the probe line's offset in Y, mm
    probe_gain,      ///< relative scale of the indication about its mean, 1
    c_offset,        ///< spindle angle datum, rad
    z_offset,        ///< Z datum, mm
    ball_radius,     ///< radius of the probe's ball, mm
    probe_tilt,      ///< of the probe line towards Z, rad; for diagnoses only, as are the next
    probe_delay,     ///< age of X when C and Z are recorded, s
    probe_lag,       ///< time constant of the probe, s
    xz_parallelism,  ///< of the Z slide and the spindle in X, rad
  } kind;
  double u = 0.0;  ///< standard uncertainty in the unit of the kind
  /// What it is, for a diagnosis: readings corrected_by_known() have it no longer.
  double value = 0.0;
};

/// How a user states an influence.
struct InfluenceInfo {
  Influence::Kind kind;
  std::string_view name;    ///< of its line in the budget
  std::string_view key;     ///< of a job, with the unit inside: "lag_s"; its u: "u_lag_s"
  std::string_view stated;  ///< the key with the unit that is usual: "lag_ms"
  std::string_view unit;    ///< mm, rad, s, 1
  bool has_value;           ///< whether its value may be stated, or its u alone
};

/// All of them, in the order of the kinds.
std::span<const InfluenceInfo> influence_catalogue();
const InfluenceInfo& info_of(Influence::Kind kind);

}  // namespace trueaxis
