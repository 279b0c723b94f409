// SPDX-License-Identifier: Apache-2.0
#include "nc/cycle.hpp"

#include <algorithm>

namespace trueaxis::nc {
namespace {

constexpr double above_mm = 0.254;  // G83: where the feed begins again
constexpr double most_pecks = 10000.0;

class Steps {
 public:
  explicit Steps(const Cycle& cycle)
      : cycle_(cycle), x_(cycle.from_mm[0]), y_(cycle.from_mm[1]), z_(cycle.from_mm[2]) {}

  std::vector<CycleStep> make() {
    const double back_mm = cycle_.to_r ? cycle_.r_mm : std::max(cycle_.initial_mm, cycle_.r_mm);
    if (z_ < cycle_.r_mm) go(x_, y_, cycle_.r_mm, false);
    for (int hole = 0; hole < cycle_.holes; ++hole) {
      const double x = cycle_.to_mm[0] + hole * cycle_.step_mm[0],
                   y = cycle_.to_mm[1] + hole * cycle_.step_mm[1];
      if (steps_.empty() || x != x_ || y != y_) go(x, y, z_, false);
      to_level(cycle_.r_mm, false);
      drill();
      steps_.back().bottom = true;
      to_level(back_mm, false);
    }
    return std::move(steps_);
  }

 private:
  void go(double x, double y, double z, bool feed) {
    x_ = x, y_ = y, z_ = z;
    steps_.push_back({{x, y, z}, feed, false});
  }
  void to_level(double z, bool feed) {
    if (z != z_) go(x_, y_, z, feed);
  }

  void drill() {
    if (cycle_.code != 83) return to_level(cycle_.bottom_mm, true);
    double depth = cycle_.r_mm;
    while (depth > cycle_.bottom_mm) {
      if (depth < cycle_.r_mm) {
        to_level(cycle_.r_mm, false);
        to_level(std::min(depth + above_mm, cycle_.r_mm), false);
      }
      depth = std::max(depth - cycle_.peck_mm, cycle_.bottom_mm);
      to_level(depth, true);
    }
  }

  const Cycle& cycle_;
  double x_, y_, z_;
  std::vector<CycleStep> steps_;
};

}  // namespace

std::vector<CycleStep> steps_of(const Cycle& cycle, std::string& trouble) {
  if (!(cycle.bottom_mm < cycle.r_mm)) {
    trouble = "the cycle's Z is not below its R";
  } else if (cycle.code == 83 && !(cycle.peck_mm > 0.0)) {
    trouble = "G83 without Q: say how deep one peck is";
  } else if (cycle.code == 83 && cycle.r_mm - cycle.bottom_mm > most_pecks * cycle.peck_mm) {
    trouble = "G83 with more than 10000 pecks: see whether Q has the unit of Z";
  } else {
    return Steps(cycle).make();
  }
  return {};
}

}  // namespace trueaxis::nc
