// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "trueaxis/virtual_lathe.hpp"

/// Sealed faces: one pass outwards, or out and back at another speed, with one effect or none.
namespace trueaxis::blind {

/// What the effect of a family does to the ideal fit.
enum class FaceHarm {
  none,   ///< nothing but what few turns leave
  biases  ///< it moves tilt or height
};

struct FaceFamily {
  std::string id, size;  ///< effect, and the parameter of the lathe that is its size
  double unit = 1e-3;    ///< a size by which it is judged how large it shows
  FaceHarm harm = FaceHarm::none;
  /// In one pass it is a drift too, whose height is that of its beginning: drawn out and back.
  bool back = false;
};

/// Every effect that a face has and that one measurement of it shows.
const std::vector<FaceFamily>& face_families();

struct FaceCase {
  virtual_lathe::Scenario scenario;
  std::string effect;  ///< empty: none
  double lambda = 0.0;
};

/// @param family nullptr: no effect. Its λ after the face's own parameters is drawn log-uniform
/// from 60 to 400.
FaceCase draw_face(const FaceFamily* family, std::uint64_t seed);

/// A section: cylinder probed at one Z over `turns`, with lobes of the part or of the spindle.
FaceCase draw_section(bool with_effect, std::uint64_t seed);

}  // namespace trueaxis::blind
