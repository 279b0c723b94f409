// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>

namespace trueaxis {

/// Thrown by work that nobody waits for any longer. It is not a std::exception: what turns those
/// into results leaves it alone.
struct Stopped {};

/// While it lives, work of this thread, and of the threads that for_each_index starts for it, ends
/// with Stopped soon after `asked` becomes true. Without one, work runs to its end.
class Stoppable {
 public:
  /// @param share of the work that is done: set by work that counts, read by who waits
  /// @param look called by this thread alone, whenever it looks whether to end: it may ask for that
  explicit Stoppable(const std::atomic<bool>* asked, std::atomic<double>* share = nullptr,
                     const std::function<void()>* look = nullptr);
  ~Stoppable();
  Stoppable(const Stoppable&) = delete;
  Stoppable& operator=(const Stoppable&) = delete;

 private:
  const std::atomic<bool>* before_;
  std::atomic<double>* share_before_;
  const std::function<void()>* look_before_;
};

/// What this thread's work is stopped by; nullptr: nothing.
const std::atomic<bool>* stopped_by();

/// Where this thread's work says how much of it is done, 0 to 1; nullptr: nobody looks.
std::atomic<double>* share_done();

/// @throws Stopped if this thread's work was asked to end
void stop_if_asked();

}  // namespace trueaxis
