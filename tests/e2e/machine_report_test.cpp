// SPDX-License-Identifier: Apache-2.0
// The page of a machine's job opened in a browser, wide and on a phone.
#include "report/machine_report.hpp"

#include <gtest/gtest.h>

#include "format/file.hpp"
#include "job/machine/files/machine_job_files.hpp"
#include "support/open_page.hpp"
#include "support/places.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using example::open_page;
using example::Opinion;

MachineJob blade_job() {
  const std::string path = places::source() + "/data/jobs/blade.toml";
  return read_machine_job_toml(read_file(path), path);
}

void expect_sound_page(const MachineJobResult& result, const std::string& name) {
  const Opinion opinion = open_page(render_machine_report(result), name);
  EXPECT_TRUE(opinion.sound) << opinion.log;
  for (const char* looked_at : {"wide folded: ", "phone folded: "})
    EXPECT_TRUE(opinion.log.find(looked_at) != std::string::npos) << opinion.log;
}

class MachineReportPage : public testing::Test {
 protected:
  void SetUp() override {
    if (!example::can_open_pages()) GTEST_SKIP() << "chromium or node is not installed";
  }
};

TEST_F(MachineReportPage, TheBlade) {
  const MachineJobResult result = run_machine_job(blade_job());
  // ReportOnAPhone opens it as the command writes it.
  const Opinion opinion = open_page(render_machine_report(result), "machine_blade", "--wide");
  EXPECT_TRUE(opinion.sound) << opinion.log;
  const Json data = machine_report_data(result);
  EXPECT_EQ(data.at("maps").size(), 3U);  // X-Y, X-Z, A-C
  EXPECT_EQ(data.at("tips").at("line").size(), result.tips.size());
}

TEST(MachineReportHeader, IsThatOfTheJob) {
  const std::string path = places::source() + "/data/jobs/blade.toml";
  const MachineJob job = read_machine_job_toml(
      read_file(path) + "\n[header]\nserial = \"0815\"\ndate = 2026-03-14\n", path);
  EXPECT_EQ(job.header, (JobHeader{{"Serial number", "0815"}, {"Date", "2026-03-14"}}));
  MachineJobResult result;
  result.job = job;
  EXPECT_EQ(machine_job_object(result).at("header"),
            Json({{"serial", "0815"}, {"date", "2026-03-14"}}));
  try {
    read_machine_job_toml(read_file(path) + "\n[header]\nmachien = \"5-axis\"\n", path);
    FAIL() << "was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("`machine`"), std::string::npos) << error.what();
  }
}

TEST_F(MachineReportPage, WithoutAProgram) {
  MachineJob job = blade_job();
  job.program.reset();
  job.tolerance_mm.reset();
  expect_sound_page(run_machine_job(std::move(job)), "machine_without_program");
}

TEST_F(MachineReportPage, NoGoOutOfLimits) {
  MachineJob job = blade_job();
  for (MachineAxis& axis : job.machine.axes)
    if (axis.name == AxisName::X) axis.high = 18.0;
  const MachineJobResult result = run_machine_job(std::move(job));
  ASSERT_FALSE(result.compensation->unreachable.empty());
  expect_sound_page(result, "machine_no_go");
}

// Every kind of remark at once: rival causes, what is unexplained and what is not corrected.
TEST_F(MachineReportPage, FindingsWithRivalsAndTheUnexplained) {
  MachineJobResult result = run_machine_job(blade_job());
  MachineFinding found = result.diagnosis.findings.front();
  found.cause.id = "reversal.C";
  found.errors.clear();
  found.separate_with.emplace().plan = "L2";
  found.rivals = {{"EYC.harmonic2", 1.0, 2.0, 0.3}, {"drift.Z", 1.0, 2.0, 0.1}};
  result.diagnosis.findings.push_back(found);
  result.diagnosis.unexplained.push_back(
      {{{0.004, 0.0005, "mm", ""}, 1e-4}, "order 5 of C along X"});
  result.verdict.reservations = {{ReasonCode::finding_not_told,
                                  {},
                                  {},
                                  {{"effect", "reversal.C"}, {"rivals", "EYC.harmonic2"}}}};
  result.verdict.decision = Decision::go_with_reservations;
  expect_sound_page(result, "machine_rivals");
}

TEST_F(MachineReportPage, ALongProgramIsThinned) {
  MachineJobResult result = run_machine_job(blade_job());
  const std::vector<ProgramTip> once = result.tips;
  while (result.tips.size() < 20000)
    result.tips.insert(result.tips.end(), once.begin(), once.end());
  for (std::size_t i = 0; i < result.tips.size(); ++i) result.tips[i].line = i + 1;
  expect_sound_page(result, "machine_long");
  EXPECT_LE(machine_report_data(result).at("tips").at("line").size(), max_drawn_tips);
}

TEST_F(MachineReportPage, HostileNamesStayText) {
  MachineJobResult result = run_machine_job(blade_job());
  const std::string hostile = "</script><script>throw 1</script><img src=x onerror='throw 2'>\xff";
  result.job.name = result.job.machine.name = hostile;
  const Reason remark{ReasonCode::remark, {}, {}, {{"text", hostile}}};
  result.verdict.reasons = result.verdict.next = result.remarks = {remark};
  result.job.header = {{"Part", hostile}};
  result.job.inputs.front().file = hostile;
  result.diagnosis.not_observable.front().why = hostile;
  expect_sound_page(result, "machine_hostile");
}

}  // namespace
}  // namespace trueaxis
