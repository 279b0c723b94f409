// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "platform/arriving_bytes.hpp"
#include "platform/files.hpp"
#include "platform/windows.hpp"

namespace trueaxis::platform {

struct ArrivingBytes::Impl {
  HANDLE handle = INVALID_HANDLE_VALUE;
  bool own = false;
};

ArrivingBytes::ArrivingBytes(Impl impl) : impl_(std::make_unique<Impl>(impl)) {}
ArrivingBytes::ArrivingBytes(ArrivingBytes&&) noexcept = default;

ArrivingBytes::~ArrivingBytes() {
  if (impl_ && impl_->own) ::CloseHandle(impl_->handle);
}

ArrivingBytes ArrivingBytes::of_file(const std::string& path) {
  if (path == "-") return ArrivingBytes({::GetStdHandle(STD_INPUT_HANDLE), false});
  const HANDLE file = ::CreateFileW(wide(path).c_str(), GENERIC_READ,
                                    FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                                    OPEN_EXISTING, 0, nullptr);
  return ArrivingBytes({file, file != INVALID_HANDLE_VALUE});
}

// LinuxCNC is the one whose program is read.
ArrivingBytes ArrivingBytes::of_program(const std::string&) { return ArrivingBytes({}); }

bool ArrivingBytes::is_open() const { return impl_->handle != INVALID_HANDLE_VALUE; }

bool ArrivingBytes::wait(int milliseconds) const {
  if (::GetFileType(impl_->handle) != FILE_TYPE_PIPE) return true;
  for (int waited = 0;; waited += 10) {
    DWORD there = 0;
    if (::PeekNamedPipe(impl_->handle, nullptr, 0, nullptr, &there, nullptr) == 0 || there > 0)
      return true;  // read() tells that the other end is closed
    if (waited >= milliseconds) return false;
    ::Sleep(10);
  }
}

std::size_t ArrivingBytes::read(char* to, std::size_t room) {
  DWORD got = 0;
  return ::ReadFile(impl_->handle, to, static_cast<DWORD>(room), &got, nullptr) != 0 ? got : 0;
}

}  // namespace trueaxis::platform
