// SPDX-License-Identifier: Apache-2.0
// Pages as the commands write them: `--report` of fit and diagnose, the shipped jobs on a phone, a
// roundness trace, and as many references as anybody has.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <regex>
#include <string>

#include "report/report.hpp"
#include "support/command_fixture.hpp"
#include "support/open_page.hpp"
#include "support/places.hpp"
#include "support/report_example.hpp"

namespace trueaxis {
namespace {

using example::open_page;
using example::Opinion;
using nlohmann::json;

class ReportCommand : public testing::CommandTest {
 protected:
  std::string page(const std::string& name) { return testing::read_text(folder_ / name); }
};

class ReportOnAPhone : public ReportCommand, public ::testing::WithParamInterface<const char*> {};

json data_of(const std::string& page) {
  const std::string open = "<script id=\"data\" type=\"application/json\">";
  const std::size_t from = page.find(open) + open.size();
  return json::parse(page.substr(from, page.find("</script>", from) - from));
}

/// Screens of 390 × 844 px before anything is unfolded.
double phone_screens(const Opinion& opinion) {
  std::smatch found;
  return std::regex_search(opinion.log, found, std::regex("phone folded: ([0-9.]+) screens"))
             ? std::stod(found[1])
             : NAN;
}

/// @param option "--wide": the page of the diagnosis has its parts, and is looked at on a phone
void expect_sound(const std::string& page, const std::string& name,
                  const std::string& option = "") {
  if (!example::can_open_pages()) return;
  const Opinion opinion = open_page(page, name, option);
  EXPECT_TRUE(opinion.sound) << opinion.log;
}

TEST_P(ReportOnAPhone, HasAtMostTwelveScreensAndNoCode) {
  if (!example::can_open_pages()) GTEST_SKIP() << "chromium or node is not installed";
  const std::string job = GetParam();
  const auto done = command("run '" + places::source() + "/data/jobs/" + job + ".toml' -o out");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const Opinion opinion = open_page(page("out/report.html"), "phone_" + job);
  EXPECT_TRUE(opinion.sound) << opinion.log;
  EXPECT_LE(phone_screens(opinion), 12.0) << opinion.log;
}

INSTANTIATE_TEST_SUITE_P(ShippedJobs, ReportOnAPhone,
                         ::testing::Values("shaft", "bushing", "shaft_three_lobes", "blade"));

TEST_F(ReportCommand, FitAndDiagnoseWriteThePageOfAJob) {
  const std::string stream = "'" + places::source() + "/data/streams/shaft_three_lobes.csv'";
  auto done = command("fit " + stream + " --surface cone --report fit.html");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  done = command("diagnose " + stream + " --surface cone --report diagnosis.html");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const json fit = data_of(page("fit.html")), diagnosis = data_of(page("diagnosis.html"));
  EXPECT_EQ(fit["schema"], diagnosis["schema"]);
  EXPECT_EQ(fit["verdict"]["outcome"], "fitted");
  EXPECT_EQ(diagnosis["verdict"]["outcome"], "effects");
  EXPECT_TRUE(diagnosis["references"][0]["diagnosis"]["simulation"]["by_lathe"]);
  EXPECT_NE(diagnosis["next"].dump().find("To tell the causes apart"), std::string::npos);
  expect_sound(page("fit.html"), "fit_command", "--wide");
  expect_sound(page("diagnosis.html"), "diagnose_command");
  // An earlier page is replaced, and it is the same bytes; nothing but it goes to standard output.
  const std::string before = page("fit.html");
  done = command("fit " + stream + " --surface cone --report fit.html");
  EXPECT_EQ(page("fit.html"), before);
  done = command("fit " + stream + " --surface cone --report -");
  EXPECT_EQ(done.out, before);
}

TEST_F(ReportCommand, WhatIsNotDeterminedHasAPageToo) {
  file("one.csv",
       "# x_convention: radius\nX_M[mm],C[deg],Z[mm]\n20,0,1\n20.1,40,1\n20,80,1\n20,120,1\n"
       "20.1,200,1\n20,240,1\n20,300,1\n20,340,1\n");
  const auto done = command("fit one.csv --surface cone --report page.html");
  EXPECT_EQ(done.exit_code, 4) << done.err;
  EXPECT_EQ(data_of(page("page.html"))["verdict"]["outcome"], "not-determined");
  expect_sound(page("page.html"), "fit_not_determined");
}

// A machine's residuals have no file; its page is tested with its diagnosis.
TEST_F(ReportCommand, OfAMachineThatIsNotReadThereIsNone) {
  EXPECT_EQ(command("machine diagnose ball.csv --machine m.toml --report page.html").exit_code, 3);
  EXPECT_EQ(command("machine diagnose ball.csv --machine m.toml --residuals r.csv").exit_code, 2);
  EXPECT_FALSE(there("page.html"));
}

/// One turn of a relative gauge, as a roundness instrument gives it: 120 µm off-centre, three lobes
/// of 2 µm, 0.05 µm of noise.
std::string roundness_trace() {
  std::mt19937_64 random(20261123);
  std::normal_distribution<double> noise(0.0, 5e-5);
  std::string text =
      "# reading: relative\n# nominal_radius: 12 mm\n# x_convention: radius\n"
      "X_M[mm],C[deg]\n";
  for (int i = 0; i < 3600; ++i) {
    const double c_rad = 0.1 * i * rad_per_deg;
    char row[80];
    std::snprintf(row, sizeof row, "%.7f,%.1f\n",
                  0.3 + 0.12 * std::cos(c_rad - 1.0) -
                      0.12 * 0.12 * std::pow(std::sin(c_rad - 1.0), 2) / 24.0 +
                      2e-3 * std::cos(3.0 * c_rad) + noise(random),
                  0.1 * i);
    text += row;
  }
  return text;
}

TEST_F(ReportCommand, ATraceGetsAPageOfItsRoundness) {
  file("trace.csv", roundness_trace());
  for (const std::string verb : {"fit", "diagnose"}) {
    const auto done = command(verb + " trace.csv --surface section --report " + verb + ".html");
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const std::string text = page(verb + ".html");
    const json roundness = data_of(text)["references"][0]["roundness"];
    // u of an amplitude is 0.05 µm √(2/3600) = 1.2 nm: 5 of them and 0.1 nm of rounding.
    EXPECT_NEAR(roundness["orders"][1]["amplitude_um"], 2.0, 0.0061);
    EXPECT_NEAR(roundness["orders"][0]["amplitude_um"], 0.0,
                0.0061);  // no oval of the eccentricity
    expect_sound(text, "trace_" + verb, verb == "fit" ? "--wide" : "");
  }
}

/// Twelve seats, each with an axis of its own.
TEST_F(ReportCommand, TwelveReferencesAreToldApart) {
  JobResult result = example::cone_job(120);
  for (int i = 1; i < 12; ++i) {
    result.streams.push_back(result.streams.front());
    result.fits.push_back(result.fits.front());
    result.fits.back().axis.axis.x_mm += 2e-3 * i;
    result.fits.back().axis.axis.slope_y += 2e-5 * i;
    result.job.references.push_back(result.job.references.front());
    result.job.references.back().name = "seat " + std::to_string(i + 1);
    result.target_axis->remainders.push_back(result.target_axis->remainders.front());
  }
  expect_sound(render_report(result), "twelve");
}

}  // namespace
}  // namespace trueaxis
