// SPDX-License-Identifier: Apache-2.0
// The position error of a measured screw axis (skipped where it is not present). The numbers were
// found in the data by others, apart from this engine (README of the data).
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "calibrate/estimate/read_out.hpp"
#include "support/places.hpp"

namespace trueaxis {
namespace {

MachineMeasurement screw_axis(const std::filesystem::path& path) {
  MachineMeasurement out;
  out.source = "screw_axis.csv";
  out.kind = MeasurementKind::axis;
  out.axis = AxisName::X;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#' || line[0] == 't') continue;
    std::istringstream fields(line);
    char comma = 0;
    double t = 0.0, command = 0.0, read = 0.0;
    fields >> t >> comma >> command >> comma >> read;
    out.axes.push_back({command});
    out.actual.push_back(read);
  }
  return out;
}

// Order 4 of 1 mm 20.57 µm, 8 1.49, 12 1.09, 16 0.60; RMS 14.6 µm before, 0.285 after. With 4300
// readings of that RMS an amplitude has u = 0.285 √(2/4300) = 6 nm; the file rounds to 10 nm.
TEST(ReadOutMeasured, ScrewIsPeriodicInOneMillimetre) {
  const auto path = std::filesystem::path(places::measured_data()) / "screw_axis.csv";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  const AxisReadOut found = calibrate_detail::read_out_of(screw_axis(path), 24);
  std::cout << "period " << found.period << " mm, RMS " << 1e3 * found.rms_before << " -> "
            << 1e3 * found.rms_after << " um\n";
  for (const auto& one : found.orders)
    std::cout << one.order << ": " << 1e3 * one.amplitude() << " um\n";
  const auto amplitude_um = [&](double per_mm) {
    for (const auto& one : found.orders)
      if (std::abs(one.order / found.period - per_mm) < 0.02) return 1e3 * one.amplitude();
    return 0.0;
  };
  EXPECT_NEAR(amplitude_um(4.0), 20.57, 0.03);
  EXPECT_NEAR(amplitude_um(8.0), 1.49, 0.03);
  EXPECT_NEAR(amplitude_um(12.0), 1.09, 0.03);
  EXPECT_NEAR(amplitude_um(16.0), 0.60, 0.03);
  EXPECT_NEAR(1e3 * found.rms_before, 14.6, 0.1);
  EXPECT_LT(1e3 * found.rms_after, 0.29);
}

}  // namespace
}  // namespace trueaxis
