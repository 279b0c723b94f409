// SPDX-License-Identifier: Apache-2.0
#include "correct/deviation.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "trueaxis/units.hpp"

namespace trueaxis {

void add_revolution(Deviation& worst, const std::vector<double>& off_mm) {
  const double count = static_cast<double>(off_mm.size());
  std::complex<double> once;
  for (std::size_t i = 0; i < off_mm.size(); ++i) {
    worst.largest_mm = std::max(worst.largest_mm, std::abs(off_mm[i]));
    const double simpson = i % 2 == 0 ? 2.0 / 3.0 : 4.0 / 3.0;
    once += simpson * off_mm[i] * std::polar(2.0 / count, -two_pi * static_cast<double>(i) / count);
  }
  worst.once_mm = std::max(worst.once_mm, std::abs(once));
}

std::vector<std::size_t> looked_at(std::size_t revolutions, std::size_t points_of_one) {
  constexpr std::size_t most_points = 400000;
  const std::size_t count =
      std::min(revolutions, std::clamp<std::size_t>(most_points / points_of_one, 3, 17));
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < count; ++k)
    chosen.push_back(count == 1 ? 0 : k * (revolutions - 1) / (count - 1));
  return chosen;
}

std::size_t parts_between(std::size_t per_revolution) {
  const std::size_t parts = std::max<std::size_t>(2, (63 + per_revolution) / per_revolution);
  return parts + parts % 2;
}

Deviation between_rows(const Profile& profile, int rows, Interpolation by) {
  const bool held = by == Interpolation::none;
  const auto per_rev = static_cast<std::size_t>(rows);
  const std::size_t parts = parts_between(per_rev);
  const auto wanted = [&](std::size_t revolution, double row) {
    const double turns = std::max(0.0, static_cast<double>(revolution) + row / rows);
    return profile.at(profile.c_after_rad(turns), profile.position_after_mm(turns));
  };
  Deviation worst;
  std::vector<double> off_mm(per_rev * parts);
  for (const std::size_t revolution : looked_at(profile.revolutions(), off_mm.size())) {
    double before = held ? wanted(revolution, -1.0) : 0.0, from = wanted(revolution, 0.0);
    for (std::size_t row = 0; row < per_rev; ++row) {
      const double to = wanted(revolution, static_cast<double>(row) + 1.0);
      for (std::size_t p = 0; p < parts; ++p) {
        const double share = static_cast<double>(p) / static_cast<double>(parts);
        off_mm[row * parts + p] = (held ? from : from + share * (to - from)) -
                                  wanted(revolution, static_cast<double>(row) + share);
      }
      // Where one value follows the other both are counted: the middle of the step.
      if (held) {
        off_mm[row * parts] = 0.5 * (before - from);
        worst.largest_mm = std::max(worst.largest_mm, std::abs(to - from));
      }
      before = from;
      from = to;
    }
    add_revolution(worst, off_mm);
  }
  return worst;
}

int rows_that_would_do(const Correction& correction, Interpolation by, const Deviation& limit) {
  constexpr double most_rows = 1e5;
  const Profile profile(correction.commanded_axis(), correction.target, correction.tool,
                        correction.motions);
  double rows = correction.tool.rows_per_revolution;
  while (rows <= most_rows) {
    const Deviation off = between_rows(profile, static_cast<int>(rows), by);
    const double times = std::max(off.largest_mm / limit.largest_mm, off.once_mm / limit.once_mm);
    if (times <= 1.0) return static_cast<int>(rows);
    // The deviation falls with the rows, that of straight lines with their square.
    rows = std::max(rows + 1.0,
                    std::ceil(rows * (by == Interpolation::none ? times : std::sqrt(times))));
  }
  return 0;
}

}  // namespace trueaxis
