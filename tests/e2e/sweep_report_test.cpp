// SPDX-License-Identifier: Apache-2.0
#include "report/sweep_report.hpp"

#include <gtest/gtest.h>

#include "studies/published/published_page.hpp"
#include "studies/published/published_toml.hpp"
#include "study/bound/quantities.hpp"
#include "support/open_page.hpp"
#include "support/places.hpp"
#include "support/sweep_examples.hpp"

namespace trueaxis {
namespace {

using example::open_page;
using example::Opinion;

std::string page_of(const study::PublishedSweep& file) {
  const study::Sweep& sweep = file.sweep;
  const std::vector<study::BlockResult> results = testing::run_all(sweep, 1);
  const study::Summary summary = study::summarise(sweep, results);
  if (!file.published) return render_sweep_report(sweep, summary);
  const study::Placement placement = study::place_published(sweep, *file.published, results);
  return render_sweep_report(sweep, summary, published_page(sweep, *file.published, placement));
}

study::PublishedSweep shipped(const std::string& name, std::size_t repeats) {
  study::PublishedSweep file =
      read_published_sweep(places::source() + "/data/sweeps/" + name + ".toml");
  file.sweep.repeats = repeats;
  return file;
}

class SweepReport : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!example::can_open_pages()) GTEST_SKIP() << "chromium or node is not installed";
  }

  /// @param option "--wide": a page of the same parts is looked at on a phone
  static void expect_sound(const study::PublishedSweep& file, const std::string& name,
                           const std::string& option = "") {
    const Opinion opinion = open_page(page_of(file), "sweep_" + name, option);
    EXPECT_TRUE(opinion.sound) << opinion.log;
  }
};

TEST_F(SweepReport, Table1) { expect_sound(shipped("table1", 50), "table1"); }

TEST_F(SweepReport, Table2WithALostLevel) {
  expect_sound(shipped("table2", 50), "table2", "--wide");
}

TEST_F(SweepReport, PlaneHasNoAxis) {
  expect_sound(shipped("table1_plane", 50), "plane", "--wide");
}

TEST_F(SweepReport, TwoAxesAndTwoMethods) { expect_sound(shipped("noise", 20), "noise"); }

TEST_F(SweepReport, CasesOfListsAreWords) { expect_sound(shipped("plans", 2), "plans"); }

/// Two curves a noise, of two losses, over eight lengths of a face.
study::PublishedSweep curves(const std::vector<double>& noises_mm) {
  study::Sweep sweep;
  sweep.base = testing::probed_part(virtual_lathe::PartKind::face);
  sweep.repeats = 4;
  sweep.methods = {study::Method::fit, study::Method::huber};
  sweep.axes = {testing::over("pass.length_mm", {20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 90.0}),
                testing::over("noise.sigma_mm", noises_mm)};
  return {sweep, {}};
}

// Fourteen curves of every parameter, in panels of twelve at most, are all drawn and told apart.
TEST_F(SweepReport, MoreThanTwelveCurvesAreAllDrawn) {
  const std::vector<double> noises_mm = {1e-3, 2e-3, 3e-3, 4e-3, 5e-3, 7e-3, 0.01};
  const study::PublishedSweep file = curves(noises_mm);
  const std::size_t quantities = study::quantities(SurfaceKind::plane).size();
  const Opinion opinion = open_page(page_of(file), "sweep_many_curves");
  EXPECT_TRUE(opinion.sound) << opinion.log;
  for (const char* screen : {"wide", "phone"}) {
    const std::string said =
        screen + (": " + std::to_string(2 * noises_mm.size() * quantities)) + " curves of errors";
    EXPECT_NE(opinion.log.find(said), std::string::npos) << opinion.log;
  }
}

// A name that a phone's width does not hold is broken, not cut.
TEST_F(SweepReport, LongNamesWrap) {
  study::PublishedSweep file = curves({1e-3, 2e-3});
  file.sweep.axes[1].name = "the noise of the probe with a name that says a great deal of it";
  expect_sound(file, "long_names");
}

TEST_F(SweepReport, OneCellWithoutAxes) {
  study::Sweep sweep;
  sweep.base = testing::probed_part(virtual_lathe::PartKind::cylinder);
  sweep.repeats = 10;
  expect_sound({sweep, {}}, "one_cell");
}

// Efficiency has a chart where its ratios have intervals: from 100 repeats on.
TEST_F(SweepReport, DrawnNumbersHaveAnEfficiency) {
  study::Sweep sweep;
  sweep.base = testing::probed_part(virtual_lathe::PartKind::face);
  sweep.drawn = {{"noise.sigma_um", "noise.sigma_mm", study::Drawn::Kind::uniform, 0.004, 0.006}};
  const auto charts = [&](std::size_t repeats) {
    sweep.repeats = repeats;
    const Opinion opinion = open_page(page_of({sweep, {}}), "drawn" + std::to_string(repeats),
                                      repeats < 100 ? "--wide" : "");
    EXPECT_TRUE(opinion.sound) << opinion.log;
    const std::size_t at = opinion.log.find("wide: ");
    return at == std::string::npos ? -1 : std::stoi(opinion.log.substr(at + 6));
  };
  EXPECT_EQ(charts(100), charts(99) + 1);
}

TEST_F(SweepReport, WithoutABoundAndWithFailures) {
  study::Sweep sweep;
  sweep.base = testing::probed_part(virtual_lathe::PartKind::cone);
  sweep.repeats = 10;
  sweep.base.probe.relative_zero_mm = 30.0;  // a gauge: no bound
  sweep.base.probe.nominal_radius_mm = 35.0;
  expect_sound({sweep, {}}, "no_bound", "--wide");
  sweep.base = testing::probed_part(virtual_lathe::PartKind::cone);
  sweep.axes = {testing::over("pass.length_mm", {0.1, 30.0})};  // some readings, then enough
  expect_sound({sweep, {}}, "failures");
}

// Of a drawn sweep's 10 repeats no ratio has an interval; of a plan in front of a cone's apex no
// repeat has a stream; without noise there is no bound.
TEST_F(SweepReport, SaysWhichOfBoundRatioAndResultIsMissing) {
  study::Sweep sweep;
  sweep.base = testing::probed_part(virtual_lathe::PartKind::cone);
  sweep.repeats = 10;
  const auto banner = [&](const std::string& name) {
    return open_page(page_of({sweep, {}}), "banner_" + name, "--folded").log;
  };
  sweep.drawn = {{"noise.sigma_um", "noise.sigma_mm", study::Drawn::Kind::uniform, 0.004, 0.006}};
  std::string log = banner("drawn");
  EXPECT_NE(log.find("a ratio has an interval from 100 repeats on"), std::string::npos) << log;
  EXPECT_EQ(log.find("No bound"), std::string::npos) << log;
  sweep.drawn.clear();
  sweep.base.noise = {};
  log = banner("noiseless");
  EXPECT_NE(log.find("There is no bound to compare with: no noise."), std::string::npos) << log;
  sweep.base = testing::probed_part(virtual_lathe::PartKind::cone);
  sweep.base.part.apex_mm = 25.0;
  log = banner("failed");
  EXPECT_NE(log.find("Every repeat failed"), std::string::npos) << log;
  EXPECT_EQ(log.find("No bound"), std::string::npos) << log;
}

// A window of 1400 px has room for the table of a cylinder and one axis; a phone does not.
TEST_F(SweepReport, TheTableTakesTheWidthThatThereIs) {
  study::Sweep sweep;
  sweep.base = testing::probed_part(virtual_lathe::PartKind::cylinder);
  sweep.repeats = 100;
  sweep.axes = {testing::over("noise.sigma_mm", {0.001, 0.002})};
  const std::string log = open_page(page_of({sweep, {}}), "width").log;
  EXPECT_NE(log.find("wide: 0 wide tables scroll"), std::string::npos) << log;
  EXPECT_EQ(log.find("phone: 0 wide tables scroll"), std::string::npos) << log;
}

TEST_F(SweepReport, ManyCells) {
  study::Sweep sweep;
  sweep.base = testing::probed_part(virtual_lathe::PartKind::cylinder);
  sweep.repeats = 3;
  sweep.axes = {testing::over("noise.sigma_mm", {0.001, 0.002, 0.003, 0.004, 0.005, 0.006, 0.007}),
                testing::over("part.x0_mm", {-3, -2, -1, 0, 1, 2, 3, 4})};
  expect_sound({sweep, {}}, "many");
}

TEST_F(SweepReport, HostileNamesStayText) {
  study::PublishedSweep file = shipped("table1", 3);
  const std::string hostile = "</script><script>throw 1</script><img src=x onerror='throw 2'>\xff";
  file.sweep.name = file.sweep.axes[0].name = file.sweep.axes[0].points[0].label = hostile;
  file.published->source = file.published->rows[0].name = hostile;
  file.published->rows[0].values[0].text = file.published->readings[0].name = hostile;
  expect_sound(file, "hostile");
}

}  // namespace
}  // namespace trueaxis
