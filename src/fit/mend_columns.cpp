// SPDX-License-Identifier: Apache-2.0
#include "fit/mend_columns.hpp"

#include <algorithm>
#include <complex>
#include <vector>

#include "base/number.hpp"
#include "math/statistics.hpp"

namespace trueaxis {
namespace {

std::vector<double> steps_of(const std::vector<double>& column) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < column.size(); ++i) steps.push_back(column[i] - column[i - 1]);
  return steps;
}

constexpr std::size_t most_looked_at = 1000;  // readings of a periodogram
constexpr double most_turns = 200.0;          // that these span at most
constexpr double lowest_order = 0.05, highest_order = 20.0;

/// The readings less a line in C, of the beginning of the stream. What is beyond `most_turns` is
/// after a gap, and would make as many orders to look at as there are turns.
struct Wave {
  std::vector<double> c_rad, x_mm;
  double turns = 0.0;

  explicit Wave(const ProbeStream& stream) {
    std::size_t n = 0;
    while (n < std::min(stream.size(), most_looked_at) &&
           std::abs(stream.c_rad[n] - stream.c_rad.front()) <= most_turns * two_pi)
      ++n;
    c_rad.assign(stream.c_rad.begin(), stream.c_rad.begin() + static_cast<std::ptrdiff_t>(n));
    x_mm.assign(stream.reading_mm.begin(),
                stream.reading_mm.begin() + static_cast<std::ptrdiff_t>(n));
    turns = range_of(c_rad).length() / two_pi;
    double c = 0.0, x = 0.0, cc = 0.0, cx = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      c += c_rad[i] / static_cast<double>(n);
      x += x_mm[i] / static_cast<double>(n);
    }
    for (std::size_t i = 0; i < n; ++i) {
      cc += (c_rad[i] - c) * (c_rad[i] - c);
      cx += (c_rad[i] - c) * x_mm[i];
    }
    const double slope = cc > 0.0 ? cx / cc : 0.0;
    for (std::size_t i = 0; i < n; ++i) x_mm[i] -= x + slope * (c_rad[i] - c);
  }

  double power(double order) const {
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < x_mm.size(); ++i)
      sum += x_mm[i] * std::polar(1.0, order * c_rad[i]);
    return std::norm(sum);
  }
  /// Of the sum of squares.
  double share(double order) const {
    double squares = 0.0;
    for (const double x : x_mm) squares += x * x;
    return squares > 0.0 ? 2.0 * power(order) / (squares * static_cast<double>(x_mm.size())) : 0.0;
  }
};

}  // namespace

void begin_anew_each_turn(ProbeStream& stream) {
  const std::vector<double> steps = steps_of(stream.c_rad);
  if (steps.empty()) return;
  const double usual = median(steps);
  std::vector<double> back;
  for (const double step : steps)
    if (step * usual < 0.0) back.push_back(step);
  if (back.size() < 2 || 4 * back.size() > steps.size()) return;
  const double period = usual - median(std::move(back));
  double added = 0.0, before = stream.c_rad.front();
  for (double& c : stream.c_rad) {
    if ((c - before) * usual < 0.0) added += period;
    before = c;
    c = (c + added) * two_pi / std::abs(period);
  }
}

void unfold_c(ProbeStream& stream) {
  const double highest = range_of(stream.c_rad).high;
  const double fold = 0.5 * two_pi * std::max(1.0, std::round(highest / (0.5 * two_pi)));
  double added = 0.0, before = stream.c_rad.front();
  bool falls = false;
  for (double& c : stream.c_rad) {
    if (c > before && falls) added += 2.0 * fold;
    if (c != before) falls = c < before;
    before = c;
    c = added + (falls ? 2.0 * fold - c : c);
  }
}

void unwrap_reading(ProbeStream& stream) {
  std::vector<double>& x = stream.reading_mm;
  const double range = range_of(x).length();
  double largest = 0.0;
  for (const double step : steps_of(x)) largest = std::max(largest, std::abs(step));
  if (!(largest > 0.8 * range)) return;
  // A display has a round range, and the readings come near both of its ends.
  const double decade = digit_worth(range, 1);
  double period = 10.0 * decade;
  for (const double digit : {5.0, 2.0, 1.0})
    if (digit * decade >= 0.999 * range) period = digit * decade;
  // Where it begins anew, X goes on as it does elsewhere; the edge of a keyway does not.
  double elsewhere = 0.0, anew = 0.0;
  for (const double step : steps_of(x)) {
    const double turns = std::round(step / period);
    double& most = turns == 0.0 ? elsewhere : anew;
    most = std::max(most, std::abs(step - turns * period));
  }
  if (anew > 2.0 * elsewhere) return;
  double added = 0.0, before = x.front();
  for (double& value : x) {
    added -= period * std::round((value - before) / period);
    before = value;
    value += added;
  }
}

void turn_as_reading_does(ProbeStream& stream) {
  const Wave wave(stream);
  if (!(wave.turns > 0.0)) return;
  const double step = 0.25 / std::max(wave.turns, 1.0);
  // If a ninth of the square goes once per revolution of C as written, only a line next to that,
  // which explains part of it, can be the misreading: any other leaves too much.
  const bool once = 9.0 * wave.share(1.0) > 1.0;
  const double from = once ? 1.0 - 4.0 * step : lowest_order;
  const double to = once ? 1.0 + 4.0 * step : highest_order;
  double best = 1.0, most = once ? wave.power(1.0) : 0.0;
  for (double order = from; order <= to; order += step) {
    const double power = wave.power(order);
    if (power <= most) continue;
    most = power;
    best = order;
  }
  for (double width = 0.5 * step; width > 1e-6; width *= 0.5)
    for (const double order : {best - width, best + width})
      if (const double power = wave.power(order); power > most) {
        most = power;
        best = order;
      }
  constexpr double lobes = 0.02;
  const double whole = std::round(best);
  if (whole >= 2.0 && std::abs(best - whole) < std::max(lobes, step)) return;
  if (std::abs(best - 1.0) < step) return;
  for (double& c : stream.c_rad) c *= best;
}

}  // namespace trueaxis
