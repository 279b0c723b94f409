// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace trueaxis {

/// 16 hexadecimal digits of the hash of all files that the library was built from; the same in
/// every command of one build. Made by build_id.cmake.
extern const char* const build_id;

}  // namespace trueaxis
