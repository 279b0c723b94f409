// SPDX-License-Identifier: Apache-2.0
#include "report/report.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "support/diagnosis_example.hpp"
#include "support/open_page.hpp"
#include "support/places.hpp"

namespace trueaxis {
namespace {

using example::can_open_pages;
using example::open_page;
using example::Opinion;

void expect_sound(const JobResult& result, const std::string& name, const std::string& file = "") {
  const Opinion opinion = open_page(render_report(result, file), name);
  EXPECT_TRUE(opinion.sound) << opinion.log;
  for (const char* looked_at : {"wide folded: ", "phone folded: "})
    EXPECT_TRUE(opinion.log.find(looked_at) != std::string::npos) << opinion.log;
}

/// A page that has the parts of another one, which is looked at on a phone: it gets dark while it
/// is open.
void expect_sound_wide(const JobResult& result, const std::string& name) {
  const Opinion opinion = open_page(render_report(result, ""), name, "--wide");
  EXPECT_TRUE(opinion.sound) << opinion.log;
  EXPECT_TRUE(opinion.log.find("print: ") != std::string::npos) << opinion.log;
}

class ReportPage : public testing::Test {
 protected:
  void SetUp() override {
    if (!can_open_pages()) GTEST_SKIP() << "chromium or node is not installed";
  }
};

TEST_F(ReportPage, ConeWithCorrection) { expect_sound(example::cone_job(), "cone"); }

TEST_F(ReportPage, LongStreamIsThinned) { expect_sound_wide(example::cone_job(60000), "long"); }

TEST_F(ReportPage, DiagnosisWithFindings) {
  expect_sound_wide(example::diagnosed_job(), "diagnosis");
}

TEST_F(ReportPage, SimulatedByTheLathe) {
  expect_sound(example::resimulated_job(), "simulated");
  expect_sound_wide(example::resimulated_job(60000), "simulated_long");
}

TEST_F(ReportPage, DiagnosisThatFoundNothing) {
  JobResult result = example::cone_job(300);
  Diagnosis nothing;
  nothing.baseline = nothing.extended = result.fits.front();
  result.diagnoses = {nothing};
  expect_sound_wide(result, "diagnosis_without_readings");
  nothing.residual_before_mm = nothing.residual_after_mm = result.fits.front().residual_mm;
  nothing.noise.sigma_mm = example::noise_mm;
  result.diagnoses = {nothing};
  expect_sound(result, "diagnosis_ideal");
}

TEST_F(ReportPage, DiagnosisOfOneSectionAndAFaceWithout) {
  JobResult section = example::section_job();
  section.diagnoses = {example::diagnosed(section.streams.front(), section.fits.front())};
  expect_sound(section, "diagnosis_section");
  JobResult faced = example::shaft_and_face_job();
  faced.diagnoses = {example::diagnosed(faced.streams.front(), faced.fits.front()), std::nullopt};
  expect_sound_wide(faced, "diagnosis_face");
  faced.diagnoses[1] = example::diagnosed(faced.streams.back(), faced.fits.back());
  expect_sound(faced, "diagnosis_of_face");
}

TEST_F(ReportPage, HostileNamesOfADiagnosisStayText) {
  JobResult result = example::diagnosed_job(200);
  Diagnosis& d = *result.diagnoses.front();
  const std::string hostile = "</script><script>throw 1</script><img src=x onerror='throw 2'>\xff";
  d.findings.front().alias = d.noise.note = d.next.what = hostile;
  d.not_observable.front().why = d.checks.front().text = hostile;
  result.resimulations = {Resimulation{{}, {}, hostile}};
  expect_sound(result, "diagnosis_hostile");
}

TEST_F(ReportPage, RankDeficientWithoutTarget) {
  expect_sound(example::rank_deficient_job(), "rank_deficient");
}

TEST_F(ReportPage, GaugeAndFaceWithAnActuatorThatCannotFollow) {
  expect_sound(example::shaft_and_face_job(), "shaft_and_face");
}

TEST_F(ReportPage, OneSectionWithoutZ) { expect_sound(example::section_job(), "section"); }

TEST_F(ReportPage, HostileNamesStayText) {
  JobResult result = example::cone_job(100);
  const std::string hostile = "</script><script>throw 1</script><img src=x onerror='throw 2'>";
  result.job.name = hostile;
  result.verdict.reasons = {{ReasonCode::cut_refused, {}, {}, {{"why", hostile}}}};
  result.job.references.front().name = hostile + "\xff";
  result.fits.front().rejected = {{3, hostile}};
  result.fits.front().notes = {hostile};
  result.verdict.reservations = result.verdict.reasons;
  result.job.header = {{"Part", hostile}, {hostile, "7"}};
  expect_sound(result, "hostile", hostile);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

TEST_F(ReportPage, TheScriptFindsWhatIsWrong) {
  const std::string page =
      replaced(render_report(example::cone_job(100)), "</main>",
               "</main><script>console.error('broken')</script><img src='file:///nowhere.png'>"
               "<div style='width:2000px'>wide</div>");
  const Opinion opinion = open_page(page, "broken", "--wide");
  EXPECT_FALSE(opinion.sound);
  for (const char* finding : {"console error: broken", "request: file:///nowhere.png", "px wide"}) {
    EXPECT_NE(opinion.log.find(finding), std::string::npos) << finding << "\n" << opinion.log;
  }
}

TEST_F(ReportPage, TheScriptFindsAnEmptyChart) {
  // The page itself works; one chart's curve has lost its points.
  const std::string page = replaced(render_report(example::cone_job(100)), "\"turns\":[",
                                    "\"turns\":[{\"c_deg\":[],\"wanted_um\":[],\"command_um\":[],"
                                    "\"revolution\":0,\"position_mm\":0}],\"was\":[");
  const Opinion opinion = open_page(page, "empty_chart", "--wide");
  EXPECT_NE(opinion.log.find("has no data"), std::string::npos) << opinion.log;
  EXPECT_EQ(opinion.log.find("page error"), std::string::npos) << opinion.log;
  EXPECT_FALSE(opinion.sound);
}

TEST_F(ReportPage, TheScriptFindsACodeThatNobodyExplains) {
  const std::string page =
      replaced(render_report(example::diagnosed_job(200)), "To tell apart: ", "To tell apart RC: ");
  const Opinion opinion = open_page(page, "code", "--wide");
  EXPECT_NE(opinion.log.find("the page shows the code \"RC\""), std::string::npos) << opinion.log;
  EXPECT_FALSE(opinion.sound);
}

TEST_F(ReportPage, TheScriptFindsWhatCannotBeReadInTheDark) {
  const std::string page =
      replaced(render_report(example::cone_job(100)), "ink: '#e3e8ed'", "ink: '#2a3440'");
  const Opinion opinion = open_page(page, "too_dark", "--wide");
  EXPECT_NE(opinion.log.find("hard to read on"), std::string::npos) << opinion.log;
  EXPECT_FALSE(opinion.sound);
}

TEST_F(ReportPage, TheScriptFindsTextThatIsCut) {
  const std::string page = replaced(render_report(example::cone_job(100)),
                                    "padding: [0, 0, 0, -24]", "padding: [0, 0, 0, -60]");
  const Opinion opinion = open_page(page, "text_cut", "--wide");
  EXPECT_NE(opinion.log.find("text is cut at the edge"), std::string::npos) << opinion.log;
  EXPECT_FALSE(opinion.sound);
}

}  // namespace
}  // namespace trueaxis
