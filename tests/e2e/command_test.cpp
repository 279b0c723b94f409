// SPDX-License-Identifier: Apache-2.0
// The exit codes of README.md, several cases each, and what the command does with odd places.
#include <cstdlib>

#include "support/command_fixture.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

class ExitCode : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    file("part.csv", csv(probe({.noise_mm = 0.002})));
  }
  int code(const std::string& arguments) { return command(arguments).exit_code; }
};

TEST_F(ExitCode, ZeroWhenDone) {
  file("job.toml", simple_job(cylinder_reference));
  file("identify.toml", std::string("[[reference]]\n") + cylinder_reference);
  file("scenario.toml",
       "[part]\nkind = \"cylinder\"\nradius_mm = 30\n[[pass]]\nz_start_mm = 0\nz_end_mm = 9\n"
       "feed_mm_per_rev = 1\nreadings_per_revolution = 20\n");
  EXPECT_EQ(code("--version"), 0);
  EXPECT_EQ(code("--help"), 0);
  EXPECT_EQ(code("fit --help"), 0);
  EXPECT_EQ(code("fit part.csv --surface cylinder"), 0);
  EXPECT_EQ(code("diagnose part.csv --surface cylinder"), 0);
  EXPECT_EQ(code("advise part.csv --surface cylinder"), 0);
  EXPECT_EQ(code("advise job.toml"), 0);
  EXPECT_EQ(code("run job.toml -o out"), 0);
  EXPECT_EQ(code("run identify.toml -o identified"), 0);
  EXPECT_EQ(code("simulate scenario.toml -o simulated.csv"), 0);
}

TEST_F(ExitCode, OneForARefusal) {
  file("tight.toml", simple_job(cylinder_reference, 600, 0.1));
  file("fast.toml", simple_job(cylinder_reference, 60000));
  EXPECT_EQ(code("run tight.toml -o tight"), 1);
  EXPECT_EQ(code("run fast.toml -o fast"), 1);
  ASSERT_EQ(code("fit part.csv --surface cylinder --json fit.json"), 0);
  EXPECT_EQ(code("table fit.json --ideal --target fast.toml -o table.csv"), 1);
  EXPECT_EQ(code("table fit.json --ideal --target fast.toml --preview"), 1);
}

TEST_F(ExitCode, TwoForUsage) {
  for (const char* arguments : {"",
                                "bogus",
                                "fit",
                                "fit part.csv",
                                "fit part.csv --surface ball",
                                "fit part.csv part.csv --surface cone",
                                "fit part.csv --surface cone --loss cauchy",
                                "fit part.csv --surface cone --noise-um -1",
                                "fit part.csv --surface cone --noise-um nan",
                                "fit part.csv --surface cone --ball-radius-mm inf",
                                "fit part.csv --surface cone --coverage-factor 0",
                                "fit part.csv --surface cone --relative --nominal-radius-mm -3",
                                "fit part.csv --surface cone --diameter --radius",
                                "fit part.csv --surface cone --json - --residuals -",
                                "fit part.csv --surface cone --json same --residuals same",
                                "diagnose part.csv",
                                "diagnose part.csv --surface sphere",
                                "diagnose part.csv --surface cone --false-alarm 0",
                                "diagnose part.csv --surface cone --false-alarm 0.6",
                                "diagnose part.csv --surface cone --json - --residuals -",
                                "advise",
                                "advise part.csv",
                                "run",
                                "table",
                                "table fit.json --target t.toml",
                                "table fit.json --target t.toml --preview -o table.csv",
                                "table fit.json --ideal --diagnosis d.json --target t.toml -o t",
                                "run job.toml -o ''",
                                "fit part.csv --surface cone --json ''",
                                "simulate",
                                "simulate s.toml --seed x -o s.csv"}) {
    const auto before = files_in(folder_);
    const CommandStreams done = command(arguments);
    EXPECT_EQ(done.exit_code, 2) << arguments;
    EXPECT_EQ(done.out, "") << arguments;
    EXPECT_NE(done.err, "") << arguments;
    EXPECT_LT(done.err.size(), 3000u) << arguments;  // a page of help, no dump
    EXPECT_EQ(files_in(folder_), before) << arguments;
  }
}

TEST_F(ExitCode, TwoForACommandThatIsNone) {
  const CommandStreams done = command("diagnoze part.csv --surface cone");
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_EQ(done.err,
            "trueaxis has no command diagnoze, did you mean diagnose?\n"
            "trueaxis --help lists all.\n");
  EXPECT_TRUE(contains(command("zzzzzz").err, "trueaxis has no command zzzzzz\n"));
  EXPECT_TRUE(contains(command("fit part.csv").err, "--surface is required"));
}

TEST_F(ExitCode, ThreeForInput) {
  file("face.csv", "Z_M,C,X\n5,0,20\n5,120,20\n5,240,20\n5,300,10\n");
  file("job.toml", simple_job("stream = \"gone.csv\"\nsurface = \"cone\"\n"));
  expect_input_error("fit gone.csv --surface cone --json f.json", "gone.csv: cannot be read");
  expect_input_error("fit . --surface cone --json f.json", "is a folder");
  expect_input_error("fit - --surface cone --json f.json", "-: is empty");
  expect_input_error("fit face.csv --surface cone --json f.json", "--surface plane");
  expect_input_error("fit part.csv --surface plane --json f.json", "Z_M,C,X");
  expect_input_error("diagnose gone.csv --surface cone --json f.json", "gone.csv: cannot be read");
  expect_input_error("diagnose face.csv --surface cone --json f.json", "--surface plane");
  expect_input_error("advise job.toml", "gone.csv: cannot be read");
  expect_input_error("advise gone.toml", "gone.toml: cannot be read");
  expect_input_error("run job.toml -o out", "gone.csv: cannot be read");
  expect_input_error("run gone.toml -o out", "gone.toml: cannot be read");
  expect_input_error("table part.csv --target job.toml -o table.csv", "trueaxis.fit/1");
  expect_input_error("simulate job.toml -o stream.csv", "has no key `reference`");
}

TEST_F(ExitCode, FourWhenNotDetermined) {
  file("section.csv", csv(probe({.sections = 1})));
  file("job.toml", simple_job("stream = \"part.csv\"\nsurface = \"cone\"\n"));
  EXPECT_EQ(code("fit part.csv --surface cone"), 4);
  EXPECT_EQ(code("fit section.csv --surface cylinder"), 4);
  EXPECT_EQ(code("diagnose part.csv --surface cone --json d.json"), 4);
  EXPECT_EQ(result("d.json").at("baseline").at("status"), "rank_deficient");
  EXPECT_EQ(code("advise part.csv --surface cone"), 4);
  EXPECT_EQ(code("run job.toml -o out"), 4);
}

TEST_F(ExitCode, OutputThatCannotBeWritten) {
  file("job.toml", simple_job(cylinder_reference));
  file("a_file", "");
  expect_input_error("run job.toml -o a_file", "a_file");
  expect_input_error("run job.toml -o a_file/below", "cannot be written");
  expect_input_error("fit part.csv --surface cylinder --json .", "it is a folder");
  expect_input_error("fit part.csv --surface cylinder --residuals good --json a_file/f.json",
                     "cannot be written");
  if (std::filesystem::exists("/dev/full")) {
    EXPECT_EQ(code("fit part.csv --surface cylinder --json - > /dev/full"), 3);
    EXPECT_EQ(code("fit part.csv --surface cylinder > /dev/full"), 3);
  }
}

TEST_F(ExitCode, AFolderIsMadeAndBlanksAndLinksAreKept) {
  file("a job.toml", simple_job(cylinder_reference));
  EXPECT_EQ(code("run 'a job.toml' -o 'new folder'"), 0);
  EXPECT_TRUE(there("new folder/table.csv"));
  file("kept.json", "");
  std::filesystem::create_symlink("kept.json", folder_ / "link.json");
  EXPECT_EQ(code("fit part.csv --surface cylinder --json link.json"), 0);
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "link.json"));
  EXPECT_EQ(result("kept.json").at("schema"), "trueaxis.fit/1");
  // A pipe is written to, not replaced by a file.
  EXPECT_EQ(shell("cd " + shell_word(folder_) + " && mkfifo pipe && (cat pipe > read.json & ) && " +
                  shell_word(places::command()) + " fit part.csv --surface cylinder --json pipe")
                .exit_code,
            0);
  EXPECT_TRUE(std::filesystem::is_fifo(folder_ / "pipe"));
}

TEST_F(ExitCode, AFileNameThatIsNoTextIsNoBug) {
  std::filesystem::rename(folder_ / "part.csv", folder_ / "\xff.csv");
  const CommandStreams done = command("fit '\xff.csv' --surface cylinder --json -");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(nlohmann::json::accept(done.out));
}

}  // namespace
}  // namespace trueaxis::testing
