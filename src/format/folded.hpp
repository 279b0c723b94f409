// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace trueaxis {

/// UTF-8 text as words are compared: small letters, Latin ones without their accents, a full-width
/// form as the character that it is of, µ as u. Ø stays, as the sign of a diameter.
std::string folded(std::string_view text);

/// `code` in UTF-8, appended.
void append_utf8(std::string& out, unsigned code);

}  // namespace trueaxis
