// SPDX-License-Identifier: Apache-2.0
// The servo component in LinuxCNC's own HAL: halcompile builds it, halrun runs it with the table of
// a job, halstreamer plays spindle, slide and probe, and halsampler reads what the servo is sent.
#include <unistd.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "support/command_fixture.hpp"
#include "support/places.hpp"
#include "trueaxis/control_table.hpp"

namespace trueaxis::testing {
namespace {

const std::string module = "/usr/lib/linuxcnc/modules/trueaxis_fts.so";
constexpr int checking = 300, enabled = 1500, after = 600;  // periods of a millisecond
constexpr double rad = std::numbers::pi / 180.0;

class LinuxCncServo : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    if (shell("command -v halrun && command -v halcompile").exit_code != 0)
      GTEST_SKIP()
          << "halrun or halcompile (linuxcnc-uspace, linuxcnc-uspace-dev) is not installed";
    if (access("/usr/lib/linuxcnc/modules", W_OK) != 0)
      GTEST_SKIP() << "halrun loads installed modules alone, and this user cannot install one";
    had_module_ = std::filesystem::exists(module);
    const auto made =
        shell("halcompile --install " + places::source() + "/linuxcnc/trueaxis_fts.comp");
    ASSERT_EQ(made.exit_code, 0) << made.output;
    write_table();
  }
  void TearDown() override {
    if (!had_module_) std::filesystem::remove(module);
  }

  void write_table() {
    file("part.toml",
         "seed = 3\n[part]\nkind = \"cylinder\"\nradius_mm = 30\nx0_mm = 0.09\ny0_mm = -0.03\n"
         "l = 5e-4\nm = -4e-4\n[noise]\nsigma_um = 0.3\n[[pass]]\nz_start_mm = 0\nz_end_mm = 40\n"
         "feed_mm_per_rev = 1\nreadings_per_revolution = 36.7\n");
    ASSERT_EQ(command("simulate part.toml -o part.csv").exit_code, 0);
    file("job.toml",
         "[[reference]]\nstream = \"part.csv\"\nsurface = \"cylinder\"\n[target]\n"
         "surface = \"cylinder\"\nradius_mm = 28\nz_start_mm = 60\nz_end_mm = 42\n"
         "coaxiality_tolerance_um = 10\n[cut]\nspeed_rpm = 600\nsense = \"+c\"\n"
         "feed_mm_per_rev = 0.5\ninterpolation = \"linear\"\n");
    const CommandStreams done = command("run job.toml -o out");
    ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  }

  /// What is played in another way than the table was made for.
  struct Played {
    double c_off_deg = 0.0;
    int sense = 1;
    double probe_sign = 1.0;
    std::string setting{};  ///< of the component, in HAL
  };
  /// Lines of halsampler: C, Z, position, fault code, active, checked.
  std::vector<std::array<double, 6>> run(const Played& played, const std::string& table) {
    std::string rows;
    for (int i = 0; i < checking + enabled + after; ++i) {
      const double c = 3.6 * played.sense * i,
                   z = i < checking ? 30.0 : std::max(42.0, 60.0 - 0.0125 * (i - checking));
      const double x = 0.09 + 5e-4 * z, y = -0.03 - 4e-4 * z, turned = (c + played.c_off_deg) * rad;
      char row[120];
      std::snprintf(row, sizeof row, "%.6f %.6f %.9f %d %d\n", c, z,
                    30.0 + played.probe_sign * (x * std::cos(turned) + y * std::sin(turned)),
                    i < checking, i >= checking && i < checking + enabled);
      rows += row;
    }
    file("rows.txt", rows);
    file("servo.hal",
         "loadrt threads name1=t period1=1000000\nloadrt streamer depth=16000 cfg=fffbb\n"
         "loadrt sampler depth=16000 cfg=fffubb\nloadrt trueaxis_fts table=" +
             table +
             "\nsetp trueaxis-fts.stroke 0.6\nsetp trueaxis-fts.z-low 42\n"
             "setp trueaxis-fts.z-high 60\nsetp trueaxis-fts.ramp-time 0.1\n"
             "setp trueaxis-fts.c-homed 1\nsetp trueaxis-fts.following-limit 0\n" +
             played.setting +
             "net c streamer.0.pin.0 => trueaxis-fts.c sampler.0.pin.0\n"
             "net z streamer.0.pin.1 => trueaxis-fts.z sampler.0.pin.1\n"
             "net probe streamer.0.pin.2 => trueaxis-fts.probe\n"
             "net check streamer.0.pin.3 => trueaxis-fts.check\n"
             "net enable streamer.0.pin.4 => trueaxis-fts.enable\n"
             "net position trueaxis-fts.position => sampler.0.pin.2\n"
             "net fault trueaxis-fts.fault-code => sampler.0.pin.3\n"
             "net active trueaxis-fts.active => sampler.0.pin.4\n"
             "net checked trueaxis-fts.checked => sampler.0.pin.5\n"
             "addf streamer.0 t\naddf trueaxis-fts t\naddf sampler.0 t\n"
             "loadusr -w halstreamer rows.txt\nloadusr halsampler -n " +
             std::to_string(checking + enabled + after) +
             " samples.txt\nstart\nloadusr -w sleep 4\n");
    halrun("servo.hal");
    std::vector<std::array<double, 6>> samples;
    if (!there("samples.txt")) return samples;
    std::istringstream lines(read_text(folder_ / "samples.txt"));
    for (std::string line; std::getline(lines, line);) {
      std::istringstream numbers(line);
      std::array<double, 6> one{};
      for (double& value : one) numbers >> value;
      if (numbers) samples.push_back(one);
    }
    return samples;
  }

  int halrun(const std::string& commands) {
    std::filesystem::permissions(folder_, std::filesystem::perms::all);
    std::string user = "cd " + shell_word(folder_) + " && ";
    // A socket's whole path has 108 characters at most: it is named from the working folder.
    if (getuid() == 0) user += "RTAPI_UID=65534 RTAPI_FIFO_PATH=fifo ";
    const auto done = shell(user + "timeout 60 halrun -f " + commands + " 2>&1");
    said_ = done.output;
    return done.exit_code;
  }

  std::string said_;

 private:
  bool had_module_ = false;
};

// Every sample of the cut has the library's value of the table, to the six decimals of halsampler.
TEST_F(LinuxCncServo, SendsWhatTheLibraryInterpolates) {
  const auto samples = run({}, (folder_ / "out/table.csv").string());
  ASSERT_GT(samples.size(), std::size_t{checking + enabled}) << said_;
  CorrectionRows rows;
  std::istringstream lines(read_text(folder_ / "out/table.csv"));
  for (std::string line; std::getline(lines, line);) {
    if (line[0] == '#' || line[0] == 'r') continue;
    double rev, z, c, wanted, command;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf", &rev, &z, &c, &wanted, &command), 5);
    rows.position_mm.push_back(z), rows.command_mm.push_back(command);
  }
  int followed = 0;
  for (const auto& [c, z, position, fault, active, checked] : samples) {
    EXPECT_EQ(fault, 0.0) << said_;
    if (active == 0.0) continue;
    ++followed;
    EXPECT_NEAR(position, table_value_mm(rows, rows.command_mm, 360, c / 360.0, z), 0.51e-6);
  }
  EXPECT_GT(followed, enabled - 200) << said_;  // but for the ramp
  EXPECT_EQ(samples.back()[2], 0.0);
}

TEST_F(LinuxCncServo, RefusesAnotherZeroOfCAndAChangedTableByName) {
  const auto samples = run({.c_off_deg = 10.0}, (folder_ / "out/table.csv").string());
  ASSERT_GT(samples.size(), std::size_t{checking}) << said_;
  for (const auto& sample : samples) EXPECT_EQ(sample[2], 0.0);
  EXPECT_TRUE(contains(said_, "position held: C zero is not that of the table")) << said_;
  std::string text = read_text(folder_ / "out/table.csv");
  text[text.size() - 3] = text[text.size() - 3] == '1' ? '2' : '1';
  file("changed.csv", text);
  std::filesystem::remove(folder_ / "samples.txt");
  EXPECT_TRUE(run({}, (folder_ / "changed.csv").string()).empty());
  EXPECT_TRUE(contains(said_, "has changed since it was written")) << said_;
}

TEST_F(LinuxCncServo, RefusesTheOtherSenseAStaleTableAndAnInvertedProbeByName) {
  const std::string table = (folder_ / "out/table.csv").string();
  const auto expect = [&](const Played& played, const std::string& fault) {
    SCOPED_TRACE(fault);
    std::filesystem::remove(folder_ / "samples.txt");
    const auto samples = run(played, table);
    ASSERT_GT(samples.size(), std::size_t{checking}) << said_;
    for (const auto& sample : samples) EXPECT_EQ(sample[2], 0.0);
    EXPECT_TRUE(contains(said_, "position held: " + fault)) << said_;
  };
  expect({.sense = -1}, "the spindle turns the other way than the table is for");
  expect({.probe_sign = -1.0}, "the probe is wired inverted");
  expect({.setting = "setp trueaxis-fts.max-age 0.001\n"}, "the table is older than max-age");
  expect({.setting = "setp trueaxis-fts.following-limit -1\n"}, "following-limit is not set");
}

// A table for the next part, with the spindle turning: a thread of 20 µs runs on while the
// component is unloaded without `delf`, and loaded again. A table that is freed before HAL has
// taken the function out of the thread ends the process of all threads within five times. HAL
// itself does so once in some 600 times on a loaded machine, in thread_task of hal_lib, whatever
// the component is: the best of three runs is judged.
TEST_F(LinuxCncServo, IsUnloadedFromARunningThreadAndLoadedAgain) {
  constexpr int times = 40, runs = 3;
  std::string commands =
      "loadrt threads name1=t period1=20000\nloadrt sum2 names=after\naddf after t\nstart\n";
  for (int i = 0; i < times; ++i)
    commands +=
        "loadrt trueaxis_fts table=out/table.csv\naddf trueaxis-fts t\n"
        "loadusr -w sleep 0.01\n" +
        std::string(i % 2 == 0 ? "" : "delf trueaxis-fts t\n") + "unloadrt trueaxis_fts\n";
  file("reload.hal", commands + "setp after.in0 7\nloadusr -w sleep 0.05\ngetp after.out\n");
  bool adds_still = false;
  for (int i = 0; i < runs && !adds_still; ++i)
    adds_still = halrun("reload.hal") == 0 && contains(said_, "\n7\n");
  EXPECT_TRUE(adds_still) << said_;
}

}  // namespace
}  // namespace trueaxis::testing
