// SPDX-License-Identifier: Apache-2.0
#pragma once

// The interface of Windows, for the sources of this room that are for Windows.
#undef NOMINMAX
#define NOMINMAX
#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <cerrno>
#include <filesystem>
#include <string>

namespace trueaxis::platform {

/// Paths are wide there; std::filesystem takes narrow ones for UTF-8.
inline std::wstring wide(const std::string& text) { return std::filesystem::path(text).wstring(); }
inline std::string narrow(const std::wstring& text) { return std::filesystem::path(text).string(); }

/// The last error of Windows as `errno`, which has a name for few of them.
inline void set_errno() {
  switch (::GetLastError()) {
    case ERROR_FILE_EXISTS:
    case ERROR_ALREADY_EXISTS:
      errno = EEXIST;
      break;
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
    case ERROR_INVALID_NAME:
    case ERROR_BAD_NETPATH:
      errno = ENOENT;
      break;
    case ERROR_DISK_FULL:
      errno = ENOSPC;
      break;
    case ERROR_ACCESS_DENIED:
    case ERROR_SHARING_VIOLATION:
    case ERROR_WRITE_PROTECT:
      errno = EACCES;
      break;
    default:
      errno = EIO;
  }
}

}  // namespace trueaxis::platform
