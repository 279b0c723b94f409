// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "simulate/files/scenario_files.hpp"
#include "support/dense.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::virtual_lathe {
namespace {

CutProgram cylinder(double nose_mm, double feed_mm) {
  CutProgram program;
  program.target.start_mm = 0.0;
  program.target.end_mm = -10.0;
  program.target.radius_mm = 30.0;
  program.tool.nose_radius_mm = nose_mm;
  program.tool.feed_mm_per_rev = feed_mm;
  program.use = CutUse::none;
  return program;
}

// offset(C, position) on 360 rows per revolution, over the whole cut.
template <class Offset>
CutTable table_of(const CutProgram& program, const Offset& offset) {
  CutTable table;
  table.face = program.target.kind == CutKind::face;
  const double travel = program.target.end_mm - program.target.start_mm;
  const double turns = std::abs(travel) / program.tool.feed_mm_per_rev;
  for (int i = 0; i <= static_cast<int>(std::ceil(turns * 360.0 - 1e-9)); ++i) {
    const double turn = i / 360.0;
    const double c = program.tool.c_start_rad + program.tool.sense * two_pi * turn;
    const double z =
        program.target.start_mm + std::copysign(program.tool.feed_mm_per_rev, travel) * turn;
    table.revolution.push_back(i / 360);
    table.c_rad.push_back(c);
    table.position_mm.push_back(z);
    table.wanted_mm.push_back(offset(c, z));
    table.command_mm.push_back(table.wanted_mm.back());
  }
  return table;
}

TEST(SimulateCut, WithoutCorrectionLeavesTheNominalCylinderWithItsFeedMarks) {
  const double nose = 0.4, feed = 0.1;
  for (const bool bore : {false, true}) {
    CutProgram program = cylinder(nose, feed);
    program.target.bore = bore;
    const CutPart part(program, {});
    double low = 1e9, high = -1e9;
    for (int i = 0; i < 1000; ++i) {
      const double radius = part.surface_mm(1.0, -5.0 - feed * i / 1000.0);
      low = std::min(low, radius);
      high = std::max(high, radius);
    }
    // The circle's exact height rn − √(rn² − f²/4) is f²/(8 rn) to 0.4 %; 1000 samples a mark miss
    // a peak of slope f/2rn by f/2000 · f/2rn = 6e-6 mm at most.
    EXPECT_NEAR(high - low, feed * feed / (8.0 * nose), 0.005 * feed * feed / (8.0 * nose) + 6e-6);
    EXPECT_NEAR(bore ? high : low, 30.0, 1e-7);
  }
}

TEST(SimulateCut, ASharpToolLeavesNoMarks) {
  const CutPart part(cylinder(0.0, 0.1), {});
  for (const double z : {-0.03, -4.98, -9.99}) EXPECT_NEAR(part.surface_mm(2.0, z), 30.0, 1e-12);
}

TEST(SimulateCut, ConeIsCutAtItsRadiusWhateverNoseAndHeight) {
  CutProgram program = cylinder(0.4, 0.02);
  program.target.kind = CutKind::cone;
  program.target.half_angle_rad = 15.0 * rad_per_deg;
  for (const double height : {0.0, 0.7}) {
    program.tool.height_mm = height;
    const CutPart part(program, {});
    for (const double z : {-0.5, -5.0, -9.5}) {
      const double radius = 30.0 + z * std::tan(15.0 * rad_per_deg);
      // Marks of f²/8rn = 0.125 µm rise above the surface.
      EXPECT_GE(part.surface_mm(0.3, z), radius - 1e-9) << height;
      EXPECT_LE(part.surface_mm(0.3, z), radius + 2e-4) << height;
    }
  }
}

// The tool's point is at C + angle + asin(h/R): a perfect actuator writes e cos(C) there.
TEST(SimulateCut, PerfectActuatorWritesTheTableWhereTheToolIs) {
  for (const int sense : {1, -1}) {
    for (const double angle : {0.0, std::numbers::pi}) {
      CutProgram program = cylinder(0.0, 0.1);
      program.use = CutUse::wanted;
      program.actuator.perfect = true;
      program.tool.sense = sense;
      program.tool.angle_from_probe_rad = angle;
      program.tool.height_mm = 2.0;
      const CutPart part(program,
                         table_of(program, [](double c, double) { return 0.3 * std::cos(c); }));
      for (int i = 0; i < 100; ++i) {
        const double c = 0.0628 * i;
        const double x = std::sqrt(900.0 - 4.0) + 0.3 * std::cos(c);
        const double theta = c + angle + std::atan2(2.0, x);
        // Linear interpolation of the table: A (π/360)²/2 = 11 nm.
        EXPECT_NEAR(part.surface_mm(theta, -5.0), std::hypot(x, 2.0), 1.2e-5) << sense << angle;
      }
    }
  }
}

TEST(SimulateCut, SecondOrderActuatorFollowsItsFrequencyResponse) {
  CutProgram program = cylinder(0.0, 0.1);
  program.use = CutUse::command;
  program.tool.speed_rpm = 2000.0;
  program.actuator.sampling_hz = 50000.0;
  program.actuator.delay_s = 1e-4;
  const int order = 5;
  const CutPart part(program,
                     table_of(program, [](double c, double) { return 0.1 * std::cos(order * c); }));
  std::complex<double> sum = 0.0;
  const int samples = 7200;
  for (int i = 0; i < samples; ++i) {
    const double c = two_pi * (20.0 + 10.0 * i / samples);  // ten turns after the start has settled
    sum += part.displacement_mm(c) * std::polar(2.0 / samples, -order * c);
  }
  const double w = two_pi * order * 2000.0 / 60.0, wn = two_pi * 600.0, t = 1.0 / 50000.0;
  const std::complex<double> j(0.0, 1.0);
  const std::complex<double> second = wn * wn / (wn * wn - w * w + 2.0 * 0.7 * wn * w * j);
  const double sinc = std::sin(w * t / 2.0) / (w * t / 2.0);
  const std::complex<double> theory = 0.1 * second * sinc * std::polar(1.0, -w * (1e-4 + t / 2.0));
  // 360 rows joined by lines pass a harmonic by sinc²(πn/360); aliases of hold and rows stay
  // outside it, the rest is the motion's own interpolation (4096 a turn).
  const double x = two_pi / 2.0 * order / 360.0;
  const double lines = std::pow(std::sin(x) / x, 2);
  EXPECT_NEAR(std::abs(sum), lines * std::abs(theory), 2e-5 * 0.1);
  EXPECT_NEAR(std::arg(sum / theory), 0.0, 2e-5);
}

TEST(SimulateCut, ProbedPartHasTheAxisThatWasCut) {
  CutProgram program = cylinder(0.4, 0.05);
  program.use = CutUse::wanted;
  program.actuator.perfect = true;
  const double e = 0.1;
  // The nose centre of an eccentric cylinder of radius R: e cos C + √((R+rn)² − e² sin² C) − R −
  // rn.
  const CutPart part(program, table_of(program, [&](double c, double) {
                       return e * std::cos(c) +
                              std::sqrt(30.4 * 30.4 - std::pow(e * std::sin(c), 2)) - 30.4;
                     }));
  Plan plan;
  PlannedPass pass;
  pass.start_mm = -1.0;
  pass.end_mm = -9.0;
  pass.feed_mm_per_rev = 0.05 * std::sqrt(2.0);
  pass.readings_per_revolution = 31.7;
  plan.passes = {pass};
  const ProbeStream stream = probe_cut(part, plan, Noise{}, 1);
  const Eigen::Index n = static_cast<Eigen::Index>(stream.size());
  Eigen::MatrixXd columns(n, 5);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double c = stream.c_rad[static_cast<std::size_t>(i)];
    columns.row(i) << 1.0, std::cos(c), std::sin(c), std::cos(2 * c), std::sin(2 * c);
  }
  const Eigen::VectorXd readings = Eigen::Map<const Eigen::VectorXd>(stream.reading_mm.data(), n);
  const Eigen::VectorXd solved = dense::least_squares(columns, readings);
  // 0.1 µm is the goal of the design.
  EXPECT_NEAR(solved[1], e, 1e-4);
  EXPECT_NEAR(solved[2], 0.0, 1e-4);
  for (std::size_t i = 0; i < stream.size(); ++i) {
    const double c = stream.c_rad[i];
    const double ideal = e * std::cos(c) + std::sqrt(900.0 - std::pow(e * std::sin(c), 2));
    // Marks up to f²/8rn = 0.78 µm; table interpolation 4e-6 mm; the centre's R + rn: e²/2 (1/R −
    // 1/(R+rn)) = 2e-6 mm.
    EXPECT_GE(stream.reading_mm[i], ideal - 1e-5);
    EXPECT_LE(stream.reading_mm[i], ideal + 0.8e-3);
  }
}

TEST(SimulateCut, FaceIsCutAlongZ) {
  CutProgram program = cylinder(0.4, 0.05);
  program.target.kind = CutKind::face;
  program.target.start_mm = 30.0;
  program.target.end_mm = 20.0;
  program.target.z_face_mm = 5.0;
  program.use = CutUse::wanted;
  program.actuator.perfect = true;
  const double slope = 0.001;
  const CutPart part(
      program, table_of(program, [&](double c, double x) { return slope * x * std::cos(c); }));
  Plan plan;
  PlannedPass pass;
  pass.start_mm = 29.0;
  pass.end_mm = 21.0;
  pass.feed_mm_per_rev = 0.0707;
  plan.passes = {pass};
  const ProbeStream stream = probe_cut(part, plan, Noise{}, 1);
  EXPECT_EQ(stream.kind, StreamKind::face);
  for (std::size_t i = 0; i < stream.size(); ++i) {
    const double plane = 5.0 + slope * stream.position_mm[i] * std::cos(stream.c_rad[i]);
    EXPECT_GE(stream.reading_mm[i], plane - 2e-6);  // rn slope²/2 and the table's interpolation
    EXPECT_LE(stream.reading_mm[i], plane + 0.8e-3);
  }
}

TEST(SimulateCut, ContradictionsAreInputErrors) {
  CutProgram program = cylinder(0.4, 0.1);
  program.use = CutUse::wanted;
  const CutTable table = table_of(program, [](double, double) { return 0.0; });
  EXPECT_NO_THROW(CutPart(program, table));
  CutProgram other = program;
  other.tool.feed_mm_per_rev = 0.12;
  EXPECT_THROW(CutPart(other, table), InputError);
  other = program;
  other.tool.sense = -1;
  EXPECT_THROW(CutPart(other, table), InputError);
  EXPECT_THROW(CutPart(program, CutTable{}), InputError);
  Plan plan;
  PlannedPass pass;
  pass.start_mm = -5.0;
  pass.end_mm = -11.0;
  plan.passes = {pass};
  EXPECT_THROW(probe_cut(CutPart(program, table), plan, Noise{}, 1), InputError);
}

TEST(SimulateCut, TableReaderUnwrapsInTheSenseOfTheCut) {
  const std::string head = "# tool: t\nrev,Z[mm],C[deg],X_fts[mm],X_command[mm]\n";
  const CutTable up =
      parse_cut_table(head + "0,0,90,0.1,0.2\n0,-1,350,0,0\n1,-2,10,0,0\n", "t.csv", 1);
  EXPECT_NEAR(up.c_rad[2], 370.0 * rad_per_deg, 1e-12);
  EXPECT_EQ(up.wanted_mm[0], 0.1);
  EXPECT_EQ(up.command_mm[0], 0.2);
  const CutTable down = parse_cut_table(head + "0,0,90,0,0\n0,-1,10,0,0\n1,-2,350,0,0\n", "t", -1);
  EXPECT_NEAR(down.c_rad[2], -10.0 * rad_per_deg, 1e-12);
  try {
    parse_cut_table(head + "0,0,90,0,0\n0,-1,x,0,0\n0,-1,10,0\n", "t.csv", 1);
    FAIL() << "bad rows were read";
  } catch (const InputError& error) {
    ASSERT_EQ(error.diagnostics().size(), 2u);
    EXPECT_EQ(error.diagnostics()[0].line, 4u);
    EXPECT_EQ(error.diagnostics()[0].column, 6u);
  }
  for (const char* revolution : {"1e30", "-1e300", "0.5"})  // no whole number that fits
    EXPECT_THROW(parse_cut_table(head + "0,0,0,0,0\n" + revolution + ",-1,10,0,0\n", "t", 1),
                 InputError)
        << revolution;
  EXPECT_THROW(parse_cut_table("", "t.csv", 1), InputError);
}

}  // namespace
}  // namespace trueaxis::virtual_lathe
