// SPDX-License-Identifier: Apache-2.0
// What is shipped: the example of the C++ page and its output, streams that are what their
// scenarios make, jobs. The console blocks of the pages are run by scripts/check_pages.
#include <gtest/gtest.h>

#include "measure/files/stream_csv.hpp"
#include "support/command.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

const std::string source = places::source();

CommandResult in_source(const std::string& arguments) {
  return shell("cd '" + source + "' && " + places::command() + " " + arguments);
}

std::string block_after(const std::string& text, const std::string& opening) {
  const std::size_t begin = text.find(opening);
  if (begin == std::string::npos) return "";
  return text.substr(begin + opening.size(),
                     text.find("```", begin + opening.size()) - begin - opening.size());
}

TEST(UseFromCpp, BlockIsTheExampleAndItsOutput) {
  const std::string page = read_text(source + "/docs/how-to/use-from-cpp.md");
  const std::string code = block_after(page, "```cpp\n");
  const std::string example = read_text(source + "/examples/fit_cone.cpp");
  ASSERT_FALSE(code.empty());
  EXPECT_TRUE(example.ends_with(code)) << code;
  const CommandResult result = shell(TRUEAXIS_EXAMPLE);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(block_after(page, "```text\n"), result.output);
}

class Shipped : public ::testing::TestWithParam<const char*> {};

TEST_P(Shipped, StreamIsWhatItsScenarioMakes) {
  const std::string name = GetParam();
  const auto folder = fresh_folder("shipped_" + name);
  const auto result =
      in_source("simulate data/scenarios/" + name + ".toml -o " + (folder / "stream.csv").string());
  ASSERT_EQ(result.exit_code, 0) << result.output;
  // The C library's sine may differ in its last bit from one processor to another: 1e-12 of some 50
  // mm.
  const ProbeStream made = read_stream_csv((folder / "stream.csv").string());
  const ProbeStream shipped = read_stream_csv(source + "/data/streams/" + name + ".csv");
  ASSERT_EQ(made.size(), shipped.size());
  EXPECT_EQ(made.metadata, shipped.metadata);
  for (std::size_t i = 0; i < made.size(); ++i) {
    ASSERT_NEAR(made.reading_mm[i], shipped.reading_mm[i], 1e-10) << "row " << i + 1;
    ASSERT_NEAR(made.c_rad[i], shipped.c_rad[i], 1e-10) << "row " << i + 1;
    ASSERT_NEAR(made.position_mm[i], shipped.position_mm[i], 1e-10) << "row " << i + 1;
  }
}

TEST(ShippedJobs, EveryJobIsAGo) {
  std::size_t jobs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source + "/data/jobs")) {
    if (entry.path().extension() != ".toml") continue;
    const std::string job = read_text(entry.path());
    const bool of_machine = job.find("\n[machine]") != std::string::npos;
    const bool cuts = of_machine || job.find("\n[target]") != std::string::npos;
    ++jobs;
    const auto folder = fresh_folder("job_" + entry.path().stem().string());
    const auto result =
        in_source("run data/jobs/" + entry.path().filename().string() + " -o " + folder.string());
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_EQ(result.output.rfind(cuts ? "GO: " : "DONE: ", 0), 0U) << result.output;
    for (const char* file :
         {of_machine ? "errors.toml" : "table.csv", "result.json", "report.html"})
      EXPECT_EQ(std::filesystem::exists(folder / file), cuts || file[0] == 'r') << file;
  }
  EXPECT_GE(jobs, 2U);
}

INSTANTIATE_TEST_SUITE_P(Streams, Shipped,
                         ::testing::Values("shaft_cone_seat", "shaft_cylinder_seat", "bushing_bore",
                                           "bushing_face"));

}  // namespace
}  // namespace trueaxis::testing
