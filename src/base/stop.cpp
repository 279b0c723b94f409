// SPDX-License-Identifier: Apache-2.0
#include "base/stop.hpp"

namespace trueaxis {
namespace {

thread_local const std::atomic<bool>* asked_of_this_thread = nullptr;
thread_local std::atomic<double>* share_of_this_thread = nullptr;
thread_local const std::function<void()>* look_of_this_thread = nullptr;

}  // namespace

Stoppable::Stoppable(const std::atomic<bool>* asked, std::atomic<double>* share,
                     const std::function<void()>* look)
    : before_(asked_of_this_thread),
      share_before_(share_of_this_thread),
      look_before_(look_of_this_thread) {
  asked_of_this_thread = asked;
  share_of_this_thread = share;
  look_of_this_thread = look;
}

Stoppable::~Stoppable() {
  asked_of_this_thread = before_;
  share_of_this_thread = share_before_;
  look_of_this_thread = look_before_;
}

const std::atomic<bool>* stopped_by() { return asked_of_this_thread; }

std::atomic<double>* share_done() { return share_of_this_thread; }

void stop_if_asked() {
  if (look_of_this_thread != nullptr) (*look_of_this_thread)();
  if (asked_of_this_thread != nullptr && asked_of_this_thread->load(std::memory_order_relaxed))
    throw Stopped{};
}

}  // namespace trueaxis
