// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <system_error>
#include <utility>

#include "cli/terminal.hpp"
#include "format/text_layout.hpp"
#include "platform/terminal.hpp"

namespace trueaxis::cli {
namespace {

constexpr auto quiet = std::chrono::seconds(2);
constexpr auto between = std::chrono::milliseconds(500);

/// `text` in `to` characters at most, without half a character of UTF-8.
std::string cut_to(std::string text, std::size_t to) {
  while (layout::width(text) > to) {
    while ((static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U) text.pop_back();
    text.pop_back();
  }
  return text;
}

}  // namespace

Waiting::Waiting(std::string doing) : doing_(std::move(doing)) {
  if (!platform::is_terminal(platform::Stream::error)) return;
  try {
    thread_ = std::thread([this] { show(); });
  } catch (const std::system_error&) {
    // Without a thread nothing is shown, and the work goes on.
  }
}

void Waiting::show() {
  const auto begun = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  if (ended_.wait_for(lock, quiet, [this] { return end_; })) return;
  do {
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    const std::string behind = fmt::format(", {:.0f} s", seconds);
    const std::size_t room = platform::columns_of(platform::Stream::error).value_or(80) - 1;
    fmt::print(stderr, "\r\033[K{}{}",
               cut_to(doing_, room > behind.size() ? room - behind.size() : 0), behind);
    std::fflush(stderr);
  } while (!ended_.wait_for(lock, between, [this] { return end_; }));
  std::fputs("\r\033[K", stderr);
}

Waiting::~Waiting() {
  if (!thread_.joinable()) return;
  {
    const std::scoped_lock lock(mutex_);
    end_ = true;
  }
  ended_.notify_all();
  thread_.join();
}

}  // namespace trueaxis::cli
