// SPDX-License-Identifier: Apache-2.0
// Read-outs of a linear axis against a scale or laser: read in both senses, and as other programs
// write them.
#include <numbers>
#include <random>

#include "support/bc_trunnion.hpp"

namespace trueaxis::testing {
namespace {

constexpr double pitch_mm = 10.0, reversal_um = 5.0, sigma_um = 0.5;

/// ISO 230-2: error is actual less commanded position; the reversal value is the mean error of
/// positions approached upwards less that downwards.
class LinearReadOut : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    file("m.toml", bc_trunnion);
    std::mt19937_64 random(11);
    std::normal_distribution<double> noise(0.0, sigma_um);
    for (int run = 0; run < 4; ++run)
      for (int i = 0; i <= 60; ++i) {
        const bool up = run % 2 == 0;
        const double z = up ? 5.0 * i : 300.0 - 5.0 * i;
        command_mm_.push_back(z);
        error_um_.push_back(0.02 * z + 3.0 * std::sin(2.0 * std::numbers::pi * z / pitch_mm / 4.0) +
                            (up ? 0.5 : -0.5) * reversal_um + noise(random));
      }
  }

  std::string rows(const char* format, double factor, bool with_command) const {
    std::string text;
    char row[80];
    for (std::size_t i = 0; i < command_mm_.size(); ++i) {
      std::snprintf(row, sizeof row, format, command_mm_[i],
                    factor * error_um_[i] + (with_command ? command_mm_[i] : 0.0));
      text += row;
    }
    return text;
  }

  nlohmann::json calibrated() {
    const CommandStreams done =
        command("machine calibrate z.csv --machine m.toml -o e.toml --json c.json --force");
    EXPECT_EQ(done.exit_code, 0) << done.err;
    screen_ = done.out;
    return result("c.json")["read_outs"][0];
  }

  std::vector<double> command_mm_, error_um_;
  std::string screen_;
};

constexpr const char* header = "# kind: axis\n# axis: Z\n";

TEST_F(LinearReadOut, TheReversalValueIsFoundAndIsNoNoise) {
  file("z.csv", header + std::string("command[mm],error[um]\n") + rows("%.3f,%.6f\n", 1.0, false));
  const nlohmann::json found = calibrated();
  // The mean of 122 errors less that of 122: u = σ √(2/122); the odds of 5 u are 1 to 1.7 million.
  const double u_mm = 1e-3 * sigma_um * std::sqrt(2.0 / 122.0);
  EXPECT_NEAR(value_of(found["reversal_value"]), 1e-3 * reversal_um, 5.0 * u_mm);
  EXPECT_NEAR(found["reversal_value"]["u"].get<double>(), u_mm, 0.3 * u_mm);
  // χ² of some 230 degrees of freedom: σ to 4.7 %.
  EXPECT_NEAR(value_of(found["noise"]), 1e-3 * sigma_um, 5.0 * 0.047e-3 * sigma_um);
  EXPECT_NEAR(value_of(found["period"]), 4.0 * pitch_mm, 0.1);
  EXPECT_TRUE(contains(screen_, "reversal value")) << screen_;
  EXPECT_FALSE(contains(read_text(folder_ / "e.toml"), "revers"));
}

TEST_F(LinearReadOut, OneSenseHasNoReversalValue) {
  command_mm_.resize(61);
  error_um_.resize(61);
  file("z.csv", header + std::string("command[mm],error[um]\n") + rows("%.3f,%.6f\n", 1.0, false));
  EXPECT_TRUE(calibrated()["reversal_value"].is_null());
}

TEST_F(LinearReadOut, ActualAndErrorAreTheSame) {
  file("z.csv", header + std::string("command[mm],actual[mm]\n") + rows("%.3f,%.9f\n", 1e-3, true));
  const nlohmann::json actual = calibrated();
  file("z.csv", header + std::string("command[mm],error[um]\n") + rows("%.3f,%.6f\n", 1.0, false));
  const nlohmann::json error = calibrated();
  // Printed to 1e-9 mm.
  for (const char* key : {"rms_before", "rms_after", "noise", "reversal_value"})
    EXPECT_NEAR(value_of(actual[key]), value_of(error[key]), 2e-9) << key;
  file("z.csv", header + std::string("command[mm],actual[mm],error[um]\n1,1,0\n2,2,0\n"));
  expect_input_error("machine calibrate z.csv --machine m.toml -o f.toml",
                     "the columns actual and error");
  file("z.csv", header + std::string("command[mm]\n1\n2\n"));
  expect_input_error("machine calibrate z.csv --machine m.toml -o f.toml",
                     "neither a column actual nor a column error");
}

TEST_F(LinearReadOut, IsImportedFromASpreadsheet) {
  file("z.csv", header + std::string("command[mm],error[um]\n") + rows("%.3f,%.6f\n", 1.0, false));
  const nlohmann::json direct = calibrated();
  std::string text = rows("%.3f;%.6f\n", 1.0, false);
  std::ranges::replace(text, '.', ',');
  file("export.csv", "Laser, axis Z\nSollposition [mm];Abweichung [µm]\n" + text);
  const CommandStreams done = command("import export.csv --axis Z -o z.csv --force");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const nlohmann::json imported = calibrated();
  for (const char* key : {"rms_before", "rms_after", "noise", "reversal_value"})
    EXPECT_DOUBLE_EQ(value_of(imported[key]), value_of(direct[key])) << key;
}

TEST_F(LinearReadOut, WhatIsNotClearIsAskedFor) {
  std::string text = rows("%.3f;%.6f\n", 1.0, false);
  file("export.csv", "Sollposition;Abweichung [µm]\n" + text);
  expect_input_error("import export.csv --axis Z -o new.csv", "command=1[mm]");
  file("export.csv", "Zeit [s];Abweichung [µm]\n" + text);
  expect_input_error("import export.csv --axis Z -o new.csv", "error=2[um]");
  file("export.csv", "Sollposition [mm];Abweichung [µm];Fehler [µm]\n1,5;1,5;1,5\n2,5;1,5;1,5\n");
  expect_input_error("import export.csv --axis Z -o new.csv", "columns 2 and 3");
}

}  // namespace
}  // namespace trueaxis::testing
