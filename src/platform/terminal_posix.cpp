// SPDX-License-Identifier: Apache-2.0
#include <sys/ioctl.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>

#include "platform/terminal.hpp"

// Highway's shared library measures the resolution of its clock when it is loaded, a fifth of the
// time to start. No one here asks for it: the library finds this in its place.
namespace hwy::platform {
[[gnu::visibility("default")]] std::uint64_t TimerResolution();
std::uint64_t TimerResolution() { return 1; }
}  // namespace hwy::platform

namespace trueaxis::platform {
namespace {

int descriptor_of(Stream stream) {
  return stream == Stream::output ? STDOUT_FILENO : STDERR_FILENO;
}

}  // namespace

bool is_terminal(Stream stream) { return ::isatty(descriptor_of(stream)) == 1; }

std::optional<std::size_t> columns_of(Stream stream) {
  winsize size{};
  if (::ioctl(descriptor_of(stream), TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
    return std::nullopt;
  return size.ws_col;
}

std::vector<std::string> begin_program(int argc, char** argv) { return {argv + 1, argv + argc}; }

void on_stop(void (*stop)(int)) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    std::signal(signal, stop == nullptr ? SIG_DFL : stop);
  if (stop != nullptr) std::signal(SIGPIPE, SIG_IGN);
}

// A program is not begun by a file dropped on it there.
bool open_in_browser(const std::string&) { return false; }
bool terminal_is_own() { return false; }

}  // namespace trueaxis::platform
