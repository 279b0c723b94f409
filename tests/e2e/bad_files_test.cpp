// SPDX-License-Identifier: Apache-2.0
// Bad streams, jobs and fits: exit code 3, every diagnostic with its place on standard error, and
// no file written.
#include "support/command_fixture.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

namespace fs = std::filesystem;

const fs::path bad_streams = fs::path(places::source()) / "tests/golden/bad_streams";

std::vector<std::string> bad_cases() {
  std::vector<std::string> cases;
  for (const std::string& name : files_in(bad_streams)) {
    if (name.ends_with(".csv")) cases.push_back(name);
  }
  return cases;
}

class BadStreamCommand : public CommandTest, public ::testing::WithParamInterface<std::string> {};

TEST_P(BadStreamCommand, EveryDiagnosticAndNoFile) {
  fs::copy_file(bad_streams / GetParam(), folder_ / GetParam());
  const std::string expected = read_text((bad_streams / GetParam()).replace_extension(".expected"));
  const char* surface = GetParam().starts_with("face") ? "plane" : "cone";
  // Without the names of a stream it counts as another program's table, and the command asks for
  // its columns.
  const bool asked = GetParam() == "header_missing.csv" || GetParam() == "reading_missing.csv" ||
                     GetParam() == "decimal_comma.csv";
  const std::string said = asked ? "the command that would read it: trueaxis fit" : expected;
  expect_input_error("fit " + GetParam() + " --json f.json --residuals r.csv --surface " + surface,
                     said);
  file("job.toml", simple_job("stream = \"" + GetParam() + "\"\nsurface = \"" + surface + "\"\n"));
  expect_input_error("run job.toml -o out",
                     asked ? "the lines of its [[reference]] that would read it: columns" : said);
}

INSTANTIATE_TEST_SUITE_P(Table, BadStreamCommand, ::testing::ValuesIn(bad_cases()),
                         [](const auto& bad) { return fs::path(bad.param).stem().string(); });

class BadJob : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    file("part.csv", csv(probe({.noise_mm = 0.002})));
  }
  void expect_refused(const std::string& job, const std::vector<std::string>& diagnostics) {
    file("job.toml", job);
    for (const std::string& diagnostic : diagnostics)
      expect_input_error("run job.toml -o out", diagnostic);
  }
};

TEST_F(BadJob, EveryDiagnosticAtOnceWithItsPlace) {
  expect_refused(
      "[[reference]]\n"
      "strem = \"part.csv\"\n"
      "surface = 3\n"
      "weight = -1\n"
      "[target]\n"
      "surface = \"cylindr\"\n"
      "radius_mm = 28\n"
      "z_start_mm = 4\n"
      "z_end_mm = 4\n"
      "[cut]\n"
      "speed_rpm = \"fast\"\n"
      "sense = \"+c\"\n"
      "feed_mm_per_rev = 0.1\n"
      "feed_um_per_rev = 100\n",
      {"job.toml:1:1: [reference] needs `stream`",
       "job.toml:2:1: [reference] has no key `strem`, did you mean `stream`?",
       "job.toml:3:11: `surface` is an integer: give a text in quotes",
       "job.toml:4:10: `weight` is -1 but must be more than 0",
       "job.toml:6:11: `surface` is \"cylindr\" but must be one of: cylinder, cone, face",
       "job.toml:9:12: `z_end_mm` equals the start", "job.toml:11:13: `speed_rpm` is a string",
       "job.toml:14:19: `feed_um_per_rev` repeats `feed_mm_per_rev`"});
}

TEST_F(BadJob, AllMissingStreamsAreNamed) {
  expect_refused(
      "[[reference]]\nstream = \"gone.csv\"\nsurface = \"cone\"\n"
      "[[reference]]\nstream = \"part.csv\"\nsurface = \"cylinder\"\n"
      "[[reference]]\nstream = \"also gone.csv\"\nsurface = \"cylinder\"\n",
      {"gone.csv: cannot be read (No such file or directory)", "\nalso gone.csv: cannot be read"});
}

TEST_F(BadJob, WhatNoCutCanBe) {
  const std::string reference = std::string("[[reference]]\n") + cylinder_reference;
  const std::string cut = "[cut]\nspeed_rpm = 600\nsense = \"+c\"\nfeed_mm_per_rev = ";
  const std::string cylinder = "[target]\nsurface = \"cylinder\"\nradius_mm = 28\nz_start_mm = 0\n";
  expect_refused("", {"`reference` in the top level is missing: add a [[reference]]"});
  expect_refused("[reference]\nstream = \"part.csv\"\n", {"begin each with [[reference]]"});
  expect_refused("x = [\n", {"job.toml:1:7: is not valid TOML"});
  expect_refused("[[reference]]\nstream = \"\"\nsurface = \"cone\"\n",
                 {"job.toml:2:10: `stream` is empty"});
  expect_refused("[[reference]]\nstream = \"part.csv\"\nsurface = \"ball\"\n",
                 {"job.toml:3:11: `surface` is an unknown surface 'ball'"});
  expect_refused(reference + "[cut]\nspeed_rpm = 600\n",
                 {"`cut` has no effect without a [target]"});
  expect_refused(reference + cylinder + "z_end_mm = 1e9\n" + cut + "0.1\n",
                 {"makes a table of 3600000000000 rows"});
  expect_refused(reference +
                     "[target]\nsurface = \"face\"\nfeature = \"bore\"\nz_mm = 0\n"
                     "radius_start_mm = 9\nradius_end_mm = 5\n" +
                     cut + "0.1\n",
                 {"`feature` has no effect: a face is neither shaft nor bore"});
  expect_refused(reference + cylinder + "z_end_mm = 9\n" + cut +
                     "0.1\n[[actuator.response]]\nfrequency_hz = 0\ngain = 1\nphase_deg = 0\n",
                 {"has one point at 0 Hz"});
  expect_refused(
      reference + cylinder + "z_end_mm = 9\ncoaxiality_tolerance_um = nan\n" + cut + "1\n",
      {"`coaxiality_tolerance_um` must be finite"});
}

TEST_F(BadJob, TheResultsOfAnEarlierRunStayUntilThereAreNewOnes) {
  file("job.toml", simple_job(cylinder_reference));
  ASSERT_EQ(command("run job.toml -o out").exit_code, 0);
  ASSERT_TRUE(there("out/table.csv"));
  file("part.csv", "X_M,C,Z\nbroken,0,0\n");
  const auto results = files_in(folder_ / "out");
  EXPECT_EQ(command("run job.toml -o out").exit_code, 3);
  EXPECT_EQ(files_in(folder_ / "out"), results);
}

TEST_F(BadJob, ReadsWhatOtherEditorsWrite) {
  std::string crlf = "\xEF\xBB\xBF";
  for (const char c : simple_job(cylinder_reference))
    crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  file("job.toml", crlf);
  EXPECT_EQ(command("run job.toml -o out").exit_code, 0);
  EXPECT_EQ(command("run - -o from_input < job.toml").exit_code, 0);
  EXPECT_EQ(read_text(folder_ / "out/table.csv"), read_text(folder_ / "from_input/table.csv"));
}

class BadFit : public CommandTest {};

TEST_F(BadFit, IsToldFromAFit) {
  file("part.csv", csv(probe({.noise_mm = 0.002})));
  file("job.toml", simple_job(cylinder_reference));
  ASSERT_EQ(command("fit part.csv --surface cylinder --json fit.json").exit_code, 0);
  const nlohmann::json good = result("fit.json");
  const auto expect_refused = [&](const std::string& text, const std::string& why) {
    file("bad.json", text);
    expect_input_error("table bad.json --target job.toml -o table.csv", why);
  };
  expect_refused("", "bad.json: cannot be read as trueaxis.fit/1");
  expect_refused("[1, 2", "bad.json: cannot be read as trueaxis.fit/1");
  expect_refused("{}", "schema");
  expect_refused("{\"schema\": \"trueaxis.run/2\"}", "is not a trueaxis.fit/1");
  for (const char* broken : {"/axis/x/value", "/axis/covariance/matrix/0/0", "/status"}) {
    nlohmann::json fit = good;
    fit[nlohmann::json::json_pointer(broken)] = nullptr;
    expect_refused(fit.dump(), "cannot be read as trueaxis.fit/1");
  }
  nlohmann::json fit = good;
  fit["axis"]["covariance"]["matrix"][1][1] = -1e-6;
  expect_refused(fit.dump(), "negative variance");
  file("target.toml", "[target]\nsurface = \"cylinder\"\n");
  expect_input_error("table fit.json --ideal --target target.toml -o table.csv", "target.toml:1:1");
  expect_input_error("table fit.json --ideal --target gone.toml -o table.csv", "gone.toml");
}

}  // namespace
}  // namespace trueaxis::testing
