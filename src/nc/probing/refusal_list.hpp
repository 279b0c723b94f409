// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "nc/probing/probing.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::nc {

/// Every reason why a plan cannot be driven.
class RefusalList {
 public:
  explicit RefusalList(std::string file) : file_(std::move(file)) {}
  /// Of which of several plans the next ones are.
  void about(const std::string& plan) { before_ = plan.empty() ? "" : plan + ": "; }
  template <class... Values>
  void unless(bool fine, fmt::format_string<Values...> text, Values&&... values) {
    if (fine) return;
    list_.push_back({file_, 0, 0, before_ + fmt::format(text, std::forward<Values>(values)...)});
  }
  void throw_if_any() {
    if (!list_.empty()) throw InputError(std::move(list_));
  }

 private:
  std::string file_, before_;
  std::vector<Diagnostic> list_;
};

/// Whether a probe has the room that its way to and along the surface needs.
void expect_room(const ProbingPlan& plan, const ProbingLimits& limits, RefusalList& refusals);

}  // namespace trueaxis::nc
