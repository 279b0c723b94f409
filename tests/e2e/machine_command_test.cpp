// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "support/command_fixture.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

const std::string data = places::source() + "/data/five_axis/";
const std::string machine = data + "trunnion_ac.toml ";
const std::string errors = " --errors " + data + "trunnion_ac_errors.toml";

/// Rows of a CSV after its header and comments.
std::vector<std::vector<double>> rows_of(const std::string& text) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(text);
  bool header = true;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    if (!header) {
      rows.emplace_back();
      std::istringstream fields(line);
      for (std::string field; std::getline(fields, field, ',');)
        rows.back().push_back(std::stod(field));
    }
    header = false;
  }
  return rows;
}

class MachineCommand : public CommandTest {
 protected:
  std::vector<double> only_row(const std::string& arguments) {
    const CommandStreams done = command(arguments);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    const auto rows = rows_of(done.out);
    EXPECT_EQ(rows.size(), 1u) << done.out;
    return rows.empty() ? std::vector<double>(16) : rows.front();
  }
  void expect_row(const std::string& arguments, const std::vector<double>& wanted,
                  double tolerance) {
    const std::vector<double> row = only_row(arguments);
    ASSERT_EQ(row.size(), wanted.size()) << arguments;
    for (std::size_t i = 0; i < row.size(); ++i)
      EXPECT_NEAR(row[i], wanted[i], tolerance) << arguments << ' ' << i;
  }
  /// The command refuses and says all of `words`.
  void expect_all(const std::string& arguments, const std::vector<std::string>& words) {
    const CommandStreams done = command(arguments);
    EXPECT_EQ(done.exit_code, 3) << arguments << done.err;
    for (const std::string& word : words)
      EXPECT_TRUE(contains(done.err, word)) << word << '\n' << done.err;
  }
};

// The worked example of docs/reference/machine.md to its last printed digit.
TEST_F(MachineCommand, PoseOfTheWorkedExample) {
  const std::string positions = data + "trunnion_ac_positions.csv";
  expect_row("machine pose --machine " + machine + positions,
             {-1.865132837481, 97.227949581144, 59.197672791717, -0.538985544696, 0.196174694969,
              0.819152044289, 0},
             0.5e-12);
  expect_row("machine pose --machine " + machine + positions + errors,
             {-1.850358534818, 97.210312596243, 59.190929118170, -0.538789781840, 0.196618406978,
              0.819174446026, -0.037854821627},
             0.5e-12);
}

TEST_F(MachineCommand, AxesGoBackFromPose) {
  ASSERT_EQ(
      command("machine pose --machine " + machine + data + "trunnion_ac_positions.csv -o cl.csv")
          .exit_code,
      0);
  const CommandStreams all = command("machine inverse --machine " + machine + "cl.csv --all");
  ASSERT_EQ(all.exit_code, 0) << all.err;
  EXPECT_TRUE(all.out.starts_with("point,solution,X[mm],Y[mm],Z[mm],A[deg],C[deg]\n"));
  const auto rows = rows_of(all.out);
  ASSERT_EQ(rows.size(), 1u) << "A = +35 is outside its limits\n" << all.out;
  const std::vector<double> wanted{1, 1, 100, -50, 30, -35, 70};
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(rows[0][i], wanted[i], 1e-10);
  file("far.csv", "x,y,z,i,j,k\n0,0,0,0,0,1\n0,5000,0,0,0,1\n");
  const CommandStreams far =
      command("machine inverse --machine " + machine + "far.csv -o far_axes.csv");
  EXPECT_EQ(far.exit_code, 1);
  EXPECT_TRUE(contains(far.err, "point 2: Y at")) << far.err;
  EXPECT_FALSE(there("far_axes.csv"));
}

// The machine with its errors, at the axes stated for it, has the tool where the nominal machine
// has it: its own forward kinematics say so. Without the errors it would be off by tens of µm.
TEST_F(MachineCommand, AxesOfAMachineWithErrorsPutItsToolAtThePoints) {
  ASSERT_EQ(
      command("machine pose --machine " + machine + data + "trunnion_ac_positions.csv -o cl.csv")
          .exit_code,
      0);
  const auto wanted =
      only_row("machine pose --machine " + machine + data + "trunnion_ac_positions.csv");
  const CommandStreams done = command("machine inverse --machine " + machine + "cl.csv" + errors);
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto rows = rows_of(done.out);
  ASSERT_EQ(rows.size(), 1u);
  file("to.csv",
       fmt::format("X[mm],Y[mm],Z[mm],A[deg],C[deg]\n{:.12f},{:.12f},{:.12f},{:.12f},{:.12f}\n",
                   rows[0][2], rows[0][3], rows[0][4], rows[0][5], rows[0][6]));
  const auto there = only_row("machine pose --machine " + machine + "to.csv" + errors);
  double nominal_off_mm = 0.0;
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(there[i], wanted[i], i < 3 ? 1e-9 : 1e-11) << i;
  const auto uncorrected =
      only_row("machine pose --machine " + machine + data + "trunnion_ac_positions.csv" + errors);
  for (std::size_t i = 0; i < 3; ++i)
    nominal_off_mm = std::max(nominal_off_mm, std::abs(uncorrected[i] - wanted[i]));
  EXPECT_GT(nominal_off_mm, 5e-3);
}

// A head of C and A, the tool nearly along C: B0S tilts it by 1 mrad across its lean, which C turns
// back only by 1 mrad over the lean. The note names what stops it.
TEST_F(MachineCommand, NearAPoleTheLimitIsNamed) {
  const auto machine_file = [&](const char* limit) {
    file("head.toml",
         std::string("schema = \"trueaxis.machine/1\"\nname = \"head\"\n"
                     "chain = \"w X' b Y Z C A t\"\n"
                     "[axes.X]\ndirection = [1.0, 0.0, 0.0]\n"
                     "[axes.Y]\ndirection = [0.0, 1.0, 0.0]\n"
                     "[axes.Z]\ndirection = [0.0, 0.0, 1.0]\n"
                     "[axes.C]\npoint_mm = [0.0, 0.0, 0.0]\n"
                     "direction = [0.0, 0.0, 1.0]\n"
                     "[axes.A]\npoint_mm = [0.0, 0.0, 0.0]\n"
                     "direction = [1.0, 0.0, 0.0]\n"
                     "[tool]\ngauge_point_mm = [0.0, 0.0, 0.0]\nlength_mm = 100.0\n"
                     "[program]\nmode = \"axes\"\n[compensation]\nmax_rotary_change_deg = ") +
             limit + "\n");
  };
  file("e.toml",
       "schema = \"trueaxis.errors/1\"\nsign = \"tool_minus_workpiece\"\n"
       "[[error]]\nname = \"B0S\"\nvalue_mrad = 1.0\n");
  const auto said = [&](const char* limit, double lean) {
    machine_file(limit);
    file("to.csv",
         fmt::format("x,y,z,i,j,k\n0,0,0,0,{:.9f},{:.9f}\n", -std::sin(lean), std::cos(lean)));
    const CommandStreams done =
        command("machine inverse --machine head.toml to.csv --errors e.toml");
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return done.err;
  };
  EXPECT_TRUE(contains(said("0.5", 0.1), "max_rotary_change_deg")) << said("0.5", 0.1);
  EXPECT_TRUE(contains(said("90", 0.003), "twenty times")) << said("90", 0.003);
}

TEST_F(MachineCommand, ErrorsAtAPosition) {
  ASSERT_EQ(command("machine errors --machine " + machine + errors +
                    " --at \"X=100,Y=-50,Z=30,A=-35,C=70\" --json e.json")
                .exit_code,
            0);
  const nlohmann::json json = result("e.json");
  EXPECT_EQ(json["component"].size(), 30u);
  EXPECT_EQ(json["location"].size(), 9u);
  EXPECT_NEAR(json["component"]["EXX"]["value"], 0.0075, 1e-15);
  EXPECT_NEAR(json["component"]["EAC"]["value"].get<double>() * std::acos(-1.0) / 180,
              8.118664537186e-6, 1e-18);
  EXPECT_NEAR(json["location"]["X0C"]["value"], 0.025, 1e-15);
  EXPECT_NEAR(json["further"]["C0W"]["value"], 0.05, 1e-15);
}

TEST_F(MachineCommand, DenavitHartenbergIsItsZeroPosition) {
  file("q.csv", "X[mm],Y[mm],Z[mm],A[deg],C[deg]\n0,0,0,0,0\n100,-50,30,-35,70\n");
  ASSERT_EQ(command("machine import " + data + "vmc50_dh.toml -o zero.toml").exit_code, 0);
  const auto dh = rows_of(command("machine pose --machine " + data + "vmc50_dh.toml q.csv").out),
             zero = rows_of(command("machine pose --machine zero.toml q.csv").out);
  ASSERT_EQ(dh.size(), 2u);
  ASSERT_EQ(zero.size(), 2u);
  for (std::size_t row = 0; row < 2; ++row)
    for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(dh[row][i], zero[row][i], 1e-12);
  expect_input_error("machine import zero.toml -o again.toml", "zero-position form already");
  expect_input_error("machine import zero.toml -o zero.toml --force", "zero-position form already");
}

// Written for another control with either sign and read back with it, nothing is lost but the
// straight line between two of 1001 points.
TEST_F(MachineCommand, OtherMakersTablesGoThereAndBack) {
  const std::string positions = data + "trunnion_ac_positions.csv";
  const auto before = only_row("machine pose --machine " + machine + positions + errors);
  for (const char* sign : {"moving_part", "tool_minus_workpiece"}) {
    for (const char* format : {"isg", "etalon"}) {
      const std::string name = std::string(sign) + (format[0] == 'i' ? ".csv" : ".txt");
      const CommandStreams written =
          command("machine errors --machine " + machine + errors + " --points 1001 --format " +
                  format + " --output-sign " + sign + " -o " + name);
      ASSERT_EQ(written.exit_code, 0);
      EXPECT_TRUE(contains(written.out, "linear between them: each error is off by"))
          << written.out;
      // None of these formats has the reference of X; its errors are few: without it C turns about
      // 0 instead of z = -100, of which ECX knows nothing.
      expect_row(
          "machine pose --machine " + machine + positions + " --errors " + name + " --sign " + sign,
          before, 2e-7);
      expect_input_error("machine pose --machine " + machine + positions + " --errors " + name,
                         "does not state the sign");
    }
  }
}

TEST_F(MachineCommand, DenavitHartenbergWithErrors) {
  std::string dh = read_text(data + "vmc50_dh.toml");
  const std::string row = "a_mm = 40\n";
  dh.insert(dh.find(row) + row.size(),
            "theta_error_urad = 80\nd_error_um = 15\na_error_um = -7\nalpha_error_urad = 120\n");
  file("dh.toml", dh);
  file("q.csv", "X[mm],Y[mm],Z[mm],A[deg],C[deg]\n100,-50,30,-35,70\n");
  expect_input_error("machine import dh.toml -o zero.toml", "--errors-output");
  ASSERT_EQ(command("machine import dh.toml -o zero.toml --errors-output errors.toml").exit_code,
            0);
  const auto actual = only_row("machine pose --machine dh.toml q.csv");
  expect_row("machine pose --machine zero.toml q.csv --errors errors.toml", actual, 1e-11);
  const auto nominal = only_row("machine pose --machine zero.toml q.csv");
  EXPECT_GT(std::hypot(actual[0] - nominal[0], actual[1] - nominal[1]), 1e-3);
}

class ForeignTables : public MachineCommand {
 protected:
  /// {value of EXX at X = 50, of EAC at C = 45, of C0C}, mm and rad.
  std::vector<double> values(const std::string& name) {
    const CommandStreams done = command("machine errors --machine " + machine + "--errors " + name +
                                        " --sign moving_part --at X=50,C=45 --json v.json");
    EXPECT_EQ(done.exit_code, 0) << done.err;
    const nlohmann::json json = result("v.json");
    const double rad = std::acos(-1.0) / 180;
    return {json["component"]["EXX"]["value"],
            json["component"]["EAC"]["value"].get<double>() * rad,
            json["location"]["C0C"]["value"].get<double>() * rad};
  }
  void expect_values(const std::string& name) {
    const std::vector<double> wanted{0.002, 4.5e-5, 1.25e-5}, got = values(name);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(got[i], wanted[i], 1e-15) << name << i;
  }
};

TEST_F(ForeignTables, AreReadAsTheirMakersWriteThem) {
  file("e.txt",
       "// vendor\r\n[C0C]\r\nVALUE = 0.0000125\r\n[EXX]\r\nGridpoints = {\r\n   0.0 0.001 // a\r\n"
       "   100.0 0.003\r\n}  // end of EXX\r\n[EAC]\r\nGridpoints = {\r\n0 0\r\n90 9e-5 }\r\n");
  expect_values("e.txt");
  file("e.csv",
       "// location\nC0C X0C\n0.0000125 0.1\n#\nX\tEXX\tEYX\n0.0\t0.001\t0\n100.0\t0.003\t1\n"
       "# next\nC;EAC\n0;0\n90;9e-5\n");
  expect_values("e.csv");
}

TEST_F(ForeignTables, RefuseWhatIsWrong) {
  file("q.csv", "X[mm],Y[mm],Z[mm],A[deg],C[deg]\n0,0,0,0,0\n");
  const std::string pose =
      "machine pose --machine " + machine + "q.csv --sign moving_part --errors ";
  file("e.txt",
       "VALUE = 1\n[EXQ]\nVALUE = 1\n[EXX]\n[Y0X]\nVALUE = 1\n[X0C]\nGridpoints = {\n1 2\n0 1\n}\n"
       "[EYX]\nGridpoints = {\n1 2 3\n");
  expect_all(
      pose + "e.txt",
      {"e.txt:1: is outside a block", "e.txt:2: the block [EXQ] is \"EXQ\", which is not an error",
       "e.txt:4: a block without", "e.txt:6: Y0X has no effect", "e.txt:8: X0C has a VALUE",
       "e.txt:10: arguments must ascend", "e.txt:14: \"1 2 3\" is not a row", "is not closed"});
  file("e.csv",
       "X Z EXX\n0 0 1\n1 0\n#\nX EYY\n0 1\n1 1\n#\nX0C EXX\n1 2\n3 4\n#\nB EXB\n2 1\n1 1\n");
  expect_all(pose + "e.csv",
             {"e.csv:1: Z is a second argument", "e.csv:3: is not a row of 3 numbers",
              "e.csv:5: EYY is not a function of X", "e.csv:9: has no axis as its first column",
              "e.csv:13: B is not an axis of the machine", "e.csv:15: the argument must ascend"});
}

TEST_F(ForeignTables, NeedLimitsAndASign) {
  const std::string tables = " --errors " + data + "trunnion_ac_errors.toml --format isg -o t.csv";
  EXPECT_EQ(command("machine errors --machine " + machine + tables).exit_code, 2);
  std::string free = read_text(data + "trunnion_ac.toml");
  free.erase(free.find("limits_mm"), std::string("limits_mm = [-400, 400]").size());
  file("free.toml", free);
  expect_input_error("machine errors --machine free.toml --output-sign moving_part" + tables,
                     "X needs limits_mm");
}

TEST_F(MachineCommand, NeverWritesOverWhatItReads) {
  file("m.toml", read_text(data + "trunnion_ac.toml"));
  file("q.csv", "X[mm],Y[mm],Z[mm],A[deg],C[deg]\n0,0,0,0,0\n");
  expect_input_error("machine pose --machine m.toml q.csv -o q.csv --force",
                     "is an input of this command");
  expect_input_error("machine errors --machine m.toml --json m.toml --force",
                     "is an input of this command");
  file("mine.csv", "my own table\n");
  EXPECT_EQ(command("machine pose --machine m.toml q.csv -o mine.csv").exit_code, 3);
  EXPECT_EQ(read_text(folder_ / "mine.csv"), "my own table\n");
}

const char* const minimal =
    "schema = \"trueaxis.machine/1\"\nchain = \"w C' A' Y' b X Z t\"\n[program]\nmode = \"axes\"\n";

TEST_F(MachineCommand, RefusesAMachineWithAllThatIsWrong) {
  file("q.csv", "X[mm],Y[mm],Z[mm],A[deg],C[deg]\n0,0,0,0,0\n");
  file("good.toml", minimal);
  EXPECT_EQ(command("machine pose --machine good.toml q.csv").exit_code, 0);
  file("bad.toml",
       "schema = \"trueaxis.machine/1\"\nchain = \"w C A' Y' b X' b U X Z\"\nnam = \"x\"\n"
       "[axes.A]\ndirection = [0, 0, 0]\npoint = [0, 0, 0]\n[axes.Z]\npoint_mm = [0, 0, 1]\n"
       "limits_mm = [5, -5]\n[axes.B]\n[tool]\nlength = 3\n");
  expect_all("machine pose --machine bad.toml q.csv",
             {"bad.toml:2:9: `chain` does not have the tool `t`: end with it", "has two beds `b`",
              "has `C` before the bed", "has `X'` after the bed", "has `U`: the axes are",
              "has the axis X twice", "bad.toml:3:1: the top level has no key `nam`, did you mean",
              "bad.toml:5:13: `direction` has no length", "has no key `point`, did you mean",
              "bad.toml:8:12: `point_mm` has no meaning for a linear axis",
              "`limits_mm` must hold two numbers", "`B` is not an axis of the chain",
              "did you mean `length_mm`", "`program` in the top level is missing"});
  file("nobed.toml", "schema = \"trueaxis.machine/1\"\nchain = \"X Y\"\n[program]\n");
  expect_all("machine pose --machine nobed.toml q.csv",
             {"does not have the bed `b`", "does not have the workpiece `w`",
              "has 2 axes: three to six", "[program] needs `mode`"});
}

TEST_F(MachineCommand, RefusesErrorsWithAllThatIsWrong) {
  file("q.csv", "X[mm],Y[mm],Z[mm],A[deg],C[deg]\n0,0,0,0,0\n");
  file("m.toml", minimal);
  file("bad.toml",
       "schema = \"trueaxis.errors/1\"\nreference_mm.B = [0, 0, 0]\n"
       "[[error]]\nname = \"EXQ\"\nvalue_um = 1\n[[error]]\nname = \"EXB\"\nvalue_um = 1\n"
       "[[error]]\nname = \"EAA\"\nvalue = 1\n[[error]]\nname = \"Y0X\"\nvalue_um = 1\n"
       "[[error]]\nname = \"EXX\"\nkind = \"table\"\nat_mm = [0, 5, 5]\nvalues_um = [1, 2]\n"
       "[[error]]\nname = \"EXX\"\nkind = \"fourier\"\nterms_um = [[1, 2]]\n"
       "[[error]]\nname = \"X0C\"\nkind = \"polynomial\"\ncoefficients_um = [1]\n");
  expect_all(
      "machine pose --machine m.toml q.csv --errors bad.toml",
      {"needs `sign`", "has no key `B`", "bad.toml:4:8: `name` is \"EXQ\", which is not an error",
       "\"EXB\", of an axis this machine does not have", "needs `value_deg`",
       "has no key `value`, did you mean", "must be 0: Y0X has no effect", "must ascend",
       "as many numbers as there are positions", "a list of rows of 3 numbers", "needs `period_mm`",
       "must be \"constant\": X0C"});
  file("one.toml",
       "schema = \"trueaxis.errors/1\"\nsign = \"moving_part\"\n[[error]]\n"
       "name = \"EXX\"\nvalue_um = 1\n");
  file("two.toml",
       "schema = \"trueaxis.errors/1\"\nsign = \"moving_part\"\n[[error]]\n"
       "name = \"EYX\"\nvalue_um = 1\n");
  expect_all("machine pose --machine m.toml q.csv --errors one.toml two.toml",
             {"they come from one file"});
}

TEST_F(MachineCommand, RefusesPositionsWithAllThatIsWrong) {
  file("m.toml", minimal);
  file("q.csv", "X[mm],Y,Z[deg],A[deg],A[deg],B[deg]\n0,0,0,0,0\n0,0,0,0,nan,0\n");
  expect_all("machine pose --machine m.toml q.csv",
             {"q.csv:1: \"Y\" needs its unit: write Y[mm]", "\"Z[deg]\" needs its unit",
              "\"A[deg]\" is given twice", "\"B[deg]\" is not an axis", "has no column C[deg]",
              "q.csv:2: has 5 numbers, the header 6 columns", "q.csv:3: \"nan\""});
  file("cl.csv", "x,y,z,i,j\n0,0,0,0,0\n");
  expect_all("machine inverse --machine m.toml cl.csv", {"has no column k"});
  file("cl0.csv", "x,y,z,i,j,k\n0,0,0,0,0,0\n");
  expect_all("machine inverse --machine m.toml cl0.csv",
             {"cl0.csv:2: has a direction i,j,k of no length"});
  EXPECT_EQ(command("machine errors --machine m.toml --at Q=5").exit_code, 2);
}

}  // namespace
}  // namespace trueaxis::testing
