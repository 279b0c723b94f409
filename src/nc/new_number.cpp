// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "nc/number_text.hpp"
#include "nc/writer.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::nc {

namespace {

/// mm or rad.
double unit_of(const Move& move, std::size_t axis) {
  return is_rotary(axis) ? rad_per_deg : move.modal.inch ? mm_per_inch : 1.0;
}

}  // namespace

bool says(const Word& word, const NewNumber& number, const Move& move) {
  const double factor = unit_of(move, axis_of(word.letter));
  return std::abs(factor * word.number - number.value) < factor * half_of(number.decimals);
}

NewNumber new_number(const Move& move, std::size_t axis, double value,
                     const WriteOptions& options) {
  const bool inch = move.modal.inch && !is_rotary(axis);
  const double factor = unit_of(move, axis);
  const int least =
      is_rotary(axis) ? options.angle_decimals : options.linear_decimals + (inch ? 2 : 0);
  NewNumber out;
  out.decimals = std::max<int>(move.decimals[axis], least);
  const double before = move.words[axis] / factor, change = (value - move.words[axis]) / factor;
  out.number = rounded(before + change, out.decimals);
  // Half of the last decimal, less the rounding of the conversion.
  out.stays = std::abs(change) < half_of(out.decimals) ||
              std::abs(out.number - before) <=
                  8.0 * std::numeric_limits<double>::epsilon() * std::abs(before);
  out.value = out.stays ? move.words[axis] : out.number * factor;
  return out;
}

AxisValues as_written(const Move& move, const AxisValues& words, const WriteOptions& options) {
  AxisValues out{};
  for (std::size_t k = 0; k < axis_count; ++k)
    if (has(options.axes, k)) out[k] = new_number(move, k, words[k], options).value;
  return out;
}

}  // namespace trueaxis::nc
