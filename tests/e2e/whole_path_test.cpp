// SPDX-License-Identifier: Apache-2.0
// A compensated program on its whole path, ends of blocks and between them, by matrices and a
// control of the test's own: it comes out worse nowhere, and what is said of it is the largest.
#include "support/bc_trunnion.hpp"
#include "support/without_comments.hpp"

namespace trueaxis::testing {
namespace {

// What the last of four decimals of X Y Z and of five of B C does at 200 mm.
constexpr double decimals_mm = 0.5e-4 * 1.7320508 + 2.0 * 0.5e-5 * rad_per_deg * 200.0;

const std::string pocket =
    "G21 G90 G94 G54\nG0 X-120 Y-60 Z10 B0 C0\nG1 Z-5 F300\nX120 F800\nY60\nX-120\nY-60\n"
    "X-100 Y-40\nX100\nY40\nX-100\nY-40\nG0 Z50\nM30\n";
const std::string planes =
    "G21 G90 G94 G54\nG0 X0 Y0 Z100 B30 C45\nG0 X-20 Y-20 Z10\nG1 Z-5 F300\nX40\nY30\nG0 Z100\n"
    "G0 B-30 C90\nG0 X-20 Y-20 Z10\nG1 Z-5 F300\nX40\nY30\nG0 Z100\nG0 B0 C0\nG0 X-20 Y-20 Z10\n"
    "G1 Z-5 F300\nX140\nY30\nG0 Z100\nM30\n";

class WholePath : public CommandTest {
 protected:
  struct Off {
    double before = 0.0, after = 0.0;
    std::size_t blocks = 0;
  };

  CommandStreams compensate(const std::string& program, unsigned seed, const std::string& options) {
    file("m.toml", bc_trunnion);
    file("e.toml", bc_errors(seed));
    file("p.nc", program);
    return command(
        "machine compensate p.nc --machine m.toml --errors e.toml -o out.nc --json r.json " +
        options + " --force");
  }

  /// Block by block, of a program whose blocks stayed whole: every block is off by no more than it
  /// was, or than a machine without errors leaves it.
  Off expect_worse_nowhere() {
    const BcTrunnion bc(folder_);
    const auto was = PlainControl(read_text(folder_ / "p.nc")).moves,
               is = PlainControl(read_text(folder_ / "out.nc")).moves;
    Off off;
    EXPECT_EQ(was.size(), is.size());
    for (std::size_t i = 0; i < std::min(was.size(), is.size()); ++i) {
      const double end_before = distance(bc.actual(was[i].to), bc.nominal(was[i].to)),
                   end_after = distance(bc.actual(is[i].to), bc.nominal(was[i].to));
      EXPECT_LT(end_after, decimals_mm) << "line " << was[i].line;
      const bool cuts = was[i].known && !was[i].rapid;
      const double before =
          std::max(end_before, cuts ? bc.off_mm(was[i], was[i].from, was[i].to) : 0.0);
      const double after =
          std::max(end_after, cuts ? bc.off_mm(was[i], is[i].from, is[i].to) : 0.0);
      if (cuts) {
        EXPECT_LE(after, 1.01 * before + decimals_mm) << "line " << was[i].line;
      }
      off.before = std::max(off.before, before);
      off.after = std::max(off.after, after);
      ++off.blocks;
    }
    return off;
  }

  /// The headline and the JSON have what the test found, to the hundredth that is stated.
  void expect_said(const CommandStreams& done, const Off& off) {
    const auto path = result("r.json").at("whole_path");
    EXPECT_NEAR(value_of(path.at("before")), off.before, 0.01 * off.before + 1e-8);
    EXPECT_NEAR(value_of(path.at("after")), off.after, 0.01 * off.after + 1e-8);
    EXPECT_TRUE(contains(first_line(done.out), "on the whole path")) << done.out;
    EXPECT_EQ(first_line(done.out).rfind("DONE: tip off by ", 0), 0U) << done.out;
  }

  std::vector<std::string> rotary_words(const std::string& name) {
    std::vector<std::string> out;
    std::istringstream lines(without_comments(read_text(folder_ / name)));
    for (std::string line; std::getline(lines, line);)
      for (std::size_t i = 0; i < line.size(); ++i)
        if (line[i] == 'B' || line[i] == 'C') out.push_back(line.substr(i, line.find(' ', i) - i));
    return out;
  }
};

// The pocket at B0: no rotary axis moves, whatever the method and the pieces.
TEST_F(WholePath, APocketOfThreeAxesTurnsNothing) {
  for (unsigned seed = 1; seed <= 5; ++seed)
    for (const char* options : {"", "--method differential"}) {
      SCOPED_TRACE(std::to_string(seed) + options);
      const CommandStreams done = compensate(pocket, seed, options);
      ASSERT_EQ(done.exit_code, 0) << done.err;
      const Off off = expect_worse_nowhere();
      EXPECT_GT(off.before, 3e-3);
      EXPECT_EQ(off.blocks, 12u);
      expect_said(done, off);
      EXPECT_EQ(rotary_words("out.nc"), (std::vector<std::string>{"B0", "C0"}));
    }
}

TEST_F(WholePath, ItsPiecesStayWithinTheToleranceAndTurnNothing) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const CommandStreams done = compensate(pocket, seed, "--tolerance-um 0.4");
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(rotary_words("out.nc"), (std::vector<std::string>{"B0", "C0"}));
    EXPECT_FALSE(contains(done.out, "--tolerance-um cuts")) << done.out;
    const BcTrunnion bc(folder_);
    const auto was = PlainControl(pocket).moves;
    double largest = 0.0;
    std::ptrdiff_t pieces = 0;
    for (const PlainMove& piece : PlainControl(read_text(folder_ / "out.nc")).moves) {
      if (piece.rapid) continue;
      ++pieces;
      // The block that the piece is of is the nearest.
      double least = 1e9;
      for (const PlainMove& block : was)
        if (!block.rapid) least = std::min(least, bc.off_mm(block, piece.from, piece.to));
      largest = std::max(largest, least);
    }
    EXPECT_GT(pieces, std::ranges::count(was, false, &PlainMove::rapid));
    EXPECT_LE(largest, 1.01 * 0.4e-3) << seed;
    EXPECT_GT(result("r.json").at("blocks").at("inserted"), 0);
  }
}

// Rounded corners: the tip against the true arcs, of which chords may be off by 1 µm.
TEST_F(WholePath, ArcsToo) {
  const std::string corners =
      "G21 G90 G94 G54\nG0 X-40 Y-50 Z-5 B0 C0\nG1 X40 F500\nG3 X50 Y-40 I0 J10\nG1 Y40\n"
      "G3 X40 Y50 I-10 J0\nG1 X-40\nG2 X-40 Y50 I0 J-20\n";
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const CommandStreams done = compensate(corners, seed, "--arcs-mm 0.001");
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const BcTrunnion bc(folder_);
    const auto was = PlainControl(corners).moves;
    double before = 0.0, after = 0.0;
    std::ptrdiff_t chords = 0;
    std::vector<std::array<Vector3, 2>> ends;  // of the blocks, in the part
    for (const PlainMove& block : was) {
      if (block.rapid) continue;
      before = std::max(before, bc.off_mm(block, block.from, block.to));
      ends.push_back({bc.nominal(block.from), bc.nominal(block.to)});
    }
    for (const PlainMove& chord : PlainControl(read_text(folder_ / "out.nc")).moves) {
      if (chord.rapid) continue;
      ++chords;
      for (const double s : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        AxisPositions q;
        for (std::size_t k = 0; k < axis_count; ++k)
          q[k] = std::lerp(chord.from[k], chord.to[k], s);
        const Vector3 tip = bc.actual(q);
        double least = 1e9;
        for (const auto& [from, to] : ends)
          least = std::min(least, BcTrunnion::off_line(tip, from, to));
        after = std::max(after, least);
      }
    }
    EXPECT_GT(chords, 0);
    EXPECT_LT(after, 1e-3 + 1.01 * value_of(result("r.json").at("whole_path").at("after")));
    EXPECT_LT(after, before);
  }
}

// Three planes at fixed tilts: B and C are corrected where the program positions them and stand
// still while it cuts; at B0, a pole, C keeps its word.
TEST_F(WholePath, PlanesThatAreTiltedStandStill) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    const CommandStreams done = compensate(planes, seed, "");
    ASSERT_EQ(done.exit_code, 0) << done.err;
    expect_said(done, expect_worse_nowhere());
    const auto words = rotary_words("out.nc");
    ASSERT_EQ(words.size(), 6u);
    EXPECT_NE(words[0], "B30");
    EXPECT_NE(words[1], "C45");
    EXPECT_LT(std::abs(std::stod(words[5].substr(1))), 1e-4);  // B is 1e-3° from the pole
    // Where they are positioned away from the pole the direction is right: a hundredth of it.
    const BcTrunnion bc(folder_);
    const auto was = PlainControl(planes).moves,
               is = PlainControl(read_text(folder_ / "out.nc")).moves;
    EXPECT_LT(bc.angle_off(was[0].to, is[0].to), 2.0 * 0.5e-5 * rad_per_deg);
  }
}

// Five axes at once, through the pole: what C is turned by is bounded by what it gains, twenty
// times the angle that is to be corrected, and no block comes out worse.
TEST_F(WholePath, FiveAxesThroughThePole) {
  std::string text = "G21 G90 G94 G54\nG0 X-30 Y-10 Z5 B-6 C10\n";
  char block[100];
  for (int i = 1; i <= 120; ++i) {
    std::snprintf(block, sizeof block, "G1 X%.3f Y%.3f Z%.3f B%.3f C%.3f F800\n", -30.0 + 0.5 * i,
                  -10.0 + 5.0 * std::sin(0.05 * i), 5.0 - 0.02 * i, -6.0 + 0.1 * i,
                  10.0 + 0.05 * i);
    text += block;
  }
  for (unsigned seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    const CommandStreams done = compensate(text, seed, "");
    ASSERT_EQ(done.exit_code, 0) << done.err;
    expect_said(done, expect_worse_nowhere());
    const BcTrunnion bc(folder_);
    const auto was = PlainControl(text).moves,
               is = PlainControl(read_text(folder_ / "out.nc")).moves;
    for (std::size_t i = 0; i < was.size(); ++i) {
      const double angle = bc.angle_off(was[i].to, was[i].to);
      for (const std::size_t k : {4, 5})
        EXPECT_LE(std::abs(is[i].to[k] - was[i].to[k]), 20.5 * angle + 1e-5 * rad_per_deg);
      EXPECT_LE(bc.angle_off(was[i].to, is[i].to), 1.001 * angle + 1e-5 * rad_per_deg);
    }
  }
}

// A turn of C by 2° at 100 mm, not alone, leaves the line by r Δφ²/8 = 15.2 µm inwards; with the
// part 7.6 µm further out the program is off by 7.6 µm as it is, and with right ends by 15.2 µm.
TEST_F(WholePath, AProgramThatComesOutWorseIsRefused) {
  file("m.toml",
       "schema = \"trueaxis.machine/1\"\nname = \"C table\"\nchain = \"w C' Y' b X Z t\"\n"
       "[tool]\ngauge_point_mm = [0, 0, 150]\nlength_mm = 120\n[program]\nmode = \"axes\"\n");
  file("p.nc", "G0 X100 Y0 Z0 C-1\nG1 Z0.01 C1 F500\n");
  const double bow_mm = 100.0 * (1.0 - std::cos(rad_per_deg));
  char errors[200];
  std::snprintf(errors, sizeof errors,
                "schema = \"trueaxis.errors/1\"\nsign = \"moving_part\"\n[[error]]\n"
                "name = \"X0W\"\nvalue_um = %.6f\n",
                0.5e3 * bow_mm);
  file("e.toml", errors);
  const std::string call =
      "machine compensate p.nc --machine m.toml --errors e.toml -o out.nc --json r.json";
  const CommandStreams done = command(call);
  EXPECT_EQ(done.exit_code, 1) << done.out;
  EXPECT_TRUE(contains(done.err, "--tolerance-um")) << done.err;
  EXPECT_FALSE(there("out.nc"));
  const auto path = result("r.json").at("whole_path");
  EXPECT_NEAR(value_of(path.at("before")), 0.5 * bow_mm, 1e-5);
  EXPECT_NEAR(value_of(path.at("after")), bow_mm, 1e-4);
  EXPECT_EQ(result("r.json").at("comes_out_worse"), true);
  EXPECT_EQ(command(call + " --tolerance-um 2").exit_code, 0);
}

// All rotary axes may be asked for: B then corrects the direction at B0 too.
TEST_F(WholePath, AllRotaryAxesIfAsked) {
  ASSERT_EQ(compensate(pocket, 1, "").exit_code, 0);
  const double still = value_of(result("r.json").at("error_after").at("direction"));
  ASSERT_EQ(compensate(pocket, 1, "--rotary all").exit_code, 0);
  EXPECT_LT(value_of(result("r.json").at("error_after").at("direction")), still);
  EXPECT_GT(rotary_words("out.nc").size(), 2u);
}

}  // namespace
}  // namespace trueaxis::testing
