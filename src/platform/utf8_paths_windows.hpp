// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

// Included before every source by the build for Windows. Narrow text is UTF-8 here as everywhere.
// The library of GCC 12 writes it so, but reads it in the locale of C, which on Windows cannot be
// UTF-8: this is its own conversion of char8_t for char.
template <>
inline auto std::filesystem::path::_S_convert<char>(const char* first, const char* last) {
  return std::filesystem::__detail::__wstr_from_utf8(
      std::string_view(first, static_cast<std::size_t>(last - first)));
}
