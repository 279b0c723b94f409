// SPDX-License-Identifier: Apache-2.0
// Jobs with several reference surfaces: weights, a face beside a cylinder, what is left at each.
#include <cmath>
#include <numbers>

#include "support/command_fixture.hpp"

namespace trueaxis::testing {
namespace {

using nlohmann::json;

class SeveralReferences : public CommandTest {
 protected:
  /// Runs the references with a cut from Z = 40 to 20 mm.
  json run(const std::string& references) {
    file("job.toml", references +
                         "[target]\nsurface = \"cylinder\"\nradius_mm = 20\nz_start_mm = 40\n"
                         "z_end_mm = 20\nstock_um = 20000\n[cut]\nspeed_rpm = 300\nsense = \"+c\"\n"
                         "feed_mm_per_rev = 0.5\n");
    const CommandStreams done = command("run job.toml -o out");
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return result("out/result.json").at("target_axis");
  }
};

std::string reference(const std::string& name, const std::string& surface, double weight) {
  return "[[reference]]\nname = \"" + name + "\"\nstream = \"" + name + ".csv\"\nsurface = \"" +
         surface + "\"\nweight = " + std::to_string(weight) + "\n";
}

double number(const json& object, const char* key) {
  return object.at(key).at("value").get<double>();
}

const json& left_at(const json& target, const std::string& name) {
  for (const json& remainder : target.at("remainders"))
    if (remainder.at("reference") == name) return remainder;
  throw std::runtime_error("no remainder of " + name);
}

// The file has 17 digits, the part none of its tilt terms: rounding of readings near 30 mm, a
// hundredfold for the lever from the probed length to the cut.
constexpr double exact_mm = 1e-7;

TEST_F(SeveralReferences, TwoAxesShareByWeight) {
  file("A.csv", csv(probe({.x0_mm = 0.08, .y0_mm = -0.06})));
  file("B.csv", csv(probe({.x0_mm = 0.04, .y0_mm = -0.06, .radius_mm = 25})));
  for (const double weight : {1.0, 3.0}) {
    // Σ wᵢ |Δᵢ|² of two parallel axes is least at their weighted mean.
    const json target = run(reference("A", "cylinder", weight) + reference("B", "cylinder", 1));
    const double mean = (weight * 0.08 + 0.04) / (weight + 1.0);
    EXPECT_NEAR(number(target, "x_at_start"), mean, exact_mm);
    EXPECT_NEAR(number(target, "y_at_start"), -0.06, exact_mm);
    EXPECT_NEAR(number(left_at(target, "A"), "offset_start"), 0.08 - mean, exact_mm);
    EXPECT_NEAR(number(left_at(target, "B"), "offset_end"), mean - 0.04, exact_mm);
    EXPECT_NEAR(number(left_at(target, "B"), "coaxiality"), 2 * (mean - 0.04), 2 * exact_mm);
  }
}

TEST_F(SeveralReferences, ReportAndTextNameEachReference) {
  file("A.csv", csv(probe({.noise_mm = 0.001})));
  file("B.csv", csv(probe({.half_angle_deg = 5, .noise_mm = 0.001})));
  run(reference("A", "cylinder", 1) + reference("B", "cone", 2));
  const json found = result("out/result.json");
  ASSERT_EQ(found.at("references").size(), 2u);
  EXPECT_EQ(found.at("references")[1].at("name"), "B");
  EXPECT_EQ(found.at("references")[1].at("weight"), 2.0);
  EXPECT_EQ(found.at("references")[1].at("fit").at("surface"), "cone");
}

/// Z_M of a plane whose normal leans by l, m: n·p = d read at radius x under the angle C.
std::string face_csv(double l, double m, double d_mm) {
  const double n = std::sqrt(1 - l * l - m * m);
  std::string text = "Z_M[mm],C[deg],X[mm]\n";
  char line[96];
  for (const double x : {15.0, 20.0, 25.0}) {
    for (int c_deg = 0; c_deg < 360; c_deg += 20) {
      const double c = c_deg * std::numbers::pi / 180;
      const double z = (d_mm - x * (l * std::cos(c) + m * std::sin(c))) / n;
      std::snprintf(line, sizeof line, "%.17g,%d,%.17g\n", z, c_deg, x);
      text += line;
    }
  }
  return text;
}

TEST_F(SeveralReferences, AFaceGivesTheDirectionACylinderThePosition) {
  constexpr double l = 4e-4, m = -3e-4, n = 0.99999987499999;
  file("seat.csv", csv(probe({})));
  file("face.csv", face_csv(l, m, 12));
  const json target = run(reference("seat", "cylinder", 1) + reference("face", "plane", 1) +
                          "face_radius_mm = 25\n");
  // About the middle of the cut (length L) the slope s minimises |s|² L³/12 + (25 mm)² L |s −
  // s_f|²: a face of radius R counts by R², a cylinder by L²/12.
  const double share = 25.0 * 25.0 / (25.0 * 25.0 + 20.0 * 20.0 / 12.0);
  EXPECT_NEAR(number(target, "slope_x"), share * l / n, 1e-9);
  EXPECT_NEAR(number(target, "slope_y"), share * m / n, 1e-9);
  EXPECT_NEAR(number(target, "x_at_start"), 0.08 + 10 * share * l / n, exact_mm);
  const double face_left = (1 - share) * std::hypot(l, m) / n;
  EXPECT_NEAR(number(left_at(target, "face"), "coaxiality"), 2 * 25 * face_left, exact_mm);
  EXPECT_NEAR(number(left_at(target, "seat"), "offset_start"), 10 * share * std::hypot(l, m) / n,
              exact_mm);
}

TEST_F(SeveralReferences, AFaceAloneIsRefused) {
  file("face.csv", face_csv(4e-4, -3e-4, 12));
  file("job.toml", simple_job("stream = \"face.csv\"\nsurface = \"plane\"\n"));
  const CommandStreams done = command("run job.toml -o out");
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_EQ(done.err.rfind("refused: ", 0), 0u) << done.err;
  EXPECT_TRUE(first_line(done.out).starts_with("NO-GO: ")) << done.out;
  EXPECT_EQ(result("out/result.json").at("verdict").at("line"), first_line(done.out));
  EXPECT_FALSE(there("out/table.csv"));
}

}  // namespace
}  // namespace trueaxis::testing
