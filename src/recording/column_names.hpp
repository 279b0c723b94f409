// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "recording/columns.hpp"

namespace trueaxis {

/// What the name of a column says it is.
struct NamedRole {
  RecordedRole role;
  std::optional<bool> diameter{};  ///< of a reading
  bool gauge = false;              ///< readings of an indicator: differences only
  bool vague = false;              ///< a position of an axis that is not named; Z, if anything
  std::string language{};          ///< ISO 639, of a name that one language alone has
};

/// By the names that controls, loggers and spreadsheets give, in the languages of
/// header_words.cpp; the last part of a name with colons or points ("LATHE:X", "Axis.C") counts.
/// Nothing for any other name.
std::optional<NamedRole> role_of_name(std::string_view name);

/// "X", "C" …: a role as `--columns` spells it. Nothing for any other word.
std::optional<RecordedRole> role_of_word(std::string_view word);
const char* word_of(RecordedRole role);

/// The unit of a stream that a unit of a file is: "deg" for "°", "um" for "µm"; with `dia` of a
/// diameter. Nothing for a unit that is unknown or could be two ("grad", but in a header in
/// German).
std::optional<std::string> stream_unit(RecordedRole role, std::string_view unit,
                                       std::string_view language = "");

/// The unit that a stream's column has where nobody says one.
const char* default_unit(RecordedRole role);

}  // namespace trueaxis
