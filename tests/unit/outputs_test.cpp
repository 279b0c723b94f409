// SPDX-License-Identifier: Apache-2.0
#include "format/outputs.hpp"

#include <gtest/gtest.h>

#include "support/command_streams.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::testing {
namespace {

const std::string fit_text = "{\"schema\": \"trueaxis.fit/1\"}\n";

TEST(Outputs, WhatIsNotCommittedIsNotThereNorIsItsFolder) {
  const auto folder = fresh_folder("outputs");
  {
    Outputs outputs;
    outputs.into((folder / "new").string());
    outputs.may_write_in_folder("a.json", "trueaxis.fit");
    outputs.check();
    EXPECT_FALSE(std::filesystem::exists(folder / "new"));
    outputs.write(outputs.in_folder("a.json"), fit_text);
    EXPECT_FALSE(std::filesystem::exists(folder / "new/a.json"));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST(Outputs, OnlyWhatWasNamedAndCheckedAndSaysItsSchemaIsWritten) {
  const std::string path = (fresh_folder("outputs") / "a.json").string();
  Outputs outputs;
  outputs.may_write(path, "trueaxis.fit");
  EXPECT_THROW(outputs.write(path, fit_text), ContractViolation);
  outputs.check();
  EXPECT_THROW(outputs.write(path + "x", fit_text), ContractViolation);
  EXPECT_THROW(outputs.write(path, "{}"), ContractViolation);
}

TEST(Outputs, TellsItsOwnFilesByTheirFirstLines) {
  EXPECT_EQ(schema_in("{\n  \"schema\": \"trueaxis.run/2\",\n"), "trueaxis.run");
  EXPECT_EQ(schema_in("{\"schema\":\"trueaxis.fit/1\"}"), "trueaxis.fit");
  EXPECT_EQ(schema_in("# schema: trueaxis.correction/1\n# version: 1\n"), "trueaxis.correction");
  EXPECT_EQ(schema_in("## schema: trueaxis.stream/1\n"), "trueaxis.stream");
  EXPECT_EQ(schema_in("<!-- schema: trueaxis.axis_bias/2 -->\n"), "trueaxis.axis_bias");
  EXPECT_EQ(schema_in("# mine\n# schema: trueaxis.stream/1\nX_M[mm]\n"), "trueaxis.stream");
  EXPECT_EQ(schema_in("// schema: trueaxis.path/1\n"), "trueaxis.path");
  EXPECT_EQ(schema_in("<!doctype html>\n<meta name=\"generator\" content=\"trueaxis.report/2\">"),
            "trueaxis.report");
  for (const char* other :
       {"", "mine", "# schema: trueaxis.stream", "# schema: trueaxis./1", "{\"schema\"",
        "<!doctype html><meta name=\"generator\" content=\"pen\">",
        "{\"of\": {\"schema\": \"trueaxis.fit/1\"}}", "{\"schema\": \"theirs.fit/1\"}",
        "X_M[mm]\n1\n# schema: trueaxis.stream/1\n", "# from trueaxis.fit/1\n",
        "<p>trueaxis.report/2</p>"})
    EXPECT_EQ(schema_in(other), "") << other;
}

}  // namespace
}  // namespace trueaxis::testing
