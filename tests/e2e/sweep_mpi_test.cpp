// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "support/command_fixture.hpp"

#ifndef TRUEAXIS_MPI
#define TRUEAXIS_MPI ""
#define TRUEAXIS_MPIRUN ""
#endif

/// `mpirun trueaxis-mpi sweep`: the bytes of one process, and an end when a rank dies.
namespace trueaxis::testing {
namespace {

namespace fs = std::filesystem;

class SweepMpi : public CommandTest {
 protected:
  void SetUp() override {
    if (std::string(TRUEAXIS_MPI).empty()) GTEST_SKIP() << "built without Open MPI";
    CommandTest::SetUp();
    // As in a container: mpirun as root, more ranks than cores, none bound to a core.
    for (const char* name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM",
                             "OMPI_MCA_rmaps_base_oversubscribe"})
      ::setenv(name, "1", 1);
    ::setenv("OMPI_MCA_hwloc_base_binding_policy", "none", 1);
    ::setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 1);
    file("sweep.toml", sweep_text(500));
  }

  static std::string sweep_text(int repeats) {
    return "repeats = " + std::to_string(repeats) +
           "\nmethods = [\"fit\", \"huber\"]\n[part]\nkind = \"cylinder\"\nradius_mm = 25\n"
           "[noise]\nsigma_um = 5\n[[pass]]\nz_start_mm = 0\nz_end_mm = 30\n"
           "readings_per_revolution = 9.3\n[[axis]]\nkey = \"noise.rho\"\nvalues = [0, 0.5]\n";
  }

  /// Starts mpirun with a group of its own.
  pid_t start(int ranks, const std::string& sweep, const std::string& out) {
    const pid_t child = ::fork();
    if (child != 0) return child;
    ::setpgid(0, 0);
    fs::current_path(folder_);
    const int to = ::open("said.txt", O_WRONLY | O_CREAT | O_TRUNC, 0666);
    ::dup2(to, STDOUT_FILENO);
    ::dup2(to, STDERR_FILENO);
    const std::string count = std::to_string(ranks);
    ::execl(TRUEAXIS_MPIRUN, "mpirun", "-n", count.c_str(), TRUEAXIS_MPI, "sweep", sweep.c_str(),
            "-o", out.c_str(), static_cast<char*>(nullptr));
    ::_exit(127);
  }

  /// What mpirun ended with; −1 (and it is killed) when it hangs.
  static int wait_for(pid_t mpirun) {
    int status = 0;
    for (int wait = 0; wait < 1200; ++wait) {
      if (::waitpid(mpirun, &status, WNOHANG) == mpirun)
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    ::kill(-mpirun, SIGKILL);
    ::waitpid(mpirun, &status, 0);
    return -1;
  }

  /// Process of a rank among the children of mpirun; 0: not there.
  static pid_t find_rank(pid_t mpirun, int rank) {
    const std::string wanted = "OMPI_COMM_WORLD_RANK=" + std::to_string(rank);
    for (const auto& entry : fs::directory_iterator("/proc")) {
      const std::string name = entry.path().filename().string();
      if (name.find_first_not_of("0123456789") != std::string::npos) continue;
      std::ifstream stat(entry.path() / "stat");
      std::string id, command, state;
      pid_t parent = 0;
      stat >> id >> command >> state >> parent;
      if (parent != mpirun) continue;
      const std::string environment = read_text(entry.path() / "environ");
      if (contains(environment, wanted + '\0')) return static_cast<pid_t>(std::stol(name));
    }
    return 0;
  }

  std::string text(const std::string& name) { return read_text(folder_ / name); }
  void expect_same_results(const std::string& a, const std::string& b) {
    EXPECT_EQ(text(a + "/sweep.csv"), text(b + "/sweep.csv"));
    EXPECT_EQ(text(a + "/sweep.json"), text(b + "/sweep.json"));
  }
};

TEST_F(SweepMpi, RanksGiveTheBytesOfOneProcess) {
  ASSERT_EQ(command("study sweep sweep.toml -o one").exit_code, 0);
  for (const int ranks : {1, 2, 3}) {
    const std::string out = "ranks" + std::to_string(ranks);
    ASSERT_EQ(wait_for(start(ranks, "sweep.toml", out)), 0) << text("said.txt");
    expect_same_results("one", out);
  }
  // The journal of one process is that of the same build's ranks too.
  EXPECT_EQ(wait_for(start(2, "sweep.toml", "one")), 0) << text("said.txt");
}

TEST_F(SweepMpi, EndsWhenARankDiesAndGoesOnFromThere) {
  file("long.toml", sweep_text(1500));
  ASSERT_EQ(command("study sweep long.toml -o whole").exit_code, 0);
  const std::uintmax_t all = fs::file_size(folder_ / "whole/journal.bin");
  std::uintmax_t wanted = all / 10;
  for (const int rank : {1, 0}) {
    const pid_t mpirun = start(2, "long.toml", "ranks");
    const fs::path journal = folder_ / "ranks/journal.bin";
    for (int wait = 0; wait < 20000; ++wait) {
      if (fs::exists(journal) && fs::file_size(journal) > wanted) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    const pid_t victim = find_rank(mpirun, rank);
    ASSERT_GT(victim, 0) << text("said.txt");
    ::kill(victim, SIGKILL);
    const int code = wait_for(mpirun);
    EXPECT_GT(code, 0) << "rank " << rank << '\n' << text("said.txt");
    EXPECT_TRUE(contains(text("said.txt"), "Killed")) << text("said.txt");
    if (rank != 0) {
      EXPECT_TRUE(contains(text("said.txt"), "the same command continues")) << text("said.txt");
    }
    EXPECT_FALSE(there("ranks/sweep.csv"));
    wanted = fs::file_size(journal) + all / 10;
  }
  ASSERT_EQ(wait_for(start(2, "long.toml", "ranks")), 0) << text("said.txt");
  expect_same_results("whole", "ranks");
  EXPECT_EQ(fs::file_size(folder_ / "ranks/journal.bin"), all);
}

TEST_F(SweepMpi, SaysOnceWhatIsWrong) {
  file("bad.toml", "repeats = 3\n");
  EXPECT_EQ(wait_for(start(2, "bad.toml", "out")), 3);
  const std::string said = text("said.txt");
  const std::size_t first = said.find("needs `part`");
  ASSERT_NE(first, std::string::npos) << said;
  EXPECT_EQ(said.find("needs `part`", first + 1), std::string::npos) << said;
}

}  // namespace
}  // namespace trueaxis::testing
