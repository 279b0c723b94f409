// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/report/report.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "support/report_example.hpp"

namespace trueaxis {
namespace {

namespace fs = std::filesystem;

bool can_open_pages() {
  const bool chromium = std::getenv("TRUEAXIS_CHROMIUM") || fs::exists("/usr/bin/chromium");
  return chromium && std::system("node --version >/dev/null 2>&1") == 0;
}

std::string read(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// Writes the report, opens it with report_page.mjs and expects that it finds nothing wrong.
void expect_sound(const JobResult& result, const std::string& name) {
  const fs::path folder = fs::path(TRUEAXIS_SCRATCH) / "report" / name;
  fs::create_directories(folder);
  const fs::path page = folder / "report.html", log = folder / "log.txt";
  std::ofstream(page, std::ios::binary) << render_report(result);
  const std::string command = "node '" TRUEAXIS_SOURCE "/tests/e2e/report_page.mjs' '" +
                              page.string() + "' '" + folder.string() + "' >'" + log.string() +
                              "' 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << read(log);
  for (const char* screen : {"wide.png", "phone.png"}) {
    EXPECT_GT(fs::file_size(folder / screen), 10000u) << "a screenshot of a page is not that small";
  }
}

class ReportPage : public testing::Test {
 protected:
  void SetUp() override {
    if (!can_open_pages()) GTEST_SKIP() << "chromium or node is not installed";
  }
};

TEST_F(ReportPage, ConeWithCorrection) { expect_sound(example::cone_job(), "cone"); }

TEST_F(ReportPage, LongStreamIsThinned) { expect_sound(example::cone_job(60000), "long"); }

TEST_F(ReportPage, RankDeficientWithoutTarget) {
  expect_sound(example::rank_deficient_job(), "rank_deficient");
}

TEST_F(ReportPage, GaugeAndFaceWithAnActuatorThatCannotFollow) {
  expect_sound(example::shaft_and_face_job(), "shaft_and_face");
}

TEST_F(ReportPage, OneSectionWithoutZ) {
  JobResult result = example::cone_job(180);
  result.streams.front().position_mm.clear();
  expect_sound(result, "section");
}

TEST_F(ReportPage, HostileNamesStayText) {
  JobResult result = example::cone_job(100);
  const std::string hostile = "</script><script>throw 1</script><img src=x onerror='throw 2'>";
  result.job.name = result.job.path = result.verdict.line = hostile;
  result.job.references.front().name = hostile + "\xff";
  result.fits.front().rejected = {{3, hostile}};
  expect_sound(result, "hostile");
}

}  // namespace
}  // namespace trueaxis
