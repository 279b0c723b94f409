// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "diagnose/files/diagnosis_json.hpp"
#include "job/files/job_words.hpp"
#include "report/chart_readings.hpp"
#include "report/page.hpp"
#include "report/report.hpp"
#include "support/diagnosis_example.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using nlohmann::json;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

TEST(ReportPageText, JsonCannotEndTheScript) {
  const json data{{"name", "</script><!-- & \xff 'µ'"}};
  const std::string text = json_for_script(data);
  EXPECT_EQ(text.find_first_of("<>&"), std::string::npos) << text;
  EXPECT_EQ(json::parse(text)["name"], "</script><!-- & \xef\xbf\xbd 'µ'");
}

TEST(ReportPageText, HtmlIsEscaped) {
  EXPECT_EQ(escape_html("<b a=\"1\" c='2'>&"), "&lt;b a=&quot;1&quot; c=&#39;2&#39;&gt;&amp;");
}

TEST(ReportPageText, PlacesInTextsAreLeftAlone) {
  EXPECT_EQ(fill_template("{{a}}-{{b}}", {{"a", "{{b}}"}, {"b", "x"}}), "{{b}}-x");
  EXPECT_THROW(fill_template("{{c}}", {{"a", ""}}), ContractViolation);
}

TEST(ReportPageText, HostileNamesAddNoElement) {
  JobResult hostile = example::cone_job(100);
  const std::string plain = render_report(hostile);
  hostile.job.name = hostile.job.references.front().name = "</script><img>";
  hostile.verdict.reasons = {{ReasonCode::cut_refused, {}, {}, {{"why", hostile.job.name}}}};
  const std::string page = render_report(hostile);
  for (const char* element : {"</script", "<script", "<img"}) {
    EXPECT_EQ(count(page, element), count(plain, element)) << element;
  }
}

TEST(ReportPageText, LoadsNothingFromElsewhere) {
  const std::string page = render_report(example::cone_job(100));
  EXPECT_EQ(count(page, "<script src"), 0u);
  EXPECT_EQ(count(page, "<link"), count(page, "<link rel=\"icon\" href=\"data:,\">"));
}

/// Three lobes of 6 µm and a wander of 1.2 µm over 2 µm of noise: surface and causes leave the
/// noise, 4/(18 + 0.72 + 4) of the variance; the sample's own share is within 5/√1500 of that.
TEST(ReportData, ShareOfTheVarianceThatIsLeft) {
  const json data = report_data(example::diagnosed_job(1500));
  const json& simulation = data["references"][0]["diagnosis"]["simulation"];
  EXPECT_NEAR(simulation["left_share"], 4.0 / 22.72, 4.0 / 22.72 * 5.0 / std::sqrt(1500.0));
  EXPECT_EQ(simulation["noise_share"].is_number(), true);
}

TEST(ReportData, MapsLeaveMaskedReadingsOut) {
  const json maps =
      report_data(example::diagnosed_job(1500))["references"][0]["diagnosis"]["simulation"]["maps"];
  EXPECT_EQ(maps["before_um"].size(), 1500u);
  const json& rejected = maps["rejected"];
  EXPECT_NE(std::find(rejected.begin(), rejected.end(), 200), rejected.end()) << "row 201";
}

TEST(ReportData, MapsAreOfTheLathesReadings) {
  JobResult result = example::resimulated_job(1500);
  SimulatedReadings& simulated = result.resimulations.front()->readings;
  simulated.before_mm[7] -= 0.25;
  simulated.after_mm[7] += 0.125;
  const json reference = report_data(result)["references"][0];
  const json& simulation = reference["diagnosis"]["simulation"];
  EXPECT_EQ(simulation["by_lathe"], true);
  const json& maps = simulation["maps"];
  const Diagnosis& d = *result.diagnoses.front();
  // Columns are rounded to 1 nm.
  EXPECT_NEAR(maps["before_um"][7], 1000.0 * d.residual_before_mm[7] + 250.0, 1e-3);
  EXPECT_NEAR(maps["after_um"][7], 1000.0 * d.residual_after_mm[7] - 125.0, 1e-3);
  EXPECT_EQ(maps["measured_um"], reference["readings"]["points"]["deviation_um"]);
  EXPECT_EQ(simulation["left_share"], result.resimulations.front()->comparison.after.share);
}

/// The page reads the objects of the files, and names every effect that it shows.
TEST(ReportData, DiagnosisIsThatOfTheFile) {
  const JobResult result = example::diagnosed_job();
  const json shown = report_data(result)["references"][0]["diagnosis"];
  const json file = json::parse(diagnosis_json(*result.diagnoses.front()));
  for (const char* key : {"findings", "unexplained", "gain", "plans", "next_measurement"})
    EXPECT_EQ(shown[key], file[key]) << key;
  EXPECT_EQ(shown["noise"]["masked"], result.diagnoses.front()->noise.masked.size());
  for (const json& finding : shown["findings"])
    EXPECT_FALSE(shown["titles"][finding["effect"]].get<std::string>().empty());
}

TEST(ReportData, SaysWhyTheLatheDidNotSimulate) {
  JobResult result = example::diagnosed_job(300);
  const auto simulation = [&]() -> json {
    return report_data(result)["references"][0]["diagnosis"]["simulation"];
  };
  const json model = simulation();
  EXPECT_EQ(model["by_lathe"], false);
  result.resimulations = {Resimulation{{}, {}, "it has no place"}};
  EXPECT_EQ(simulation()["why_not"], "it has no place");
  EXPECT_EQ(simulation()["maps"], model["maps"]);
  result.diagnoses.front()->residual_after_mm.pop_back();
  EXPECT_TRUE(simulation().is_null());
}

TEST(ReportData, AxisShownIsThatOfTheCorrection) {
  JobResult result = example::diagnosed_job(200);
  result.diagnoses.front()->extended.axis.axis.x_mm += 0.5;
  EXPECT_EQ(&fit_used(result, 0), &result.diagnoses.front()->extended);
  const double x = report_data(result)["target"]["references"][0]["axis"]["start"]["x_mm"];
  EXPECT_NEAR(x, example::true_axis().at(25.0)[0] + 0.5, 1e-12);
  result.diagnoses.front()->extended.status = FitStatus::rank_deficient;
  EXPECT_EQ(&fit_used(result, 0), &result.fits[0]);
  result.diagnoses.front()->extended.status = FitStatus::converged;
  result.diagnoses.front()->verdict = DiagnosisVerdict::ideal;
  // Nothing was found: that axis, with the u of what the passes do not show.
  EXPECT_EQ(&fit_used(result, 0), &result.diagnoses.front()->extended);
  EXPECT_EQ(report_data(result)["references"][0]["extended"], false);
}

TEST(ReportData, SameResultSameBytes) {
  EXPECT_EQ(render_report(example::cone_job(500)), render_report(example::cone_job(500)));
}

TEST(ReportData, DeviationOfAConeIsItsEccentricity) {
  const JobResult result = example::cone_job(1500);
  const json data = report_data(result)["references"][0]["readings"];
  ASSERT_EQ(data["points"]["deviation_um"].size(), 1500u);
  for (std::size_t i = 0; i < 1500; ++i) {
    // Offset along the probe + taper × lean + noise; not counted: across² / 2R = 0.13 µm at most,
    // taper × lean × offset = 0.01 µm.
    const double c = result.streams[0].c_rad[i], z = result.streams[0].position_mm[i];
    const Revolved cone = example::true_cone();
    const auto [x, y] = cone.axis.at(z);
    const double lean = cone.axis.slope_x * std::cos(c) + cone.axis.slope_y * std::sin(c);
    const double radius = cone.radius_mm + cone.tan_half_angle * z;
    const double expected_mm = x * std::cos(c) + y * std::sin(c) +
                               cone.tan_half_angle * radius * lean + result.fits[0].residual_mm[i];
    const double shown_um = data["points"]["deviation_um"][i];
    // The constant is the mean of predicted minus intersect: within the 0.13 µm, too.
    ASSERT_NEAR(shown_um, 1000.0 * expected_mm, 0.3) << "reading " << i;
  }
}

TEST(ReportData, SectionsHoldOneTurnAndItsCurve) {
  const json sections =
      report_data(example::cone_job(1500))["references"][0]["readings"]["sections"];
  ASSERT_EQ(sections.size(), 3u);
  for (const json& section : sections) {
    // 1500 readings in 50.3 turns.
    EXPECT_NEAR(section["measured"]["um"].size(), 1500 / 50.3, 1.0);
    EXPECT_EQ(section["model"]["um"].size(), 121u);
    for (std::size_t i = 0; i < section["measured"]["um"].size(); ++i) {
      const double c_deg = section["measured"]["c_deg"][i], shown = section["measured"]["um"][i];
      const double curve = section["model"]["um"][static_cast<std::size_t>(c_deg / 3.0)];
      // 5 σ of noise, and the curve's slope: 130 µm × 3° = 6.8 µm.
      EXPECT_NEAR(shown, curve, 10.0 + 6.8);
    }
  }
}

TEST(ReportData, LongStreamsAreThinned) {
  const std::size_t readings = max_points + 1;
  const JobResult result = example::cone_job(readings);
  const json data = report_data(result)["references"][0]["readings"];
  EXPECT_TRUE(data["thinned"]);
  EXPECT_FALSE(data.contains("points"));
  EXPECT_LE(data["cells"]["residual_um"].size(), 20000u);
  std::size_t blank = 0;
  for (const json& cell : data["cells"]["residual_um"]) blank += std::isnan(cell.get<double>());
  EXPECT_LT(blank, 120u) << "at most the end of the last turn is blank";
  double least = 0.0, greatest = 0.0;
  std::size_t rejected = 0;
  for (std::size_t i = 0; i < readings; ++i) {
    if (rejected < result.fits[0].rejected.size() &&
        result.fits[0].rejected[rejected].row == i + 1) {
      ++rejected;
      continue;
    }
    least = std::min(least, 1000.0 * result.fits[0].residual_mm[i]);
    greatest = std::max(greatest, 1000.0 * result.fits[0].residual_mm[i]);
  }
  EXPECT_GT(rejected, 0u);
  for (const char* against : {"c", "position", "time"}) {
    const json& band = data["envelopes"][against];
    // Numbers are written to 1 nm.
    const auto low = band["min"].get<std::vector<double>>(),
               high = band["max"].get<std::vector<double>>();
    EXPECT_NEAR(*std::min_element(low.begin(), low.end()), least, 0.0006);
    EXPECT_NEAR(*std::max_element(high.begin(), high.end()), greatest, 0.0006);
  }
}

TEST(ReportData, RejectedReadingsAreListedUpToTheLimit) {
  FitResult fit;
  for (std::size_t row = 1; row <= max_rejected_listed + 7; ++row)
    fit.rejected.push_back({row, "off"});
  const json rejected = fit_data(fit)["rejected"];
  EXPECT_EQ(rejected["count"], max_rejected_listed + 7);
  EXPECT_EQ(rejected["listed"].size(), max_rejected_listed);
}

TEST(ReportData, WhatIsNotDeterminedIsNullAndSaysWhy) {
  const json data = json::parse(json_for_script(report_data(example::rank_deficient_job())));
  const json& reference = data["references"][0];
  EXPECT_EQ(reference["status"], "rank_deficient");
  EXPECT_TRUE(reference["parameters"]["k"]["value"].is_null());
  EXPECT_EQ(reference["parameters"]["k"]["why"], "one height only: every taper fits");
  EXPECT_FALSE(reference["readings"]["has_model"]);
  EXPECT_TRUE(reference["readings"]["histogram"].is_null());
  EXPECT_FALSE(data.contains("correction"));
  EXPECT_FALSE(data["target"].contains("axis"));
  EXPECT_EQ(data["verdict"]["outcome"], "no-go");
}

TEST(ReportData, WithoutToleranceThereIsNoGo) {
  JobResult result = example::cone_job(100);
  EXPECT_EQ(report_data(result)["verdict"]["outcome"], "go");
  result.job.coaxiality_tolerance_mm.reset();
  EXPECT_EQ(report_data(result)["verdict"]["outcome"], "done");
  result.job.coaxiality_tolerance_mm = 0.005;
  result.target_axis.reset();  // a tolerance, and nothing cut that could meet it
  EXPECT_EQ(report_data(result)["verdict"]["outcome"], "done");
}

TEST(ReportData, ARefusalIsNoGoWithoutToleranceToo) {
  JobResult result = example::cone_job(100);
  result.job.coaxiality_tolerance_mm.reset();
  result.verdict.decision = Decision::no_go;
  EXPECT_EQ(report_data(result)["verdict"]["outcome"], "no-go");
  result.target_axis.reset();
  EXPECT_EQ(report_data(result)["verdict"]["outcome"], "no-go");
}

TEST(ReportData, FaceAndGaugeShowTheirTilt) {
  const JobResult result = example::shaft_and_face_job();
  const json data = report_data(result);
  const json& gauge = data["references"][0]["readings"]["points"];
  double mean = 0.0;
  for (const double deviation : gauge["deviation_um"]) mean += deviation / 900.0;
  // The constant 49.7 mm of the gauge is gone. What stays is below e/(turns) × 60 µm of an
  // incomplete last turn and 5 σ/√900 of noise.
  EXPECT_NEAR(mean, 0.0, 2.0);
  const json& face = data["references"][1]["readings"];
  EXPECT_TRUE(face["face"]);
  double most = 0.0;
  for (const double deviation : face["points"]["deviation_um"])
    most = std::max(most, std::abs(deviation));
  // Tilt × 45 mm = 20.1 µm, noise up to 5 σ.
  EXPECT_NEAR(most, 45.0 * std::hypot(0.4, 0.2), 10.0);
  // Axial run-out: 2 × 45 mm × 0.447 mrad.
  EXPECT_NEAR(data["target"]["references"][1]["before"]["coaxiality_mm"],
              0.09 * std::hypot(0.4, 0.2), 1e-9);
}

TEST(ReportData, CorrectionShowsWholeRevolutions) {
  JobResult result = example::cone_job(100);
  CorrectionRows& rows = result.correction->rows;
  for (std::vector<double>* column :
       {&rows.position_mm, &rows.c_rad, &rows.wanted_mm, &rows.command_mm}) {
    column->push_back(column->back());
  }
  rows.revolution.push_back(150);  // one row of the next revolution: no turn to show
  const json correction = report_data(result)["correction"];
  ASSERT_EQ(correction["turns"].size(), 3u);
  EXPECT_EQ(correction["turns"][0]["revolution"], 0);
  EXPECT_EQ(correction["turns"][2]["revolution"], 149);
  EXPECT_EQ(correction["turns"][1]["wanted_um"].size(), 360u);
  EXPECT_LE(correction["map"]["wanted_um"].size(), 20000u);
}

TEST(ReportData, EmptyPartsStayQuiet) {
  JobResult result = example::cone_job(100);
  result.correction->rows = {};
  result.streams.front() = {};
  const json data = report_data(result);
  EXPECT_EQ(data["correction"]["turns"], json::array());
  EXPECT_FALSE(data["correction"].contains("map"));
  const json& readings = data["references"].at(0)["readings"];
  EXPECT_EQ(readings["count"], 0);
  EXPECT_TRUE(readings["histogram"].is_null());
  EXPECT_EQ(readings["sections"], json::array());
  const json nothing = report_data(JobResult{});
  EXPECT_EQ(nothing["references"], json::array());
  EXPECT_FALSE(nothing.contains("correction"));
  for (const JobResult& one : {result, JobResult{}}) {
    const std::string page = render_report(one);
    EXPECT_NE(page.find(escape_html(verdict_line(one))), std::string::npos);
    EXPECT_EQ(count(page, "<html"), 1u);
    EXPECT_EQ(count(page, "</html>"), 1u);
    EXPECT_EQ(count(page, ">nan"), 0u);
  }
}

TEST(Thinning, CellsAreMeansAndBlanks) {
  CellMeans cells({0.0, 2.0, 2}, {0.0, 1.0, 1});
  cells.add(0.5, 0.5, 1.0);
  cells.add(0.1, 1.0, 3.0);  // the upper end belongs to the last cell
  const json means = cells.to_json(3);
  EXPECT_EQ(means[0], 2.0);
  EXPECT_TRUE(std::isnan(means[1].get<double>()));
}

TEST(Thinning, HistogramCountsEveryValueOnce) {
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(std::sin(i));
  const json bins = histogram(values, 3);
  std::size_t total = 0;
  for (const std::size_t in_bin : bins["count"]) total += in_bin;
  EXPECT_EQ(total, 1000u);
  EXPECT_TRUE(histogram({1.0, 1.0}, 3).is_null());
}

}  // namespace
}  // namespace trueaxis
