// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "trueaxis/control_table.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

/// The helix of a table at one angle: revolution k of it is the point between the rows there.
class AtAngle {
 public:
  AtAngle(std::size_t rows, std::size_t per_revolution, double turns)
      : rows_(rows), per_revolution_(per_revolution) {
    part_ = turns - std::floor(turns);
    if (part_ >= 1.0) part_ = 0.0;  // a turn less a rounding
    const double at = part_ * static_cast<double>(per_revolution);
    first_ = std::min(static_cast<std::size_t>(at), per_revolution - 1);
    share_ = at - static_cast<double>(first_);
  }

  double part() const { return part_; }
  /// The last revolution, at the end of the path, closes on itself.
  double of(const std::vector<double>& values, std::size_t revolution) const {
    const std::size_t row = revolution * per_revolution_ + first_;
    const std::size_t next = row + 1 < rows_ ? row + 1 : rows_ - per_revolution_;
    return values[row] + share_ * (values[next] - values[row]);
  }

 private:
  std::size_t rows_, per_revolution_, first_ = 0;
  double part_ = 0.0, share_ = 0.0;
};

}  // namespace

double table_value_mm(const CorrectionRows& rows, const std::vector<double>& values,
                      int rows_per_revolution, double turns, double position_mm) {
  const std::vector<double>& along = rows.position_mm;
  const auto per_rev = static_cast<std::size_t>(rows_per_revolution);
  expects(per_rev > 0 && along.size() % per_rev == 0 && along.size() >= 2 * per_rev &&
              values.size() == along.size(),
          "two whole revolutions of rows or more");
  const std::size_t last = along.size() / per_rev - 2;  // revolution that has one after it
  const auto [low, high] = std::minmax(along.front(), along.back());
  const double position = std::clamp(position_mm, low, high);
  const double feed = along[per_rev] - along[0];
  const AtAngle angle(along.size(), per_rev, turns);
  const double guess = std::floor((position - along.front()) / feed - angle.part());
  auto k = static_cast<std::size_t>(std::clamp(guess, 0.0, static_cast<double>(last)));
  // Positions are rounded, so the guess is one off at most.
  if ((position - angle.of(along, k + 1)) * feed > 0.0 && k < last)
    ++k;
  else if ((position - angle.of(along, k)) * feed < 0.0 && k > 0)
    --k;
  const double from = angle.of(along, k), to = angle.of(along, k + 1);
  const double share = to != from ? std::clamp((position - from) / (to - from), -1.0, 1.0) : 0.0;
  const double a = angle.of(values, k), b = angle.of(values, k + 1);
  return a + share * (b - a);
}

}  // namespace trueaxis
