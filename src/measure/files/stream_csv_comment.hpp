// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace trueaxis {

/// Judges the text behind '#' of a comment that holds no known key as it is spelt. Prose is free;
/// what looks like a known key (another spelling, '=' or blanks for ':', a letter or two wrong, a
/// word that means one), or says a unit or convention for the whole file, must not be passed over.
/// @returns what is wrong and what to write instead, empty for free text. Text that begins with a
/// further '#' is always free.
std::string csv_comment_trouble(std::string_view text);

}  // namespace trueaxis
