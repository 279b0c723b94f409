// SPDX-License-Identifier: Apache-2.0
// What has no uncertainty, or no direction, is never a go.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/command.hpp"

namespace trueaxis::testing {
namespace {

constexpr const char* target =
    "[target]\nsurface = \"cylinder\"\nradius_mm = 30\nz_start_mm = 40\nz_end_mm = 20\nstock_um = "
    "9000\n"
    "coaxiality_tolerance_um = 10\n[cut]\nspeed_rpm = 600\nsense = \"+c\"\nfeed_mm_per_rev = 0.1\n";

/// Readings of a circle of 32 mm, 50 µm off along x, by its closed form; `count` of them along a
/// helix.
std::string circle_stream(int count, bool with_z, double c_step_rad = 2.4, int z_step_mm = 1) {
  std::string text = with_z ? "X_M[mm],C[rad],Z[mm]\n" : "X_M[mm],C[rad]\n";
  for (int i = 0; i < count; ++i) {
    const double c = c_step_rad * i, e = 0.05;
    char row[96];
    std::snprintf(row, sizeof row, with_z ? "%.12f,%.12f,%d\n" : "%.12f,%.12f\n",
                  e * std::cos(c) + std::sqrt(32.0 * 32.0 - std::pow(e * std::sin(c), 2)), c,
                  z_step_mm * i);
    text += row;
  }
  return text;
}

TEST(NoUncertainty, AsManyReadingsAsParametersIsNoGo) {
  const auto folder = fresh_folder("no_redundancy");
  write_text(folder / "probe.csv", circle_stream(5, true, 2.0, 40));
  write_text(
      folder / "job.toml",
      std::string("[[reference]]\nstream = \"probe.csv\"\nsurface = \"cylinder\"\n") + target);
  const auto run = trueaxis_command("run " + (folder / "job.toml").string() + " -o " +
                                    (folder / "out").string());
  EXPECT_EQ(run.exit_code, 1) << run.output;
  EXPECT_EQ(run.output.rfind("NO-GO: ", 0), 0U) << run.output;
  EXPECT_FALSE(std::filesystem::exists(folder / "out/table.csv"));
}

TEST(NoUncertainty, FiveReadingsThatTwoCylindersPassThroughAreNotDetermined) {
  const auto folder = fresh_folder("two_cylinders");
  write_text(folder / "probe.csv", circle_stream(5, true));
  write_text(
      folder / "job.toml",
      std::string("[[reference]]\nstream = \"probe.csv\"\nsurface = \"cylinder\"\n") + target);
  const auto run = trueaxis_command("run " + (folder / "job.toml").string() + " -o " +
                                    (folder / "out").string());
  EXPECT_EQ(run.exit_code, 4) << run.output;
  EXPECT_EQ(run.output.rfind("NO-GO: ", 0), 0U) << run.output;
  EXPECT_NE(run.output.find("two surfaces fit equally well"), std::string::npos) << run.output;
  EXPECT_FALSE(std::filesystem::exists(folder / "out/table.csv"));
}

TEST(NoUncertainty, OneSectionIsNoReferenceOfATarget) {
  const auto folder = fresh_folder("section_reference");
  write_text(folder / "probe.csv", circle_stream(200, false));
  write_text(
      folder / "job.toml",
      std::string("[[reference]]\nstream = \"probe.csv\"\nsurface = \"section\"\n") + target);
  const auto run = trueaxis_command("run " + (folder / "job.toml").string() + " -o " +
                                    (folder / "out").string());
  EXPECT_EQ(run.exit_code, 3) << run.output;
  EXPECT_NE(run.output.find("does not show the direction"), std::string::npos) << run.output;
}

TEST(NoUncertainty, ANoseThatDoesNotFitIntoTheBoreIsRefused) {
  const auto folder = fresh_folder("nose_in_bore");
  write_text(folder / "probe.csv", circle_stream(200, true));
  std::string text =
      std::string("[[reference]]\nstream = \"probe.csv\"\nsurface = \"cylinder\"\n") + target +
      "nose_radius_mm = 30\n";
  const std::string kind = "surface = \"cylinder\"\nradius_mm";
  text.replace(text.find(kind), kind.size(),
               "surface = \"cylinder\"\nfeature = \"bore\"\nradius_mm");
  write_text(folder / "job.toml", text);
  const auto run = trueaxis_command("run " + (folder / "job.toml").string() + " -o " +
                                    (folder / "out").string());
  EXPECT_EQ(run.exit_code, 3) << run.output;
  EXPECT_NE(run.output.find("does not fit into the bore"), std::string::npos) << run.output;
}

}  // namespace
}  // namespace trueaxis::testing
