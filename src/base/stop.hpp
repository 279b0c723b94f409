// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace trueaxis {

/// Thrown by work that nobody waits for any longer. It is not a std::exception: what turns those
/// into results leaves it alone.
struct Stopped {};

/// While it lives, work of this thread, and of the threads that for_each_index starts for it, ends
/// with Stopped soon after `asked` becomes true. Without one, work runs to its end.
class Stoppable {
 public:
  explicit Stoppable(const std::atomic<bool>* asked);
  ~Stoppable();
  Stoppable(const Stoppable&) = delete;
  Stoppable& operator=(const Stoppable&) = delete;

 private:
  const std::atomic<bool>* before_;
};

/// What this thread's work is stopped by; nullptr: nothing.
const std::atomic<bool>* stopped_by();

/// @throws Stopped if this thread's work was asked to end
void stop_if_asked();

}  // namespace trueaxis
