// SPDX-License-Identifier: Apache-2.0
// A caller of the library and a user of the command get the same decision about the same job.
#include <algorithm>

#include "job/files/job_results.hpp"
#include "job/files/job_toml.hpp"
#include "job/files/job_words.hpp"
#include "support/command_fixture.hpp"
#include "support/places.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis::testing {
namespace {

class LibraryAndCommand : public CommandTest {
 protected:
  /// Both run the job; what they say of it is compared.
  JobResult expect_same(const std::filesystem::path& path) {
    const JobFile file = read_job_toml(path.string());
    JobResult by_library = run_job(file.job, read_streams(file));
    word_unknown_axes(by_library);
    const CommandStreams by_command = command("run " + shell_word(path) + " -o out");
    const Verdict& verdict = by_library.verdict;
    // A part that is only measured has its axis's accuracy in the line as well.
    EXPECT_TRUE(first_line(by_command.out).starts_with(verdict_line(by_library))) << by_command.out;
    EXPECT_EQ(by_command.exit_code, verdict.go() ? 0 : 1) << by_command.err;
    const nlohmann::json written = result("out/result.json").at("verdict");
    EXPECT_EQ(written.at("go"), verdict.go());
    EXPECT_EQ(written.at("line"), verdict_line(by_library));
    EXPECT_FALSE(verdict.reasons.empty());
    EXPECT_EQ(written.at("reasons").size(), verdict.reasons.size());
    for (std::size_t i = 0; i < verdict.reasons.size(); ++i)
      EXPECT_EQ(written.at("reasons").at(i).at("code"), to_string(verdict.reasons[i].code));
    EXPECT_EQ(there("out/table.csv"), verdict.go() && by_library.correction.has_value());
    for (const ResultFile& file : job_files(by_library))
      EXPECT_EQ(read_text(folder_ / "out" / file.name), file.text) << file.name;
    return by_library;
  }
};

TEST_F(LibraryAndCommand, DecideTheShippedJobsAlike) {
  const std::filesystem::path jobs = std::filesystem::path(places::source()) / "data/jobs";
  std::size_t count = 0;
  for (const std::string& name : files_in(jobs)) {
    if (!name.ends_with(".toml") || contains(read_text(jobs / name), "\n[machine]")) continue;
    SCOPED_TRACE(name);
    expect_same(jobs / name);
    ++count;
  }
  EXPECT_GE(count, 3u);
}

/// The stream of RunRefusals.AHeightThatIsImplausibleMovesNoAxis.
TEST_F(LibraryAndCommand, DecideAlikeAboutAnImplausibleCause) {
  file("part.toml",
       shaft_with("id = \"encoder.eccentricity\"\namplitude_deg = 1\n", "2", 1000.0, 25.0, 1));
  ASSERT_EQ(command("simulate part.toml -o part.csv").exit_code, 0);
  file("job.toml",
       simple_job(cylinder_reference, 120.0, 1000.0) + "[actuator]\nstroke_um = 4000\n");
  EXPECT_TRUE(expect_same(folder_ / "job.toml").verdict.go());
}

}  // namespace
}  // namespace trueaxis::testing
