// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

/// Absolute paths of this build. They are compiled in one small file, so that a compiler cache
/// serves every clone.
namespace places {

std::string command();        ///< the program `trueaxis`
std::string source();         ///< the top of the source tree
std::string scratch();        ///< a folder for what tests write
std::string measured_data();  ///< the measured streams of docs/evidence/measured_data.md; empty if
                              ///< there are none

}  // namespace places
