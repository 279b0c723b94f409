// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "job/evidence.hpp"
#include "job/files/job_file.hpp"

namespace trueaxis {

/// Whether a file is a job, as standard input is: its first line that is not a comment is one of
/// TOML.
bool is_job(const std::string& path);

/// The job of one stream about which nothing else is known.
JobFile job_of_stream(StreamFile stream, FitOptions fit);

/// How a user says a stretch of Z.
enum class RangesAs {
  options,  ///< --z-from-mm 0 --z-to-mm 25
  keys,     ///< z_from_mm = 0, z_to_mm = 25
};

/// @throws InputError where the readings of a stream that is to be one cone or cylinder are of
///         several, with the Z ranges of each
void expect_one_surface(const ProbeStream& stream, SurfaceKind surface, RangesAs ranges);

/// Of a job of one stream whose surface nobody says: a reference for every seat that is found, its
/// surface chosen by what the readings show, and the streams say so.
void take_seats(Job& job, std::vector<ProbeStream>& streams);
void choose_surfaces(Job& job, std::vector<ProbeStream>& streams);

/// What the job would have done, in words.
std::string job_plan_text(const Job& job, const std::vector<ProbeStream>& streams,
                          bool surface_known);

}  // namespace trueaxis
