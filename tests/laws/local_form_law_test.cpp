// SPDX-License-Identifier: Apache-2.0
// A dent or a bump is in no surface of few orders, and the diagnosis excludes its middle as
// outliers: RONt was 3.1 ± 0.3 µm next to a local form of 8 µm.
#include <gtest/gtest.h>

#include <cmath>

#include "laws/turned_cylinder.hpp"
#include "trueaxis/part_form.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::testing {
namespace {

TEST(LocalForm, IsInTheBoundOfTheForm) {
  constexpr double wide_rad = 0.25, long_mm = 3.0;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    virtual_lathe::Scenario scenario = turned_cylinder(seed, 20.0, 0.0005);
    scenario.plan.passes[0].readings_per_revolution = 48.3;
    const double height_mm = seed % 2 == 0 ? 0.008 : -0.012;
    ProbeStream stream = simulate(scenario);
    for (std::size_t i = 0; i < stream.size(); ++i) {
      const double around = std::remainder(stream.c_rad[i] - static_cast<double>(seed), two_pi);
      const double along_mm = stream.position_mm[i] - 14.0;
      stream.reading_mm[i] += height_mm * std::exp(-0.5 * std::pow(around / wide_rad, 2) -
                                                   0.5 * std::pow(along_mm / long_mm, 2));
    }
    const Diagnosis diagnosis = diagnosed_cylinder(stream);
    FitOptions fit;
    fit.surface = SurfaceKind::cylinder;
    const PartForm form = part_form({stream, &diagnosis}, fit, {});
    ASSERT_TRUE(form.why_not.empty()) << form.why_not;
    EXPECT_GT(form.local_mm, 0.8 * std::abs(height_mm)) << seed;
    for (const char* name : {"RONt", "CYLt"}) {
      const FormValue* value = worst_value(form.with_open(), name, name[0] == 'R' ? "MZCI" : "");
      if (value == nullptr) value = worst_value(form.with_open(), name, "MZCY");
      ASSERT_NE(value, nullptr) << name;
      ASSERT_TRUE(value->estimate.interval) << name << ", seed " << seed;
      // A lone bump is as high as it is, whatever circle or cylinder it is about; the filter of 50
      // UPR takes 2 % of one of 14°.
      EXPECT_GE(value->estimate.interval->back(), 0.9 * std::abs(height_mm)) << name << seed;
      EXPECT_LE(value->estimate.interval->back(), 2.0 * std::abs(height_mm)) << name << seed;
    }
  }
}

}  // namespace
}  // namespace trueaxis::testing
