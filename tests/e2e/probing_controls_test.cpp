// SPDX-License-Identifier: Apache-2.0
// Probing programs of FANUC, SINUMERIK and HEIDENHAIN on a control of the test's own.
#include <gtest/gtest.h>

#include <cmath>

#include "support/command_fixture.hpp"
#include "support/places.hpp"
#include "support/plain_klartext_control.hpp"

namespace trueaxis::testing {
namespace {

const std::string both_sides =
    "[part]\nsurface = \"cylinder\"\nradius_mm = 30\n[noise]\nsigma_um = 1\n"
    "[[pass]]\nz_start_mm = -30\nz_end_mm = -10\nfeed_mm_per_rev = 10\n"
    "readings_per_revolution = 12\n"
    "[[pass]]\nz_start_mm = -10\nz_end_mm = -30\nfeed_mm_per_rev = 10\n"
    "readings_per_revolution = 12\nspeed_rpm = -60\nsetup = 2\n"
    "[[setup]]\nnumber = 2\nside = \"rear\"\n";

struct Case {
  std::string control, options;
  bool diameter = false;
};
const Case cases[] = {{"fanuc", "gcode_system = \"A\"\nx = \"diameter\"\n", true},
                      {"fanuc", "gcode_system = \"B\"\n"},
                      {"siemens", ""},
                      {"heidenhain", ""}};

class ProbingControls : public CommandTest {
 protected:
  std::string plan_ = both_sides;
  std::string part_limits_ = "[part]\nreach_mm = 34\nfront_mm = 5\n";
  std::string stylus_;
  PartGap part_;  ///< none: the shaft
  double slope_ = 0.0;

  /// A control that holds the program of a case.
  PlainProbingControl ran(const Case& one, const std::string& options = "", double part_mm = 30.0,
                          double from_x = 100.0, double from_z = 60.0, double from_y = 0.0) {
    file("plan.toml", plan_);
    file("limits.toml", "[limits]\nx_mm = [-80, 120]\nz_mm = [-60, 80]\nspeed_rpm = 400\n" +
                            part_limits_ +
                            "[probe]\nkind = \"touch\"\nball_radius_mm = 1\nfeed_mm_per_min = 150\n"
                            "clearance_mm = 3\nsearch_mm = 1.5\n" +
                            stylus_ + "[control]\n" + one.options);
    const CommandStreams done = command(
        "study plan plan.toml --goal-um 5 --repeats 100 --limits limits.toml -o p.nc "
        "--force --control " +
        one.control + options);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    PlainKlartextControl control;
    control.siemens = one.control == "siemens", control.x_diameter = one.diameter;
    control.part_mm = part_mm, control.x = from_x, control.z = from_z, control.y = from_y;
    control.slope = slope_, control.part = part_;
    control.mask = read_text(places::source() + "/data/probing/heidenhain_mask.txt");
    if (one.control == "heidenhain")
      control.run(read_text(folder_ / "p.nc"));
    else
      control.PlainProbingControl::run(read_text(folder_ / "p.nc"));
    return control;
  }
};

TEST_F(ProbingControls, TouchEveryPointAndLogIt) {
  for (const Case& one : cases) {
    SCOPED_TRACE(one.control + one.options);
    const PlainProbingControl control = ran(one);
    EXPECT_EQ(control.alarm, "");
    std::size_t probed = 0;
    double x = 100.0, z = 60.0;
    for (const PlainProbingControl::Move& move : control.moves) {
      EXPECT_GE(move.c, 0.0);
      EXPECT_LT(move.c, 360.0);
      if (move.probing) {
        ++probed;
        EXPECT_EQ(move.feed, 150.0);
      } else {
        EXPECT_TRUE(move.rapid);
        // 34 mm of reach, 1 of ball, 3 of clearance; in front of the part at Z 9.
        EXPECT_GE(std::abs(move.x), 38.0 - 1e-9);
        EXPECT_TRUE(move.x * x > 0.0 || std::min(move.z, z) >= 9.0 - 1e-9) << x << " " << move.x;
      }
      x = move.x, z = move.z;
    }
    EXPECT_EQ(probed, 50u);
    // The log is read without an option; it has four digits.
    file("p.log", control.log);
    ASSERT_EQ(command("import p.log -o s.csv --force").exit_code, 0) << control.log;
    std::istringstream rows(read_text(folder_ / "s.csv"));
    std::size_t k = 0;
    for (std::string row; std::getline(rows, row);) {
      double reading = 0.0, c = 0.0, position = 0.0;
      int pass = 0, setup = 0;
      if (std::sscanf(row.c_str(), "%lf,%lf,%lf,%d,%d", &reading, &c, &position, &pass, &setup) !=
          5)
        continue;
      const bool rear = k >= 25;
      const double i = static_cast<double>(k % 25);
      EXPECT_NEAR(c, rear ? -30.0 * i : 30.0 * i, 1e-4);
      EXPECT_NEAR(position, rear ? -10.0 - i * 20.0 / 24.0 : -30.0 + i * 20.0 / 24.0, 1e-4);
      EXPECT_EQ(setup, rear ? 2 : 1);
      const double met = rear ? -control.contact(c + 180.0) : control.contact(c);
      EXPECT_NEAR(reading, one.diameter ? 2.0 * met : met, 1e-4);
      ++k;
    }
    EXPECT_EQ(k, 50u);
  }
}

TEST_F(ProbingControls, AnAirRunTouchesAndLogsNothing) {
  for (const Case& one : cases) {
    SCOPED_TRACE(one.control + one.options);
    const PlainProbingControl control = ran(one, " --air-run", 33.0);
    EXPECT_EQ(control.alarm, "");
    EXPECT_EQ(control.log, "");
    EXPECT_GT(control.moves.size(), 150u);
  }
}

// A cone that is 1.3 mm smaller than planned is in reach of a search of 1.5 mm; one of 1.7 mm is
// not, at either end: where the probe stops follows the cone.
TEST_F(ProbingControls, SearchAlongACone) {
  plan_.replace(plan_.find("cylinder\""), 9, "cone\"\nhalf_angle_deg = 5");
  slope_ = std::tan(5.0 * std::acos(-1.0) / 180.0);
  for (const Case& one : cases) {
    SCOPED_TRACE(one.control + one.options);
    const PlainProbingControl met = ran(one, "", 28.7);
    EXPECT_EQ(met.alarm, "");
    std::size_t probed = 0;
    for (const PlainProbingControl::Move& move : met.moves) {
      if (!move.probing) continue;
      ++probed;
      EXPECT_NEAR(std::abs(move.x), 29.7 + slope_ * move.z, 0.1 + 1e-4);  // 0.1 mm off the axis
    }
    EXPECT_EQ(probed, 50u);
    const PlainProbingControl missed = ran(one, "", 28.3);
    EXPECT_NE(missed.alarm, "");
    ASSERT_FALSE(missed.moves.empty());
    const PlainProbingControl::Move& last = missed.moves.back();
    EXPECT_NEAR(std::abs(last.x), 29.5 + slope_ * last.z, 1e-4);
  }
}

// A part that is not there, and a probe that is next to the part when the program starts; in front
// of the part it is clear.
TEST_F(ProbingControls, StopWithAnAlarm) {
  for (const Case& one : cases) {
    SCOPED_TRACE(one.control + one.options);
    const PlainProbingControl missed = ran(one, "", 20.0);
    EXPECT_NE(missed.alarm, "");
    EXPECT_FALSE(contains(missed.log, "END"));
    const PlainProbingControl near = ran(one, "", 30.0, 36.0, -20.0);
    EXPECT_NE(near.alarm, "");
    EXPECT_TRUE(near.moves.empty());
    EXPECT_EQ(ran(one, "", 30.0, 0.0, 60.0).alarm, "");
  }
}

/// What a log tells a fit, of a parameter.
class ProbingOtherSurfaces : public ProbingControls {
 protected:
  void take_bore() {
    plan_ =
        "[part]\nsurface = \"cylinder\"\nfeature = \"bore\"\nradius_mm = 30\n[noise]\n"
        "sigma_um = 1\n[[pass]]\nz_start_mm = -10\nz_end_mm = -40\nfeed_mm_per_rev = 10\n"
        "readings_per_revolution = 12\n[[pass]]\nz_start_mm = -40\nz_end_mm = -10\n"
        "feed_mm_per_rev = 10\nreadings_per_revolution = 12\nspeed_rpm = -60\nsetup = 2\n"
        "[[setup]]\nnumber = 2\nside = \"rear\"\n";
    part_limits_ =
        "[part]\nreach_mm = 41\nfront_mm = 0.5\nbore_radius_mm = 29.7\nbore_bottom_mm = -60\n";
    stylus_ = "stylus_radius_mm = 0.6\nstylus_length_mm = 50\n";
    part_ = BlockWithBore{};
  }
  void take_face() {
    plan_ =
        "[part]\nsurface = \"face\"\nd_mm = 0\n[noise]\nsigma_um = 1\n[[pass]]\n"
        "x_start_mm = 12\nx_end_mm = 36\nfeed_mm_per_rev = 12\nreadings_per_revolution = 12\n"
        "[[pass]]\nx_start_mm = 36\nx_end_mm = -24\nfeed_mm_per_rev = 30\n"
        "readings_per_revolution = 12\n";
    part_limits_ = "[part]\nreach_mm = 41\nfront_mm = 0.5\n";
    stylus_ = "stylus_length_mm = 50\n";
    part_ = TiltedFace{};
  }
  double fitted(const PlainProbingControl& control, const std::string& options,
                const std::string& parameter) {
    file("p.log", control.log);
    EXPECT_EQ(command("import p.log -o s.csv --force").exit_code, 0) << control.log;
    const CommandStreams fit = command("fit s.csv --json fit.json --force --surface " + options);
    EXPECT_EQ(fit.exit_code, 0) << fit.err;
    return result("fit.json")["parameters"][parameter]["value"].get<double>();
  }
};

// A log has four digits and more, of a diameter too.
TEST_F(ProbingOtherSurfaces, TouchABoreFromInside) {
  take_bore();
  const BlockWithBore bore;
  for (const Case& one : cases) {
    SCOPED_TRACE(one.control + one.options);
    const PlainProbingControl control = ran(one);
    EXPECT_EQ(control.alarm, "");
    EXPECT_EQ(std::ranges::count(control.moves, true, &PlainProbingControl::Move::probing), 74);
    const std::string options = "cylinder";
    EXPECT_NEAR(fitted(control, options, "radius"), bore.radius_mm, 5e-5);
    EXPECT_NEAR(fitted(control, options, "x0"), bore.x0_mm, 5e-5);
    EXPECT_NEAR(fitted(control, options, "y0"), bore.y0_mm, 5e-5);
  }
}

// One that is 2 mm larger than planned is not met.
TEST_F(ProbingOtherSurfaces, StopInABoreWithoutAWall) {
  take_bore();
  BlockWithBore bore;
  bore.radius_mm = 32.0;
  part_ = bore;
  for (const Case& one : cases) {
    SCOPED_TRACE(one.control + one.options);
    const PlainProbingControl missed = ran(one);
    EXPECT_NE(missed.alarm, "");
    EXPECT_NE(missed.alarm, "collision");
    EXPECT_NEAR(missed.moves.back().x, 30.0 - 1.0 + 1.5, 1e-4);
  }
}

TEST_F(ProbingOtherSurfaces, TouchAFaceAlongZ) {
  take_face();
  const TiltedFace face;
  for (const Case& one : cases) {
    SCOPED_TRACE(one.control + one.options);
    const PlainProbingControl control = ran(one);
    EXPECT_EQ(control.alarm, "");
    EXPECT_EQ(std::ranges::count(control.moves, true, &PlainProbingControl::Move::probing), 50);
    EXPECT_NEAR(fitted(control, "plane", "d"), face.level_mm, 5e-5);
    EXPECT_NEAR(fitted(control, "plane", "l"), -face.slope_x, 5e-5 / 15.0);
    EXPECT_NEAR(fitted(control, "plane", "m"), -face.slope_y, 5e-5 / 15.0);
  }
}

// One that is 2 mm farther away is not met.
TEST_F(ProbingOtherSurfaces, StopInFrontOfNoFace) {
  take_face();
  TiltedFace face;
  face.level_mm = -2.0;
  part_ = face;
  for (const Case& one : cases) {
    SCOPED_TRACE(one.control + one.options);
    const PlainProbingControl missed = ran(one);
    EXPECT_NE(missed.alarm, "");
    EXPECT_NE(missed.alarm, "collision");
    EXPECT_NEAR(missed.moves.back().z, 1.0 - 1.5, 1e-4);
  }
}

TEST_F(ProbingOtherSurfaces, AnAirRunStaysOffTheWall) {
  take_bore();
  BlockWithBore bore;
  bore.ball_mm = 2.3;  // of the 2.5 that half of the clearance leaves
  bore.length_mm = 60.0;
  part_ = bore;
  for (const Case& one : cases) {
    SCOPED_TRACE(one.control + one.options);
    const PlainProbingControl control = ran(one, " --air-run");
    EXPECT_EQ(control.alarm, "");
    EXPECT_EQ(control.log, "");
    EXPECT_GT(control.moves.size(), 200u);
  }
}

// Off the axis in Y, a probe meets a shaft at a smaller X.
TEST_F(ProbingControls, HeidenhainStopsOffTheAxis) {
  for (const double y : {-0.02, 0.02}) {
    const PlainProbingControl control = ran({"heidenhain", ""}, "", 30.0, 100.0, 60.0, y);
    EXPECT_NE(control.alarm, "");
    EXPECT_TRUE(control.moves.empty());
  }
}

}  // namespace
}  // namespace trueaxis::testing
