// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "diagnose/geometry/linearisation_point.hpp"
#include "diagnose/geometry/observation_mask.hpp"
#include "diagnose/refit/relinearised_fit.hpp"

namespace trueaxis::diagnose_detail {

/// A delay of X that explains the readings without a slip.
struct DelayInstead {
  double delay_s = 0.0;  ///< NaN: without a clock
  Rival rival;           ///< of what was found
};

/// The delay that a slip, or anything else that the search found, may be instead (Eq. 94a). It
/// turns the part by an angle that no column about the surface reaches. None: one speed, a delay of
/// an ordinary size, which the search weighs, or the readings refute it.
std::optional<DelayInstead> delay_instead(const IdealModel& ideal, const RelinearisedFit& fit);

/// The passes of a stream, read when a delay of X says: C' = C − ω τ and Z' = Z − v τ, ω and v
/// those of the pass.
class TurnedPasses {
 public:
  /// @param onset_s without a clock, when the speed changed; passes then turn by τ after it
  TurnedPasses(const ProbeStream& stream, const LinearisationPoint& point, double onset_s);

  /// Whether a delay turns all readings by one angle.
  bool at_one_speed() const;
  /// The angle that a delay puts between the slowest and the fastest pass, rad.
  double turned_apart(double delay_s) const;
  ProbeStream without(double delay_s) const;
  /// The mask without the readings just after a change of speed, which a delay puts before it.
  ObservationMask counted(const ObservationMask& mask, double delay_s) const;
  /// The shortest delay after which offset, tilt, radius and taper leave as little as after any. It
  /// is known up to one revolution between the speeds, but for what it does along Z.
  double best(const ObservationMask& mask) const;

 private:
  /// Readings that a delay turns alike.
  struct Part {
    std::size_t begin, end;
    double speed_rad_per_s, velocity_mm_per_s;
  };
  const ProbeStream& stream_;
  const LinearisationPoint& point_;
  std::vector<Part> parts_;
};

}  // namespace trueaxis::diagnose_detail
