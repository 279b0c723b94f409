// SPDX-License-Identifier: Apache-2.0
// The README's block is what the command prints, to the letter, and the streams shipped with the
// jobs are what the scenarios shipped with them make.
#include <gtest/gtest.h>

#include <sstream>

#include "measure/files/stream_csv.hpp"
#include "support/command.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

const std::string source = places::source();

CommandResult in_source(const std::string& arguments) {
  return shell("cd '" + source + "' && " + places::command() + " " + arguments);
}

TEST(Readme, ConsoleBlockIsTheOutput) {
  const std::string readme = read_text(source + "/README.md");
  const std::string opening = "```console\n$ trueaxis ";
  const std::size_t begin = readme.find(opening);
  ASSERT_NE(begin, std::string::npos);
  const std::size_t end = readme.find("```", begin + opening.size());
  std::istringstream block(readme.substr(begin + opening.size(), end - begin - opening.size()));
  std::string command;
  std::getline(block, command);
  const std::string arguments = command.substr(0, command.find(" -o "));
  const auto folder = fresh_folder("readme");
  const CommandResult result = in_source(arguments + " -o " + folder.string());
  ASSERT_EQ(result.exit_code, 0) << result.output;
  std::istringstream output(result.output);
  std::size_t lines = 0;
  for (std::string expected, line; std::getline(block, expected); ++lines) {
    ASSERT_TRUE(std::getline(output, line));
    EXPECT_EQ(line, expected);
  }
  EXPECT_GT(lines, 5U);
}

std::string block_after(const std::string& text, const std::string& opening) {
  const std::size_t begin = text.find(opening);
  if (begin == std::string::npos) return "";
  return text.substr(begin + opening.size(),
                     text.find("```", begin + opening.size()) - begin - opening.size());
}

TEST(Readme, CppBlockIsTheExampleAndItsOutput) {
  const std::string readme = read_text(source + "/README.md");
  const std::string code = block_after(readme, "```cpp\n");
  const std::string example = read_text(source + "/examples/fit_cone.cpp");
  ASSERT_FALSE(code.empty());
  EXPECT_TRUE(example.ends_with(code)) << code;
  const CommandResult result = shell(TRUEAXIS_EXAMPLE);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(block_after(readme, "```text\n"), result.output);
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
    const bool of_machine = read_text(entry.path()).find("\n[machine]") != std::string::npos;
    ++jobs;
    const auto folder = fresh_folder("job_" + entry.path().stem().string());
    const auto result =
        in_source("run data/jobs/" + entry.path().filename().string() + " -o " + folder.string());
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_EQ(result.output.rfind("GO: ", 0), 0U) << result.output;
    for (const char* file :
         {of_machine ? "errors.toml" : "table.csv", "result.json", "report.html"}) {
      EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
    }
  }
  EXPECT_GE(jobs, 2U);
}

INSTANTIATE_TEST_SUITE_P(Streams, Shipped,
                         ::testing::Values("shaft_cone_seat", "shaft_cylinder_seat", "bushing_bore",
                                           "bushing_face"));

}  // namespace
}  // namespace trueaxis::testing
