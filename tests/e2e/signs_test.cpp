// SPDX-License-Identifier: Apache-2.0
// docs/images/signs.svg and the table of signs in job.md, word by word: every expected angle here
// is written down from the words, "a mark at C = 10° then stands at …".
#include <cmath>
#include <numbers>
#include <random>

#include "support/command_fixture.hpp"
#include "trueaxis/correction.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::testing {
namespace {

using nlohmann::json;

double off_deg(double a, double b) { return std::abs(std::remainder(a - b, 360.0)); }

class Signs : public CommandTest {
 protected:
  /// C in degrees of the first harmonic's crest in the table of a cylinder's job.
  double crest_deg(const std::string& cut) {
    file("job.toml",
         "[[reference]]\nstream = \"part.csv\"\nsurface = \"cylinder\"\n[target]\n"
         "surface = \"cylinder\"\nradius_mm = 20\nz_start_mm = 60\nz_end_mm = 58\n"
         "[cut]\nspeed_rpm = 600\nsense = \"+c\"\nfeed_mm_per_rev = 0.1\n" +
             cut);
    const CommandStreams done = command("run job.toml -o out");
    EXPECT_EQ(done.exit_code, 0) << done.err << done.out;
    const json harmonics = result("out/result.json").at("correction").at("harmonics");
    for (const json& harmonic : harmonics)
      if (harmonic.at("order") == 1) return harmonic.at("phase_start").at("value").get<double>();
    return std::nan("");
  }
};

/// A shaft of radius 20 mm whose high spot a probe on the given side meets at C = 10°.
std::string high_spot_at_10(int side) {
  std::string text = "# sensor_noise: 0.1 um\nX_M[mm],C[deg],Z[mm]\n";
  for (int i = 0; i < 800; ++i) {
    const double c = 17.3 * i, from_crest = (c - 10.0) * rad_per_deg, e = 0.05;
    const double x =
        e * std::cos(from_crest) + std::sqrt(400.0 - std::pow(e * std::sin(from_crest), 2));
    char line[96];
    std::snprintf(line, sizeof line, "%.9f,%.6f,%.6f\n", side * x, c, 0.05 * i);
    text += line;
  }
  return text;
}

// "A mark that a probe at X_M > 0 meets at C = 10° meets a tool at φ at C = 10° − φ."
TEST_F(Signs, TheAngleOfAToolIsCountedAgainstTheWayOfTheSurface) {
  file("part.csv", high_spot_at_10(1));
  EXPECT_LT(off_deg(crest_deg(""), 10.0), 0.01);
  EXPECT_LT(off_deg(crest_deg("angle_from_probe_deg = 90\n"), 280.0), 0.01);
  EXPECT_LT(off_deg(crest_deg("angle_from_probe_deg = 180\n"), 190.0), 0.01);
}

// "… from +X whichever side was probed: a mark that a probe at X_M < 0 meets at C = 10° meets a
// tool at 180° at C = 10°, one at 0° at C = 190°."
TEST_F(Signs, TheAngleOfAToolIsFromPlusXThoughTheProbeStoodBehind) {
  file("part.csv", high_spot_at_10(-1));
  EXPECT_LT(off_deg(crest_deg("angle_from_probe_deg = 180\n"), 10.0), 0.01);
  EXPECT_LT(off_deg(crest_deg(""), 190.0), 0.01);
}

// "tool_height_mm is positive to the side from which the surface comes when C grows: the edge meets
// a mark asin(h/R) of C before one at height 0 does", at 180° as at 0°. 2 mm of 20 mm: 5.739°.
TEST(SignOfToolHeight, IsThatOfTheSurfaceThatComes) {
  const double on = 10.0 * rad_per_deg;
  const AxisEstimate axis{{0.05 * std::cos(on), 0.05 * std::sin(on), 0.0, 0.0, 0.0}, {}};
  const TargetSurface cylinder{TargetKind::cylinder, false, 0.0, 1.0, 20.0, 0.0, 0.0, 0.0, 0.0};
  const auto crest_deg = [&](double height_mm, double angle_deg) {
    ToolSetup tool;
    tool.height_mm = height_mm, tool.angle_from_probe_rad = angle_deg * rad_per_deg;
    for (const CorrectionHarmonic& h : make_correction(axis, cylinder, tool, {}).harmonics)
      if (h.order == 1) return h.phase_start_rad / rad_per_deg;
    return std::nan("");
  };
  EXPECT_LT(off_deg(crest_deg(2.0, 0.0), 10.0 - 5.739), 0.002);
  EXPECT_LT(off_deg(crest_deg(-2.0, 0.0), 10.0 + 5.739), 0.002);
  EXPECT_LT(off_deg(crest_deg(2.0, 180.0), 190.0 - 5.739), 0.002);
  EXPECT_LT(off_deg(crest_deg(-2.0, 180.0), 190.0 + 5.739), 0.002);
}

// "A measured response holds the delay, the hold is multiplied in addition": a pure delay of 1 ms
// is gain 1 and −0.36° a Hz; at 10 Hz it lags by 3.6°, and a hold of 1 ms by 1.8° more.
TEST(SignOfTheResponse, ADelayIsANegativePhaseAndTheHoldIsAdded) {
  Actuator actuator;
  actuator.sampling_hz = 1000.0;
  for (double hz : {1.0, 10.0, 100.0, 200.0})
    actuator.measured.push_back({hz, 1.0, -0.36 * hz * rad_per_deg});
  ToolSetup tool;
  tool.speed_rpm = 600.0;
  const TargetSurface cylinder{TargetKind::cylinder, false, 0.0, 1.0, 20.0, 0.0, 0.0, 0.0, 0.0};
  const Correction correction = make_correction({{0.05, 0, 0, 0, 0}, {}}, cylinder, tool, actuator);
  ASSERT_FALSE(correction.harmonics.empty());
  double lag_deg = 0.0;
  for (const CorrectionHarmonic& h : correction.harmonics)
    if (h.order == 1) lag_deg = h.lag_rad / rad_per_deg;
  EXPECT_NEAR(lag_deg, 3.6 + 1.8, 1e-9);
  // The command is ahead by that: its crest, wanted at C = 0, is sent 5.4° earlier.
  double sine = 0.0, cosine = 0.0;
  for (std::size_t i = 0; i < 360; ++i) {
    sine += correction.rows.command_mm[i] * std::sin(correction.rows.c_rad[i]);
    cosine += correction.rows.command_mm[i] * std::cos(correction.rows.c_rad[i]);
  }
  EXPECT_NEAR(std::atan2(sine, cosine) / rad_per_deg, -5.4, 1e-3);
}

// "Before set-up 2 the part was turned in the sense of C by 70°: a mark that the probe met at
// C = 10° it then meets at C = −60° = 300°." The mark is a keyway of the virtual lathe's part.
TEST_F(Signs, AMarkOfAReindexedPartStandsAtLessC) {
  file("part.toml",
       "[part]\nkind = \"cylinder\"\nradius_mm = 20\n"
       "[[setup]]\nnumber = 2\nreindex_deg = 70\n"
       "[[pass]]\nz_start_mm = 0\nz_end_mm = 1\nreadings_per_revolution = 360\nrevolutions = 1\n"
       "[[pass]]\nz_start_mm = 0\nz_end_mm = 1\nreadings_per_revolution = 360\nrevolutions = 1\n"
       "setup = 2\n"
       "[[effect]]\nid = \"part.interruption\"\nangle_deg = 10\nwidth_deg = 8\ndepth_mm = 1\n");
  const CommandStreams done = command("simulate part.toml -o part.csv");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  std::istringstream lines(read_text(folder_ / "part.csv"));
  double sine[2] = {}, cosine[2] = {};
  for (std::string line; std::getline(lines, line);) {
    double x, c, z, t;
    int pass, setup;
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%d,%d", &x, &c, &z, &t, &pass, &setup) != 6)
      continue;
    if (x > 19.5) continue;
    sine[setup - 1] += std::sin(c), cosine[setup - 1] += std::cos(c);
  }
  EXPECT_LT(off_deg(std::atan2(sine[0], cosine[0]) / rad_per_deg, 10.0), 1.0);
  EXPECT_LT(off_deg(std::atan2(sine[1], cosine[1]) / rad_per_deg, 300.0), 1.0);
}

// The same in words of the stream, without the lathe: three lobes of 3 µm that turn with the part,
// a crest at C = 10° and, after the turn, at 300°. Read the other way they looked like a motion of
// the machine, which the correction was then asked to cut in.
TEST_F(Signs, LobesOfAReindexedPartAreThePartsAndNoMotion) {
  std::mt19937_64 random(4711);
  std::normal_distribution<double> noise(0.0, 0.5e-3);
  std::string text = "# setup.2.reindex: 70 deg\nX_M[mm],C[deg],Z[mm],pass,setup\n";
  for (const int setup : {1, 2}) {
    const double crest = setup == 1 ? 10.0 : 300.0;
    for (int i = 0; i < 1500; ++i) {
      const double c = 360.0 / 36.7 * i, x0 = setup == 1 ? 0.05 : -0.02;
      const double x = 20.0 + x0 * std::cos(c * rad_per_deg) +
                       3e-3 * std::cos(3.0 * (c - crest) * rad_per_deg) + noise(random);
      char line[96];
      std::snprintf(line, sizeof line, "%.7f,%.6f,%.6f,%d,%d\n", x, c, 40.0 * i / 1500.0, setup,
                    setup);
      text += line;
    }
  }
  file("part.csv", text);
  const CommandStreams done = command("diagnose part.csv --surface cylinder --json d.json");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const json findings = result("d.json").at("findings");
  ASSERT_EQ(findings.size(), 1u) << done.out;
  EXPECT_EQ(findings[0].at("effect"), "part.roundness") << done.out;
  for (const json& member : findings[0].at("class"))
    EXPECT_FALSE(contains(member.get<std::string>(), "spindle.")) << done.out;
}

}  // namespace
}  // namespace trueaxis::testing
