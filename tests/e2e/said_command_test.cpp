// SPDX-License-Identifier: Apache-2.0
// What a result carries of what was said: the convention of X and the noise.
#include "support/command_fixture.hpp"

namespace trueaxis::testing {
namespace {

using nlohmann::json;

class Said : public CommandTest {
 protected:
  void write(const std::string& head) { file("part.csv", csv(probe({.noise_mm = 0.002}), head)); }
  json convention(const std::string& arguments) {
    const CommandStreams done = command(arguments + " --force --json out.json");
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return result("out.json").at("input").at("x_convention");
  }
};

constexpr const char* fit_part = "fit part.csv --surface cylinder";

TEST_F(Said, WhoSaysWhatXIs) {
  write("X_M,C,Z\n");
  EXPECT_EQ(convention(fit_part), json::parse(R"({"taken": "radius", "said": false})"));
  EXPECT_EQ(convention(std::string(fit_part) + " --diameter"),
            json::parse(R"({"taken": "diameter", "said": "option"})"));
  EXPECT_EQ(convention("diagnose part.csv --surface cylinder --radius"),
            json::parse(R"({"taken": "radius", "said": "option"})"));
  file("job.toml", simple_job(std::string(cylinder_reference) + "x_convention = \"radius\"\n"));
  EXPECT_EQ(command("run job.toml -o out").exit_code, 0);
  EXPECT_EQ(result("out/result.json").at("references")[0].at("fit").at("input").at("x_convention"),
            json::parse(R"({"taken": "radius", "said": "job"})"));
  write("# x_convention: radius\nX_M,C,Z\n");
  EXPECT_EQ(convention(fit_part), json::parse(R"({"taken": "radius", "said": "stream"})"));
}

TEST_F(Said, ANoiseThatTheReadingsDoNotShow) {
  for (const auto& [stated, found] :
       {std::pair{"2 um", false}, {"20 um", true}, {"0.2 um", true}}) {
    write(std::string("# x_convention: radius\n# sensor_noise: ") + stated + "\nX_M,C,Z\n");
    ASSERT_EQ(command("diagnose part.csv --surface cylinder --json out.json").exit_code, 0);
    const json diagnosis = result("out.json");
    bool seen = false;
    for (const json& check : diagnosis.at("checks")) {
      if (check.at("effect") != "probe.stated_noise") continue;
      seen = true;
      EXPECT_EQ(check.at("found"), found) << check;
    }
    EXPECT_TRUE(seen);
    EXPECT_EQ(!diagnosis.at("baseline").at("notes").empty(), found) << diagnosis.at("baseline");
  }
}

}  // namespace
}  // namespace trueaxis::testing
