// SPDX-License-Identifier: Apache-2.0
// One program that measures every reference of a job, driven past a part that is met numerically.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/command_fixture.hpp"
#include "support/driven_program.hpp"

namespace trueaxis::testing {
namespace {

/// A disc of 40 mm that is off centre, with a bore of 15 mm and a face that is not square to it.
struct Disc {
  double rim_x_mm = 0.05, rim_y_mm = -0.03;
  BlockWithBore block{.radius_mm = 15.0};
  TiltedFace face{.slope_x = -0.0005, .slope_y = 0.0};
  double operator()(const BallAt& ball) const {
    const double x = std::abs(ball.x);
    if (x > 39.5 && ball.z < block.ball_mm) {
      const InPart p = in_part(ball);
      return std::hypot(p.x - rim_x_mm, p.y - rim_y_mm) - 40.0 - block.ball_mm;
    }
    return x > 16.0 && x < 40.0 && ball.z > 0.5 ? face(ball) : block(ball);
  }
};

class ProbingJob : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    if (!has_interpreter()) GTEST_SKIP() << "rs274 (linuxcnc) is not installed";
    const std::string noise = "[noise]\nsigma_um = 1\n[[pass]]\nspeed_rpm = 60\n";
    file("rim.toml", "seed = 1\n[part]\nsurface = \"cylinder\"\nradius_mm = 40\n" + noise +
                         "z_start_mm = -30\nz_end_mm = -10\nfeed_mm_per_rev = 2\n"
                         "readings_per_revolution = 12.3\n");
    file("face.toml", "seed = 2\n[part]\nsurface = \"face\"\nd_mm = 0\nl = 0.0005\n" + noise +
                          "x_start_mm = 18\nx_end_mm = 36\nfeed_mm_per_rev = 2\n"
                          "readings_per_revolution = 12.3\n");
    file("bore.toml",
         "seed = 3\n[part]\nsurface = \"cylinder\"\nfeature = \"bore\"\nradius_mm = 15\n"
         "x0_mm = 0.12\ny0_mm = -0.07\nl = 0.002\nm = -0.001\n" +
             noise +
             "z_start_mm = -10\nz_end_mm = -30\nfeed_mm_per_rev = 2\n"
             "readings_per_revolution = 12.3\n");
    for (const char* part : {"rim", "face", "bore"})
      ASSERT_EQ(command(std::string("simulate ") + part + ".toml -o " + part + ".csv").exit_code,
                0);
    file("job.toml",
         "[[reference]]\nname = \"rim\"\nstream = \"rim.csv\"\nsurface = \"cylinder\"\n"
         "[[reference]]\nname = \"end face\"\nstream = \"face.csv\"\nsurface = \"plane\"\n"
         "[[reference]]\nname = \"bore (ø 30)\"\nstream = \"bore.csv\"\nsurface = \"cylinder\"\n"
         "feature = \"bore\"\n");
    file("limits.toml", limits());
  }
  static std::string limits(double bore_radius_mm = 14.7) {
    return "[limits]\nx_mm = [-80, 120]\nz_mm = [-80, 80]\nspeed_rpm = 400\n[part]\n"
           "reach_mm = 40.1\nfront_mm = 0.5\nbore_bottom_mm = -60\nbore_radius_mm = " +
           std::to_string(bore_radius_mm) +
           "\n[probe]\nkind = \"touch\"\nball_radius_mm = 1\nstylus_radius_mm = 0.6\n"
           "stylus_length_mm = 50\nfeed_mm_per_min = 150\nclearance_mm = 3\nsearch_mm = 1.5\n";
  }
  CommandStreams advise(const std::string& control = "linuxcnc") {
    return command("advise job.toml --limits limits.toml -o p.ngc --control " + control);
  }
  double fitted(const Driven& run, const std::string& log, const std::string& surface,
                const std::string& parameter) {
    file("p.log", run.logs.at(log));
    const CommandStreams fit = command("fit p.log --json fit.json --force --surface " + surface);
    EXPECT_EQ(fit.exit_code, 0) << fit.err << run.logs.at(log);
    return result("fit.json")["parameters"][parameter]["value"].get<double>();
  }
};

// The readings have six decimals, and a parameter is a mean of hundreds of them.
TEST_F(ProbingJob, EveryReferenceIsMeasuredByOneProgram) {
  const CommandStreams done = advise();
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  EXPECT_TRUE(contains(done.out, "log p_2_end_face: reference end face: probe")) << done.out;
  const std::vector<Call> calls = interpreted(folder_, "p.ngc");
  EXPECT_EQ(count(calls, "LOGOPEN"), 3u);
  const Disc part;
  const Driven run = driven(calls, part);
  EXPECT_EQ(run.trouble, "");
  // 3 mm of clearance to a front of 0.5, a rim of 40.1 and a bore of 14.7 mm.
  EXPECT_GT(run.nearest_mm, 3.0);
  EXPECT_NEAR(fitted(run, "p_1_rim.log", "cylinder", "radius"), 40.0, 1e-6);
  EXPECT_NEAR(fitted(run, "p_1_rim.log", "cylinder", "x0"), part.rim_x_mm, 1e-6);
  EXPECT_NEAR(fitted(run, "p_2_end_face.log", "plane", "d"), 0.0, 1e-6);
  EXPECT_NEAR(fitted(run, "p_2_end_face.log", "plane", "l"), -part.face.slope_x, 1e-6 / 15.0);
  EXPECT_NEAR(fitted(run, "p_3_bore_____30_.log", "cylinder", "radius"), part.block.radius_mm,
              1e-6);
  EXPECT_NEAR(fitted(run, "p_3_bore_____30_.log", "cylinder", "x0"), part.block.x0_mm, 1e-6);
}

TEST_F(ProbingJob, AReferenceThatCannotBeDrivenIsNamed) {
  file("limits.toml", limits(30.0));
  const CommandStreams done = advise();
  EXPECT_EQ(done.exit_code, 3);
  EXPECT_TRUE(contains(done.err, "3_bore_____30_: the bore has a radius of")) << done.err;
  EXPECT_FALSE(there("p.ngc"));
}

TEST_F(ProbingJob, AControlWithOneLogTakesOneReference) {
  std::string system = limits();
  file("limits.toml", system + "[control]\ngcode_system = \"A\"\n");
  const CommandStreams done = advise("fanuc");
  EXPECT_EQ(done.exit_code, 3);
  EXPECT_TRUE(contains(done.err, "DPRNT of a FANUC control writes one log")) << done.err;
  EXPECT_EQ(command("advise job.toml --control linuxcnc -o p.ngc").exit_code, 2);  // no limits
}

}  // namespace
}  // namespace trueaxis::testing
