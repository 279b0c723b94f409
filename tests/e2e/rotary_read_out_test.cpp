// SPDX-License-Identifier: Apache-2.0
// Read-outs of a rotary axis: what is done with them beyond the turn that was read.
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>

#include "support/bc_trunnion.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

constexpr double pi = std::numbers::pi;

class RotaryReadOut : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    file("m.toml", bc_trunnion);
  }

  /// A file of kind axis: degrees and radians.
  template <class Error>
  void read_out(char axis, double first_deg, double step_deg, int count, const Error& error_urad,
                const std::string& more = "") {
    std::string text =
        std::string("# kind: axis\n# axis: ") + axis + "\n" + more + "command[deg],actual[deg]\n";
    char row[80];
    for (int i = 0; i < count; ++i) {
      const double at = first_deg + step_deg * i;
      std::snprintf(row, sizeof row, "%.9f,%.9f\n", at, at + 1e-6 * error_urad(at) * 180.0 / pi);
      text += row;
    }
    file("c.csv", text);
  }
  CommandStreams calibrate() {
    return command("machine calibrate --machine m.toml c.csv -o e.toml --json r.json --force");
  }
  double error_urad(double at_deg, const char* name = "ECC") {
    const Machine machine = read_machine_toml((folder_ / "m.toml").string()).machine;
    AxisPositions q{};
    q[name[2] == 'C' ? 5 : 4] = at_deg * pi / 180.0;
    return 1e6 * read_errors_toml((folder_ / "e.toml").string(), machine)
                     .value(*parse_error_name(name), q);
  }
};

// 72 readings of one turn, printed to 1e-9 deg (1.7e-5 µrad): at 460 deg what is at 100 deg. The
// table carries the part, and the errors are of the moving part: the sign of the axis.
TEST_F(RotaryReadOut, OneTurnRepeatsItself) {
  const auto truth = [](double at) { return 50.0 * std::cos(at * pi / 180.0); };
  for (const double noise_urad : {0.0, 1.0}) {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0.0, noise_urad + 1e-12);
    read_out('C', 0.0, 5.0, 72, [&](double at) { return truth(at) + noise(random); });
    const CommandStreams done = calibrate();
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const nlohmann::json found = result("r.json").at("read_outs")[0];
    EXPECT_NEAR(value_of(found.at("period")), 360.0, 1e-9);
    ASSERT_EQ(found.at("orders").size(), 1u);
    EXPECT_EQ(found.at("orders")[0].at("order"), 1);
    const double sign = error_urad(0.0) < 0.0 ? -1.0 : 1.0;
    // Two coefficients of 72 readings: u = σ √(2/72) each, together at most 4 of them.
    const double off_urad = 1e-3 + 4.0 * noise_urad * std::sqrt(2.0 / 72.0);
    for (const double at : {10.0, 100.0, 460.0, -300.0, 820.0})
      EXPECT_NEAR(sign * error_urad(at), truth(at), off_urad) << at;
  }
}

TEST_F(RotaryReadOut, AGearIsStatedOrFoundOverSeveralTurns) {
  // A worm of 30 to 1 in one turn of readings every 2°: found only where it is stated.
  const auto worm = [](double at) {
    return 20.0 * std::cos(at * pi / 180.0) + 8.0 * std::sin(30.0 * at * pi / 180.0);
  };
  read_out('C', 0.0, 2.0, 180, worm, "# gear_ratio: 30\n");
  ASSERT_EQ(calibrate().exit_code, 0);
  double sign = error_urad(0.0) < 0.0 ? -1.0 : 1.0;
  for (const double at : {33.0, 393.0, 750.5}) EXPECT_NEAR(sign * error_urad(at), worm(at), 1e-3);
  // A period of 143° over five turns: nothing that the turn explains.
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0.0, 0.5);
  const auto belt = [&](double at) {
    return 30.0 * std::cos(2.0 * pi * at / 143.0 + 0.4) + noise(random);
  };
  read_out('C', 0.0, 4.0, 450, belt);
  ASSERT_EQ(calibrate().exit_code, 0);
  EXPECT_NEAR(value_of(result("r.json").at("read_outs")[0].at("period")), 143.0, 0.01);
  // Over one turn and a half the same is not a period of its own.
  read_out('C', 0.0, 4.0, 135, belt);
  const CommandStreams done = calibrate();
  if (done.exit_code == 0) {
    const auto period = result("r.json").at("read_outs")[0].at("period");
    EXPECT_TRUE(period.is_null() || std::abs(value_of(period) - 360.0) < 1e-9) << period;
  }
}

// B from -30 to 30 deg: beyond it its errors are not known, and a program that goes there is
// refused.
TEST_F(RotaryReadOut, APartOfATurnIsNotExtrapolated) {
  read_out('B', -30.0, 1.0, 61, [](double at) { return 0.02 * at * at + at; });
  ASSERT_EQ(calibrate().exit_code, 0);
  const double sign = error_urad(20.0, "EBB") < 0.0 ? -1.0 : 1.0;
  EXPECT_NEAR(sign * (error_urad(25.0, "EBB") - error_urad(0.0, "EBB")), 0.02 * 625 + 25, 0.01);
  file("in.nc", "G0 X0 Y0 Z0 B25 C10\nG1 B-28 C40 F500\n");
  EXPECT_EQ(
      command("machine compensate in.nc --machine m.toml --errors e.toml -o o.nc --tolerance-um 50")
          .exit_code,
      0);
  file("out.nc", "G0 X0 Y0 Z0 B25 C10\nG1 B-80 F500\n");
  const CommandStreams done =
      command("machine compensate out.nc --machine m.toml --errors e.toml -o o2.nc");
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_TRUE(contains(done.err, "B at -80 deg is beyond -30 to 30")) << done.err;
  EXPECT_FALSE(there("o2.nc"));
  file("q.csv", "X[mm],Y[mm],Z[mm],B[deg],C[deg]\n0,0,0,-80,0\n");
  EXPECT_EQ(command("machine pose --machine m.toml q.csv --errors e.toml").exit_code, 1);
}

// A real encoder: one turn of a screw as a rotary axis (1 mm is 360°), against Fourier sums over
// all ten turns that the test makes itself. Of 400 readings of the file's 0.29 µm an amplitude has
// u = 0.29 √(2/400) µm = 0.0074°, and turns differ by no more than three of them.
TEST_F(RotaryReadOut, OneTurnOfARealEncoder) {
  const auto path = std::filesystem::path(places::measured_data()) / "screw_axis.csv";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  std::vector<std::pair<double, double>> readings;  // turns, error in turns
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    double t = 0.0, command = 0.0, read = 0.0;
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf", &t, &command, &read) == 3)
      readings.emplace_back(command, read - command);
  }
  const auto amplitude_deg = [&](double from, double to, int order) {
    double a = 0.0, b = 0.0, n = 0.0;
    for (const auto& [at, error] : readings) {
      if (at < from || at >= to) continue;
      a += error * std::cos(2.0 * pi * order * at);
      b += error * std::sin(2.0 * pi * order * at);
      n += 1.0;
    }
    return 360.0 * 2.0 / n * std::hypot(a, b);
  };
  std::string text = "# kind: axis\n# axis: C\ncommand[deg],actual[deg]\n";
  char row[80];
  for (const auto& [at, error] : readings) {
    if (at < 3.0 || at >= 4.0) continue;
    std::snprintf(row, sizeof row, "%.6f,%.6f\n", 360.0 * at, 360.0 * (at + error));
    text += row;
  }
  file("c.csv", text);
  file("m.toml", bc_trunnion);
  const CommandStreams done = calibrate();
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const nlohmann::json found = result("r.json").at("read_outs")[0];
  EXPECT_NEAR(value_of(found.at("period")), 360.0, 1e-9);
  std::map<int, double> amplitude;
  for (const auto& one : found.at("orders"))
    amplitude[one.at("order")] = value_of(one.at("amplitude"));
  for (const int order : {1, 4, 8})
    EXPECT_NEAR(amplitude[order], amplitude_deg(1.0, 11.0, order), 3.0 * 0.0074) << order;
}

}  // namespace
}  // namespace trueaxis::testing
