// SPDX-License-Identifier: Apache-2.0
#include "nc/cycle_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "trueaxis/units.hpp"

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
    // After G99 the tool is at R: G98 then takes it over the next hole at the initial level.
    const double over_mm = cycle_.to_r ? z_ : std::max(z_, cycle_.initial_mm);
    for (int hole = 0; hole < cycle_.holes; ++hole) {
      const double x = cycle_.to_mm[0] + hole * cycle_.step_mm[0],
                   y = cycle_.to_mm[1] + hole * cycle_.step_mm[1];
      const double z = hole == 0 ? over_mm : z_;
      if (steps_.empty() || x != x_ || y != y_ || z != z_) go(x, y, z, false);
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

namespace {

constexpr double most_repeats = 9999.0;

double length_mm(const Word& word, const ModalState& state) {
  return (state.inch ? mm_per_inch : 1.0) * word.number;
}

const Word* repeats_of(const Block& block) {
  return block.word('K') != nullptr ? block.word('K') : block.word('L');
}

}  // namespace

void CycleWords::begin(double z_mm) {
  *this = {};
  initial_mm_ = z_mm;
}

bool CycleWords::take(const Block& block, const ModalState& state,
                      const std::vector<Word>& of_program) {
  const Word *r = block.word('R'), *z = block.word('Z'), *p = block.word('P');
  if (const Word* q = block.word('Q')) peck_mm_ = length_mm(*q, state);
  if (p != nullptr) dwell_ = static_cast<std::uint32_t>(p - of_program.data());
  if (state.cycle != 82) dwell_ = Move::no_dwell;
  if (r != nullptr) {
    r_mm_ = length_mm(*r, state);
    decimals_ = r->decimals;
  }
  if (z != nullptr) z_mm_ = length_mm(*z, state);
  if (r != nullptr && z != nullptr) incremental_ = state.incremental;
  return block.named != 0 || r != nullptr;
}

std::string CycleWords::trouble(const Block& block, const ModalState& state, const AxisValues& from,
                                AxisSet axes) const {
  if (state.plane != Plane::xy) return "a canned cycle in G18 or G19: drilling is read in G17";
  if (state.feed_mode == FeedMode::inverse_time)
    return "a canned cycle under G93: give its feed under G94 or G95";
  if (!std::ranges::all_of(block.m, starts))
    return "a canned cycle with an M code that acts after it: give that a block of its own";
  if ((linear_axes & ~axes) != 0) return "a canned cycle needs X, Y and Z";
  for (std::size_t k = 3; k < axis_count; ++k)
    if (has(block.named, k) &&
        std::abs(rad_per_deg * block.word(axis_letters[k])->number - from[k]) > 1e-12)
      return "a canned cycle turns an axis: position it in a block before";
  if (!r_mm_) return "a canned cycle without R: say where its feed begins";
  if (!z_mm_) return "a canned cycle without Z: say how deep it goes";
  if (incremental_ != state.incremental)
    return "G90 and G91 were exchanged within a canned cycle, and controls differ in what its "
           "levels then are: give R and Z in this block" +
           levels_as_words(block, state);
  if (block.word('K') != nullptr && block.word('L') != nullptr)
    return "a canned cycle has both K and L: keep one";
  const Word* const repeats = repeats_of(block);
  if (repeats != nullptr && !(repeats->number >= 1.0 && repeats->number <= most_repeats &&
                              repeats->number == std::floor(repeats->number)))
    return "controls do not agree about this number of repeats: write 1 to 9999";
  return "";
}

std::string CycleWords::levels_as_words(const Block& block, const ModalState& state) const {
  if (block.word('R') != nullptr || block.word('Z') != nullptr) return "";
  const double r_mm = *r_mm_ + (incremental_ ? initial_mm_ : 0.0);
  const double z_mm = *z_mm_ + (incremental_ ? r_mm : 0.0);
  const double unit_mm = state.inch ? mm_per_inch : 1.0;
  return fmt::format(", R{:.9g} Z{:.9g} for the levels of before",
                     (r_mm - (state.incremental ? initial_mm_ : 0.0)) / unit_mm,
                     (z_mm - (state.incremental ? r_mm : 0.0)) / unit_mm);
}

Cycle CycleWords::cycle(const Block& block, const ModalState& state, const AxisValues& from) const {
  Cycle out;
  out.code = state.cycle;
  std::copy_n(from.begin(), 3, out.from_mm);
  for (std::size_t k = 0; k < 2; ++k) {
    out.to_mm[k] = from[k];
    if (!has(block.named, k)) continue;
    const double word_mm = length_mm(*block.word(axis_letters[k]), state);
    if (state.incremental) out.step_mm[k] = word_mm;
    out.to_mm[k] = word_mm + (state.incremental ? from[k] : 0.0);
  }
  if (const Word* const repeats = repeats_of(block)) out.holes = static_cast<int>(repeats->number);
  out.r_mm = *r_mm_ + (state.incremental ? initial_mm_ : 0.0);
  out.bottom_mm = *z_mm_ + (state.incremental ? out.r_mm : 0.0);
  out.initial_mm = initial_mm_;
  out.to_r = state.back_to_r;
  out.peck_mm = peck_mm_;
  return out;
}

}  // namespace trueaxis::nc
