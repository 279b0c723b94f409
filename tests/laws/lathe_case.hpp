// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "trueaxis/effect.hpp"

namespace trueaxis::testing {

inline constexpr double phi = 0.7;           ///< phase of all that have one
inline constexpr double face_end_mm = 40.0;  ///< X where the probing of a face ends

/// An effect of the virtual lathe at a size, and the linear parameters that theory.md gives it
/// per unit of the size.
struct LatheCase {
  std::string id;
  double size;  ///< small enough for the second order to be below a twentieth of the first
  std::function<std::map<std::string, double>(double size)> lathe;
  TermShape shape;
  std::vector<double> linear;
  bool has_limit = true;  ///< flat tops have none: they last by the root of the play
};

inline void PrintTo(const LatheCase& c, std::ostream* out) { *out << c.id; }

}  // namespace trueaxis::testing
