// SPDX-License-Identifier: Apache-2.0
// Bad streams: every diagnostic with its place and what to do. tests/golden/bad_streams holds the
// table: <case>.csv and, written by hand, <case>.expected.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "format/file.hpp"
#include "measure/files/stream_csv.hpp"
#include "support/places.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

namespace fs = std::filesystem;

const fs::path bad_streams = fs::path(places::source()) / "tests/golden/bad_streams";

/// What reading `path` complains of; empty when it does not.
std::vector<Diagnostic> diagnostics_of(const std::string& path,
                                       const StreamReadOptions& options = {}) {
  try {
    read_stream_csv(path, options);
  } catch (const InputError& error) {
    return error.diagnostics();
  }
  return {};
}

class BadStream : public testing::TestWithParam<std::string> {};

TEST_P(BadStream, GetsEveryDiagnostic) {
  const std::string path = (bad_streams / (GetParam() + ".csv")).string();
  std::string found;
  for (Diagnostic diagnostic : diagnostics_of(path)) {
    EXPECT_EQ(diagnostic.file, path);
    diagnostic.file = GetParam() + ".csv";
    found += to_string(diagnostic) + '\n';
  }
  EXPECT_EQ(found, read_file((bad_streams / (GetParam() + ".expected")).string()));
}

std::vector<std::string> bad_cases() {
  std::vector<std::string> cases;
  for (const auto& entry : fs::directory_iterator(bad_streams)) {
    if (entry.path().extension() == ".expected") cases.push_back(entry.path().stem().string());
  }
  std::sort(cases.begin(), cases.end());
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Table, BadStream, testing::ValuesIn(bad_cases()),
                         [](const auto& bad_case) { return bad_case.param; });

TEST(BadInput, TheTableIsThere) { EXPECT_GE(bad_cases().size(), 30u); }

class BadInputFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(places::scratch()) /
        ("bad_input_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  std::string write(const std::string& text) {
    const std::string path = (folder_ / "stream.csv").string();
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  fs::path folder_;
};

TEST_F(BadInputFile, MissingFileIsNamed) {
  const std::string path = (folder_ / "absent.csv").string();
  const auto found = diagnostics_of(path);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(to_string(found[0]),
            path + ": cannot be read (No such file or directory): name a file that can be read");
}

TEST_F(BadInputFile, FolderIsNamed) {
  const auto found = diagnostics_of(folder_.string());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].message, "is a folder: name a file");
}

TEST_F(BadInputFile, FurtherDiagnosticsAreCounted) {
  std::string text = "X_M,C,Z\n";
  for (int i = 0; i < 25; ++i) text += "# X_M in inch\n";
  StreamReadOptions options;
  options.max_diagnostics = 10;
  const auto found = diagnostics_of(write(text), options);
  ASSERT_EQ(found.size(), 11u);
  EXPECT_EQ(found[9].line, 11u);
  EXPECT_EQ(found[10].message.substr(0, 4), "and ");
  EXPECT_EQ(found[10].line, 0u);
}

// A mistake that every row has is one message, with its count and the lines that come next.
TEST_F(BadInputFile, OneKindInManyRowsIsOneMessage) {
  std::string text = "X_M,C,Z\n";
  for (int i = 0; i < 25; ++i) text += "a,0,0\n";
  const auto found = diagnostics_of(write(text), {});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].line, 2u);
  EXPECT_EQ(found[0].message,
            "X_M: 'a' is not a number (so too in 24 further places, in lines 3, 4, 5, 6, 7, 8 …)");
}

TEST_F(BadInputFile, CallerAndFileMustAgreeOnDiameter) {
  const std::string rows = "\n40,0,1\n40,120,1\n40,240,1\n";
  const auto complaint = [&](const std::string& header, bool diameter) {
    StreamReadOptions options;
    options.diameter = diameter;
    const auto found = diagnostics_of(write(header + rows), options);
    return found.empty() ? std::string() : found[0].message;
  };
  EXPECT_EQ(complaint("X_M,C,Z", true), "");
  EXPECT_EQ(complaint("X_M,C,Z", false), "");
  EXPECT_EQ(complaint("X_M[mm dia],C,Z", true), "");
  EXPECT_EQ(complaint("X_M[mm dia],C,Z", false),
            "X_M is a diameter in the file, but the option says a radius: correct one of them");
  EXPECT_EQ(complaint("# x_convention: radius\nX_M,C,Z", true),
            "X_M is a radius in the file, but the option says a diameter: correct one of them");
}

TEST_F(BadInputFile, OtherEncodingsAndBinaryAreTold) {
  const auto utf16 = diagnostics_of(write(std::string("\xFF\xFEX\0_\0M\0,\0C\0\n\0", 14)));
  ASSERT_EQ(utf16.size(), 1u);
  EXPECT_EQ(utf16[0].message, "this is UTF-16 text: save it as UTF-8");
  const auto endless = diagnostics_of(write("X_M,C,Z\n" + std::string(3u << 20u, '7')));
  ASSERT_EQ(endless.size(), 1u);
  EXPECT_EQ(endless[0].line, 2u);
  const auto nul = diagnostics_of(write(std::string("X_M,C,Z\n1\0,2,3\n", 15)));
  ASSERT_EQ(nul.size(), 1u);
  EXPECT_EQ(nul[0].message, "X_M: '1\\x00' is not a number");
}

TEST_F(BadInputFile, ErrorsBeyondTheFirstChunkHaveTheirLine) {
  std::string text = "X_M,C,Z\n";
  for (int i = 0; i < 100000; ++i) text += "40.123456,1.25," + std::to_string(i) + "\n";
  text += "40.1,oops,3";
  const auto found = diagnostics_of(write(text));
  ASSERT_EQ(found.size(), 2u);  // the second: how to leave the row out
  EXPECT_EQ(found[0].line, 100002u);
  EXPECT_EQ(found[0].column, 6u);
}

}  // namespace
}  // namespace trueaxis
