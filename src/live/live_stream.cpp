// SPDX-License-Identifier: Apache-2.0
#include "live/live_stream.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

/// Calls `each` with every column that a stream may have.
template <class Each>
void for_columns(ProbeStream& stream, const ProbeStream& other, Each each) {
  each(stream.reading_mm, other.reading_mm);
  each(stream.c_rad, other.c_rad);
  each(stream.position_mm, other.position_mm);
  each(stream.time_s, other.time_s);
  each(stream.pass, other.pass);
  each(stream.setup, other.setup);
}

/// All that is not a column.
ProbeStream without_readings(const ProbeStream& stream) {
  ProbeStream out = stream;
  for_columns(out, stream, [](auto& column, const auto&) { column.clear(); });
  return out;
}

}  // namespace

LiveStream::LiveStream(std::size_t most) : most_(most) {
  expects(most >= 2, "two readings or more");
}

void LiveStream::take(const ProbeStream& next, std::size_t row) {
  for_columns(kept_, next, [row](auto& column, const auto& from) {
    if (!from.empty()) column.push_back(from[row]);
  });
}

void LiveStream::add(ProbeStream next) {
  expects(next.more_reading_mm.empty(), "one sensor");
  if (next.size() == 0) return;
  if (readings_ == 0) kept_ = without_readings(next);
  if (kept_.size() > 0) {
    const double gap = kept_.c_rad.back() - next.c_rad.front();
    const double turns = std::round(gap / two_pi);
    for (double& c : next.c_rad) c += two_pi * turns;
  }
  for (std::size_t row = 0; row < next.size(); ++row, ++readings_) {
    if (readings_ % stride_ != 0) continue;
    if (kept_.size() == most_) {
      const std::size_t half = (most_ + 1) / 2;
      for_columns(kept_, kept_, [half](auto& column, const auto&) {
        if (column.empty()) return;
        for (std::size_t i = 0; i < half; ++i) column[i] = column[2 * i];
        column.resize(half);
      });
      stride_ *= 2;
      if (readings_ % stride_ != 0) continue;
    }
    take(next, row);
  }
}

ProbeStream LiveStream::sample(std::size_t count) const {
  const std::size_t size = kept_.size();
  if (size <= count) return kept_;
  constexpr double golden = 0.6180339887498949;
  ProbeStream out = without_readings(kept_);
  const double step = static_cast<double>(size) / static_cast<double>(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double share = golden * static_cast<double>(k);
    const double at = (static_cast<double>(k) + share - std::floor(share)) * step;
    const std::size_t row = std::min(static_cast<std::size_t>(at), size - 1);
    for_columns(out, kept_, [row](auto& column, const auto& from) {
      if (!from.empty()) column.push_back(from[row]);
    });
  }
  return out;
}

}  // namespace trueaxis
