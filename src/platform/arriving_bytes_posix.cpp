// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cstdio>

#include "platform/arriving_bytes.hpp"

namespace trueaxis::platform {

struct ArrivingBytes::Impl {
  int descriptor = -1;
  std::FILE* program = nullptr;
};

ArrivingBytes::ArrivingBytes(Impl impl) : impl_(std::make_unique<Impl>(impl)) {}
ArrivingBytes::ArrivingBytes(ArrivingBytes&&) noexcept = default;

ArrivingBytes::~ArrivingBytes() {
  if (!impl_) return;
  if (impl_->program != nullptr)
    ::pclose(impl_->program);
  else if (impl_->descriptor > STDIN_FILENO)
    ::close(impl_->descriptor);
}

ArrivingBytes ArrivingBytes::of_file(const std::string& path) {
  const int file = path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  return ArrivingBytes({file, nullptr});
}

ArrivingBytes ArrivingBytes::of_program(const std::string& command) {
  std::FILE* const program = ::popen(command.c_str(), "r");
  return ArrivingBytes({program == nullptr ? -1 : ::fileno(program), program});
}

bool ArrivingBytes::is_open() const { return impl_->descriptor >= 0; }

bool ArrivingBytes::wait(int milliseconds) const {
  pollfd waits{impl_->descriptor, POLLIN, 0};
  return ::poll(&waits, 1, milliseconds) > 0;
}

std::size_t ArrivingBytes::read(char* to, std::size_t room) {
  const ssize_t got = ::read(impl_->descriptor, to, room);
  return got > 0 ? static_cast<std::size_t>(got) : 0;
}

}  // namespace trueaxis::platform
