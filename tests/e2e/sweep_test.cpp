// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <thread>

#include "support/command_fixture.hpp"
#include "support/places.hpp"

/// `trueaxis study sweep` as a process: the same bytes whatever happens to it.
namespace trueaxis::testing {
namespace {

namespace fs = std::filesystem;

class SweepCommand : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    file("sweep.toml", sweep_text(40));
  }

  /// 4 cells, two blocks of each at least.
  static std::string sweep_text(int repeats) {
    return "seed = 3\nrepeats = " + std::to_string(repeats) +
           "\nmethods = [\"fit\", \"tukey\"]\n[part]\nkind = \"cone\"\nk_mm = -150\nhalf_angle_deg "
           "= 10\n"
           "x0_mm = 0.1\n[noise]\nsigma_um = 5\n[[pass]]\nz_start_mm = 0\nz_end_mm = 30\n"
           "readings_per_revolution = 9.3\n[[axis]]\nkey = \"noise.sigma_um\"\nvalues = [2, 10]\n";
  }

  std::string text(const std::string& name) { return read_text(folder_ / name); }

  void expect_same_results(const std::string& a, const std::string& b) {
    EXPECT_EQ(text(a + "/sweep.csv"), text(b + "/sweep.csv"));
    EXPECT_EQ(text(a + "/sweep.json"), text(b + "/sweep.json"));
  }

  /// Starts the command and kills it once the journal has grown to `bytes`.
  void kill_at(const std::string& sweep, const std::string& out, std::uintmax_t bytes) {
    const fs::path journal = folder_ / out / "journal.bin";
    const pid_t child = ::fork();
    if (child == 0) {
      const std::string program = places::command();
      ::setpgid(0, 0);
      fs::current_path(folder_);
      const int nowhere = ::open("/dev/null", O_WRONLY);
      ::dup2(nowhere, STDOUT_FILENO);
      ::execl(program.c_str(), program.c_str(), "sweep", sweep.c_str(), "-o", out.c_str(),
              static_cast<char*>(nullptr));
      ::_exit(127);
    }
    std::error_code error;
    for (int wait = 0; wait < 20000; ++wait) {
      const std::uintmax_t size = fs::exists(journal) ? fs::file_size(journal, error) : 0;
      if (!error && size >= bytes) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
  }
};

TEST_F(SweepCommand, GivesTheSameBytesOnAnyNumberOfThreads) {
  for (const char* threads : {"1", "2", "3"})
    ASSERT_EQ(
        command(std::string("study sweep sweep.toml --threads ") + threads + " -o t" + threads)
            .exit_code,
        0);
  expect_same_results("t1", "t2");
  expect_same_results("t1", "t3");
  const nlohmann::json json = result("t1/sweep.json");
  EXPECT_EQ(json["schema"], "trueaxis.sweep/1");
  EXPECT_EQ(json["seed"], 3);
  ASSERT_EQ(json["cells"].size(), 4U);
  EXPECT_EQ(json["cells"][1]["at"]["noise.sigma_um"], "2");
  EXPECT_EQ(json["cells"][1]["method"], "tukey");
  EXPECT_EQ(json["cells"][3]["rows"].size(), 11U);
}

TEST_F(SweepCommand, IsQuietInAPipe) {
  const CommandStreams done = command("study sweep sweep.toml -o out");
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_EQ(done.err, "");
  EXPECT_TRUE(contains(done.out, "RMSE / bound"));
}

// Killed again and again at other sizes of the journal, it ends with the bytes of one run.
TEST_F(SweepCommand, ContinuesWhereItWasKilled) {
  file("long.toml", sweep_text(1500));
  ASSERT_EQ(command("study sweep long.toml -o whole").exit_code, 0);
  const std::uintmax_t all = fs::file_size(folder_ / "whole/journal.bin");
  for (const std::uintmax_t tenth : {1U, 4U, 7U}) kill_at("long.toml", "killed", tenth * all / 10);
  const std::uintmax_t before = fs::file_size(folder_ / "killed/journal.bin");
  EXPECT_GE(before, 7 * all / 10);
  ASSERT_FALSE(there("killed/sweep.csv")) << "the sweep was over before it was killed";
  ASSERT_EQ(command("study sweep long.toml -o killed").exit_code, 0);
  expect_same_results("whole", "killed");
  // No block was lost or run twice: every record is as long as in the other journal.
  EXPECT_EQ(fs::file_size(folder_ / "killed/journal.bin"), all);
}

// The last record cut at every kind of place, and a byte of it changed.
TEST_F(SweepCommand, TakesOffATornRecord) {
  ASSERT_EQ(command("study sweep sweep.toml --threads 1 -o whole").exit_code, 0);
  const std::string journal = text("whole/journal.bin");
  const std::size_t last = journal.rfind("TXBLOCK1");
  std::vector<std::string> torn;
  for (const std::size_t keep : {std::size_t{0}, std::size_t{10}, last + 3, last + 8, last + 12,
                                 last + 100, journal.size() - 1})
    torn.push_back(journal.substr(0, keep));
  torn.push_back(journal);
  torn.back()[last + 60] = static_cast<char>(torn.back()[last + 60] ^ 1);
  torn.push_back(journal + journal.substr(last));  // a record twice
  int number = 0;
  for (const std::string& bytes : torn) {
    const std::string out = "torn" + std::to_string(number++);
    fs::create_directories(folder_ / out);
    file(out + "/journal.bin", bytes);
    ASSERT_EQ(command("study sweep sweep.toml -o " + out).exit_code, 0) << out;
    expect_same_results("whole", out);
  }
}

TEST_F(SweepCommand, RefusesTheJournalOfAnotherSweep) {
  ASSERT_EQ(command("study sweep sweep.toml -o out").exit_code, 0);
  file("sweep.toml", sweep_text(41));
  expect_input_error("study sweep sweep.toml -o out", "is of another sweep");
}

// The same version with another engine: one digit of the build's hash differs.
TEST_F(SweepCommand, RefusesTheJournalOfAnotherBuild) {
  ASSERT_EQ(command("study sweep sweep.toml -o out").exit_code, 0);
  std::string journal = text("out/journal.bin");
  char& digit = journal.at(journal.find('\n') - 1);
  digit = digit == '0' ? '1' : '0';
  file("out/journal.bin", journal);
  expect_input_error("study sweep sweep.toml -o out", "was begun by another build of TrueAxis");
  expect_input_error("study sweep sweep.toml -o out", "choose another folder with -o");
  EXPECT_EQ(text("out/journal.bin"), journal);
}

TEST_F(SweepCommand, RefusesAFolderInUse) {
  fs::create_directories(folder_ / "out");
  file("out/journal.bin", "");
  const std::string locked = "study sweep sweep.toml -o out";
  const int status =
      std::system(("cd " + shell_word(folder_) + " && flock out/journal.bin " +
                   shell_word(places::command()) + " " + locked + " > /dev/null 2> locked.txt")
                      .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_TRUE(contains(text("locked.txt"), "another process is running this sweep"));
}

TEST_F(SweepCommand, SaysWhatIsWrongWithTheInput) {
  file("bad.toml", "scenario = \"none.toml\"\nrepeats = -1\n");
  expect_input_error("study sweep bad.toml -o out", "none.toml: cannot be read");
  file("plain", "");
  expect_input_error("study sweep sweep.toml -o plain/out", "plain/out");
  EXPECT_EQ(command("sweep").exit_code, 2);
}

// A cell that cannot be probed is not an error of the sweep: its rows say so, the others are there.
TEST_F(SweepCommand, KeepsGoingWhereACellCannotBeProbed) {
  std::string text = sweep_text(10);
  text += "[[axis]]\nkey = \"part.k_mm\"\nvalues = [-150, 15]\n";  // 15: the apex is in the way
  file("sweep.toml", text);
  ASSERT_EQ(command("study sweep sweep.toml -o out").exit_code, 0);
  EXPECT_TRUE(contains(command("study sweep sweep.toml").out, "4 of 8 cells have no result: "));
  const nlohmann::json cells = result("out/sweep.json")["cells"];
  EXPECT_EQ(cells[0]["failures"], 0);
  EXPECT_EQ(cells[2]["failures"], 10);
  EXPECT_TRUE(contains(cells[2]["why"].get<std::string>(), "apex"));
}

TEST_F(SweepCommand, SaysWhyThereIsNoBound) {
  int number = 0;
  const auto expect_why = [&](const std::string& sweep, const std::string& why) {
    const std::string out = "out" + std::to_string(number++);
    file("sweep.toml", sweep);
    const CommandStreams done = command("study sweep sweep.toml -o " + out);
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_TRUE(contains(done.out, "no bound: " + why)) << done.out;
    EXPECT_EQ(result(out + "/sweep.json")["cells"][0]["why_no_bound"], why);
    EXPECT_TRUE(contains(text(out + "/report.html"), why));
  };
  const std::string part = "repeats = 3\n[part]\nkind = \"cylinder\"\nradius_mm = 30\n",
                    pass =
                        "[[pass]]\nz_start_mm = 0\nz_end_mm = 20\nreadings_per_revolution = 9.3\n",
                    noise = "[noise]\nsigma_um = 5\n";
  expect_why(part + noise + pass + pass + "setup = 2\n[[setup]]\nnumber = 2\nx0_mm = 0.1\n",
             "the axis moves between set-ups of one clamping");
  expect_why(part + pass, "no noise");
  expect_why(part + noise + "[[pass]]\nz_start_mm = 0\nz_end_mm = 0\nrevolutions = 9\n" +
                 "readings_per_revolution = 9.3\n",
             "the readings do not determine the parameters");
}

TEST_F(SweepCommand, StudiesADiagnosis) {
  std::string text =
      sweep_text(3) + "[[effect]]\nid = \"part.roundness\"\norder = 3\namplitude_um = 8\n";
  text.replace(text.find("[\"fit\", \"tukey\"]"), 16, "[\"diagnosis\"]");
  file("sweep.toml", text);
  ASSERT_EQ(command("study sweep sweep.toml -o out").exit_code, 0);
  const nlohmann::json cells = result("out/sweep.json")["cells"];
  EXPECT_EQ(cells[0]["found"]["value"],
            1.0);  // 8 µm at σ = 2 µm over 1395 readings: λ of thousands
  EXPECT_EQ(cells[0]["named"]["value"], 1.0);
}

// An effect of size 0 hides nothing: there is nothing to be named. Of two only the other counts.
TEST_F(SweepCommand, NamesNothingWhereNothingIsHidden) {
  std::string text = sweep_text(3) +
                     "[[effect]]\nid = \"part.roundness\"\norder = 3\namplitude_um = 8\n"
                     "[[effect]]\nid = \"part.roundness\"\norder = 2\namplitude_um = 0\n"
                     "[[axis]]\nkey = \"effect.0.amplitude_um\"\nvalues = [0, 8]\n";
  text.replace(text.find("[\"fit\", \"tukey\"]"), 16, "[\"diagnosis\"]");
  file("sweep.toml", text);
  ASSERT_EQ(command("study sweep sweep.toml -o out").exit_code, 0);
  const nlohmann::json cells = result("out/sweep.json")["cells"];
  EXPECT_TRUE(cells[0]["named"]["value"].is_null()) << cells[0];
  EXPECT_FALSE(cells[0]["found"]["value"].is_null());
  EXPECT_EQ(cells[1]["named"]["value"], 1.0);
}

}  // namespace
}  // namespace trueaxis::testing
