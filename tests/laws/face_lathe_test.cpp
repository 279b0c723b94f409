// SPDX-License-Identifier: Apache-2.0
// Faces: the columns of base and effects against the virtual lathe, and findings played back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "diagnose/files/diagnosis_json.hpp"
#include "laws/face_bench.hpp"
#include "trueaxis/resimulation.hpp"

namespace trueaxis::testing {
namespace {

// The lathe finds a contact to a few units of the last place of 40 mm.
constexpr double reading_mm = 1e-12;

double largest(const std::vector<double>& values) {
  double size = 0.0;
  for (const double value : values) size = std::max(size, std::abs(value));
  return size;
}

class FaceLathe : public ::testing::TestWithParam<FaceBench> {
 protected:
  FaceBench bench() const { return GetParam(); }
  std::vector<double> read(const LatheCase& one, double size) const {
    virtual_lathe::Scenario scenario = bench().scenario();
    scenario.effects = {{one.id, one.lathe(size)}};
    return virtual_lathe::simulate(scenario).reading_mm;
  }
};

TEST_P(FaceLathe, StartsFromTheSameReadings) {
  const ProbeStream stream = virtual_lathe::simulate(bench().scenario());
  const diagnose_detail::LinearisationPoint point = bench().point(stream);
  const std::vector<double> x = point.column(&diagnose_detail::PointPart::x);
  for (std::size_t i = 0; i < stream.size(); ++i)
    ASSERT_NEAR(stream.reading_mm[i], x[i], 10.0 * reading_mm);
  EXPECT_EQ(point.two_sided, bench().across);
}

// change(a)/a = column + O(a): half the size leaves half the error, and none but rounding where the
// effect is linear. The axis of the lathe's part and that of the point agree to the tilt's square,
// 1e-6 of 12 mm. A spiral of 3 mm feed sees that as 3e-5 of a turn.
TEST_P(FaceLathe, ColumnsAreTheLimitOfTheLathe) {
  const ProbeStream stream = virtual_lathe::simulate(bench().scenario());
  const diagnose_detail::LinearisationPoint point = bench().point(stream);
  diagnose_detail::PointRoom room;
  std::size_t compared = 0;
  for (const LatheCase& one : bench().cases()) {
    // Through the centre a form about the axis is not smooth: a ball rests on its flanks.
    if (bench().ball_mm > 0.0 && one.id.starts_with("part.") && one.id != "part.seat_slip")
      continue;
    SCOPED_TRACE(one.id);
    const EffectTerm& term = find_effect(one.id)->term;
    const std::size_t count = linear_parameters(term, one.shape).size();
    ASSERT_EQ(count, one.linear.size());
    std::vector<std::vector<double>> columns(count, std::vector<double>(stream.size()));
    std::vector<double*> rows;
    for (auto& column : columns) rows.push_back(column.data());
    fill_columns(term, point.context(point.all(room)), one.shape, rows);
    std::vector<double> expected(stream.size(), 0.0);
    for (std::size_t j = 0; j < count; ++j)
      for (std::size_t i = 0; i < expected.size(); ++i)
        expected[i] += one.linear[j] * columns[j][i];
    const auto error = [&](double size) {
      const std::vector<double> after = read(one, size);
      std::vector<double> off(after.size());
      for (std::size_t i = 0; i < off.size(); ++i)
        off[i] = (after[i] - stream.reading_mm[i]) / size - expected[i];
      return largest(off);
    };
    const double rounding = 2.0 * reading_mm / one.size + 1e-4 * largest(expected);
    const double whole = error(one.size), half = error(0.5 * one.size);
    EXPECT_LT(whole, 0.05 * largest(expected) + rounding);
    EXPECT_LT(half, 0.55 * whole + 2.0 * rounding);
    ++compared;
  }
  EXPECT_GE(compared, bench().ball_mm > 0.0 ? 10u : bench().cases().size());
}

// A face that is elsewhere: the base columns are the lathe's readings of it, to the tilt's
// square.
TEST_P(FaceLathe, BaseColumnsAreTheFacePutElsewhere) {
  const ProbeStream stream = virtual_lathe::simulate(bench().scenario());
  const diagnose_detail::LinearisationPoint point = bench().point(stream);
  const std::size_t count = point.base.columns();
  ASSERT_EQ(count, 6u);  // two clampings
  std::vector<std::vector<double>> columns(count, std::vector<double>(stream.size()));
  std::vector<double*> rows;
  for (auto& column : columns) rows.push_back(column.data());
  diagnose_detail::PointRoom room;
  point.fill_base(point.all(room), rows);
  const double step = 1e-6;
  const std::function<void(diagnose_detail::Clamping&)> moves[] = {
      [&](diagnose_detail::Clamping& c) { c.shape.axis.slope_x += step; },
      [&](diagnose_detail::Clamping& c) { c.shape.axis.slope_y += step; },
      [&](diagnose_detail::Clamping& c) { c.shape.axis.z_ref_mm += step; }};
  for (std::size_t j = 0; j < 3; ++j) {
    virtual_lathe::Scenario scenario = bench().scenario();
    diagnose_detail::Clamping moved = bench().clamping();
    moves[j](moved);
    const Axis& axis = moved.shape.axis;
    const double n =
        1.0 / std::sqrt(1.0 + axis.slope_x * axis.slope_x + axis.slope_y * axis.slope_y);
    scenario.part.l = axis.slope_x * n, scenario.part.m = axis.slope_y * n;
    scenario.part.x0_mm = scenario.part.y0_mm = 0.0;
    scenario.part.d_mm = axis.z_ref_mm * n - bench().ball_mm;
    const std::vector<double> after = virtual_lathe::simulate(scenario).reading_mm;
    for (std::size_t i = 0; i < stream.size(); ++i)
      ASSERT_NEAR((after[i] - stream.reading_mm[i]) / step, columns[j][i] + columns[j + 3][i],
                  1e-5);
  }
}

// The diagnosis that names an effect at its size, as written to a file, plays back the readings.
TEST_P(FaceLathe, EveryEffectComesBack) {
  const ProbeStream ideal = virtual_lathe::simulate(bench().scenario());
  FitOptions options;
  options.surface = SurfaceKind::plane;
  Diagnosis diagnosis;
  diagnosis.baseline = diagnosis.named = diagnosis.extended = fit(ideal, options);
  ASSERT_EQ(diagnosis.baseline.status, FitStatus::converged);
  diagnosis.z_mid_mm = bench().middle_mm();
  diagnosis.z_half_mm = bench().half_mm();
  for (const LatheCase& one : bench().cases()) {
    if (bench().ball_mm > 0.0) continue;  // see above
    SCOPED_TRACE(one.id);
    virtual_lathe::Scenario scenario = bench().scenario();
    scenario.effects = {{one.id, one.lathe(one.size)}};
    const ProbeStream stream = virtual_lathe::simulate(scenario);
    Finding finding;
    finding.term.effect = find_effect(one.id);
    finding.term.shape = one.shape;
    for (const double linear : one.linear) finding.term.linear.push_back(one.size * linear);
    Diagnosis found = diagnosis;
    found.findings = {finding};
    const SimulatedReadings simulated =
        resimulate(diagnosis_from_json(diagnosis_json(found), "diagnosis.json"), stream).readings;
    ASSERT_EQ(simulated.after_mm.size(), stream.size());
    double off = 0.0, hidden = 0.0;
    for (std::size_t i = 0; i < stream.size(); ++i) {
      off = std::max(off, std::abs(stream.reading_mm[i] - simulated.after_mm[i]));
      hidden = std::max(hidden, std::abs(stream.reading_mm[i] - ideal.reading_mm[i]));
    }
    // Phases and times pass through text and back; the plane is exact to its last place.
    EXPECT_LT(off, 1e-6 * hidden + 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Faces, FaceLathe,
                         ::testing::Values(FaceBench{"OneSide"}, FaceBench{"Across", true},
                                           FaceBench{"WithABall", false, 1.5}),
                         [](const auto& bench) { return bench.param.name; });

}  // namespace
}  // namespace trueaxis::testing
