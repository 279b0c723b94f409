// SPDX-License-Identifier: Apache-2.0
// GUM: U = k u. Twice the k is twice the U, wherever a command of machines or set-ups prints one.
#include <cmath>
#include <regex>

#include "support/command_fixture.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

const std::string machines = places::source() + "/data/five_axis/";

/// Every number after ±, as it is printed.
std::vector<std::string> printed_U(const std::string& text) {
  const std::regex number("± ([0-9.]+)");
  std::vector<std::string> all;
  for (std::sregex_iterator at(text.begin(), text.end(), number), end; at != end; ++at)
    all.push_back((*at)[1]);
  return all;
}

/// Half of the last digit.
double rounding(const std::string& number) {
  const std::size_t point = number.find('.');
  return 0.5 * std::pow(10.0, point == std::string::npos
                                  ? 0.0
                                  : -static_cast<double>(number.size() - point - 1));
}

class CoverageFactor : public CommandTest {
 protected:
  /// With k = 3 and k = 6, screen and --verbose.
  void expect_twice(const std::string& one, std::size_t least) {
    for (const char* const how : {"", " --verbose"}) {
      const CommandStreams three = command(one + how + " --force --coverage-factor 3"),
                           six = command(one + how + " --force --coverage-factor 6");
      ASSERT_EQ(three.exit_code, 0) << one << three.err;
      ASSERT_EQ(six.exit_code, 0) << one << six.err;
      EXPECT_TRUE(contains(three.out, "k = 3)")) << three.out;
      EXPECT_TRUE(contains(six.out, "k = 6)")) << six.out;
      EXPECT_FALSE(contains(three.out + six.out, "k = 2")) << three.out << six.out;
      const auto once = printed_U(three.out), twice = printed_U(six.out);
      ASSERT_GE(once.size(), least) << three.out;
      ASSERT_EQ(once.size(), twice.size()) << three.out << six.out;
      for (std::size_t i = 0; i < once.size(); ++i)
        EXPECT_NEAR(std::stod(twice[i]), 2.0 * std::stod(once[i]),
                    2.0 * rounding(once[i]) + rounding(twice[i]))
            << one << how;
    }
  }
};

TEST_F(CoverageFactor, OfLocatorsAndCalibrations) {
  expect_twice("setup locators " + machines + "hong.toml", 6);
  expect_twice("machine calibrate " + machines + "zxacy_ball.csv --machine " + machines +
                   "zxacy.toml -o e.toml",
               3);
}

TEST_F(CoverageFactor, OfProgramsAndCauses) {
  const std::string of = " --machine " + machines + "zxacy.toml --json r.json --force";
  ASSERT_EQ(command("machine calibrate " + machines + "zxacy_ball.csv --machine " + machines +
                    "zxacy.toml -o e.toml")
                .exit_code,
            0);
  const struct {
    std::string command, key;
  } cases[] = {
      {"machine compensate " + machines + "holes.nc -o new.nc --errors e.toml" + of, ""},
      {"machine diagnose " + machines + "zxacy_ball.csv --program " + machines + "blade.nc" + of,
       "program"},
      {"advise " + machines + "zxacy_ball.csv --program " + machines + "blade.nc" + of, "program"}};
  for (const auto& [arguments, key] : cases) {
    std::vector<double> U;
    for (const double k : {1.0, 4.0}) {
      const CommandStreams ran =
          command(arguments + " --coverage-factor " + std::to_string(static_cast<int>(k)));
      ASSERT_EQ(ran.exit_code, 0) << arguments << ran.err;
      const nlohmann::json found = result("r.json");
      const nlohmann::json& holder = key.empty() ? found.at("U") : found.at(key);
      EXPECT_EQ(holder.at("coverage_factor"), k) << arguments;
      const nlohmann::json& of_tip = key.empty() ? holder : holder.at("U_without_place_of_part");
      U.push_back(of_tip.at("value").get<double>());
    }
    EXPECT_GT(U[0], 0.0) << arguments;
    EXPECT_NEAR(U[1], 4.0 * U[0], 1e-9 * U[1]) << arguments;
  }
}

// A wrong unit is refused whatever k is printed.
TEST_F(CoverageFactor, DoesNotHideAMistake) {
  std::string ball = read_text(machines + "zxacy_ball.csv");
  ball = std::regex_replace(ball, std::regex("(d[XYZ])\\[um\\]"), "$1[mm]");
  file("ball.csv", ball);
  for (const char* const k : {"2", "100"}) {
    const CommandStreams ran = command("machine calibrate ball.csv --machine " + machines +
                                       "zxacy.toml -o e.toml --coverage-factor " + k);
    EXPECT_EQ(ran.exit_code, 1) << ran.out << ran.err;
    EXPECT_FALSE(there("e.toml")) << k;
  }
}

}  // namespace
}  // namespace trueaxis::testing
