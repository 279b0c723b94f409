// SPDX-License-Identifier: Apache-2.0
// What the page says beside its charts: header, what is to be minded, next step, seats, ellipses of
// U, roundness of a section.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "job/files/job_results.hpp"
#include "job/files/job_toml.hpp"
#include "job/files/job_words.hpp"
#include "report/page_data.hpp"
#include "report/report.hpp"
#include "support/diagnosis_example.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using nlohmann::json;

constexpr const char* reference = "[[reference]]\nstream = \"a.csv\"\nsurface = \"cone\"\n";

TEST(ReportHeader, IsWhatTheJobSaysInTheOrderOfThePage) {
  const Job job = read_job_toml(std::string("[header]\ndate = \"2026-11-23\"\npart = \"<shaft>\"\n"
                                            "operator = \"\"\n") +
                                    reference,
                                "job.toml")
                      .job;
  const JobHeader expected{{"Part", "<shaft>"}, {"Date", "2026-11-23"}};
  EXPECT_EQ(job.header, expected);
  JobResult result = example::cone_job(100);
  EXPECT_TRUE(report_data(result)["header"].empty()) << "what is absent is left out";
  result.job.header = job.header;
  EXPECT_EQ(json(report_data(result)["header"]).dump(),
            R"([["Part","<shaft>"],["Date","2026-11-23"]])");
  EXPECT_EQ(render_report(result).find("<shaft>"), std::string::npos) << "it is escaped";
}

// A date of TOML needs no quotes, alone, with a time, and with an offset; result.json has it.
TEST(ReportHeader, ADateNeedsNoQuotes) {
  for (const auto& [written, read] : {std::pair{"2026-03-14", "2026-03-14"},
                                      {"2026-03-14T07:30:00", "2026-03-14T07:30:00"},
                                      {"2026-03-14 07:30:00", "2026-03-14T07:30:00"},
                                      {"2026-03-14T07:30:00Z", "2026-03-14T07:30:00Z"},
                                      {"\"14.3.2026\"", "14.3.2026"}}) {
    const Job job = read_job_toml(std::string("[header]\nserial = \"7\"\ndate = ").append(written) +
                                      "\n" + reference,
                                  "job.toml")
                        .job;
    EXPECT_EQ(job.header, (JobHeader{{"Serial number", "7"}, {"Date", read}}));
    JobResult result = example::cone_job(100);
    result.job.header = job.header;
    const json expected{{"serial", "7"}, {"date", read}};
    EXPECT_EQ(json::parse(job_files(result).front().text).at("header"), expected);
  }
  EXPECT_FALSE(json::parse(job_files(example::cone_job(100)).front().text).contains("header"));
}

TEST(ReportHeader, AWrongKeyIsNamedWithTheRightOne) {
  try {
    read_job_toml(std::string("[header]\nserail = \"7\"\ndate = 7\n") + reference, "job.toml");
    FAIL() << "was read";
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("job.toml:2:"), std::string::npos) << what;
    EXPECT_NE(what.find("`serial`"), std::string::npos) << what;
    EXPECT_NE(what.find("a text in quotes"), std::string::npos) << what;
  }
}

bool holds(const json& list, const std::string& text) {
  return list.dump().find(text) != std::string::npos;
}

TEST(ReportWarnings, ReservationsComeFirstAndAreOffTheLine) {
  JobResult result = example::cone_job(100);
  result.verdict.decision = Decision::go_with_reservations;
  result.verdict.reasons = {{ReasonCode::no_target}};
  result.verdict.reservations = {{ReasonCode::undiagnosed_correlated, {0}},
                                 {ReasonCode::gauge_shows_no_radius, {0}}};
  const std::vector<std::string> said = sentences_of(result.verdict.reservations, result);
  const json data = report_data(result);
  EXPECT_EQ(data["verdict"]["line"], "GO with reservations: axis identified; no target to correct");
  EXPECT_EQ(verdict_line(result), "GO with reservations: axis identified; no target to correct; " +
                                      said[0] + "; " + said[1]);
  ASSERT_GE(data["warnings"].size(), 2u);
  EXPECT_EQ(data["warnings"][0]["text"], said[0]);
  EXPECT_EQ(data["warnings"][1]["text"], said[1]);
}

TEST(ReportWarnings, TheSameOfTwoReferencesIsSaidOnce) {
  JobResult result = example::shaft_and_face_job();
  for (FitResult& fit : result.fits) fit.input_notes = {"X_M was taken as a radius"};
  json found;
  for (const json& one : json(warnings_data(result)))
    if (one["text"] == "X_M was taken as a radius") found.push_back(one);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0]["of"], json({"bearing seat", "shoulder face"}));
}

TEST(ReportNext, SaysWhatToDo) {
  EXPECT_TRUE(holds(next_data(example::cone_job(100)), "Run table.csv at"));
  EXPECT_TRUE(holds(next_data(example::shaft_and_face_job()), "Lower the speed to 410 rpm"));
  EXPECT_TRUE(holds(next_data(example::rank_deficient_job()), "Mend what the verdict names"));
  JobResult unproven = example::cone_job(100);
  unproven.verdict.decision = Decision::not_proven;
  const Reason more{ReasonCode::more_readings, {}, {{"needed", 4000.0}, {"now", 1500.0}}};
  Reason reason{ReasonCode::tolerance_not_proven};
  reason.remedies = {{ReasonCode::more_would_prove, {}, {}, {}, {more}}};
  unproven.verdict.reasons = {reason};
  const json steps = next_data(unproven);
  EXPECT_EQ(steps[0], "about 4000 readings instead of 1500 would prove it");
  EXPECT_FALSE(holds(steps, "Run table.csv"));
}

/// Axes σ_x = 1 µm, σ_y = 2 µm at z_ref and slopes of 0.1 µm/mm, turned by 30°: at 20 mm from z_ref
/// √(1 + 4) µm and √(4 + 4) µm along the turned axes.
TEST(ReportAxes, TheEllipseIsThatOfTheCovarianceThere) {
  const double turn = 30.0 * rad_per_deg, c = std::cos(turn), s = std::sin(turn);
  const auto turned = [&](double xx, double yy, AxisEstimate& axis, std::size_t at) {
    axis.covariance.by_rows[at] = xx * c * c + yy * s * s;
    axis.covariance.by_rows[at + 1] = axis.covariance.by_rows[at + 4] = (xx - yy) * c * s;
    axis.covariance.by_rows[at + 5] = xx * s * s + yy * c * c;
  };
  AxisEstimate axis;
  axis.axis.z_ref_mm = 7.0;
  turned(1e-6, 4e-6, axis, 0);
  turned(1e-8, 1e-8, axis, 10);
  const json ellipse = ellipse_data(axis, 27.0);
  EXPECT_NEAR(ellipse["u_long_mm"], std::sqrt(8e-6), 1e-12);
  EXPECT_NEAR(ellipse["u_short_mm"], std::sqrt(5e-6), 1e-12);
  EXPECT_NEAR(ellipse["towards_deg"], 30.0 - 90.0, 1e-9);
  EXPECT_NEAR(ellipse["u_long_mm"].get<double>(), axis.u_at(27.0), 1e-12);
}

TEST(ReportAxes, SeatsStandWhereTheyWereProbed) {
  const JobResult result = example::shaft_and_face_job();
  const json data = seats_data(result);
  ASSERT_EQ(data["seats"].size(), 2u);
  EXPECT_EQ(data["seats"][0]["radius_mm"], json({50.0, 50.0}));
  EXPECT_NEAR(data["seats"][0]["z_mm"][1], result.fits[0].position_max_mm, 5e-4);
  EXPECT_EQ(data["seats"][1]["radius_mm"], json({20.0, 45.0}));  // of a face: X
  EXPECT_NEAR(data["seats"][1]["z_mm"][0], 12.0, 0.01);          // its tilt is 20 µm at 45 mm
  EXPECT_EQ(data["cut"]["z_mm"], json({25.0, 10.0}));
  EXPECT_TRUE(seats_data(example::section_job())["seats"].empty());
}

/// One turn of 3600 readings: 5 undulations of 3 µm at 40°, 0.1 µm of noise.
JobResult trace_of_five_lobes(std::size_t readings, double arc_deg = 360.0) {
  JobResult result = example::section_job();
  ProbeStream& stream = result.streams.front();
  FitResult& fit = result.fits.front();
  fit.rejected.clear();
  stream.c_rad.clear();
  stream.time_s.clear();
  stream.reading_mm.clear();
  fit.residual_mm.clear();
  std::mt19937_64 random(example::seed);
  std::normal_distribution<double> noise(0.0, 1e-4);
  for (std::size_t i = 0; i < readings; ++i) {
    const double c_rad =
        static_cast<double>(i) / static_cast<double>(readings) * arc_deg * rad_per_deg;
    const double off = 3e-3 * std::cos(5.0 * c_rad - 40.0 * rad_per_deg) + noise(random);
    stream.c_rad.push_back(c_rad);
    fit.residual_mm.push_back(off);
    stream.reading_mm.push_back(example::contact_mm(fit.shape, c_rad, 0.0) + off);
  }
  fit.points = readings;
  return result;
}

TEST(ReportRoundness, FindsTheUndulationsOfATrace) {
  for (const std::size_t readings : {720u, 3600u, 9000u}) {  // the last is thinned
    const JobResult result = trace_of_five_lobes(readings);
    const json r = roundness_data(result.streams.front(), result.fits.front());
    EXPECT_EQ(r["readings"], readings);
    EXPECT_EQ(r["averaged"], readings == 9000);
    EXPECT_EQ(r["order_max"], 50);
    EXPECT_EQ(r["orders"].size(), 49u);
    // u of an amplitude is σ √(2/N) in white noise; 5 of them, and 0.1 nm of rounding.
    const double five_u = 5.0 * 0.1 * std::sqrt(2.0 / static_cast<double>(readings)) + 1e-4;
    for (const json& one : r["orders"]) {
      const bool fifth = one["order"] == 5;
      EXPECT_NEAR(one["amplitude_um"], fifth ? 3.0 : 0.0, five_u) << one;
      if (fifth) {
        EXPECT_NEAR(one["phase_deg"], 40.0, five_u / 3.0 / rad_per_deg + 0.05);
      }
    }
    // Peak to valley of the wave is 6 µm, of the noise up to 5 σ on either side.
    EXPECT_NEAR(r["peak_um"].get<double>() + r["valley_um"].get<double>(), 6.5, 0.5);
    EXPECT_NEAR(r["rms_um"], 3.0 / std::sqrt(2.0), 0.02);
    EXPECT_NEAR(r["of_orders_um"], 6.0, 2.0 * 49.0 * five_u / 5.0);
  }
}

TEST(ReportRoundness, AnArcTellsFewerUndulationsOrNone) {
  // A gap of 20° leaves those of which half an undulation is two gaps: 90/20 = 4.
  const JobResult gap = trace_of_five_lobes(3400, 340.0);
  EXPECT_EQ(roundness_data(gap.streams.front(), gap.fits.front())["order_max"], 4);
  const JobResult arc = trace_of_five_lobes(1000, 100.0);
  EXPECT_TRUE(roundness_data(arc.streams.front(), arc.fits.front())["orders"].empty());
  JobResult failed = trace_of_five_lobes(100);
  failed.fits.front().status = FitStatus::rank_deficient;
  EXPECT_TRUE(roundness_data(failed.streams.front(), failed.fits.front()).is_null());
}

// Each case of a surface has stations of its own where its form is largest.
TEST(ReportPartForm, SectionsOfTheCasesStandSideBySideByPlace) {
  const auto of_sections = [](const std::vector<std::pair<double, double>>& all) {
    FormResult out;
    for (const auto& [z_mm, round_mm] : all) {
      SectionForm section;
      section.z_mm = z_mm;
      section.values.push_back(
          {.name = "RONt", .reference = "MZCI", .estimate = {round_mm, 1e-5, "mm", ""}});
      section.circles.resize(1);
      out.sections.push_back(section);
    }
    return out;
  };
  PartForm form;
  form.probed = of_sections({{0.0, 1e-3}, {10.0, 2e-3}});
  form.less_motion = of_sections({{0.0, 4e-3}, {4.0, 5e-3}, {10.0, 6e-3}});
  const json data = part_form_data(form);
  EXPECT_EQ(data["section_count"], 3);
  ASSERT_EQ(data["sections"].size(), 3U);
  const double z_mm[] = {0.0, 4.0, 10.0}, probed_mm[] = {1e-3, 1e-3, 2e-3};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(data["sections"][i]["z_mm"], z_mm[i]);
    EXPECT_EQ(data["sections"][i]["cases"][0]["mm"], probed_mm[i]);
    EXPECT_EQ(data["sections"][i]["cases"][1]["mm"], 4e-3 + 1e-3 * static_cast<double>(i));
  }
}

TEST(StreamReport, IsThePageOfAJobAndTheSameBytesEachTime) {
  const JobResult job = example::cone_job(200);
  const std::string page = render_fit_report(job.streams.front(), job.fits.front(), {});
  EXPECT_EQ(page, render_fit_report(job.streams.front(), job.fits.front(), {}));
  EXPECT_NE(page.find("content=\"trueaxis.report/"), std::string::npos);
  EXPECT_NE(page.find("trueaxis diagnose cone.csv --surface cone"), std::string::npos);
}

}  // namespace
}  // namespace trueaxis
