// SPDX-License-Identifier: Apache-2.0
// From the errors of a part's datums to the program that cuts it right: twelve holes and a blade.
#include <cmath>
#include <sstream>

#include "support/command_fixture.hpp"
#include "support/places.hpp"
#include "support/twelve_holes.hpp"

namespace trueaxis::testing {
namespace {

class FixtureCompensate : public CommandTest {
 protected:
  static std::string of_data(const std::string& name) {
    return std::string(places::source() + "/data/five_axis/").append(name);
  }
  nlohmann::json compensate(const std::string& part, const std::string& options) {
    const CommandStreams datum =
        command("setup datums " + of_data(part + ".toml") + " -o E.toml --json d.json");
    EXPECT_EQ(datum.exit_code, 0) << datum.err;
    const CommandStreams done =
        command("machine compensate " + of_data(part + ".nc") + " --machine " +
                of_data("zxacy.toml") + " --errors E.toml -o cut.nc --json c.json " + options);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return result("c.json");
  }
};

double value(const nlohmann::json& json) { return json.at("value"); }

/// Half of the last decimals of the words: 10⁻⁴ mm of X Y Z, 10⁻⁵ deg of A C at up to 160 mm.
constexpr double rounding_mm = 0.5e-4 * 1.7320508 + 2.0 * 0.5e-5 * rad_per_deg * 160.0;
constexpr double rounding_rad = 2.0 * 0.5e-5 * rad_per_deg;

// 0.3 mm before, the rounding of the words after; and so by the test's own machine, in whose
// fixture the part is displaced by D.
TEST_F(FixtureCompensate, TwelveHoles) {
  const nlohmann::json json = compensate("holes", "");
  EXPECT_NEAR(value(json.at("error_before").at("position")), 0.3, 0.03);
  EXPECT_LT(value(json.at("error_after").at("position")), rounding_mm);
  EXPECT_TRUE(json.at("singular").empty());
  const Holes holes = twelve_holes(read_text(of_data("holes.nc")));
  const std::vector<FiveAxes> ends = ends_of_moves(read_text(folder_ / "cut.nc"));
  ASSERT_EQ(ends.size(), 12U);
  Matrix4 D{};
  const nlohmann::json matrix = result("d.json").at("matrix");
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) D[i][j] = matrix.at(i).at(j);
  for (std::size_t n = 0; n < 12; ++n) {
    const Matrix4 tool = times(inverse(D), tool_in_fixture(ends[n]));
    const Matrix4 as_it_was = times(inverse(D), tool_in_fixture(holes.at[n]));
    double off = 0.0, was = 0.0, turned = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      off += std::pow(tool[k][3] - holes.bottom[n][k], 2);
      was += std::pow(as_it_was[k][3] - holes.bottom[n][k], 2);
      turned += std::pow(tool[k][2] - holes.axis[n][k], 2);
    }
    // The nominal program is rounded as well.
    EXPECT_LT(std::sqrt(off), 2.0 * rounding_mm) << "hole " << n + 1;
    EXPECT_GT(std::sqrt(was), 0.05) << "hole " << n + 1;
    EXPECT_LT(std::sqrt(turned), 2.0 * rounding_rad) << "hole " << n + 1;
  }
}

/// The datum errors of holes.toml times `factor`.
std::string datums_times(double factor) {
  std::string out;
  std::istringstream in(read_text(places::source() + "/data/five_axis/holes.toml"));
  for (std::string line; std::getline(in, line);) {
    const std::size_t equals = line.find(" = ");
    if (line[0] == 'E' && equals != std::string::npos)
      line =
          line.substr(0, equals + 3) + std::to_string(factor * std::stod(line.substr(equals + 3)));
    out += line + '\n';
  }
  return out;
}

// What the total differential leaves is a product of two errors, 2 mrad times 0.3 mm: half the
// errors leave a quarter, up to the third order, a hundredth of it and less.
TEST_F(FixtureCompensate, TheDifferentialLeavesTheSecondOrder) {
  double left_mm[2];
  for (int half = 0; half < 2; ++half) {
    file("d.toml", datums_times(half == 1 ? 0.5 : 1.0));
    ASSERT_EQ(command("setup datums d.toml -o E.toml").exit_code, 0);
    const CommandStreams done = command(
        "machine compensate " + of_data("holes.nc") + " --machine " + of_data("zxacy.toml") +
        " --errors E.toml -o cut.nc --json c.json --method differential --decimals 9 "
        "--angle-decimals 9");
    ASSERT_EQ(done.exit_code, 0) << done.err;
    left_mm[half] = value(result("c.json").at("error_after").at("position"));
  }
  EXPECT_GT(left_mm[0], 1e-4);
  EXPECT_LT(left_mm[0], 2e-3);
  EXPECT_NEAR(left_mm[0] / left_mm[1], 4.0, 0.04);
}

// Between the blocks a tolerance is kept that was asked for, 0.03 mm as the article has it.
TEST_F(FixtureCompensate, TheBladeWithinItsTolerance) {
  const nlohmann::json json = compensate("blade", "--tolerance-um 30");
  EXPECT_NEAR(value(json.at("error_before").at("position")), 0.35, 0.01);
  EXPECT_LT(value(json.at("error_after").at("position")), rounding_mm);
  EXPECT_LE(value(json.at("between_blocks").at("after")), 0.03 + rounding_mm);
  EXPECT_GT(value(json.at("between_blocks").at("before")), 0.2);
}

// A file of errors says what it is in its first line: its name may be any.
TEST_F(FixtureCompensate, ErrorsNeedNoSuffix) {
  const CommandStreams datum =
      command("setup datums " + of_data("holes.toml") + " -o errors_of_the_part");
  ASSERT_EQ(datum.exit_code, 0) << datum.err;
  const CommandStreams done =
      command("machine compensate " + of_data("holes.nc") + " --machine " + of_data("zxacy.toml") +
              " --errors errors_of_the_part -o cut.nc");
  EXPECT_EQ(done.exit_code, 0) << done.err;
}

}  // namespace
}  // namespace trueaxis::testing
