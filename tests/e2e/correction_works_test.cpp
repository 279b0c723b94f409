// SPDX-License-Identifier: Apache-2.0
// "The correction works" as a measured coaxiality: a part is probed, corrected, cut in the virtual
// lathe with the table that the command wrote, and probed again with a lead that is no multiple of
// the feed. Every step is a process of its own; the truth is the scenario written here.
#include <gtest/gtest.h>

#include <cmath>

#include "support/command.hpp"

namespace trueaxis::testing {
namespace {

struct Case {
  const char* name;
  bool bore = false;
  bool cone_target = false;
  double noise_um = 0.0;
  bool perfect = true;  ///< the wanted column, followed without error
  double nose_mm = 0.8, tool_height_mm = 0.0, tool_angle_deg = 0.0;
  int sense = 1;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

// The true axis of the reference: 0.1 mm off at the cut, so that an uncorrected cut is 0.2 mm off
// in diameter.
constexpr double x0 = 0.08, y0 = -0.06, l = 0.0003, m = -0.0002;
constexpr double z_start = 40.0, z_end = 20.0;

std::string format(const char* text, double value) {
  char line[96];
  std::snprintf(line, sizeof line, text, value);
  return line;
}

/// A bore is opened, a shaft turned down: its own material is there.
std::string target_radius(const Case& c) {
  return c.bore ? "radius_mm = 34\n" : "radius_mm = 30\n";
}

std::string reference_scenario(const Case& c) {
  return std::string("seed = 4711\n[part]\nkind = \"cylinder\"\n") +
         (c.bore ? "bore = true\n" : "") + format("x0_mm = %.17g\n", x0) +
         format("y0_mm = %.17g\n", y0) + format("l = %.17g\n", l) + format("m = %.17g\n", m) +
         "radius_mm = 32\n" + format("[noise]\nsigma_um = %g\n", c.noise_um) +
         "[[pass]]\nz_start_mm = 0\nz_end_mm = 40\nfeed_mm_per_rev = 1\nreadings_per_revolution = "
         "36.7\n";
}

std::string job(const Case& c) {
  std::string text =
      std::string("[[reference]]\nname = \"A\"\nstream = \"probe.csv\"\nsurface = \"cylinder\"\n") +
      (c.bore ? "feature = \"bore\"\n" : "") + "[target]\n" +
      (c.cone_target ? "surface = \"cone\"\nhalf_angle_deg = 10\nopens = \"+z\"\n"
                     : "surface = \"cylinder\"\n") +
      (c.bore ? "feature = \"bore\"\n" : "") + target_radius(c) +
      format("z_start_mm = %g\n", z_start) + format("z_end_mm = %g\n", z_end) +
      "coaxiality_tolerance_um = 10\nstock_um = 8000\n[cut]\nspeed_rpm = 600\nfeed_mm_per_rev = "
      "0.1\n";
  text += format("nose_radius_mm = %g\n", c.nose_mm) +
          format("tool_height_mm = %g\n", c.tool_height_mm) +
          format("angle_from_probe_deg = %g\n", c.tool_angle_deg);
  text += c.sense > 0 ? "sense = \"+c\"\n" : "sense = \"-c\"\n";
  return text;
}

std::string cut_scenario(const Case& c, const char* use) {
  std::string text =
      std::string("seed = 1\n[part]\nkind = \"cylinder\"\nradius_mm = 30\n[cut]\nuse = \"") + use +
      "\"\n" + "[cut.target]\n" +
      (c.cone_target ? "kind = \"cone\"\nhalf_angle_deg = 10\n" : "kind = \"cylinder\"\n") +
      (c.bore ? "bore = true\n" : "") + target_radius(c) + format("z_start_mm = %g\n", z_start) +
      format("z_end_mm = %g\n", z_end) + "[cut.tool]\nspeed_rpm = 600\nfeed_mm_per_rev = 0.1\n";
  text += format("nose_radius_mm = %g\n", c.nose_mm) +
          format("height_mm = %g\n", c.tool_height_mm) +
          format("angle_from_probe_deg = %g\n", c.tool_angle_deg) + format("sense = %g\n", c.sense);
  text += c.perfect ? "[cut.actuator]\nperfect = true\n" : "[cut.actuator]\nperfect = false\n";
  // The lead: 0.1 × 11.618… is not a multiple of the feed, so that the feed marks average out.
  return text +
         "[[pass]]\nz_start_mm = 38\nz_end_mm = 22\nfeed_mm_per_rev = "
         "1.1618033988\nreadings_per_revolution = 101.3\n";
}

/// ISO coaxiality of the cut against the true reference axis, over the cut, µm; and the U of the
/// fit of A.
double measured_coaxiality_um(const std::filesystem::path& folder, const Case& c, const char* use) {
  write_text(folder / "cut.toml", cut_scenario(c, use));
  const std::string stream = (folder / "cut.csv").string(), fit = (folder / "cut.json").string();
  const auto cut = trueaxis_command("simulate " + (folder / "cut.toml").string() + " --table " +
                                    (folder / "out/table.csv").string() + " -o " + stream);
  EXPECT_EQ(cut.exit_code, 0) << cut.output;
  const auto fitted =
      trueaxis_command("fit " + stream + " --surface " + (c.cone_target ? "cone" : "cylinder") +
                       (c.bore ? " --bore" : "") + " --json " + fit);
  EXPECT_EQ(fitted.exit_code, 0) << fitted.output;
  const auto p = read_json(folder / "cut.json").at("parameters");
  const auto value = [&](const char* name) { return p.at(name).at("value").get<double>(); };
  double worst = 0.0;
  for (const double z : {z_start, z_end}) {
    const double n = std::sqrt(1 - value("l") * value("l") - value("m") * value("m")),
                 nt = std::sqrt(1 - l * l - m * m);
    worst = std::max(worst, std::hypot(value("x0") + value("l") / n * z - x0 - l / nt * z,
                                       value("y0") + value("m") / n * z - y0 - m / nt * z));
  }
  return 2.0 * worst * 1000.0;
}

class CorrectionWorks : public ::testing::TestWithParam<Case> {};

TEST_P(CorrectionWorks, CutPartIsCoaxialWithTheReference) {
  const Case& c = GetParam();
  const auto folder = fresh_folder(std::string("correction_") + c.name);
  write_text(folder / "probe.toml", reference_scenario(c));
  write_text(folder / "job.toml", job(c));
  const auto probe = trueaxis_command("simulate " + (folder / "probe.toml").string() + " -o " +
                                      (folder / "probe.csv").string());
  ASSERT_EQ(probe.exit_code, 0) << probe.output;
  const auto run = trueaxis_command("run " + (folder / "job.toml").string() + " -o " +
                                    (folder / "out").string());
  ASSERT_EQ(run.exit_code, 0) << run.output;
  EXPECT_EQ(run.output.rfind("GO: ", 0), 0U) << run.output;

  EXPECT_GT(measured_coaxiality_um(folder, c, "none"), 200.0)
      << "the part was hardly off: the test tests nothing";
  const double after = measured_coaxiality_um(folder, c, c.perfect ? "wanted" : "command");
  const auto verdict = read_json(folder / "out/result.json").at("verdict");
  const double at_most_um = 1000.0 * verdict.at("coaxiality_at_most").at("value").get<double>();
  RecordProperty("coaxiality_um", std::to_string(after));
  // Noise-free: theory.md asks for 0.1 µm. With noise, 1.6 times what 5 of 100 exceed, of a
  // Rayleigh distribution: missed in 1 of 2000 seeds.
  EXPECT_LT(after, c.noise_um == 0.0 ? 0.1 : 1.6 * at_most_um + 0.1) << at_most_um << " µm";
}

INSTANTIATE_TEST_SUITE_P(
    Cases, CorrectionWorks,
    ::testing::Values(Case{.name = "shaft"}, Case{.name = "shaft_reversed", .sense = -1},
                      Case{.name = "shaft_real_actuator", .perfect = false},
                      Case{.name = "bore", .bore = true},
                      Case{.name = "bore_noisy", .bore = true, .noise_um = 3},
                      Case{.name = "cone", .cone_target = true},
                      Case{.name = "cone_low_tool", .cone_target = true, .tool_height_mm = -0.3},
                      Case{.name = "shaft_noisy", .noise_um = 3},
                      Case{.name = "rear_turret", .tool_angle_deg = 180, .sense = -1},
                      Case{.name = "rear_turret_real_actuator_noisy",
                           .noise_um = 3,
                           .perfect = false,
                           .tool_angle_deg = 180}),
    [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace trueaxis::testing
