// SPDX-License-Identifier: Apache-2.0
// `trueaxis watch`: pipes that a program of this test fills, with a part that slips, a probe that
// goes deaf, and one that ends as `run` does.
#include <cmath>
#include <random>
#include <sstream>

#include "support/command_fixture.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

using nlohmann::json;

constexpr double two_pi = 6.283185307179586;
constexpr int per_turn = 200;
constexpr double sigma_mm = 0.5e-3, x0_mm = 0.03, y0_mm = -0.02;

class Watch : public CommandTest {
 protected:
  /// A helical pass over a cylinder; x, y and the reading as of a time are the caller's.
  template <class Part>
  void write_stream(int turns, Part part) {
    std::mt19937_64 random(20261127);
    std::normal_distribution<double> noise(0.0, sigma_mm);
    std::string text = "X_M[mm],C[deg],Z[mm]\n";
    double last = 0.0;
    for (int i = 0; i < turns * per_turn; ++i) {
      const double turn = static_cast<double>(i) / per_turn, z = turn;
      const auto [x, y, deaf] = part(turn);
      const double c = two_pi * turn;
      if (!deaf)
        last = 20.0 + (x + 1e-4 * z) * std::cos(c) + (y - 2e-4 * z) * std::sin(c) + noise(random);
      char row[80];
      std::snprintf(row, sizeof row, "%.7f,%.6f,%.6f\n", last, 360.0 * turn, z);
      text += row;
    }
    file("part.csv", text);
  }

  /// `pieces` of the file, one after the other, into `trueaxis watch -`.
  std::vector<json> watch(const std::string& options, int pieces = 20) {
    const std::string rows = "$(( ($(wc -l < part.csv) + " + std::to_string(pieces) + ") / " +
                             std::to_string(pieces) + " ))";
    const auto done = shell(
        "cd " + shell_word(folder_) + " && (split -l " + rows + " part.csv piece. && " +
        "(for p in piece.*; do cat $p; sleep 0.25; done) | " + shell_word(places::command()) +
        " watch - --json-lines --surface cylinder -o out " + options + " > lines.txt 2> said.txt)");
    exit_code_ = done.exit_code;
    said_ = read_text(folder_ / "said.txt");
    std::vector<json> lines;
    std::istringstream in(read_text(folder_ / "lines.txt"));
    for (std::string line; std::getline(in, line);)
      if (line[0] == '{') lines.push_back(json::parse(line));
    return lines;
  }

  struct Place {
    double x, y;
    bool deaf;
  };

  int exit_code_ = -1;
  std::string said_;
};

TEST_F(Watch, ShowsTheAxisWhileItArrivesAndEndsLikeRun) {
  write_stream(30, [](double) { return Place{x0_mm, y0_mm, false}; });
  const auto lines = watch("--until-u-um 0.2");
  EXPECT_EQ(exit_code_, 0) << said_;
  ASSERT_GE(lines.size(), 10u);
  EXPECT_TRUE(contains(said_, "enough U of the axis is reached")) << said_;
  bool was_enough = false;
  for (const json& line : lines) {
    EXPECT_EQ(line.at("schema"), "trueaxis.watch/1");
    EXPECT_EQ(line.at("alarm"), "") << line;
    if (line.at("U").at("value").is_null()) continue;
    const double U = line.at("U").at("value");
    was_enough = was_enough || line.at("enough").get<bool>();
    EXPECT_EQ(line.at("enough").get<bool>(), U <= 0.2e-3);
    for (const json& end : line.at("axis")) {
      const double z = end.at("z").at("value");
      // Four U of a normal component: 8 σ.
      const double off = std::hypot(end.at("x").at("value").get<double>() - x0_mm - 1e-4 * z,
                                    end.at("y").at("value").get<double>() - y0_mm + 2e-4 * z);
      EXPECT_LE(off, 4.0 * end.at("U").at("value").get<double>()) << line;
    }
  }
  EXPECT_TRUE(was_enough);
  // What arrived, byte for byte, and the result of `run` of it.
  EXPECT_EQ(read_text(folder_ / "out/stream.csv"),
            "## schema: trueaxis.stream/1\n" + read_text(folder_ / "part.csv"));
  std::filesystem::create_directory(folder_ / "batch");
  std::filesystem::create_directory(folder_ / "batch/out");
  std::filesystem::copy_file(folder_ / "out/stream.csv", folder_ / "batch/out/stream.csv");
  ASSERT_EQ(run_in(folder_ / "batch", "run out/stream.csv --surface cylinder -o out").exit_code, 0);
  EXPECT_EQ(read_text(folder_ / "out/result.json"), read_text(folder_ / "batch/out/result.json"));
}

// The recording says what the options said, so that `run` reads it alike. Read as diameters, the
// axis is half as far off.
TEST_F(Watch, TheRecordingOfDiametersSaysSo) {
  write_stream(10, [](double) { return Place{x0_mm, y0_mm, false}; });
  watch("--diameter --ball-radius-mm 2", 2);
  ASSERT_EQ(exit_code_, 0) << said_;
  const std::string recording = read_text(folder_ / "out/stream.csv");
  EXPECT_TRUE(contains(recording, "\n# x_convention: diameter\n# ball_radius: 2 mm\n")) << said_;
  ASSERT_EQ(command("run out/stream.csv --surface cylinder -o again").exit_code, 0);
  const auto x = [&](const char* path) {
    return value_of(result(path).at("references")[0].at("axis").at("ends")[0].at("x"));
  };
  EXPECT_EQ(x("out/result.json"), x("again/result.json"));
  EXPECT_NEAR(x("again/result.json"), 0.5 * x0_mm, 1e-3);
}

TEST_F(Watch, SaysAtOnceThatThePartSlipped) {
  write_stream(40, [](double turn) {
    return Place{x0_mm + (turn < 20 ? 0.0 : 0.02), y0_mm, false};
  });
  const auto lines = watch("", 40);
  EXPECT_TRUE(contains(said_, "STOP   the part slipped")) << said_;
  // A turn a piece: no alarm before the slip, and one at most four turns after it.
  for (const json& line : lines) {
    const double turns = line.at("turns");
    if (turns < 20.0) {
      EXPECT_TRUE(line.at("slipped").is_null()) << line.at("turns");
    }
    if (turns > 24.0) {
      EXPECT_FALSE(line.at("slipped").is_null()) << line.at("turns");
    }
    EXPECT_FALSE(line.at("deaf").get<bool>());
  }
  EXPECT_EQ(exit_code_, 0)
      << said_;  // the slip is sure, and the axis that of the part as it is now
}

TEST_F(Watch, SaysAtOnceThatTheProbeIsDeaf) {
  write_stream(40, [](double turn) { return Place{x0_mm, y0_mm, turn >= 20}; });
  const auto lines = watch("", 40);
  EXPECT_TRUE(contains(said_, "STOP   the probe is deaf")) << said_;
  for (const json& line : lines) {
    const double turns = line.at("turns");
    if (turns < 20.0) {
      EXPECT_FALSE(line.at("deaf").get<bool>()) << turns;
    }
    if (turns > 21.0 && turns < 24.0) {
      EXPECT_TRUE(line.at("deaf").get<bool>()) << turns;
    }
  }
}

TEST_F(Watch, ThinsWhatIsTooMuchAndSaysSo) {
  write_stream(30, [](double) { return Place{x0_mm, y0_mm, false}; });
  const auto lines = watch("--most-readings 2000", 12);
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines.back().at("readings"), 6000);
  EXPECT_GE(lines.back().at("stride"), 4);  // 6000 readings: at most 2000 are kept
  EXPECT_LE(lines.back().at("used").get<int>(), 2000);
  EXPECT_TRUE(contains(said_, "neighbours among the 6000 that arrived")) << said_;
  EXPECT_TRUE(contains(said_, "thinned each reading kept is the mean")) << said_;
  EXPECT_EQ(exit_code_, 0) << said_;
}

TEST_F(Watch, AFileEndsWhenItNoLongerGrows) {
  write_stream(10, [](double) { return Place{x0_mm, y0_mm, false}; });
  const CommandStreams done =
      command("watch part.csv --surface cylinder --idle-s 0.5 --json-lines -o out");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  ASSERT_EQ(command("run part.csv --surface cylinder -o batch").exit_code, 0);
  EXPECT_EQ(read_text(folder_ / "out/result.json"), read_text(folder_ / "batch/result.json"));
}

/// Another part, 80 µm elsewhere, in a longer file of the same name.
TEST_F(Watch, AFileThatIsOverwrittenIsANewOne) {
  write_stream(20, [](double) { return Place{x0_mm + 0.08, y0_mm, false}; });
  file("next.csv", read_text(folder_ / "part.csv"));
  write_stream(10, [](double) { return Place{x0_mm, y0_mm, false}; });
  const auto done =
      shell("cd " + shell_word(folder_) + " && (sleep 1; cat next.csv > part.csv) & " + "cd " +
            shell_word(folder_) + " && " + shell_word(places::command()) +
            " watch part.csv --surface cylinder --idle-s 2 --json-lines -o out "
            "> lines.txt 2> said.txt; code=$?; wait; exit $code");
  const std::string said = read_text(folder_ / "said.txt");
  EXPECT_EQ(done.exit_code, 0) << said;
  EXPECT_TRUE(contains(said, "new    part.csv was overwritten")) << said;
  EXPECT_FALSE(contains(said, "STOP")) << said;
  EXPECT_TRUE(contains(read_text(folder_ / "lines.txt"), "\"readings\":2000,"));
  EXPECT_TRUE(contains(read_text(folder_ / "lines.txt"), "\"readings\":4000,"));
}

TEST_F(Watch, ExcludesALastLineThatIsTorn) {
  write_stream(10, [](double) { return Place{x0_mm, y0_mm, false}; });
  std::string text = read_text(folder_ / "part.csv");
  const std::size_t last = text.rfind('\n', text.size() - 2) + 1;
  file("part.csv", text.substr(0, text.size() - 4));  // Z lacks digits
  watch("", 2);
  EXPECT_EQ(exit_code_, 0) << said_;
  EXPECT_TRUE(contains(said_, "torn   the last line has no end")) << said_;
  EXPECT_EQ(read_text(folder_ / "out/stream.csv"),
            "## schema: trueaxis.stream/1\n" + text.substr(0, last));
}

TEST_F(Watch, WaitsForASlowStream) {
  write_stream(1, [](double) { return Place{x0_mm, y0_mm, false}; });
  // Thirty readings of a sixth of a turn, which show no surface, for more than twenty pictures.
  const auto done = shell("cd " + shell_word(folder_) +
                          " && (head -n 31 part.csv; sleep 4; tail -n +32 part.csv; sleep 0.5) | " +
                          shell_word(places::command()) +
                          " watch - --json-lines --surface section -o out > lines.txt");
  EXPECT_NE(done.exit_code, 3) << done.output;
  const std::string text = read_text(folder_ / "lines.txt");
  EXPECT_TRUE(contains(text, "\"readings\":200")) << text;
}

TEST_F(Watch, SaysWhileItArrivesThatTheLinesAreWrong) {
  write_stream(30, [](double) { return Place{x0_mm, y0_mm, false}; });
  file("part.csv",
       "X_M[mm],C[deg],Z[mm],t[s]\n" +
           read_text(folder_ / "part.csv").substr(std::string("X_M[mm],C[deg],Z[mm]\n").size()));
  EXPECT_TRUE(watch("", 30).empty());
  EXPECT_EQ(exit_code_, 3);
  EXPECT_TRUE(contains(said_, "wrong  the row has 3 fields, the header names 4")) << said_;
}

TEST_F(Watch, TakesAByteOrderMarkBeforeAComment) {
  write_stream(30, [](double) { return Place{x0_mm, y0_mm, false}; });
  file("part.csv", "\xEF\xBB\xBF# measured: today\n" + read_text(folder_ / "part.csv"));
  EXPECT_FALSE(watch("").empty());
  EXPECT_EQ(exit_code_, 0) << said_;
}

TEST_F(Watch, ItsHelpHasNoOptionThatItRefuses) {
  const std::string help = command("watch --help").out;
  EXPECT_TRUE(contains(help, "--radius")) << help;
  EXPECT_FALSE(contains(help, "--columns")) << help;
}

TEST_F(Watch, RefusesWhatItCannotWatch) {
  write_stream(2, [](double) { return Place{x0_mm, y0_mm, false}; });
  EXPECT_EQ(command("watch").exit_code, 2);
  EXPECT_EQ(command("watch part.csv --hal").exit_code, 2);
  EXPECT_EQ(command("watch nowhere.csv").exit_code, 3);
  const auto nothing = shell(": | (cd " + shell_word(folder_) + " && " +
                             shell_word(places::command()) + " watch -)");
  EXPECT_EQ(nothing.exit_code, 3) << nothing.output;
  EXPECT_EQ(command("watch part.csv --columns X=1,C=2,Z=3").exit_code, 2);
  std::filesystem::create_directory(folder_ / "result");
  file("result/stream.csv", "mine");
  EXPECT_EQ(shell("cd " + shell_word(folder_) + " && cat part.csv | " +
                  shell_word(places::command()) + " watch -")
                .exit_code,
            3);
  EXPECT_EQ(read_text(folder_ / "result/stream.csv"), "mine");
}

}  // namespace
}  // namespace trueaxis::testing
