// SPDX-License-Identifier: Apache-2.0
// A gauge that is wired inverted: the part comes out opposite to where it is, and a table would
// double the error. Its own eccentricity e leaves two undulations of e²/2R then.
#include <sstream>

#include "support/command_fixture.hpp"

namespace trueaxis::testing {
namespace {

class InvertedGauge : public CommandTest {
 protected:
  void probe(const std::string& kind, double x0_mm, const std::string& effect = "") {
    file("part.toml", "seed = 3\n[part]\nkind = \"" + kind +
                          "\"\nradius_mm = 20\nx0_mm = " + std::to_string(x0_mm) +
                          "\ny0_mm = -0.05\nl = 5e-4\nm = -4e-4\n[noise]\nsigma_um = 0.5\n"
                          "[[pass]]\nz_start_mm = 0\nz_end_mm = 40\nfeed_mm_per_rev = 1\n"
                          "readings_per_revolution = 36.7\n" +
                          effect);
    ASSERT_EQ(command("simulate part.toml -o part.csv --force").exit_code, 0);
  }

  /// 40 − X in place of X: the slide is at 20 mm, and the gauge counts the wrong way.
  void invert() {
    std::istringstream lines(read_text(folder_ / "part.csv"));
    std::string text;
    bool header = true;
    for (std::string line; std::getline(lines, line);) {
      if (line[0] == '#' || header) {
        header = header && line[0] == '#';
        text += line + '\n';
        continue;
      }
      const std::size_t end = line.find(',');
      char x[40];
      std::snprintf(x, sizeof x, "%.9f", 40.0 - std::stod(line.substr(0, end)));
      text += x + line.substr(end) + '\n';
    }
    file("part.csv", text);
  }

  CommandStreams cut() {
    file("job.toml",
         "[[reference]]\nstream = \"part.csv\"\nsurface = \"cylinder\"\n[target]\n"
         "surface = \"cylinder\"\nradius_mm = 18\nz_start_mm = 60\nz_end_mm = 50\n"
         "coaxiality_tolerance_um = 20\n[cut]\nspeed_rpm = 600\nsense = \"+c\"\n"
         "feed_mm_per_rev = 0.5\ninterpolation = \"linear\"\n");
    return command("run job.toml -o out --force");
  }
};

TEST_F(InvertedGauge, IsRefusedByName) {
  probe("cylinder", 0.1);
  EXPECT_EQ(cut().exit_code, 0);
  EXPECT_TRUE(there("out/table.csv"));
  invert();
  const CommandStreams done = cut();
  EXPECT_EQ(done.exit_code, 1) << done.out;
  EXPECT_TRUE(contains(done.out, "NOT PROVEN")) << done.out;
  // With its sign reversed it would be probed from the rear, and GO for a mirrored axis.
  EXPECT_TRUE(contains(done.out, "runs in the opposite direction: probe again")) << done.out;
  EXPECT_FALSE(there("out/table.csv"));
  const CommandStreams alone = command("run part.csv -o alone --surface cylinder");
  EXPECT_EQ(alone.exit_code, 1) << alone.out;
  EXPECT_TRUE(contains(alone.out, "opposite direction")) << alone.out;
}

// An oval part is not taken for it: three times the wave, or the wave in another direction.
TEST_F(InvertedGauge, AnOvalPartIsNotTakenForIt) {
  for (const char* oval :
       {"amplitude_um = 1.2\nphase_deg = 120\n", "amplitude_um = 0.4\nphase_deg = 20\n"}) {
    probe("cylinder", 0.1, "[[effect]]\nid = \"part.roundness\"\norder = 2\n" + std::string(oval));
    const CommandStreams done = cut();
    EXPECT_EQ(done.exit_code, 0) << done.out;
    EXPECT_FALSE(contains(done.out, "opposite direction")) << done.out;
  }
}

// 0.08 mm off, the wave is 0.2 µm, and noise of 1.5 µm leaves it a u of 0.3 of itself: an oval of
// 0.35 µm whose phase is anywhere within 40° of it would match. It says nothing of the gauge.
TEST_F(InvertedGauge, AWaveThatIsHardlySeenIsNotTakenForIt) {
  probe("cylinder", 0.08,
        "[[effect]]\nid = \"part.roundness\"\norder = 2\namplitude_um = 0.4\nphase_deg = 122\n");
  std::string part = read_text(folder_ / "part.toml");
  part.replace(part.find("sigma_um = 0.5"), 14, "sigma_um = 1.5");
  file("part.toml", part);
  ASSERT_EQ(command("simulate part.toml -o part.csv --force").exit_code, 0);
  const CommandStreams alone = command("run part.csv -o alone --surface cylinder");
  EXPECT_FALSE(contains(alone.out, "opposite direction")) << alone.out;
}

// Whatever the diagnosis takes the wave for: 0.3 mm off, two undulations of 2.25 µm were a sensor
// that bends, and the table that was a GO doubled the error.
TEST_F(InvertedGauge, IsRefusedWhateverTheWaveIsCalled) {
  probe("cylinder", 0.3);
  EXPECT_EQ(command("run part.csv -o alone --surface cylinder").exit_code, 0);
  invert();
  const CommandStreams done = command("run part.csv -o inverted --surface cylinder");
  EXPECT_EQ(done.exit_code, 1) << done.out;
  EXPECT_TRUE(contains(done.out, "runs in the opposite direction")) << done.out;
}

}  // namespace
}  // namespace trueaxis::testing
