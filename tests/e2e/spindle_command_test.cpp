// SPDX-License-Identifier: Apache-2.0
// `trueaxis spindle` as a user meets it: from a scenario of the virtual lathe to values and plots.
#include <algorithm>
#include <cmath>

#include "support/command_fixture.hpp"
#include "support/open_page.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

class SpindleCommand : public CommandTest {
 protected:
  /// Simulates a scenario of the repository, or a file, into `stream`.
  void simulate(const std::string& scenario, const std::string& stream) {
    const CommandStreams done = command("simulate " + scenario + " -o " + stream);
    ASSERT_EQ(done.exit_code, 0) << done.err;
  }
  static std::string of_data(const std::string& name) {
    return std::string(places::source() + "/data/scenarios/").append(name);
  }
  static void expect_within(const nlohmann::json& estimate, double truth_mm, const char* what) {
    const double value = estimate.at("value"), u = estimate.at("u");
    EXPECT_NEAR(value, truth_mm, 3.0 * u) << what;  // 3 u: once in 370
    EXPECT_LT(u, 0.1 * truth_mm) << what;
  }
};

TEST_F(SpindleCommand, ThreeSensorsGiveValuesOrdersAndPlots) {
  simulate(of_data("spindle_three_sensors.toml"), "s.csv");
  const CommandStreams done = command("spindle s.csv --json s.json --svg s.svg");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_LE(std::ranges::count(done.out, '\n'), 15) << done.out;
  EXPECT_TRUE(contains(done.out, "suppressed     no order")) << done.out;
  const nlohmann::json json = result("s.json"), radial = json.at("radial");
  EXPECT_EQ(json.at("schema"), "trueaxis.spindle/1");
  EXPECT_EQ(json.at("inputs").at(0).at("file"), "s.csv");
  expect_within(radial.at("values").at("synchronous"), 0.8e-3, "synchronous along X");
  expect_within(radial.at("values_across").at("synchronous"), 0.6e-3, "synchronous along Y");
  ASSERT_EQ(radial.at("orders").size(), 99U);
  const nlohmann::json& second = radial.at("orders").at(0);
  EXPECT_EQ(second.at("order"), 2);
  const auto near = [&](const char* which, double amplitude_mm, double phase_deg) {
    const nlohmann::json& one = second.at(which);
    EXPECT_NEAR(one.at("amplitude").get<double>(), amplitude_mm, 3.0 * one.at("u").get<double>());
    EXPECT_NEAR(std::remainder(one.at("phase").get<double>() - phase_deg, 360.0), 0.0, 0.5);
  };
  near("form", 0.8e-3, 40.0);
  near("sensitive", 0.4e-3, 0.0);
  near("across", 0.3e-3, 90.0);
  const std::string svg = read_text(folder_ / "s.svg");
  EXPECT_TRUE(svg.starts_with("<!-- schema: trueaxis.spindle_plot/1 -->\n<svg"));
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_FALSE(contains(svg, "nan"));
  // The same bytes again, over its own results without --force.
  const std::string before = read_text(folder_ / "s.json");
  ASSERT_EQ(command("spindle s.csv --json s.json --svg s.svg").exit_code, 0);
  EXPECT_EQ(read_text(folder_ / "s.json"), before);
  EXPECT_EQ(read_text(folder_ / "s.svg"), svg);
}

// The page has every value that the result has, a plot of the motion and one of the form, and needs
// nothing from elsewhere.
TEST_F(SpindleCommand, APageHasValuesAndPolarPlots) {
  simulate(of_data("spindle_three_sensors.toml"), "s.csv");
  const CommandStreams done = command("spindle s.csv --report s.html");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_FALSE(done.out.empty());
  const std::string page = read_text(folder_ / "s.html");
  EXPECT_TRUE(page.starts_with("<!doctype html>"));
  for (const char* row : {"synchronous", "asynchronous", "total", "roundness of the part"})
    EXPECT_TRUE(contains(page, "<tr><th>" + std::string(row) + "</th><td>")) << row;
  for (const char* plot : {"Radial error motion along 0°</text>", "Form of the part</text>"})
    EXPECT_TRUE(contains(page, plot)) << plot;
  for (const char* wrong : {"nan", "inf ", "src=", "href="})
    EXPECT_FALSE(contains(page, wrong)) << wrong;
  EXPECT_EQ(command("spindle s.csv --report s.html").exit_code, 0) << "over its own page";
  EXPECT_NE(command("spindle s.csv --report s.html --svg s.html").exit_code, 0);
}

// Read in the light, on a phone, in the dark and on paper, which is light.
TEST_F(SpindleCommand, ThePageIsDarkWhereTheReaderAsksForIt) {
  simulate(of_data("spindle_three_sensors.toml"), "s.csv");
  ASSERT_EQ(command("spindle s.csv --report s.html").exit_code, 0);
  EXPECT_TRUE(contains(read_text(folder_ / "s.html"), "prefers-color-scheme: dark"));
  if (!example::can_open_pages()) GTEST_SKIP() << "chromium or node is not installed";
  const std::string page = (folder_ / "s.html").string();
  const CommandResult looked =
      shell("node " + shell_word(places::source() + "/tests/e2e/plain_page.mjs") + " " +
            shell_word(page) + example::pictures(folder_ / "shots") + " 2>&1");
  EXPECT_EQ(looked.exit_code, 0) << looked.output;
}

TEST_F(SpindleCommand, AReversalIsKnownInTheSensitiveDirectionOnly) {
  simulate(of_data("spindle_reversal.toml"), "r.csv");
  const CommandStreams done = command("spindle r.csv --json r.json --verbose");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(contains(done.out, "the motion is known only along 0°")) << done.out;
  EXPECT_TRUE(contains(done.out, "order  condition")) << done.out;
  const nlohmann::json radial = result("r.json").at("radial");
  expect_within(radial.at("values").at("synchronous"), 0.8e-3, "synchronous");
  expect_within(radial.at("form"), 1.0e-3, "roundness");
  EXPECT_FALSE(radial.contains("values_across"));
  EXPECT_EQ(radial.at("runs").size(), 2U);
}

TEST_F(SpindleCommand, AReversalMayBeTwoFiles) {
  const std::string part =
      "[part]\nkind = \"cylinder\"\nradius_mm = 20\nx0_mm = 0.005\n[noise]\nsigma_um = 0.02\n"
      "[[effect]]\nid = \"part.roundness\"\norder = 3\namplitude_um = 0.5\n[[effect]]\n"
      "id = \"spindle.radial_synchronous\"\norder = 3\namplitude_um = 0.4\n[[pass]]\nz_mm = 10\n"
      "readings_per_revolution = 250\nrevolutions = 12\n";
  file("front.toml", part);
  file("rear.toml",
       part + "setup = 2\n[[setup]]\nnumber = 2\nreindex_deg = 180\nside = \"rear\"\n");
  simulate("front.toml", "front.csv");
  simulate("rear.toml", "rear.csv");
  const CommandStreams done = command("spindle front.csv rear.csv --json r.json");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const nlohmann::json radial = result("r.json").at("radial");
  expect_within(radial.at("values").at("synchronous"), 0.8e-3, "synchronous");
  expect_within(radial.at("form"), 1.0e-3, "roundness");
}

TEST_F(SpindleCommand, AJobAndTwoStreamsSayTheSameAsOptions) {
  simulate(of_data("spindle_three_sensors.toml"), "s.csv");
  file("face.toml",
       "[part]\nkind = \"face\"\nd_mm = 40\n[noise]\nsigma_um = 0.02\n[[pass]]\nx_mm = 0\n"
       "speed_rpm = 600\nreadings_per_revolution = 200\nrevolutions = 20\n[[effect]]\n"
       "id = \"spindle.axial_synchronous\"\norder = 1\namplitude_um = 0.4\n[[effect]]\n"
       "id = \"spindle.axial_synchronous\"\norder = 2\namplitude_um = 0.2\n");
  simulate("face.toml", "z.csv");
  file("job.toml",
       "order_max = 50\n[sensor]\nangles_deg = [0, 55, 113.2]\nu_angle_deg = 0.05\n"
       "[[stream]]\nstream = \"s.csv\"\n[[stream]]\nstream = \"z.csv\"\n");
  const CommandStreams of_job = command("spindle job.toml --json a.json");
  ASSERT_EQ(of_job.exit_code, 0) << of_job.err;
  const CommandStreams of_options = command(
      "spindle s.csv z.csv --angles-deg 0,55,113.2 --u-angle-deg 0.05 --orders 2-50 --json b.json");
  ASSERT_EQ(of_options.exit_code, 0) << of_options.err;
  const nlohmann::json axial = result("a.json").at("axial");
  expect_within(axial.at("fundamental"), 0.8e-3, "fundamental axial");
  expect_within(axial.at("residual_synchronous"), 0.4e-3, "residual synchronous axial");
  nlohmann::json a = result("a.json"), b = result("b.json");
  for (nlohmann::json* one : {&a, &b}) {  // a job's paths are those of its folder
    one->erase("inputs");
    for (const char* which : {"radial", "axial"})
      for (nlohmann::json& run : one->at(which).at("runs")) run.erase("stream");
  }
  EXPECT_EQ(a, b);
  EXPECT_EQ(of_job.out, of_options.out);
}

TEST_F(SpindleCommand, SuppressedOrdersAreNamedWithTheirConditionNumber) {
  file("s.toml",
       "[part]\nkind = \"cylinder\"\nradius_mm = 20\nx0_mm = 0.01\n[probe]\n"
       "sensor_angles_deg = [0, 120, 240]\n[noise]\nsigma_um = 0.02\n[[pass]]\nz_mm = 0\n"
       "readings_per_revolution = 60\nrevolutions = 8\n[[effect]]\nid = \"part.roundness\"\n"
       "order = 5\namplitude_um = 1\n");
  simulate("s.toml", "s.csv");
  const CommandStreams done = command("spindle s.csv --orders 2-12 --json s.json");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(contains(done.out,
                       "2, 4, 5, 7, 8, 10, 11: form and motion are read as one "
                       "(condition number"))
      << done.out;
  const nlohmann::json radial = result("s.json").at("radial");
  EXPECT_EQ(radial.at("suppressed").size(), 7U);
  for (const nlohmann::json& one : radial.at("orders")) {
    const bool suppressed = one.at("order").get<int>() % 3 != 0;
    EXPECT_EQ(one.contains("suppressed"), suppressed);
    EXPECT_EQ(one.at("form").at("amplitude").is_null(), suppressed) << "never as zero";
  }
}

TEST_F(SpindleCommand, AnglesAreProposedAndThoseGivenAreJudged) {
  const CommandStreams done = command("spindle --advise --sensors 3 --angles-deg 0,120,240");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(contains(done.out, "no order of 2 to 100")) << done.out;
  EXPECT_TRUE(contains(done.out, "given     0, 120, 240 deg")) << done.out;
  EXPECT_TRUE(contains(done.out, "2, 4, 5, 7")) << done.out;
}

TEST_F(SpindleCommand, AdviceNamesItWhereRoundnessAndSpindleLookAlike) {
  const std::string scenario =
      "seed = 5\n[part]\nkind = \"cylinder\"\nradius_mm = 30\nx0_mm = 0.05\n[noise]\nsigma_um = 1\n"
      "[[pass]]\nz_start_mm = 0\nz_end_mm = 40\nfeed_mm_per_rev = 1\n"
      "readings_per_revolution = 24.3\n";
  file("round.toml", scenario);
  file("lobes.toml",
       scenario + "[[effect]]\nid = \"part.roundness\"\norder = 3\namplitude_um = 3\n");
  simulate("round.toml", "round.csv");
  simulate("lobes.toml", "lobes.csv");
  const CommandStreams round = command("advise round.csv --surface cylinder");
  const CommandStreams lobes = command("advise lobes.csv --surface cylinder");
  EXPECT_FALSE(contains(round.out, "trueaxis spindle")) << round.out;
  EXPECT_TRUE(contains(lobes.out, "`trueaxis spindle --advise`")) << lobes.out;
}

}  // namespace
}  // namespace trueaxis::testing
