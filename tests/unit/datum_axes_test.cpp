// SPDX-License-Identifier: Apache-2.0
// The axes that other associations give the same readings, against geometry.
#include "job/datum_axes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace trueaxis {
namespace {

constexpr int angles = 72, sections = 6;
constexpr double radius_mm = 20.0, ridge_mm = 4e-3;

/// A cylinder that runs true, with a ridge along Z at one of its angles.
JobResult ridged() {
  JobResult result;
  JobReference& reference = result.job.references.emplace_back();
  reference.name = "seat";
  reference.fit.surface = SurfaceKind::cylinder;
  ProbeStream& stream = result.streams.emplace_back();
  for (int s = 0; s < sections; ++s)
    for (int a = 0; a < angles; ++a) {
      stream.reading_mm.push_back(radius_mm + (a == 0 ? ridge_mm : 0.0));
      stream.c_rad.push_back(2.0 * std::numbers::pi * (s + static_cast<double>(a) / angles));
      stream.position_mm.push_back(10.0 * s);
    }
  result.fits = {fit(stream, reference.fit)};
  result.diagnoses = {std::nullopt};
  result.forms.resize(1);
  return result;
}

double off_by(const std::vector<DatumAxis>& axes, Criterion criterion, std::size_t end) {
  const auto one = std::ranges::find(axes, criterion, &DatumAxis::criterion);
  return one == axes.end() || !one->why.empty() ? -1.0 : one->off_mm[end];
}

/// The axis of least squares goes 2/n of the ridge towards it. The circumscribed circle touches the
/// ridge and the point across: half of the ridge.
TEST(DatumAxes, ARidgeDrawsTheCircumscribedAxisByHalfOfIt) {
  const std::vector<DatumAxis> axes = datum_axes(ridged(), 0);
  const double by_least_squares = 2.0 * ridge_mm / angles;
  for (const std::size_t end : {0U, 1U}) {
    EXPECT_NEAR(off_by(axes, Criterion::gaussian, end), 0.0, 1e-7);  // of second order: h²/R/8
    EXPECT_NEAR(off_by(axes, Criterion::minimum_circumscribed, end),
                0.5 * ridge_mm - by_least_squares, 1e-6);  // h²/R
    EXPECT_LT(off_by(axes, Criterion::maximum_inscribed, end), 0.0) << "is not of a shaft";
  }
  const auto iso = std::ranges::find_if(axes, &DatumAxis::of_iso_5459);
  ASSERT_NE(iso, axes.end());
  EXPECT_EQ(iso->criterion, Criterion::minimum_circumscribed);
}

TEST(DatumAxes, AreNoneWhereNoValuesOfFormAreAskedFor) {
  for (const bool asked : {false, true}) {
    JobResult given = ridged();
    given.job.values_of_form = asked;
    const JobResult result = run_job(given.job, given.streams);
    EXPECT_EQ(result.datum_axes.size(), asked ? 1U : 0U);
  }
}

}  // namespace
}  // namespace trueaxis
