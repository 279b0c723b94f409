// SPDX-License-Identifier: Apache-2.0
#include "spindle/sensors_agree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/angle.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double noted_rad = 2.0 * rad_per_deg, refused_rad = 10.0 * rad_per_deg;
constexpr double noted_gain = 0.03;
constexpr double times_motion = 3.0;  // the spindle's own order 1 is no larger than its others

}  // namespace

void check_sensors_agree(std::span<const RunReadings> runs, std::span<const SynchronousPart> parts,
                         std::vector<std::string>& notes) {
  std::vector<Diagnostic> wrong;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const RunReadings& run = runs[r];
    const Eigen::MatrixXcd& z = parts[r].harmonics;
    const double others = std::sqrt(z.rightCols(z.cols() - 2).squaredNorm() /
                                    static_cast<double>(run.angles_rad.size()));
    const std::complex<double> first = z(0, 1);
    const double blurred = times_motion * others / std::abs(first);
    if (run.angles_rad.size() > 1 && blurred > noted_rad)
      notes.push_back(
          fmt::format("{}: the eccentricity shows the sensors' angles only to {:.0f}° because of "
                      "the other orders: a smaller error remains undetected",
                      run.stream, std::max(2.0 * blurred, refused_rad) / rad_per_deg));
    for (std::size_t s = 1; s < run.angles_rad.size(); ++s) {
      const std::complex<double> seen = z(static_cast<Eigen::Index>(s), 1) / first;
      const double stated_rad = run.angles_rad[s] - run.angles_rad[0];
      const double off_rad = apart_rad(std::arg(seen), stated_rad);
      const double seen_deg = std::fmod(std::arg(seen) / rad_per_deg + 360.0, 360.0);
      const std::string what = fmt::format(
          "from the eccentricity, sensor {} is {:.1f}° from sensor 1, but {:.1f}° is stated", s + 1,
          seen_deg, std::fmod(stated_rad / rad_per_deg + 720.0, 360.0));
      const double gain = std::abs(seen);
      if (off_rad > std::max(refused_rad, 2.0 * blurred)) {
        wrong.push_back({run.stream, 0, 0,
                         what + ": correct the angles (from +X towards +Y) or the order of the "
                                "columns"});
      } else if (off_rad > std::max(noted_rad, blurred)) {
        notes.push_back(run.stream + ": " + what);
      } else if (std::abs(gain - 1.0) > std::max(noted_gain, blurred)) {
        notes.push_back(
            fmt::format("{}: sensor {} shows the eccentricity {:.3g} times as large as sensor 1: "
                        "check its gain",
                        run.stream, s + 1, gain));
      }
    }
  }
  if (!wrong.empty()) throw InputError(std::move(wrong));
}

}  // namespace trueaxis
