// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trueaxis/form.hpp"

namespace trueaxis::form {

/// The readings of one section as distances from the spindle axis, at angles in the part.
struct SectionReadings {
  std::optional<double> z_mm;
  std::vector<double> angle_rad, distance_mm;
  double turns = 1.0;
  std::size_t size() const { return angle_rad.size(); }
};

/// A lateral stream cut into sections. If Z does not move, each Z is one. A helix that is not a
/// surface, for a cut-off above 50 UPR, is cut into turns, less what the associated cone does along
/// Z within a turn (Eq. 268).
struct Sections {
  std::vector<SectionReadings> list;
  bool radius_known = true;  ///< false: a gauge without a nominal radius; Eq. 265 is then a limaçon
  double pitch_mm = 0.0;     ///< of a helix
  std::vector<std::string> notes;
};

/// All readings of a part that is one surface: a helix, or sections whose angles differ.
struct SurfaceReadings {
  std::vector<double> angle_rad, distance_mm, z_mm;
  double turns = 1.0;  ///< or sections
  bool radius_known = true;
  std::size_t size() const { return angle_rad.size(); }
};

/// The highest cut-off that a surface is estimated for.
inline constexpr int highest_of_surface = 50;

/// The highest cut-off (UPR) that the angles of all readings of a surface carry together,
/// `highest_of_surface` at most. 0: the stream is not a surface but sections, each by itself: fewer
/// than 4, or such that carry a standard cut-off (15 UPR) alone.
struct UprOfSurface {
  int by_steps = 0;     ///< 7 readings a wave
  int by_gaps_too = 0;  ///< and no gap of more than half a wave
};
UprOfSurface upr_of_surface(const ProbeStream& stream, const FormOptions& options);
SurfaceReadings surface_readings(const ProbeStream& stream, const FormOptions& options);

/// @throws InputError with all that is not a measurement of sections: a face, several set-ups or
///         sensors, numbers that are not finite, angles of another unit, fewer than 4 readings
Sections sections_of(const ProbeStream& stream, const FormOptions& options);

}  // namespace trueaxis::form
