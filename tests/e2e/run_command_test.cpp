// SPDX-License-Identifier: Apache-2.0
// `trueaxis run` and `correct`: verdict, table only when it may be run, the same bytes every time.
#include <cmath>
#include <cstdio>
#include <sstream>

#include "support/command_fixture.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

using nlohmann::json;

class RunCommand : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    file("part.csv", csv(probe({.noise_mm = 0.002})));
  }
};

const std::vector<std::string> all_results{"diagnosis_1_cylinder.json", "readings_1_cylinder.csv",
                                           "report.html", "result.json", "table.csv"};

/// ObservationMask of a table without its header, whose numbers may be rounded otherwise.
std::string rows_of(const std::string& table) { return table.substr(table.find("\nrev,")); }

TEST_F(RunCommand, GoWithTableResultAndReport) {
  file("job.toml", "name = \"seat\"\n" + simple_job(cylinder_reference));
  const CommandStreams done = command("run job.toml -o out");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(done.err, "");
  EXPECT_EQ(done.out.substr(0, 4), "GO: ");
  EXPECT_EQ(files_in(folder_ / "out"), all_results);
  const json found = result("out/result.json");
  EXPECT_EQ(found.at("schema"), "trueaxis.run/2");
  EXPECT_EQ(found.at("job"), "seat");
  EXPECT_TRUE(found.at("verdict").at("go").get<bool>());
  EXPECT_EQ(found.at("verdict").at("line"), first_line(done.out));
  EXPECT_EQ(found.at("references").at(0).at("fit").at("schema"), "trueaxis.fit/1");
  // 0.1 mm off, untilted: 200 µm of coaxiality; u of the offset is 2 µm / sqrt(72) = 0.24 µm.
  EXPECT_NEAR(found.at("verdict").at("coaxiality_before").at("value").get<double>(), 0.2, 0.003);
  const std::string table = read_text(folder_ / "out/table.csv");
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(rows_of(table), '\n')) - 2,
            found.at("correction").at("rows").get<std::size_t>());
}

TEST_F(RunCommand, ToleranceThatUExceedsIsNotProven) {
  file("job.toml", simple_job(cylinder_reference, 600, 0.1));
  std::filesystem::create_directories(folder_ / "out");
  file("out/table.csv", earlier_table);
  const CommandStreams done = command("run job.toml -o out");
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_EQ(done.out.substr(0, 12), "NOT PROVEN: ");
  EXPECT_TRUE(contains(first_line(done.out), "tolerance 0.1")) << first_line(done.out);
  EXPECT_EQ(files_in(folder_ / "out"),
            (std::vector<std::string>{"diagnosis_1_cylinder.json", "readings_1_cylinder.csv",
                                      "report.html", "result.json", "table.csv.kept"}));
}

TEST_F(RunCommand, ActuatorThatCannotFollow) {
  std::filesystem::create_directories(folder_ / "out");
  file("out/table.csv", earlier_table);
  file("job.toml", simple_job(cylinder_reference, 60000));
  const CommandStreams done = command("run job.toml -o out");
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_EQ(first_line(done.out).rfind("NO-GO: the actuator cannot follow: ", 0), 0u) << done.out;
  EXPECT_FALSE(there("out/table.csv"));
  // Once a revolution at 60000 rpm is 1000 Hz, the second harmonic 2000 Hz: beyond the 606 Hz
  // piezo.
  EXPECT_TRUE(contains(first_line(done.out), "frequency 2000 Hz of a bandwidth of 606 Hz"));
  // 0.1 mm at 200 mm/s is 2000 rad/s at the most, 19099 rpm.
  const json margin = result("out/result.json").at("correction").at("margin");
  const double rpm = margin.at("max_speed").at("value").get<double>();
  EXPECT_GT(rpm, 600.0);
  EXPECT_LT(rpm, 19100.0);
  char speed[64];
  std::snprintf(speed, sizeof speed, "it can follow at %.0f rpm or less", std::floor(rpm));
  EXPECT_TRUE(contains(first_line(done.out), speed)) << first_line(done.out);
  EXPECT_FALSE(margin.at("follows").get<bool>());
  EXPECT_TRUE(contains(margin.at("breaks"), "bandwidth"));
  // The speed that was named is one at which the job runs.
  file("slower.toml", simple_job(cylinder_reference, std::floor(0.999 * rpm)));
  EXPECT_EQ(command("run slower.toml -o out").exit_code, 0);
  EXPECT_TRUE(there("out/table.csv"));
}

TEST_F(RunCommand, ARefusalLeavesNoEarlierTable) {
  std::filesystem::create_directories(folder_ / "out");
  file("out/table.csv", earlier_table);
  file("job.toml", simple_job(cylinder_reference) + "tool_height_mm = 40\n");
  const CommandStreams done = command("run job.toml -o out");
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_EQ(done.err.rfind("refused: the tool's line misses the target surface", 0), 0u);
  const json found = result("out/result.json");
  EXPECT_FALSE(found.at("verdict").at("go").get<bool>());
  EXPECT_EQ(found.at("verdict").at("line"), first_line(done.out));
  EXPECT_EQ(first_line(done.out).rfind("NO-GO: the tool's line misses the target surface", 0), 0u);
  EXPECT_TRUE(contains(read_text(folder_ / "out/report.html"), "\"outcome\":\"no-go\""));
  EXPECT_FALSE(there("out/table.csv"));
  // Nothing says that it is not the user's.
  EXPECT_EQ(read_text(folder_ / "out/table.csv.kept"), earlier_table);
  EXPECT_TRUE(contains(done.err + done.out, "keeps it as out/table.csv.kept"))
      << done.err << done.out;
}

TEST_F(RunCommand, ATableThatWasEditedIsKeptBesideTheNewOne) {
  file("job.toml", simple_job(cylinder_reference));
  ASSERT_EQ(command("run job.toml -o out").exit_code, 0);
  const std::string table = read_text(folder_ / "out/table.csv");
  file("out/table.csv", table + "# mine\n");
  const CommandStreams again = command("run job.toml -o out");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(contains(again.err, "keeps it as out/table.csv.kept")) << again.err;
  EXPECT_EQ(read_text(folder_ / "out/table.csv.kept"), table + "# mine\n");
  EXPECT_EQ(read_text(folder_ / "out/table.csv"), table);
  EXPECT_EQ(command("run job.toml -o out").err, "");  // not again: nobody changed it since
}

TEST_F(RunCommand, TheSameBytesEveryTime) {
  const std::string job = shell_word(places::source() + "/data/jobs/shaft.toml");
  for (const char* folder : {"first", "second"})
    ASSERT_EQ(command(std::string("run ") + job + " -o " + folder).exit_code, 0);
  ASSERT_EQ(command(std::string("run ") + job + " -o second").exit_code,
            0);  // over its own results
  const std::vector<std::string> names = files_in(folder_ / "first");
  for (const std::string& name : names) {
    EXPECT_EQ(read_text(folder_ / "first" / name), read_text(folder_ / "second" / name)) << name;
  }
  EXPECT_EQ(files_in(folder_ / "second"), names);
  EXPECT_EQ(names, (std::vector<std::string>{
                       "diagnosis_1_cone_seat.json", "diagnosis_2_cylinder_seat.json",
                       "readings_1_cone_seat.csv", "readings_2_cylinder_seat.csv", "report.html",
                       "result.json", "table.csv"}));
}

TEST_F(RunCommand, TwoAtOnceIntoOneFolder) {
  file("job.toml", simple_job(cylinder_reference));
  const std::string run = shell_word(places::command()) + " run job.toml -o ";
  const auto both = shell("cd " + shell_word(folder_) + " && " + run + "alone >alone.txt && (" +
                          run + "out >1.txt & " + run + "out >2.txt & wait)");
  ASSERT_EQ(both.exit_code, 0) << both.output;
  EXPECT_EQ(files_in(folder_ / "out"), all_results);
  for (const std::string& name : all_results)
    EXPECT_EQ(read_text(folder_ / "alone" / name), read_text(folder_ / "out" / name)) << name;
}

TEST_F(RunCommand, EachReferenceHasItsDiagnosis) {
  file("job.toml", simple_job(cylinder_reference));
  ASSERT_EQ(command("run job.toml -o out").exit_code, 0);
  ASSERT_EQ(command("diagnose part.csv --surface cylinder --json alone.json").exit_code, 0);
  json of_job = result("out/diagnosis_1_cylinder.json"), alone = result("alone.json");
  EXPECT_EQ(of_job.at("schema"), "trueaxis.diagnosis/3");
  for (json* diagnosis : {&of_job, &alone}) {  // the job names its stream by another path
    diagnosis->at("input").erase("file");
    for (const char* fit : {"baseline", "extended"}) diagnosis->at(fit).at("input").erase("file");
  }
  alone.erase("form");  // of a job in result.json
  EXPECT_EQ(of_job, alone);
  const json summary = result("out/result.json").at("references").at(0).at("diagnosis");
  EXPECT_EQ(summary.at("verdict"), alone.at("verdict"));
  EXPECT_EQ(summary.at("file"), "diagnosis_1_cylinder.json");
  EXPECT_EQ(summary.at("axis_of_the_correction"), "ideal surface");
}

TEST_F(RunCommand, OnlyRepeatingMotionsMayBeAskedFor) {
  for (const char* id : {"probe.height", "part.roundness", "spindle.asynchronous", "bogus"}) {
    file("job.toml", simple_job(cylinder_reference) + "[correction]\ninclude = [\"" + id + "\"]\n");
    expect_input_error("run job.toml -o out", std::string("contains '") + id + "'");
  }
  file("job.toml", simple_job(cylinder_reference) +
                       "[correction]\ninclude = [\"spindle.radial_synchronous\"]\n");
  const CommandStreams done = command("run job.toml -o out");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(contains(done.out, "not followed spindle.radial_synchronous: it was not found"));
  EXPECT_EQ(result("out/result.json").at("included").at(0).at("included"), false);
}

/// The job's target axis is taken at the middle of the cut: 1e-7 mm is the last digit of a row.
void expect_same_rows(const std::string& table, const std::string& as) {
  std::istringstream one(rows_of(table)), other(rows_of(as));
  std::string left, right;
  std::size_t rows = 0;
  while (std::getline(one, left) && std::getline(other, right)) {
    if (left.empty() || left[0] == 'r') continue;
    ++rows;
    const double a = std::stod(left.substr(left.rfind(',') + 1)),
                 b = std::stod(right.substr(right.rfind(',') + 1));
    ASSERT_NEAR(a, b, 1.5e-7) << left << '\n' << right;
  }
  EXPECT_GE(rows, 360u * 40u);  // 4 mm at 0.1 mm a revolution
}

class CorrectCommand : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    file("part.csv", csv(probe({.noise_mm = 0.002})));
    file("job.toml", simple_job(cylinder_reference));
    ASSERT_EQ(command("fit part.csv --surface cylinder --json fit.json").exit_code, 0);
    ASSERT_EQ(command("diagnose part.csv --surface cylinder --json d.json").exit_code, 0);
  }
};

TEST_F(CorrectCommand, PreviewWritesNothing) {
  const auto before = files_in(folder_);
  const CommandStreams done = command("table fit.json --ideal --target job.toml --preview");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(contains(done.out, "harmonics"));
  EXPECT_EQ(files_in(folder_), before);
}

TEST_F(CorrectCommand, AFitHasItsDiagnosisBesideItOrSaysThatItHasNone) {
  const std::string table = command("table d.json --target job.toml -o -").out;
  ASSERT_FALSE(table.empty());
  const CommandStreams beside = command("table fit.json --diagnosis d.json --target job.toml -o -");
  EXPECT_EQ(beside.out, table) << beside.err;
  const CommandStreams ideal = command("table fit.json --ideal --target job.toml -o -");
  // Nothing was found: the axis is that of the ideal fit, its u without what the passes do not
  // show.
  const auto without_u = [](std::string text) {
    const std::size_t line = text.find("# target_axis"), u = text.find(", u ", line);
    text.erase(u, text.find('\n', u) - u);
    const std::size_t checksum = text.find("# checksum");  // u is in it
    return text.erase(checksum, text.find('\n', checksum) - checksum);
  };
  EXPECT_EQ(without_u(ideal.out), without_u(table));
  EXPECT_TRUE(contains(ideal.err, "relies on the ideal fit alone")) << ideal.err;
  const CommandStreams bare = command("table fit.json --target job.toml -o -");
  EXPECT_EQ(bare.exit_code, 1);
  EXPECT_EQ(bare.out, "");
  EXPECT_TRUE(contains(bare.err, "nothing looked for slips")) << bare.err;
}

// The material between the cone and the target comes from the radius at mid length, which a fit
// that is read back has too.
TEST_F(CorrectCommand, OfAConeItKnowsTheStock) {
  const std::string stream = places::source() + "/data/streams/shaft_cone_seat.csv";
  const std::string target =
      "[target]\nsurface = \"cylinder\"\nradius_mm = 24\nz_start_mm = 40\nz_end_mm = 10\n"
      "coaxiality_tolerance_um = 20\nstock_um = ";
  const std::string cut = "\n[cut]\nspeed_rpm = 600\nsense = \"+c\"\nfeed_mm_per_rev = 0.1\n";
  ASSERT_EQ(
      command("diagnose " + stream + " --surface cone --loss tukey --json cone.json").exit_code, 0);
  file("little.toml", target + "1" + cut);
  const CommandStreams little = command("table cone.json --target little.toml -o cone.csv");
  EXPECT_EQ(little.exit_code, 1) << little.err;
  EXPECT_TRUE(contains(little.err, "stock")) << little.err;
  file("much.toml", target + "20000" + cut);
  const CommandStreams much = command("table cone.json --target much.toml -o cone.csv");
  EXPECT_EQ(much.exit_code, 0) << much.err;
  EXPECT_TRUE(there("cone.csv"));
}

TEST_F(CorrectCommand, TableIsThatOfTheWholeJob) {
  ASSERT_EQ(command("run job.toml -o out").exit_code, 0);
  std::filesystem::create_directories(folder_ / "a/b c");
  ASSERT_EQ(command("table d.json --target job.toml -o 'a/b c/table.csv'").exit_code, 0);
  const CommandStreams printed = command("table d.json --target job.toml -o -");
  EXPECT_EQ(printed.exit_code, 0);
  EXPECT_EQ(printed.out, read_text(folder_ / "a/b c/table.csv"));
  EXPECT_EQ(printed.out, command("table - --target job.toml -o - < d.json").out);
  EXPECT_EQ(printed.out, command("table d.json --target - -o - < job.toml").out);
  expect_same_rows(printed.out, read_text(folder_ / "out/table.csv"));
}

// What is known is in the diagnosis: the table needs it no second time.
TEST_F(CorrectCommand, TableIsThatOfTheWholeJobWhereSomethingIsKnown) {
  file("known.toml", simple_job(cylinder_reference) +
                         "[sensor]\nheight_mm = 0.2\nu_height_mm = 0.01\ngain = 0.01\n"
                         "u_gain = 0.002\n");
  ASSERT_EQ(command("run known.toml -o out").exit_code, 0);
  ASSERT_EQ(command("diagnose part.csv --surface cylinder --known height_mm=0.2±0.01 --known "
                    "gain=0.01±0.002 --json known.json")
                .exit_code,
            0);
  const CommandStreams printed = command("table known.json --target job.toml -o -");
  EXPECT_EQ(printed.exit_code, 0) << printed.err;
  expect_same_rows(printed.out, read_text(folder_ / "out/table.csv"));
  EXPECT_EQ(command("simulate --from known.json --compare").exit_code, 0);
}

TEST_F(CorrectCommand, RefusalNamesNumberAndSpeedAndLeavesNoTable) {
  file("fast.toml", simple_job(cylinder_reference, 60000));
  file("table.csv", earlier_table);
  const CommandStreams done = command("table d.json --target fast.toml -o table.csv");
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_TRUE(contains(done.err, "refused: the actuator cannot follow: ")) << done.err;
  EXPECT_TRUE(contains(done.err, "slew")) << done.err;
  EXPECT_TRUE(contains(done.err, " rpm or less")) << done.err;
  EXPECT_FALSE(there("table.csv"));
}

}  // namespace
}  // namespace trueaxis::testing
