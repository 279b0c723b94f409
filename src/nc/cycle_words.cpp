// SPDX-License-Identifier: Apache-2.0
#include "nc/cycle_words.hpp"

#include <algorithm>
#include <cmath>

#include "trueaxis/units.hpp"

namespace trueaxis::nc {
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
    r_mm_ = length_mm(*r, state) + (state.incremental ? initial_mm_ : 0.0);
    decimals_ = r->decimals;
  }
  if (z != nullptr)
    bottom_mm_ = length_mm(*z, state) + (state.incremental ? r_mm_.value_or(0.0) : 0.0);
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
  if (!bottom_mm_) return "a canned cycle without Z: say how deep it goes";
  if (block.word('K') != nullptr && block.word('L') != nullptr)
    return "a canned cycle has both K and L: keep one";
  const Word* const repeats = repeats_of(block);
  if (repeats != nullptr && !(repeats->number >= 1.0 && repeats->number <= most_repeats &&
                              repeats->number == std::floor(repeats->number)))
    return "controls do not agree about this number of repeats: write 1 to 9999";
  return "";
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
  out.r_mm = *r_mm_;
  out.bottom_mm = *bottom_mm_;
  out.initial_mm = initial_mm_;
  out.to_r = state.back_to_r;
  out.peck_mm = peck_mm_;
  return out;
}

}  // namespace trueaxis::nc
