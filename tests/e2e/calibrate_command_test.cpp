// SPDX-License-Identifier: Apache-2.0
#include <random>

#include "support/command_fixture.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

class CalibrateCommand : public CommandTest {
 protected:
  static std::string data(const std::string& name) {
    return places::source() + "/data/five_axis/" + name;
  }
  /// Words with blanks between them.
  static std::string line(std::initializer_list<std::string_view> words) {
    std::string out;
    for (const std::string_view word : words) out.append(word).append(1, ' ');
    return out;
  }
  std::string machine_ = data("trunnion_ac.toml"), ball_ = data("trunnion_ac_ball.csv");
};

// The example was made with Z0A 31 µm, B0C 60 and C0A −45 µrad; U is printed in degrees.
TEST_F(CalibrateCommand, WritesErrorsThatPoseReads) {
  const auto done =
      command(line({"machine calibrate --machine", machine_, ball_, "-o e.toml --json c.json"}));
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const nlohmann::json json = result("c.json");
  EXPECT_EQ(json["schema"], "trueaxis.calibration/1");
  const nlohmann::json& parameters = json["parameters"];
  EXPECT_EQ(parameters["Z0A"]["unit"], "mm");
  EXPECT_EQ(parameters["B0C"]["unit"], "deg");
  EXPECT_NEAR(parameters["B0C"]["value"].get<double>(), 60e-6 * 180.0 / 3.14159265358979,
              5.0 * parameters["B0C"]["u"].get<double>());
  EXPECT_EQ(json["covariance"]["matrix"].size(), parameters.size());
  EXPECT_FALSE(json["not_determined"].empty());
  for (const auto& one : json["not_determined"])
    EXPECT_FALSE(one["why"].get<std::string>().empty());
  const auto pose = command(line(
      {"machine pose --machine", machine_, data("trunnion_ac_positions.csv"), "--errors e.toml"}));
  EXPECT_EQ(pose.exit_code, 0) << pose.err;
  const auto again =
      command(line({"machine calibrate --machine", machine_, ball_, "--errors e.toml -o f.toml"}));
  ASSERT_EQ(again.exit_code, 0) << again.err;
}

// Residuals of ±0.5 µm, and one of 15 µm: of 31 readings an RMS of 2.7 µm, five times the noise.
TEST_F(CalibrateCommand, AReadOutBeyondItsNoiseIsUnexplained) {
  for (const double outlier_um : {0.0, 15.0}) {
    std::string text = "# kind: axis\n# axis: X\n# noise: 0.5 um\ncommand[mm],error[um]\n";
    for (int i = 0; i < 31; ++i)
      text += std::to_string(20 * i - 300) + "," +
              std::to_string((i % 2 == 0 ? 0.5 : -0.5) + (i == 12 ? outlier_um : 0.0)) + "\n";
    file("x.csv", text);
    const auto done =
        command(line({"machine calibrate --machine", machine_, "x.csv -o x.toml --force"}));
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_TRUE(done.out.starts_with(
        outlier_um > 0.0 ? "UNEXPLAINED: position errors found, read-out of X " : "DONE: "))
        << done.out;
  }
}

// The virtual machine shares no formula with the model that is fitted. Four u are exceeded by one
// estimate in 16 000.
TEST_F(CalibrateCommand, FindsWhatTheVirtualMachineHides) {
  file("hidden.toml",
       "schema = \"trueaxis.errors/1\"\nsign = \"moving_part\"\n"
       "[[error]]\nname = \"X0C\"\nvalue_um = 25\n[[error]]\nname = \"B0C\"\nvalue_urad = 60\n"
       "[[error]]\nname = \"Y0A\"\nvalue_um = -18\n[[error]]\nname = \"Z0A\"\nvalue_um = 31\n");
  file("ball.toml",
       std::string("seed = 3\nmachine.file = \"")
           .append(machine_)
           .append("\"\nmachine.errors = \"hidden.toml\"\n[measure]\nkind = \"ball\"\n"
                   "ball_mm = [[60, 20, 30]]\ntool_length_mm = 120\nnoise_um = 1\n"
                   "positions.A_deg = [-80, -55, -30, -5, 20]\n"
                   "positions.C_deg = [0, 30, 60, 90, 120, 150, 180, 210, 240, 270, 300, 330]\n"));
  ASSERT_EQ(command("machine simulate ball.toml -o ball.csv").exit_code, 0);
  ASSERT_EQ(
      command(line({"machine calibrate --machine", machine_, "ball.csv -o e.toml --json c.json"}))
          .exit_code,
      0);
  const nlohmann::json found = result("c.json")["parameters"];
  const std::map<std::string, double> hidden{
      {"X0C", 0.025}, {"B0C", 60e-6 * 180.0 / 3.14159265358979}, {"Y0A", -0.018}, {"Z0A", 0.031}};
  for (const auto& [name, value] : hidden) {
    ASSERT_TRUE(found.contains(name)) << name;
    EXPECT_NEAR(found[name]["value"].get<double>(), value, 4.0 * found[name]["u"].get<double>())
        << name;
  }
}

// The same bytes come twice.
TEST_F(CalibrateCommand, IsDeterministic) {
  ASSERT_EQ(
      command(line({"machine calibrate --machine", machine_, ball_, "-o e.toml --json c.json"}))
          .exit_code,
      0);
  ASSERT_EQ(
      command(line({"machine calibrate --machine", machine_, ball_, "-o f.toml --json d.json"}))
          .exit_code,
      0);
  EXPECT_EQ(read_text(folder_ / "e.toml"), read_text(folder_ / "f.toml"));
  EXPECT_EQ(read_text(folder_ / "c.json"), read_text(folder_ / "d.json"));
}

// The example hides EXC of order 2, amplitude √(3² + 2²) = 3.6 µm.
TEST_F(CalibrateCommand, DiagnoseNamesTheHiddenError) {
  const auto done =
      command(line({"machine diagnose", ball_, "--machine", machine_, "--json d.json -o e.toml"}));
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const nlohmann::json json = result("d.json");
  EXPECT_EQ(json["schema"], "trueaxis.machine_diagnosis/2");
  EXPECT_EQ(json["verdict"], "effects");
  ASSERT_EQ(json["findings"].size(), 1U) << json["findings"].dump(1);
  const nlohmann::json& finding = json["findings"][0];
  EXPECT_EQ(finding["effect"], "EXC.harmonic2");
  EXPECT_NEAR(finding["parameters"]["cos"]["value"].get<double>(), 3e-3,
              4.0 * finding["parameters"]["cos"]["u"].get<double>());
  EXPECT_NEAR(finding["parameters"]["sin"]["value"].get<double>(), -2e-3,
              4.0 * finding["parameters"]["sin"]["u"].get<double>());
  EXPECT_LT(json["gain"]["held_out_rms_after"]["value"],
            json["gain"]["held_out_rms_before"]["value"]);
  EXPECT_TRUE(contains(done.out, "EXC.harmonic2"));
  // With the errors that it wrote nothing is left to be found.
  const auto again = command(line(
      {"machine diagnose", ball_, "--machine", machine_, "--errors e.toml --json again.json"}));
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(result("again.json")["verdict"], "ideal");
}

TEST_F(CalibrateCommand, ReadOutOfAnAxis) {
  std::string text = "# kind: axis\n# axis: Z\ncommand[mm],actual[mm]\n";
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0.0, 1e-5);
  for (int i = 0; i <= 400; ++i) {
    const double z = 0.25 * i;
    char row[80];
    std::snprintf(
        row, sizeof row, "%.17g,%.17g\n", z,
        z + 0.01 * z / 100.0 + 0.003 * std::cos(2.0 * 3.14159265358979 * z / 4.0) + normal(random));
    text += row;
  }
  file("z.csv", text);
  const auto done =
      command(line({"machine calibrate --machine", machine_, "z.csv -o e.toml --json c.json"}));
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const nlohmann::json read_out = result("c.json")["read_outs"][0];
  EXPECT_NEAR(read_out["period"]["value"].get<double>(), 4.0, 1e-3);
  // 401 readings of σ = 10 nm: u = 10 nm √(2/401) = 0.7 nm.
  EXPECT_NEAR(read_out["orders"][0]["amplitude"]["value"].get<double>(), 3e-3, 4e-6);
  EXPECT_TRUE(contains(read_text(folder_ / "e.toml"), "EZZ"));
}

}  // namespace
}  // namespace trueaxis::testing
