// SPDX-License-Identifier: Apache-2.0
// Canned drilling cycles at fixed tilts, compensated: by a control and matrices of the test's own
// the tool is where the cycles of the source have it, at every end of every move that they make.
#include <regex>

#include "support/bc_trunnion.hpp"

namespace trueaxis::testing {
namespace {

constexpr double decimals_mm = 0.5e-4 * 1.7320508 + 2.0 * 0.5e-5 * rad_per_deg * 200.0;

const std::string holes =
    "%\nO100 (DRILL)\nG21 G90 G94 G54\nT1 M6 S2000 M3\nG0 X0 Y0 Z100 B30 "
    "C45\n"
    "N10 G99 G81 X10 Y10 Z-12.5 R2 F200 M8 (hole 1, Z R)\nN20 X20.\nN30 Y20. (hole 3)\n"
    "/N35 X25.\nN40 G98 G82 X30 Z-8 P0.5 L2\nN50 G83 X40 Z-20 Q5. R3\nN55 Y30 ; on\nN60 G80\n"
    "G0 Z100 M9\nG0 B-20 C-70\nX0 Y0 Z10\nG99 G81 Z-5 R1\nG91 X5. Z-6 R-9 K3\nX2. Y-3 R-8\nX2. "
    "Z-4\nG90 G80\n"
    "G0 X0 Y0 Z-3\nG98 G82 X3 Y3 Z-9 R1 P1000\nG0 Z50\nX10\nM30\n%\n";

class DrillingCycles : public CommandTest {
 protected:
  CommandStreams compensate(const std::string& program, unsigned seed,
                            const std::string& more = "") {
    file("m.toml", bc_trunnion);
    file("e.toml", bc_errors(seed));
    file("p.nc", program);
    return command(
        "machine compensate p.nc --machine m.toml --errors e.toml -o out.nc --json r.json "
        "--force " +
        more);
  }
};

TEST_F(DrillingCycles, AreWhereTheSourceHasThem) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    const CommandStreams done = compensate(holes, seed);
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const std::string out = read_text(folder_ / "out.nc");
    const PlainControl was(holes), is(out);
    const BcTrunnion bc(folder_);
    ASSERT_EQ(is.moves.size(), was.moves.size()) << out;
    EXPECT_EQ(is.dwells, was.dwells);
    EXPECT_EQ(was.dwells.size(), 3u);
    double before = 0.0;
    for (std::size_t i = 0; i < was.moves.size(); ++i) {
      EXPECT_EQ(is.moves[i].rapid, was.moves[i].rapid) << i;
      EXPECT_LT(distance(bc.actual(is.moves[i].to), bc.nominal(was.moves[i].to)), decimals_mm)
          << "line " << was.moves[i].line;
      before = std::max(before, distance(bc.actual(was.moves[i].to), bc.nominal(was.moves[i].to)));
      if (!was.moves[i].rapid) {
        EXPECT_LT(bc.off_mm(was.moves[i], is.moves[i].from, is.moves[i].to), 2.0 * decimals_mm);
      }
    }
    EXPECT_NEAR(value_of(result("r.json").at("error_before").at("position")), before, 1e-9);
    // No cycle is left, and every word that is not a position of a cycle stays.
    EXPECT_FALSE(std::regex_search(out, std::regex("G8[123]|G9[89]")));
    for (const char* kept :
         {"%\nO100 (DRILL)\nG21 G90 G94 G54 (COMPENSATED BY TRUEAXIS)\nT1 M6 S2000 M3\n",
          "N10 G0 X", " F200 M8 (hole 1, Z R)\n", "(hole 3)\n", "/N35 X", " ; on\n", "N60 G80\n",
          " M9\n", "M30\n%\n"})
      EXPECT_TRUE(contains(out, kept)) << kept << '\n' << out;
  }
}

TEST_F(DrillingCycles, StayWithoutErrors) {
  file("m.toml", bc_trunnion);
  file("p.nc", holes);
  ASSERT_EQ(command("machine compensate p.nc --machine m.toml -o out.nc").exit_code, 0);
  EXPECT_EQ(read_text(folder_ / "out.nc"), holes);
}

// Y alone is corrected: the word X of a hole under G91, a distance, stayed where G90 was written
// before it, and the hole was the rest of X off.
TEST_F(DrillingCycles, ADistanceOfAnAxisThatNoErrorMovesBecomesItsPosition) {
  const std::string row = "G21 G90 G94 G54\nG0 X10 Y2 Z5 B0 C0\nG91 G81 X5 Y3 Z-6 R-3 F100 K2\n";
  file("m.toml", bc_trunnion);
  file("e.toml",
       "schema = \"trueaxis.errors/1\"\nsign = \"moving_part\"\n"
       "[[error]]\nname = \"Y0S\"\nvalue_um = 20\n");
  file("p.nc", row);
  ASSERT_EQ(command("machine compensate p.nc --machine m.toml --errors e.toml -o out.nc").exit_code,
            0);
  const std::string out = read_text(folder_ / "out.nc");
  const PlainControl was(row), is(out);
  ASSERT_EQ(is.moves.size(), was.moves.size()) << out;
  for (std::size_t i = 0; i < was.moves.size(); ++i) {
    EXPECT_NEAR(is.moves[i].to[0], was.moves[i].to[0], 1e-9) << out;
    EXPECT_NEAR(is.moves[i].to[1], was.moves[i].to[1] - 0.02, 1e-9) << out;
    EXPECT_NEAR(is.moves[i].to[2], was.moves[i].to[2], 1e-9) << out;
  }
}

// X alone is corrected, and the tool is below R: the first move is up, where the tool is. The word
// Y of the hole stayed in it, and the tool went across below R.
TEST_F(DrillingCycles, BelowRTheFirstMoveIsUpAlone) {
  const std::string low = "G21 G90 G94 G54\nG0 X0 Y0 Z1 B0 C0\nG81 G98 X10 Y100 Z-5 R2 F100\n";
  file("m.toml", bc_trunnion);
  file("e.toml",
       "schema = \"trueaxis.errors/1\"\nsign = \"moving_part\"\n"
       "[[error]]\nname = \"X0S\"\nvalue_um = 100\n");
  file("p.nc", low);
  ASSERT_EQ(command("machine compensate p.nc --machine m.toml --errors e.toml -o out.nc").exit_code,
            0);
  const std::string out = read_text(folder_ / "out.nc");
  const PlainControl was(low), is(out);
  ASSERT_EQ(is.moves.size(), was.moves.size()) << out;
  for (std::size_t i = 0; i < was.moves.size(); ++i)
    for (std::size_t k : {1, 2}) EXPECT_NEAR(is.moves[i].to[k], was.moves[i].to[k], 1e-9) << out;
  EXPECT_NEAR(is.moves[1].to[0], is.moves[0].to[0], 1e-9) << out;
}

TEST_F(DrillingCycles, InInchToo) {
  const std::string inch =
      "G20 G90 G94 G54\nG0 X0 Y0 Z4 B30 C45\nG81 X.5 Y.5 Z-.4 R.1 F8\nX1.\nG80\nG21\nG0 X30\n";
  ASSERT_EQ(compensate(inch, 1).exit_code, 0);
  const std::string out = read_text(folder_ / "out.nc");
  const BcTrunnion bc(folder_);
  std::vector<PlainMove> was = PlainControl(inch).moves, is = PlainControl(out).moves;
  ASSERT_EQ(was.size(), is.size());
  for (std::size_t i = 0; i + 1 < was.size(); ++i) {  // the last is in mm
    for (PlainMove* move : {&was[i], &is[i]})
      for (std::size_t k = 0; k < 3; ++k) move->to[k] *= 25.4;
    EXPECT_LT(distance(bc.actual(is[i].to), bc.nominal(was[i].to)), decimals_mm) << i;
  }
}

TEST_F(DrillingCycles, RefusesWhatControlsDisagreeAbout) {
  const std::string start = "G0 X0 Y0 Z100 B30 C45\n";
  const std::map<std::string, std::string> wrong{
      {"G81 X1 Z-5", "without R"},
      {"G81 X1 R2", "without Z"},
      {"G83 X1 Z-5 R2", "without Q"},
      {"G81 X1 Z5 R2", "not below its R"},
      {"G81 X1 Z-5 R2 L0", "number of repeats"},
      {"G81 X1 Z-5 R2 K2 L2", "both K and L"},
      {"G81 X1 Z-5 R2 B31", "turns an axis"},
      {"G18 G81 X1 Z-5 R2", "G17"},
      {"G93 G81 X1 Z-5 R2 F2", "G93"},
      {"G81 X1 Z-5 R2 M9", "a block of its own"},
      {"G0 G81 X1 Z-5 R2", "in one block with another G code"},
      {"G81 X1 Z-5 R2 P1", "P has no meaning"},
      {"G81 F100", "without a hole"},
      {"G84 X1 Z-5 R2", "canned cycle that is not read"},
      {"G81 X1 Z-5 R2\nG91 X5 K3", "R-98 Z-7 for the levels of before"},
      {"G91 G81 X1 Z-5 R-98\nG90 X5", "R2 Z-3 for the levels of before"},
      {"G91 G81 X1 Z-5 R-98\nG90 X5 R2", "G90 and G91 were exchanged within a canned cycle"},
      {"G81 X1 Z-5 R2\nG80\nX5", "axis words before G0 or G1"}};
  for (const auto& [block, why] : wrong) {
    const CommandStreams done = compensate(start + block + "\n", 1);
    EXPECT_EQ(done.exit_code, 3) << block;
    EXPECT_TRUE(contains(done.err, why)) << block << '\n' << done.err;
  }
}

/// The straight moves that LinuxCNC's interpreter makes: rapid or not, and where to.
std::vector<std::string> straight_moves(const std::filesystem::path& folder,
                                        const std::string& program) {
  const auto done = shell("cd " + shell_word(folder) + " && rs274 -g " + program);
  EXPECT_EQ(done.exit_code, 0) << done.output;
  std::vector<std::string> out;
  std::istringstream lines(done.output);
  const std::regex call(R"(.*(STRAIGHT_(?:TRAVERSE|FEED)|DWELL)\((.*)\).*)");
  std::smatch found;
  for (std::string line; std::getline(lines, line);)
    if (std::regex_match(line, found, call) &&
        (out.empty() || out.back() != found[1].str() + found[2].str()))
      out.push_back(found[1].str() + found[2].str());
  return out;
}

// Without errors LinuxCNC makes of the written moves what it makes of the cycles. Writing the
// source out by errors that cancel each other except for one rounding would not do, so the test
// counts its moves by kind.
// From the R level G98 takes LinuxCNC up on its way to the next hole, and FANUC after it: the
// higher way is clear on both.
TEST_F(DrillingCycles, LinuxCncMakesTheSameKindsOfMoves) {
  if (shell("command -v rs274").exit_code != 0) GTEST_SKIP() << "rs274 (linuxcnc) is not installed";
  const std::string program =
      "G21 G90 G94 G54\nG0 X0 Y0 Z100 B30 C45\nG99 G81 X10 Y10 Z-12.5 R2 F200\nX20.\n"
      "G98 G82 X30 Z-8 R2 P0.5\nG83 X40 Z-20 Q5. R3\nG80\nG0 Z100\nM2\n";
  ASSERT_EQ(compensate(program, 1).exit_code, 0);
  const auto was = straight_moves(folder_, "p.nc"), is = straight_moves(folder_, "out.nc");
  ASSERT_EQ(was.size(), is.size());
  for (std::size_t i = 0; i < was.size(); ++i)
    EXPECT_EQ(was[i].substr(0, 15), is[i].substr(0, 15)) << was[i] << '\n' << is[i];
}

}  // namespace
}  // namespace trueaxis::testing
