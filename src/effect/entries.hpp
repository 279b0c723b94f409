// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trueaxis/effect.hpp"

/// The catalogue, family by family; the file of a family is entries_*.cpp.
namespace trueaxis::entries {

std::vector<Effect> part_roundness();  ///< forms that go around
std::vector<Effect> part_profile();    ///< forms along the axis
std::vector<Effect> part_face();       ///< what a face shows: its probe reads Z at (C, X)
std::vector<Effect> spindle();
std::vector<Effect> spindle_axial();  ///< of a face
std::vector<Effect> slide();
std::vector<Effect> slide_face();
std::vector<Effect> probe_geometry();
std::vector<Effect> probe_response();
std::vector<Effect> encoder_and_time();
std::vector<Effect> checks();

}  // namespace trueaxis::entries
