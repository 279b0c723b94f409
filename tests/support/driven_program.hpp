// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "support/probed_part.hpp"
#include "support/rs274_calls.hpp"

namespace trueaxis::testing {

/// What LinuxCNC would log where a probe stops at the part instead of where the program ends it.
struct Driven {
  std::string trouble;
  std::map<std::string, std::string> logs;  ///< by the names of their files
  std::vector<BallAt> touched;
  double nearest_mm = 1e9;  ///< of all moves but those that probe
};
inline Driven driven(const std::vector<Call>& calls, const PartGap& part) {
  Driven out;
  BallAt at{100.0, 60.0, 0.0};
  std::string* log = &out.logs[""];
  for (const Call& one : calls) {
    if (one.name == "LOGOPEN") {
      log = &out.logs[one.words];
      continue;
    }
    if (one.name == "LOG") {
      const std::size_t pass = one.words.find(" P ");
      if (pass != std::string::npos) {
        char row[100];
        std::snprintf(row, sizeof row, "X %.6f C %.6f Z %.6f", at.x, at.c_deg, at.z);
        *log += row + one.words.substr(pass);
        out.touched.push_back(at);
      } else {
        *log += one.words;
      }
      *log += '\n';
      continue;
    }
    const bool probing = one.name == "STRAIGHT_PROBE";
    const Met met = first_met(part, at, {one.x, one.z, one.c});
    if (met.part != probing)
      out.trouble += one.name + (met.part ? " meets the part at X " : " meets nothing to X ") +
                     std::to_string(met.at.x) + " Z " + std::to_string(met.at.z) + "\n";
    at = met.at;
    if (!probing) out.nearest_mm = std::min(out.nearest_mm, part(at));
  }
  return out;
}

}  // namespace trueaxis::testing
