// SPDX-License-Identifier: Apache-2.0
// `trueaxis run` of a machine's job: errors found, program compensated, verdict; judged by the
// machine that the job does not know.
#include <algorithm>
#include <cmath>

#include "machine/files/errors_files.hpp"
#include "machine/files/machine_toml.hpp"
#include "support/command_fixture.hpp"
#include "support/part_alignment.hpp"
#include "support/places.hpp"
#include "support/twelve_holes.hpp"

namespace trueaxis::testing {
namespace {

class MachineJobCommand : public CommandTest {
 protected:
  static std::string of_data(const std::string& name) {
    return std::string(places::source() + "/data/five_axis/").append(name);
  }
  /// The job of data/jobs/blade.toml with other tables for [program] and [part].
  void job(const std::string& program_keys, const std::string& part = "") {
    std::string text = "name = \"blade\"\n[machine]\nfile = \"";
    text.append(of_data("zxacy.toml")).append("\"\n[measure]\ndata = [\"");
    text.append(of_data("zxacy_ball.csv")).append("\"]\n[program]\nfile = \"");
    text.append(of_data("blade.nc")).append("\"\n").append(program_keys).append("\n").append(part);
    file("job.toml", text);
  }
  static double um(const nlohmann::json& of) { return 1e3 * of.at("value").get<double>(); }
};

/// Largest tip error of a program by the hidden machine, the part's displacement subtracted, µm.
double by_truth_um(const std::vector<FiveAxes>& ends, const std::vector<FiveAxes>& wanted) {
  const std::string folder = places::source() + "/data/five_axis/";
  const Machine machine = read_machine_toml(folder + "zxacy.toml").machine;
  const ErrorModel truth = read_errors_toml(folder + "zxacy_errors.toml", machine), none;
  const Setting setting = first_setting(machine);
  const auto tip = [&](const FiveAxes& at, const ErrorModel& errors) {
    AxisPositions q{at[0], at[1], at[2], at[3] * rad_per_deg, 0.0, at[4] * rad_per_deg};
    return tip_of(ChainMatrices{machine, errors}.tool_in_part(q, setting));
  };
  std::vector<Vector3> points, off;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const Vector3 is = tip(ends[i], truth), want = tip(wanted[i], none);
    points.push_back(want);
    off.push_back({is[0] - want[0], is[1] - want[1], is[2] - want[2]});
  }
  return 1e3 * largest_norm(without_rigid_body(points, off));
}

// U is k = 2; three standard uncertainties are 1.5 U. The job's `after` has the rounding of the
// words. What the rigid body takes off is the displacement that held errors give the part.
TEST_F(MachineJobCommand, TheBladeIsTruerByTheMachineThatWasHidden) {
  job("");
  const CommandStreams done = command("run job.toml -o out");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(done.out.rfind("DONE, no tolerance given: tip off by at most ", 0), 0U) << done.out;
  EXPECT_EQ(files_in(folder_ / "out"),
            (std::vector<std::string>{"blade_compensated.nc", "compensation.json", "diagnosis.json",
                                      "errors.toml", "report.html", "result.json"}));
  const nlohmann::json verdict = result("out/result.json").at("verdict");
  const std::vector<FiveAxes> source = ends_of_moves(read_text(of_data("blade.nc"))),
                              made = ends_of_moves(read_text(folder_ / "out/blade_compensated.nc"));
  ASSERT_EQ(source.size(), made.size());
  ASSERT_GT(source.size(), 500U);
  const double U_um = um(verdict.at("U_without_place_of_part")),
               before_um = by_truth_um(source, source), after_um = by_truth_um(made, source);
  EXPECT_GT(U_um, 0.1);
  EXPECT_LT(U_um, 2.0);  // σ = 1 µm of 360 numbers
  EXPECT_NEAR(um(verdict.at("tip_before")), before_um, 1.5 * U_um);
  EXPECT_LT(after_um, um(verdict.at("tip_after")) + 1.5 * U_um);
  EXPECT_LT(after_um, 0.05 * before_um);
  const nlohmann::json findings = result("out/diagnosis.json").at("findings");
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].at("effect"), "EXC.harmonic2");
  const std::string pose =
      "machine pose --machine " + of_data("zxacy.toml") + " p.csv --errors out/errors.toml";
  file("p.csv", positions_csv({source[0]}));
  EXPECT_EQ(command(pose).exit_code, 0);
}

// Between its blocks the blade's program leaves the line by 0.2 mm: no go until they are cut in
// pieces; then the tolerance against left + U decides, and a program is there with a go only.
TEST_F(MachineJobCommand, TheToleranceDecides) {
  job("", "[part]\ntolerance_um = 30\n");
  const CommandStreams whole = command("run job.toml -o out");
  EXPECT_EQ(whole.exit_code, 1);
  EXPECT_EQ(whole.out.rfind("NO-GO: tip off by at most ", 0), 0U) << whole.out;
  EXPECT_TRUE(contains(whole.out, "[program] tolerance_um = ")) << whole.out;
  EXPECT_FALSE(there("out/blade_compensated.nc"));
  EXPECT_EQ(result("out/result.json").at("files").at("program"), nullptr);

  job("tolerance_um = 5", "[part]\ntolerance_um = 8\n");
  const CommandStreams pieces = command("run job.toml -o out");
  EXPECT_EQ(pieces.exit_code, 0) << pieces.out;
  EXPECT_EQ(pieces.out.rfind("GO: tip off by at most ", 0), 0U) << pieces.out;
  EXPECT_TRUE(there("out/blade_compensated.nc"));
  const nlohmann::json verdict = result("out/result.json").at("verdict");
  EXPECT_EQ(verdict.at("decision"), "go");
  EXPECT_LE(um(verdict.at("tip_at_most")), 8.0);
  EXPECT_NEAR(um(verdict.at("tip_at_most")),
              um(verdict.at("between_blocks_after")) + um(verdict.at("U_without_place_of_part")),
              1e-9);

  const double halfway_um =
      um(verdict.at("between_blocks_after")) + 0.5 * um(verdict.at("U_without_place_of_part"));
  job("tolerance_um = 5", "[part]\ntolerance_um = " + std::to_string(halfway_um) + "\n");
  const CommandStreams open = command("run job.toml -o out");
  EXPECT_EQ(open.exit_code, 1);
  EXPECT_EQ(open.out.rfind("NOT PROVEN: ", 0), 0U) << open.out;
  EXPECT_FALSE(there("out/blade_compensated.nc")) << "an earlier one must not be run any more";
}

// The first cut of this blade has no known way, and the verdict is of the tip: its direction, which
// comes out worse, is a note.
TEST_F(MachineJobCommand, SaysWhatItsVerdictDoesNotCount) {
  std::string blade = read_text(of_data("blade.nc"));
  const std::size_t rapid = blade.find("G0 ");
  file("blade.nc", blade.erase(rapid, blade.find('\n', rapid) + 1 - rapid));
  job("tolerance_um = 5", "[part]\ntolerance_um = 20\n");
  std::string text = read_text(folder_ / "job.toml");
  text.replace(text.find(of_data("blade.nc")), of_data("blade.nc").size(), "blade.nc");
  file("job.toml", text);
  const CommandStreams done = command("run job.toml -o out");
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  const nlohmann::json verdict = result("out/result.json").at("verdict");
  EXPECT_EQ(verdict.at("decision"), "go_with_reservations");
  ASSERT_EQ(verdict.at("reserved").size(), 1u) << verdict.dump(1);
  EXPECT_EQ(verdict.at("reserved")[0].at("code"), "ways_not_counted");
  EXPECT_TRUE(contains(verdict.at("remarks").dump(), "direction comes out worse")) << done.out;
}

TEST_F(MachineJobCommand, WithoutAProgramItEndsWithTheErrors) {
  std::string text = "[machine]\nfile = \"";
  file("job.toml", text.append(of_data("zxacy.toml"))
                       .append("\"\n[measure]\ndata = [\"")
                       .append(of_data("zxacy_ball.csv"))
                       .append("\"]\n"));
  const CommandStreams done = command("run job.toml -o out");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(done.out.rfind("DONE: errors of the machine identified", 0), 0U) << done.out;
  EXPECT_EQ(files_in(folder_ / "out"), (std::vector<std::string>{"diagnosis.json", "errors.toml",
                                                                 "report.html", "result.json"}));
  const std::string diagnose = "machine diagnose " + of_data("zxacy_ball.csv") + " --machine " +
                               of_data("zxacy.toml") + " --json d.json";
  ASSERT_EQ(command(diagnose).exit_code, 0);
  EXPECT_EQ(read_text(folder_ / "d.json"), read_text(folder_ / "out/diagnosis.json"));
}

// The new program is that of `compensate` with the errors of the job, byte for byte.
TEST_F(MachineJobCommand, TheProgramIsThatOfCompensate) {
  job("tolerance_um = 10\ndecimals = 5\nmethod = \"differential\"");
  ASSERT_EQ(command("run job.toml -o out").exit_code, 0);
  const std::string compensate =
      "machine compensate " + of_data("blade.nc") + " --machine " + of_data("zxacy.toml") +
      " --errors out/errors.toml -o cut.nc --method differential --tolerance-um 10 --decimals 5";
  ASSERT_EQ(command(compensate).exit_code, 0);
  EXPECT_EQ(read_text(folder_ / "cut.nc"), read_text(folder_ / "out/blade_compensated.nc"));
}

TEST_F(MachineJobCommand, TheSameBytesEveryTime) {
  job("tolerance_um = 10", "[part]\ntolerance_um = 20\n");
  for (const char* folder : {"first", "second", "second"})
    ASSERT_EQ(command(std::string("run job.toml -o ") + folder).exit_code, 0);
  ASSERT_GE(files_in(folder_ / "first").size(), 3u);
  for (const std::string& name : files_in(folder_ / "first"))
    EXPECT_EQ(read_text(folder_ / "first" / name), read_text(folder_ / "second" / name)) << name;
}

// Errors that were known before are added to, and their u counts.
TEST_F(MachineJobCommand, KnownErrorsAreKeptAndTheirUCounts) {
  job("");
  ASSERT_EQ(command("run job.toml -o out").exit_code, 0);
  const double without_um =
      um(result("out/result.json").at("verdict").at("U_without_place_of_part"));
  const std::string known =
      "schema = \"trueaxis.errors/1\"\nsign = \"moving_part\"\n[[error]]\nname = \"EXC\"\n"
      "kind = \"fourier\"\nterms_um = [[2, 0, 0]]\nu_um = 3\n";
  file("known.toml", known);
  std::string text = read_text(folder_ / "job.toml");
  const std::string before = "[measure]";
  text.replace(text.find(before), before.size(), "errors = [\"known.toml\"]\n[measure]");
  file("job.toml", text);
  ASSERT_EQ(command("run job.toml -o out").exit_code, 0);
  EXPECT_TRUE(contains(read_text(folder_ / "out/errors.toml"), "u_um = 3"));
  // A constant along X of the bed turns with C in the part: no rigid body takes it off. Along Z,
  // the axis of C, it would.
  EXPECT_GT(um(result("out/result.json").at("verdict").at("U_without_place_of_part")),
            without_um + 1.0);
  text = known;
  text.replace(text.find("EXC"), 3, "EZC");
  file("known.toml", text);
  ASSERT_EQ(command("run job.toml -o out").exit_code, 0);
  EXPECT_LT(um(result("out/result.json").at("verdict").at("U_without_place_of_part")),
            without_um + 0.1);
}

TEST_F(MachineJobCommand, TheShippedMeasurementIsThatOfItsScenario) {
  ASSERT_EQ(command("machine simulate " + of_data("zxacy_ball.toml") + " -o ball.csv").exit_code,
            0);
  EXPECT_EQ(read_text(folder_ / "ball.csv"), read_text(of_data("zxacy_ball.csv")));
}

TEST_F(MachineJobCommand, TheDemonstrationIsAGoJudgedByTheHiddenMachine) {
  const std::string source = places::source();
  const CommandStreams done = command("run " + source + "/data/jobs/blade.toml -o out");
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  EXPECT_EQ(done.out.rfind("GO: ", 0), 0U) << done.out;
}

}  // namespace
}  // namespace trueaxis::testing
