// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <utility>

#include "base/stop.hpp"
#include "cli/terminal.hpp"
#include "platform/terminal.hpp"

namespace trueaxis::cli {
namespace {

std::string duration_text(double seconds) {
  if (seconds < 100.0) return fmt::format("{:.0f} s", std::ceil(seconds));
  if (seconds < 6000.0) return fmt::format("{:.0f} min", std::ceil(seconds / 60.0));
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

}  // namespace

Progress::Progress(std::size_t before, std::size_t to_do, std::string unit)
    : before_(before),
      to_do_(to_do),
      unit_(std::move(unit)),
      on_terminal_(platform::is_terminal(platform::Stream::error)),
      begun_(Clock::now()),
      shown_(begun_),
      share_(share_done()) {}

double Progress::share() const {
  return static_cast<double>(before_ + done_) / static_cast<double>(before_ + to_do_);
}

void Progress::add(std::size_t count) {
  done_ += count;
  if (share_ != nullptr) *share_ = share();
  const auto now = Clock::now();
  if (!on_terminal_ || now - shown_ < std::chrono::milliseconds(200)) return;
  shown_ = now;
  show();
}

void Progress::show() {
  const double seconds = std::chrono::duration<double>(Clock::now() - begun_).count();
  const double rate = static_cast<double>(done_) / seconds;
  fmt::print(stderr, "\r\033[K{:3.0f} %  {} of {} {}, {:.{}f}/s, {} left", 100.0 * share(),
             before_ + done_, before_ + to_do_, unit_, rate, rate < 10.0 ? 1 : 0,
             duration_text(static_cast<double>(to_do_ - done_) / rate));
  std::fflush(stderr);
}

void Progress::end() {
  if (on_terminal_ && to_do_ > 0) std::fprintf(stderr, "\r\033[K");
}

}  // namespace trueaxis::cli
