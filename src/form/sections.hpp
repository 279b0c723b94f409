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

/// A lateral stream cut into sections: where Z stands still, each Z is one; a helix is cut into
/// turns, and what the associated cone does along Z within a turn is taken off (Eq. 268).
struct Sections {
  std::vector<SectionReadings> list;
  bool radius_known = true;  ///< false: a gauge without a nominal radius; Eq. 265 is then a limaçon
  double pitch_mm = 0.0;     ///< of a helix
  std::vector<std::string> notes;
};

/// @throws InputError with all that is no measurement of sections: a face, several set-ups or
///         sensors, numbers that are not finite, angles of another unit, fewer than 4 readings
Sections sections_of(const ProbeStream& stream, const FormOptions& options);

}  // namespace trueaxis::form
