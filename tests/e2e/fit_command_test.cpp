// SPDX-License-Identifier: Apache-2.0
// `trueaxis fit`: the JSON of outputs.md, streams from anywhere, and what is not determined.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "support/command_fixture.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

using nlohmann::json;

class FitCommand : public CommandTest {
 protected:
  json fitted(const std::string& arguments, int exit_code = 0) {
    const CommandStreams done = command("fit " + arguments + " --json -");
    EXPECT_EQ(done.exit_code, exit_code) << arguments << '\n' << done.err;
    return json::parse(done.out);
  }
};

double value(const json& fit, const char* name) {
  return fit.at("parameters").at(name).at("value").get<double>();
}

/// {"value", "unit"} with a number; "u" as well where `with_u`.
void expect_quantity(const json& quantity, const std::string& unit, bool with_u) {
  EXPECT_TRUE(quantity.at("value").is_number()) << quantity;
  EXPECT_EQ(quantity.at("unit"), unit);
  if (with_u) {
    EXPECT_GT(quantity.at("u").get<double>(), 0.0) << quantity;
  }
}

constexpr Part noisy_cone{.half_angle_deg = 7, .noise_mm = 0.002};

TEST_F(FitCommand, HasTheFieldsOfTheSchema) {
  file("cone.csv", csv(probe(noisy_cone)));
  const json fit = fitted("cone.csv --surface cone");
  EXPECT_EQ(fit.at("schema"), "trueaxis.fit/1");
  EXPECT_EQ(fit.at("surface"), "cone");
  EXPECT_EQ(fit.at("criterion"), "probe");
  EXPECT_EQ(fit.at("status"), "converged");
  EXPECT_EQ(fit.at("points"), 144);
  EXPECT_EQ(fit.at("rejected"), json::array());
  EXPECT_GT(fit.at("iterations").get<int>(), 0);
  EXPECT_EQ(fit.at("input").at("hash").get<std::string>().substr(0, 8), "xxh3-64:");
  EXPECT_TRUE(fit.at("version").is_string());
  const std::vector<std::pair<std::string, std::string>> parameters{
      {"x0", "mm"}, {"y0", "mm"}, {"l", "1"}, {"m", "1"}, {"k", "mm"}, {"half_angle", "deg"}};
  ASSERT_EQ(fit.at("parameters").size(), parameters.size());
  json order = json::array();
  for (const auto& [name, unit] : parameters) {
    expect_quantity(fit.at("parameters").at(name), unit, true);
    order.push_back(name);
  }
  expect_quantity(fit.at("derived").at("radius_mid"), "mm", true);
  expect_quantity(fit.at("rms"), "mm", false);
  expect_quantity(fit.at("noise").at("sigma"), "mm", false);
  EXPECT_TRUE(fit.at("noise").at("source").is_string());
  EXPECT_EQ(fit.at("covariance").at("order"), order);
  const json& matrix = fit.at("covariance").at("matrix");
  ASSERT_EQ(matrix.size(), 6u);
  const auto u = [&](std::size_t i) {
    return fit.at("parameters").at(parameters[i].first).at("u").get<double>();
  };
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(matrix[i][i].get<double>(), u(i) * u(i), 1e-12 * u(i) * u(i));
    for (std::size_t j = 0; j < 6; ++j) {  // symmetric but for the order of summation
      EXPECT_NEAR(matrix[i][j].get<double>(), matrix[j][i].get<double>(), 1e-12 * u(i) * u(j));
    }
  }
}

TEST_F(FitCommand, FindsTheConeThatWasWritten) {
  file("cone.csv", csv(probe({.half_angle_deg = 7})));
  const json fit = fitted("cone.csv --surface cone");
  // Noise-free, 17 digits in the file: what remains is rounding of readings near 30 mm.
  EXPECT_NEAR(value(fit, "x0"), 0.08, 1e-9);
  EXPECT_NEAR(value(fit, "y0"), -0.06, 1e-9);
  EXPECT_NEAR(value(fit, "l"), 0.0, 1e-10);
  EXPECT_NEAR(value(fit, "half_angle"), 7.0, 1e-9);
  EXPECT_NEAR(value(fit, "k"), -30.0 / std::tan(7.0 * std::numbers::pi / 180.0), 1e-7);
}

TEST_F(FitCommand, FileAndStandardInputGiveTheSame) {
  file("cone.csv", csv(probe(noisy_cone)));
  json from_file = fitted("cone.csv --surface cone");
  json from_input = fitted("- --surface cone < cone.csv");
  json from_pipe =
      json::parse(shell("cat " + shell_word(folder_ / "cone.csv") + " | " +
                        shell_word(places::command()) + " fit - --surface cone --json -")
                      .output);
  EXPECT_EQ(from_file.at("input").at("file"), "cone.csv");
  EXPECT_EQ(from_input.at("input").at("file"), "-");
  EXPECT_EQ(from_input, from_pipe);
  from_file["input"]["file"] = from_input["input"]["file"];
  EXPECT_EQ(from_file, from_input);
}

TEST_F(FitCommand, JsonToAFileIsTheJsonPrinted) {
  file("cone.csv", csv(probe(noisy_cone)));
  const CommandStreams printed = command("fit cone.csv --surface cone --json -");
  const CommandStreams written = command("fit cone.csv --surface cone --json fit.json");
  EXPECT_EQ(printed.out, read_text(folder_ / "fit.json"));
  EXPECT_EQ(printed.err, "");
  EXPECT_TRUE(contains(written.out, "\nangle  "));
  EXPECT_EQ(files_in(folder_), (std::vector<std::string>{"cone.csv", "fit.json"}));
}

TEST_F(FitCommand, UnitsLineEndsAndDiameterChangeNothing) {
  const auto readings = probe(noisy_cone);
  file("radius.csv", csv(readings));
  std::string diameter = "X_M[mm dia];C[rev];Z[um]\r\n", flagged = "Z,X_M,C\n";
  char line[120];
  for (const PartReading& r : readings) {
    std::snprintf(line, sizeof line, "%.17g; %.17g; %.17g\r\n", 2 * r.x_mm, r.c_deg / 360,
                  r.z_mm * 1000);
    diameter += line;
    std::snprintf(line, sizeof line, "%.17g,%.17g,%.17g\n", r.z_mm, 2 * r.x_mm, r.c_deg);
    flagged += line;
  }
  file("diameter.csv", diameter);
  file("flagged.csv", flagged);
  const json wanted = fitted("radius.csv --surface cone").at("parameters");
  for (const char* other :
       {"diameter.csv --surface cone", "flagged.csv --surface cone --diameter"}) {
    const json found = fitted(other).at("parameters");
    for (const auto& [name, parameter] : wanted.items()) {
      // Units are converted with a rounding each: far below a thousandth of u.
      EXPECT_NEAR(found.at(name).at("value").get<double>(), parameter.at("value").get<double>(),
                  1e-6 * parameter.at("u").get<double>())
          << other << ' ' << name;
    }
  }
}

TEST_F(FitCommand, ProbedFromTheRearGivesTheSamePart) {
  // The line through the spindle axis at C meets the rear of the part where at C + 180° it meets
  // the front, with the sign of X reversed.
  const auto front = probe(noisy_cone);
  auto rear = front;
  for (PartReading& r : rear) r = {-r.x_mm, r.c_deg + 180, r.z_mm};
  file("front.csv", csv(front));
  file("rear.csv", csv(rear));
  const json wanted = fitted("front.csv --surface cone").at("parameters");
  const json found = fitted("rear.csv --surface cone").at("parameters");
  for (const auto& [name, parameter] : wanted.items()) {
    EXPECT_NEAR(found.at(name).at("value").get<double>(), parameter.at("value").get<double>(),
                1e-6 * parameter.at("u").get<double>())
        << name;
  }
}

TEST_F(FitCommand, SpikesAreListedByRow) {
  auto readings = probe({.noise_mm = 0.002});
  readings[17].x_mm += 0.08;
  readings[90].x_mm += 0.05;
  file("part.csv", csv(readings));
  const json rejected = fitted("part.csv --surface cylinder --loss tukey").at("rejected");
  std::vector<int> rows;
  for (const json& r : rejected) {
    rows.push_back(r.at("row").get<int>());
    EXPECT_TRUE(contains(r.at("why").get<std::string>(), "µm off")) << r;
  }
  for (const int row : {18, 91}) {
    EXPECT_NE(std::ranges::find(rows, row), rows.end()) << "row " << row << " in " << rejected;
  }
}

TEST_F(FitCommand, ResidualsHaveARowPerReading) {
  file("part.csv", csv(probe({.noise_mm = 0.002})));
  ASSERT_EQ(command("fit part.csv --surface cylinder --residuals r.csv").exit_code, 0);
  const std::string text = read_text(folder_ / "r.csv");
  EXPECT_TRUE(
      text.starts_with("# schema: trueaxis.residuals/1\n"
                       "row,C[deg],Z[mm],X_M[mm],residual[um],rejected\n"));
  EXPECT_EQ(std::ranges::count(text, '\n'), 146);
}

TEST_F(FitCommand, TooFewReadingsWriteNothing) {
  auto readings = probe({.sections = 3, .angles = 4});
  const std::pair<const char*, std::size_t> cases[] = {
      {"cone", 5}, {"cylinder", 4}, {"section", 2}};
  for (const auto& [surface, count] : cases) {
    file("few.csv", csv({readings.begin(), readings.begin() + static_cast<long>(count)}));
    expect_input_error(std::string("fit few.csv --json f.json --surface ") + surface,
                       std::to_string(count) + " readings are fewer than the " +
                           std::to_string(count + 1) + " parameters");
  }
}

TEST_F(FitCommand, GaugeNeedsANominalRadius) {
  auto readings = probe({});
  for (PartReading& r : readings) r.x_mm -= 30;
  file("gauge.csv", csv(readings, "# reading: relative\nX_M,C,Z\n"));
  file("bare.csv", csv(readings));
  expect_input_error("fit gauge.csv --surface cylinder --json f.json", "nominal_radius");
  expect_input_error("fit bare.csv --surface cylinder --json f.json", "changes sign");
  for (const char* arguments : {"gauge.csv --surface cylinder --nominal-radius-mm 30",
                                "bare.csv --surface cylinder --relative --nominal-radius-mm 30"}) {
    const json fit = fitted(arguments);
    EXPECT_NEAR(value(fit, "x0"), 0.08, 1e-9);
    EXPECT_TRUE(fit.at("parameters").at("radius").at("value").is_null());
    EXPECT_TRUE(fit.at("parameters").at("radius").at("why").is_string());
  }
}

}  // namespace
}  // namespace trueaxis::testing
