// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "blind/plans.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/virtual_lathe.hpp"

/// Where the axis is after a diagnosis: streams of a shop whose truth is sealed, 2 to 6 small
/// effects at once, diagnosed by the library, judged by the drawn axis alone.
namespace trueaxis::axis {

/// What is hidden in the streams.
enum class Group {
  mixture,   ///< 2 to 6 effects that the plan shows, or that do nothing
  slip,      ///< one to three of them and a slip of 10 to 200 µm
  outside,   ///< one that is in no catalogue, and up to two that are
  absorbed,  ///< 2 to 6 effects, also such that the plan cannot show
  noise,     ///< nothing
  known,     ///< nothing, and probe and machine are stated to have none of what may be stated
};
inline constexpr Group groups[] = {Group::mixture,  Group::slip,  Group::outside,
                                   Group::absorbed, Group::noise, Group::known};
std::string_view name_of(Group group);

/// A stream with what only the judge knows.
struct Case {
  Group group = Group::mixture;
  std::uint64_t seed = 1;
  blind::PlanId plan = blind::PlanId::p1;
  std::string surface;  ///< cylinder, cone to 20°, cone above
  std::string noise;    ///< white, AR(1), outliers, rounded
  std::string side;     ///< shaft, bore, rear
  virtual_lathe::Scenario scenario;
  double low_mm = 0.0, high_mm = 0.0;  ///< probed length
};

/// Draws the case of this seed.
Case draw_case(Group group, std::uint64_t seed);

/// x, y of the true axis at both ends of the probed length, mm. It is the axis of the part after
/// the last reading; for a bent part it is the straight line nearest to its bent axis (least
/// squares).
std::array<double, 4> true_ends(const Case& of);

/// How far the axis of a result is from the truth.
struct Judged {
  std::array<double, 4> error_mm{}, u_mm{};  ///< x, y at the one end, x, y at the other
  double rms_mm() const;                     ///< over both ends
  double u_rms_mm() const;
  int covered() const;  ///< of the four, by k = 2
  /// Interval score of e ± 2 u at 95 % (Gneiting and Raftery 2007, Eq. 43), mean of the four: the
  /// width plus 2/0.05 times what lies outside. The lower, the better.
  double interval_score_mm() const;
};
Judged judge(const Case& of, const AxisEstimate& axis);

/// What `diagnose` says of the readings of a case alone, on one thread.
Diagnosis diagnosed(const Case& of, const ProbeStream& stream);

/// One diagnosed case.
struct Outcome {
  Case made;
  std::size_t readings = 0;
  Judged ideal, extended;
  bool stated = true;  ///< whether the command states the axis, and does not withhold it
  double seconds = 0.0;
  std::string hidden, found;
};
Outcome run_case(Group group, std::uint64_t seed);

}  // namespace trueaxis::axis
