// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/stream_options.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/resimulation.hpp"

namespace trueaxis::cli {

/// Where the stream of a diagnosis is: as `said`, else as the diagnosis names it, from here or
/// next to the diagnosis. @throws InputError when it is at none of these
std::string diagnosed_stream_path(const std::string& said, const std::string& diagnosis_path,
                                  const Diagnosis& diagnosis);

/// What the diagnosis was of: the stream as it was corrected by what was known.
ProbeStream as_diagnosed(ProbeStream measured, const Diagnosis& diagnosis, double ball_radius_mm);

/// The diagnosed part as the virtual lathe takes it again.
/// @throws InputError for another stream (hash), and one that is read otherwise than then
Resimulation measured_again(const std::string& diagnosis_path, const Diagnosis& diagnosis,
                            const ProbeStream& measured, double ball_radius_mm);

/// @throws InputError where the stream does not leave the residuals that the diagnosis states: it
/// was read otherwise.
void expect_read_as_then(const std::string& diagnosis_path, const Diagnosis& diagnosis,
                         const ProbeStream& measured, const SimulatedReadings& simulated);

}  // namespace trueaxis::cli
