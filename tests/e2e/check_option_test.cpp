// SPDX-License-Identifier: Apache-2.0
// --check: everything is read, what would be done is said, nothing is computed and nothing written.
#include <regex>

#include "support/command_fixture.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

const std::string data = places::source() + "/data/";

class CheckOption : public CommandTest {
 protected:
  void expect_checked(const std::string& arguments, const std::string& would) {
    const auto before = files_in(folder_);
    const CommandStreams done = command(arguments + " --check");
    EXPECT_EQ(done.exit_code, 0) << arguments << '\n' << done.out << done.err;
    EXPECT_TRUE(done.out.starts_with("CHECKED: ")) << arguments << '\n' << done.out;
    // Where a line ends hangs on how long the paths in it are.
    const std::string said = std::regex_replace(done.out, std::regex("\n +"), " ");
    EXPECT_TRUE(contains(said, would)) << arguments << '\n' << done.out;
    EXPECT_EQ(done.err, "") << arguments;
    EXPECT_EQ(files_in(folder_), before) << arguments;
  }
  /// Exit 3, and each of `whys` said.
  void expect_all_said(const std::string& arguments, const std::vector<std::string>& whys) {
    const auto before = files_in(folder_);
    const CommandStreams done = command(arguments + " --check");
    EXPECT_EQ(done.exit_code, 3) << arguments << '\n' << done.out << done.err;
    EXPECT_EQ(done.out, "") << arguments;
    for (const std::string& why : whys)
      EXPECT_TRUE(contains(done.err, why)) << arguments << '\n' << done.err;
    EXPECT_EQ(files_in(folder_), before) << arguments;
  }
};

TEST_F(CheckOption, OfALathe) {
  const std::string cone = data + "streams/shaft_cone_seat.csv";
  expect_checked("run " + data + "jobs/shaft.toml -o out", "fit and diagnose a cone in 1469");
  expect_checked("run " + cone + " -o out", "choose the surface");
  expect_checked("fit " + cone + " --surface cone --json f.json", "f.json");
  expect_checked("diagnose " + cone + " --surface cone --json d.json", "diagnose it");
  expect_checked("advise " + data + "jobs/shaft.toml", "next measurement");
  expect_checked("advise " + cone + " --surface cone", "next measurement");
  expect_checked("simulate " + data + "scenarios/cone_shaft.toml -o s.csv", "probe the part");
  expect_checked("study sweep " + data + "sweeps/cut.toml -o sweep", "8 cells of 20");
  expect_checked("spindle " + cone, "separate part and spindle");
  expect_checked("study plan --surface cylinder --radius-mm 20 --goal-um 1", "search the plans");
  expect_checked("study axis-bias -o bias", "effects, one at a time");
}

// A gauge's readings are not positions, which an association of points needs: `--check` refuses
// what `run` would end with.
TEST_F(CheckOption, RefusesTheAssociationOfAGaugeAsRunDoes) {
  file("job.toml",
       "[[reference]]\nname = \"seat\"\nstream = \"" + data +
           "streams/shaft_cylinder_seat.csv\"\nsurface = \"cylinder\"\nreading = \"relative\"\n"
           "nominal_radius_mm = 30\nassociation = \"minimum_zone\"\n"
           "[target]\nsurface = \"cylinder\"\nradius_mm = 30\nz_start_mm = 40\n"
           "z_end_mm = 0\n[cut]\nspeed_rpm = 600\nsense = \"+c\"\nfeed_mm_per_rev = 0.1\n");
  const CommandStreams run = command("run job.toml -o out"),
                       checked = command("run job.toml -o out --check");
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_TRUE(contains(run.out, "NO-GO: the association of seat needs positions")) << run.out;
  EXPECT_EQ(checked.exit_code, 1) << checked.out;
  EXPECT_TRUE(contains(checked.err, "the association of seat needs positions")) << checked.err;
}

TEST_F(CheckOption, OfAMachine) {
  const std::string of = data + "five_axis/";
  const std::string measured = of + "zxacy_ball.csv --machine " + of + "zxacy.toml";
  expect_checked("run " + data + "jobs/blade.toml -o out", "rewrite ");
  expect_checked("machine diagnose " + measured + " --json d.json", "by 120 rows");
  expect_checked("advise " + measured, "next measurement");
  expect_checked("machine calibrate --machine " + of + "trunnion_ac.toml " + of +
                     "trunnion_ac_ball.csv -o e.toml",
                 "from 240 rows");
  expect_checked("machine compensate " + of + "holes.nc --machine " + of + "zxacy.toml --errors " +
                     of + "zxacy_errors.toml -o n.nc",
                 "rewrite 36 moves");
  expect_checked("machine simulate " + of + "ball.toml -o b.csv", "play the measurement");
  expect_checked("machine simulate " + of + "cut.toml --json c.json", "cut the program");
  expect_checked("setup datums " + of + "holes.toml -o e.toml", "where the part");
  expect_checked("setup locators " + of + "hong.toml", "where the part");
}

TEST_F(CheckOption, SaysAllThatIsWrongAtOnce) {
  file("stream.csv", "X_M[mm],C[deg]\n1,2,3\n");
  file("job.toml", "[[reference]]\nstream = \"stream.csv\"\nsurface = \"cylinder\"\n");
  expect_all_said("fit stream.csv --surface cone --json nowhere/f.json",
                  {"stream.csv:2:", "nowhere/f.json: cannot be written"});
  expect_all_said("run job.toml -o no/where", {"stream.csv:2:", "no/where"});
  file("good.csv", "# x_convention: radius\nX_M[mm],C[deg]\n1,0\n1,90\n1,180\n1,270\n");
  expect_all_said("fit good.csv --surface section --json good.csv",
                  {"is an input of this command"});
  file("bad.toml", "[part]\nsurfce = \"cylinder\"\nradius_mm = -1\n");
  expect_all_said("simulate bad.toml -o s.csv", {"surfce", "radius_mm", "pass"});
  file("bad.nc", "G1 X1 Q\nG68.2 X0\n");
  const std::string of = data + "five_axis/";
  expect_all_said(
      "machine compensate bad.nc --machine " + of + "zxacy.toml --errors none.toml -o n.nc",
      {"bad.nc:1:", "bad.nc:2:", "none.toml"});
  expect_all_said("machine calibrate --machine " + of +
                      "trunnion_ac.toml stream.csv --errors none.toml -o e.toml",
                  {"stream.csv", "none.toml"});
}

}  // namespace
}  // namespace trueaxis::testing
