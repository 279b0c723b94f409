// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "spindle/recording.hpp"
#include "spindle/synchronous.hpp"

namespace trueaxis {

/// Holds the stated angles against the eccentricity, which all sensors of a set-up see alike, each
/// at its own angle: where columns are exchanged or an angle has the other sign, it is far off.
/// Small differences, of angle or of gain, are notes.
/// @throws InputError where an angle cannot be the stated one.
void check_sensors_agree(std::span<const RunReadings> runs, std::span<const SynchronousPart> parts,
                         std::vector<std::string>& notes);

}  // namespace trueaxis
