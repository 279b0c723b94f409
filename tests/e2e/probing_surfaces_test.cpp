// SPDX-License-Identifier: Apache-2.0
// Programs for bores and faces: LinuxCNC's interpreter drives them towards a part that is met
// numerically.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "support/command_fixture.hpp"
#include "support/driven_program.hpp"
#include "support/rs274_calls.hpp"

namespace trueaxis::testing {
namespace {

const std::string limits_inside =
    "[limits]\nx_mm = [-80, 120]\nz_mm = [-80, 80]\nspeed_rpm = 400\n"
    "[part]\nreach_mm = 41\nfront_mm = 0.5\nbore_radius_mm = 29.7\nbore_bottom_mm = -60\n"
    "[probe]\nkind = \"touch\"\nball_radius_mm = 1\nstylus_radius_mm = 0.6\n"
    "stylus_length_mm = 50\nfeed_mm_per_min = 150\nclearance_mm = 3\nsearch_mm = 1.5\n";

/// Out over a face and through its centre, 12 points per revolution.
const std::string over_a_face =
    "[part]\nsurface = \"face\"\nd_mm = 0\n[noise]\nsigma_um = 1\n"
    "[[pass]]\nx_start_mm = 12\nx_end_mm = 36\nfeed_mm_per_rev = 12\n"
    "readings_per_revolution = 12\n"
    "[[pass]]\nx_start_mm = 36\nx_end_mm = -24\nfeed_mm_per_rev = 30\n"
    "readings_per_revolution = 12\n";
const std::string bore_from_both_sides =
    "[part]\nsurface = \"cylinder\"\nfeature = \"bore\"\nradius_mm = 30\n[noise]\nsigma_um = 1\n"
    "[[pass]]\nz_start_mm = -10\nz_end_mm = -40\nfeed_mm_per_rev = 10\n"
    "readings_per_revolution = 12\n"
    "[[pass]]\nz_start_mm = -40\nz_end_mm = -10\nfeed_mm_per_rev = 10\n"
    "readings_per_revolution = 12\nsetup = 2\n[[setup]]\nnumber = 2\nside = \"rear\"\n";

class ProbingSurfaces : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    if (!has_interpreter()) GTEST_SKIP() << "rs274 (linuxcnc) is not installed";
    file("plan.toml", bore_from_both_sides);
    file("limits.toml", limits_inside);
  }
  std::vector<Call> program(const std::string& options = "") {
    const CommandStreams done = command(
        "study plan plan.toml --goal-um 5 --repeats 100 --control linuxcnc --limits limits.toml "
        "-o p.ngc" +
        options);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return interpreted(folder_, "p.ngc");
  }
  double fitted(const char* parameter) {
    return result("fit.json")["parameters"][parameter]["value"].get<double>();
  }
};

// The readings have six decimals: half of the last is 5e-7 mm, and a mean of 74 of them less.
TEST_F(ProbingSurfaces, ABoreIsTouchedFromInsideAndFittedAsItIs) {
  const BlockWithBore bore;
  const std::vector<Call> calls = program();
  const Driven run = driven(calls, bore);
  EXPECT_EQ(run.trouble, "");
  ASSERT_EQ(run.touched.size(), 74u);
  for (std::size_t k = 0; k < run.touched.size(); ++k)
    EXPECT_EQ(run.touched[k].x < 0.0, k >= 37) << k;
  // 3 mm of clearance to a free radius that the bore keeps to 0.3 mm less its offset.
  EXPECT_GT(run.nearest_mm, 3.0);
  for (const Call& one : calls) EXPECT_TRUE(one.name != "STRAIGHT_FEED" || one.feed == 150.0);
  file("p.log", run.logs.at("p.log"));
  ASSERT_EQ(command("import p.log -o s.csv").exit_code, 0) << run.logs.at("p.log");
  EXPECT_TRUE(contains(read_text(folder_ / "s.toml"), "feature = \"bore\""));
  const CommandStreams fit = command("fit s.csv --surface cylinder --json fit.json");
  ASSERT_EQ(fit.exit_code, 0) << fit.err;
  const double n = std::sqrt(1.0 + 0.002 * 0.002 + 0.001 * 0.001);
  EXPECT_NEAR(fitted("radius"), bore.radius_mm, 5e-7);
  EXPECT_NEAR(fitted("x0"), bore.x0_mm, 1e-6);
  EXPECT_NEAR(fitted("y0"), bore.y0_mm, 1e-6);
  EXPECT_NEAR(fitted("l"), bore.slope_x / n, 1e-6 / 15.0);  // over half of the length
  EXPECT_NEAR(fitted("m"), bore.slope_y / n, 1e-6 / 15.0);
  // As a shaft it would be two balls too small.
  std::string job = read_text(folder_ / "s.toml");
  job.replace(job.find("\"bore\""), 6, "\"shaft\"");
  file("shaft.toml", job);
  const CommandStreams shaft = command("run shaft.toml -o result");
  EXPECT_EQ(shaft.exit_code, 3);
  EXPECT_TRUE(contains(shaft.err, "the stream states 'feature: bore'")) << shaft.err;
}

// The shank has room in a taper that opens to the front, if its mouth is stated.
TEST_F(ProbingSurfaces, ATaperIsTouchedFromInside) {
  BlockWithBore bore;
  bore.taper = std::tan(3.0 * std::numbers::pi / 180.0);
  std::string taper = bore_from_both_sides, narrow = limits_inside;
  taper.replace(taper.find("cylinder\""), 9, "cone\"\nhalf_angle_deg = 3");
  narrow.replace(narrow.find("29.7"), 4, "27.5");
  file("plan.toml", taper);
  file("limits.toml", narrow);
  expect_input_error(
      "study plan plan.toml --goal-um 5 --repeats 100 --control linuxcnc --limits limits.toml "
      "-o narrow.ngc",
      "the bore is free to 27.5 mm");
  file("limits.toml", narrow.insert(narrow.find("[probe]"), "bore_mouth_radius_mm = 29.7\n"));
  const Driven run = driven(program(), bore);
  EXPECT_EQ(run.trouble, "");
  EXPECT_GT(run.nearest_mm, 3.0);
  file("p.log", run.logs.at("p.log"));
  const CommandStreams fit = command("fit p.log --surface cone --json fit.json");
  ASSERT_EQ(fit.exit_code, 0) << fit.err;
  EXPECT_NEAR(fitted("half_angle"), 3.0, 180.0 / std::numbers::pi * 1e-6 / 15.0);  // deg
  EXPECT_NEAR(-fitted("k") * bore.taper, bore.radius_mm, 1e-5);
}

// Inside a narrower mouth the shank would be what touches.
TEST_F(ProbingSurfaces, AnUndercutIsNotProbed) {
  BlockWithBore bore;
  bore.mouth_mm = 29.0;
  const Driven run = driven(program(), bore);
  EXPECT_EQ(run.trouble, "");
  for (const BallAt& touched : run.touched) EXPECT_LT(std::abs(touched.x), 28.7);
  std::string narrow = limits_inside;
  narrow.replace(narrow.find("29.7"), 4, "28.7");
  file("limits.toml", narrow);
  expect_input_error(
      "study plan plan.toml --goal-um 5 --repeats 100 --control linuxcnc --limits limits.toml "
      "-o narrow.ngc",
      "the shank would be at a radius of 29.6 mm while the ball touches at Z");
}

// A gauge is at the wall through one block, of 20 revolutions and one before and after them.
TEST_F(ProbingSurfaces, AGaugeScansABoreAndAFace) {
  std::string gauge = limits_inside;
  gauge.replace(gauge.find("\"touch\""), 7, "\"analogue\"");
  gauge.replace(gauge.find("search_mm = 1.5"), 15, "rate_hz = 1000\nspin_up_s = 0.2");
  file("limits.toml", gauge);
  const std::string noise = "[noise]\nsigma_um = 1\n[[pass]]\nspeed_rpm = 120\n";
  file("plan.toml", "[part]\nsurface = \"cylinder\"\nfeature = \"bore\"\nradius_mm = 30\n" + noise +
                        "z_start_mm = -20\nz_end_mm = -40\nfeed_mm_per_rev = 1\n"
                        "readings_per_revolution = 40.3\n");
  const auto feeds = [&] {
    std::vector<Call> out;
    for (const Call& one : program())
      if (one.name == "STRAIGHT_FEED") out.push_back(one);
    std::filesystem::remove(folder_ / "p.ngc");
    return out;
  };
  const std::vector<Call> bore = feeds();
  ASSERT_EQ(bore.size(), 3u);  // into the bore, to the wall, along it
  EXPECT_NEAR(bore[0].x, 25.7, 1e-4);
  EXPECT_NEAR(bore[1].x, 29.0, 1e-4);
  EXPECT_NEAR(bore[1].z, -19.0, 1e-4);
  EXPECT_NEAR(bore[2].x, 29.0, 1e-4);
  EXPECT_NEAR(bore[2].z, -41.0, 1e-4);
  EXPECT_NEAR(bore[2].c - bore[1].c, 22.0 * 360.0, 1e-3);
  file("plan.toml", "[part]\nsurface = \"face\"\nd_mm = 0\n" + noise +
                        "x_start_mm = 10\nx_end_mm = 30\nfeed_mm_per_rev = 1\n"
                        "readings_per_revolution = 40.3\n");
  const std::vector<Call> face = feeds();
  ASSERT_EQ(face.size(), 2u);
  EXPECT_NEAR(face[0].z, 1.0, 1e-4);
  EXPECT_NEAR(face[0].x, 9.0, 1e-4);
  EXPECT_NEAR(face[1].z, 1.0, 1e-4);
  EXPECT_NEAR(face[1].x, 31.0, 1e-4);
}

// Across the centre X is negative, and the point is on the other side of the part.
TEST_F(ProbingSurfaces, AFaceIsTouchedAlongZAndFittedAsItIs) {
  const TiltedFace face;
  file("plan.toml", over_a_face);
  const std::vector<Call> calls = program();
  const Driven run = driven(calls, face);
  EXPECT_EQ(run.trouble, "");
  ASSERT_EQ(run.touched.size(), 50u);
  EXPECT_LT(run.touched.back().x, -20.0);
  EXPECT_EQ(count(calls, "STRAIGHT_FEED"), 0u);
  // Rapid moves stay 3 mm in front of front_mm = 0.5; the face rises to 0.06 mm at 36 mm.
  EXPECT_GT(run.nearest_mm, 3.4);
  file("p.log", run.logs.at("p.log"));
  ASSERT_EQ(command("import p.log -o s.csv").exit_code, 0) << run.logs.at("p.log");
  EXPECT_TRUE(contains(read_text(folder_ / "s.csv"), "\nX[mm],Z_M[mm],C[deg],pass,setup\n"));
  const CommandStreams fit = command("fit s.csv --surface plane --json fit.json");
  ASSERT_EQ(fit.exit_code, 0) << fit.err;
  const double n = std::sqrt(1.0 + 0.0015 * 0.0015 + 0.0007 * 0.0007);
  EXPECT_NEAR(fitted("d"), face.level_mm / n, 1e-6);
  EXPECT_NEAR(fitted("l"), -face.slope_x / n, 1e-6 / 15.0);  // over the mean radius and less
  EXPECT_NEAR(fitted("m"), -face.slope_y / n, 1e-6 / 15.0);
}

// The pass that was measured, and the one that is advised, touched from in front.
TEST_F(ProbingSurfaces, TheNextMeasurementOfAFaceIsDriven) {
  file("part.toml",
       "seed = 3\n[part]\nsurface = \"face\"\nd_mm = 0.2\nl = 0.001\n[noise]\nsigma_um = 1\n"
       "[[pass]]\nx_start_mm = 10\nx_end_mm = 36\nfeed_mm_per_rev = 2\n"
       "readings_per_revolution = 12.3\nspeed_rpm = 60\n");
  ASSERT_EQ(command("simulate part.toml -o part.csv").exit_code, 0);
  const CommandStreams done =
      command("advise part.csv --surface plane --control linuxcnc --limits limits.toml -o p.ngc");
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  const std::vector<Call> calls = interpreted(folder_, "p.ngc");
  TiltedFace face;
  face.level_mm = 0.2, face.slope_x = -0.001, face.slope_y = 0.0;
  const Driven run = driven(calls, face);
  EXPECT_EQ(run.trouble, "");
  EXPECT_GT(run.touched.size(), 160u);  // those of 13 turns, and more
  for (const Call& one : calls)
    EXPECT_TRUE(one.name != "STRAIGHT_PROBE" || std::abs(one.z - (0.2 + 1.0 - 1.5)) < 0.01);
}

TEST_F(ProbingSurfaces, AnAirRunTouchesNothing) {
  file("plan.toml", over_a_face);
  EXPECT_EQ(driven(program(" --air-run"), TiltedFace{}).trouble, "");
  file("plan.toml", bore_from_both_sides);
  std::filesystem::remove(folder_ / "p.ngc");
  const std::vector<Call> calls = program(" --air-run");
  EXPECT_EQ(count(calls, "STRAIGHT_PROBE") + count(calls, "LOG"), 0u);
  EXPECT_GT(count(calls, "STRAIGHT_FEED"), 74u);
  const Driven run = driven(calls, BlockWithBore{});
  EXPECT_EQ(run.trouble, "");
  EXPECT_GT(run.nearest_mm, 1.5);  // half of the clearance
}

}  // namespace
}  // namespace trueaxis::testing
