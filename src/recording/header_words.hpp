// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace trueaxis {

/// What a word in the header of a column speaks of.
enum class HeaderMeaning {
  axis,      ///< X, Y, Z, C; `axial` is Z
  radius,    ///< a reading that is a radius
  diameter,  ///< a reading that is a diameter
  angle,
  time,
  gauge,  ///< an indicator: differences only
  pass,
  setup,
  face,      ///< Z_M, TrueAxis' own name for the readings of a face
  position,  ///< a position or a length along some axis
  filler     ///< says nothing of its own: actual, spindle, measured, of
};

/// What the words of a name say together.
struct HeaderName {
  char axis = 0;                         ///< 'x', 'y', 'z', 'c', or 0: none is named
  std::optional<HeaderMeaning> meaning;  ///< other than axis, position and filler
  bool position = false;
  std::string language;  ///< the only one that has all these words; empty: several have
};

/// The words of "Spindelwinkel C", "Position broche", "X軸位置": nothing where one of them is not
/// in the table (header_words.cpp), or two contradict each other.
std::optional<HeaderName> read_header_name(std::string_view name);

}  // namespace trueaxis
