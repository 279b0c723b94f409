// SPDX-License-Identifier: Apache-2.0
// A measurement of a machine whose columns are written wrongly, each in one way.
#include <algorithm>
#include <functional>
#include <iterator>
#include <random>
#include <sstream>

#include "support/command_fixture.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

using Fields = std::map<std::string, std::string>;

class MeasurementMistakes : public CommandTest {
 protected:
  static void SetUpTestSuite() {
    made_ = fresh_folder("command/MeasurementMistakes");
    ASSERT_EQ(run_in(made_, "machine simulate " + data_ + "ball.toml -o ball.csv").exit_code, 0);
    ASSERT_EQ(run_in(made_, "machine calibrate --machine " + machine_ + " ball.csv -o right.toml")
                  .exit_code,
              0);
  }
  void SetUp() override {
    CommandTest::SetUp();
    for (const char* const name : {"ball.csv", "right.toml"})
      std::filesystem::copy_file(made_ / name, folder_ / name);
  }

  /// ball.csv with its header and every row changed.
  void write(const std::function<void(std::string&)>& header,
             const std::function<void(Fields&)>& row) {
    std::istringstream lines(read_text(folder_ / "ball.csv"));
    std::vector<std::string> names;
    std::string out;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with('#')) {
        out += line + '\n';
        continue;
      }
      std::vector<std::string> cells;
      std::istringstream fields(line);
      for (std::string field; std::getline(fields, field, ',');) cells.push_back(field);
      if (names.empty()) {
        for (const std::string& cell : cells) names.push_back(cell.substr(0, cell.find('[')));
        header(line);
        out += line + '\n';
        continue;
      }
      Fields at;
      for (std::size_t i = 0; i < names.size(); ++i) at[names[i]] = cells[i];
      row(at);
      for (std::size_t i = 0; i < names.size(); ++i) out += (i == 0 ? "" : ",") + at[names[i]];
      out += '\n';
    }
    file("wrong.csv", out);
  }
  void rows(const std::function<void(Fields&)>& row) {
    write([](std::string&) {}, row);
  }
  static void scale(std::string& field, double factor) {
    char number[40];
    std::snprintf(number, sizeof number, "%.12g", std::stod(field) * factor);
    field = number;
  }
  static std::function<void(Fields&)> scaled(std::vector<std::string> names, double factor) {
    return [=](Fields& at) {
      for (const std::string& name : names) scale(at[name], factor);
    };
  }
  static std::function<void(Fields&)> swapped(const char* a, const char* b) {
    return [=](Fields& at) { std::swap(at[a], at[b]); };
  }
  static std::function<void(std::string&)> replaced(std::string what, std::string by) {
    return [=](std::string& line) { line.replace(line.find(what), what.size(), by); };
  }

  /// Refused with all of these words and nothing written, by both commands.
  void expect_refused(std::initializer_list<const char*> words) {
    for (const std::string& call :
         {"machine calibrate --machine " + machine_ + " wrong.csv -o wrong.toml --json wrong.json",
          "machine diagnose wrong.csv --machine " + machine_ +
              " -o wrong.toml --json wrong.json"}) {
      const CommandStreams done = command(call);
      EXPECT_EQ(done.exit_code, 1) << call << done.err;
      for (const char* word : words)
        EXPECT_TRUE(contains(done.err, word)) << word << '\n' << done.err;
      EXPECT_FALSE(std::filesystem::exists(folder_ / "wrong.toml"));
      EXPECT_FALSE(std::filesystem::exists(folder_ / "wrong.json"));
    }
  }

  static inline const std::string data_ = places::source() + "/data/five_axis/";
  static inline const std::string machine_ = data_ + "trunnion_ac.toml";
  static inline std::filesystem::path made_;  ///< where the right measurement is
};

TEST_F(MeasurementMistakes, ToolLengthOfAnother) {
  rows([](Fields& at) {
    ASSERT_EQ(at["tool_length"], "120");
    at["tool_length"] = "60";
  });
  expect_refused({"Z0A is 59.9", "no machine is so far from its model", "tool length"});
}

// Every second row with a tool 50 mm shorter and Z as much lower: the tip is the same.
TEST_F(MeasurementMistakes, OneOfTwoToolLengths) {
  const auto second_tool = [](const char* stated) {
    return [stated, row = 0](Fields& at) mutable {
      if (++row % 2 == 1) return;
      at["tool_length"] = stated;
      at["Z"] = std::to_string(std::stod(at["Z"]) - 50.0);
    };
  };
  rows(second_tool("70"));
  EXPECT_EQ(command("machine calibrate --machine " + machine_ + " wrong.csv -o two.toml").exit_code,
            0);
  rows(second_tool("70.02"));
  expect_refused({"if the tool of 120 mm is 19.9 µm longer against the others", "measure"});
  rows(second_tool("69.8"));
  expect_refused({"if the tool of 120 mm is 200 µm shorter against the others"});
}

// A scale of 0.5 mm per m fits as an error that no machine has, EYY of 79 µm RMS.
TEST_F(MeasurementMistakes, AComponentErrorBeyondAnyMachineIsNotDone) {
  rows([](Fields& at) {
    at["dY"] = std::to_string(std::stod(at["dY"]) + 0.5 * std::stod(at["Y"]));
  });
  const CommandStreams done =
      command("machine calibrate --machine " + machine_ + " wrong.csv -o wrong.toml");
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_TRUE(contains(done.out, "UNEXPLAINED")) << done.out;
  EXPECT_TRUE(contains(done.out, "check tool lengths, scales")) << done.out;
}

// Residuals of few degrees of freedom may be thirty times less than the noise: 2 % of one are.
TEST_F(MeasurementMistakes, FewHonestPositions) {
  const std::string text = read_text(folder_ / "ball.csv");
  const std::size_t header = text.find("setup,");
  std::vector<std::string> all;
  std::istringstream lines(text.substr(text.find('\n', header) + 1));
  for (std::string line; std::getline(lines, line);) all.push_back(line + '\n');
  std::mt19937 random(1);
  int found = 0;
  for (int draw = 0; draw < 40; ++draw) {
    std::vector<std::string> some;
    std::ranges::sample(all, std::back_inserter(some), 5, random);
    file("few.csv", text.substr(0, text.find('\n', header) + 1) + some[0] + some[1] + some[2] +
                        some[3] + some[4]);
    const CommandStreams done =
        command("machine calibrate --machine " + machine_ + " few.csv -o few.toml --force");
    EXPECT_FALSE(contains(done.err, "scatter")) << draw << done.err;
    found += done.exit_code == 0 ? 1 : 0;
  }
  EXPECT_GT(found, 10);  // else there are more unknowns than numbers
}

// The zero of A off by 1°: no column is written wrongly.
TEST_F(MeasurementMistakes, NoHintThatExplainsNothing) {
  rows([](Fields& at) { at["A"] = std::to_string(std::stod(at["A"]) + 1.0); });
  expect_refused({"A0C is 0.99", "no usual mistake", "zeros of the axes"});
}

TEST_F(MeasurementMistakes, UnitsOfTheDeviations) {
  rows(scaled({"dX", "dY", "dZ"}, 1e-3));  // mm under µm
  expect_refused({"scatter by 0.001", "stated noise is 1 µm", "unit of the deviations"});
  write(replaced("dX[um],dY[um],dZ[um]", "dX[mm],dY[mm],dZ[mm]"), [](Fields&) {});
  expect_refused({"the deviations are in um and the header says mm", "write [um]"});
}

// A probe's own deviations, with the axes off the ball by up to 0.2 mm and the file's noise 1 µm:
// in mm under µm they say nothing, and what the axes were off is left of the readings.
TEST_F(MeasurementMistakes, UnitsOfTheDeviationsOfAProbe) {
  const auto off = [](double by_um) {
    return [by_um, count = 0](Fields& at) mutable {
      const double off_um[3] = {120.0 * std::cos(1.7 * count), 120.0 * std::sin(2.9 * count),
                                120.0 * std::cos(4.1 * count + 1.0)};
      ++count;
      char number[40];
      for (std::size_t k = 0; k < 3; ++k) {
        std::string &axis = at[std::string(1, "XYZ"[k])], &d = at[std::string("d") + "XYZ"[k]];
        std::snprintf(number, sizeof number, "%.12g", std::stod(axis) + 1e-3 * off_um[k]);
        axis = number;
        // Y carries the part: the table goes against +Y.
        std::snprintf(number, sizeof number, "%.12g", (std::stod(d) - off_um[k]) * by_um);
        d = number;
      }
    };
  };
  rows(off(1.0));
  EXPECT_EQ(command("machine calibrate --machine " + machine_ + " wrong.csv -o off.toml").exit_code,
            0);
  rows(off(1e-3));
  expect_refused({"the deviations are in mm and the header says um", "write [mm]"});
  write(replaced("dX[um],dY[um],dZ[um]", "dX[mm],dY[mm],dZ[mm]"), off(1.0));
  expect_refused({"the deviations are in um and the header says mm", "write [um]"});
}

// Numbers that no machine makes: residuals out of proportion to the noise that is stated.
TEST_F(MeasurementMistakes, RandomNumbers) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> draw(-400.0, 400.0);
  rows([&](Fields& at) {
    for (const char* d : {"dX", "dY", "dZ"}) at[d] = std::to_string(draw(random));
  });
  expect_refused(
      {"even with every error that a machine can have", "stated noise is 1 µm", "units"});
}

TEST_F(MeasurementMistakes, ReadOutsInTwoUnits) {
  const auto refused = [&](const std::string& text, const char* words) {
    file("axis.csv", text);
    const CommandStreams done =
        command("machine calibrate --machine " + machine_ + " axis.csv -o wrong.toml");
    EXPECT_EQ(done.exit_code, 1) << text;
    EXPECT_TRUE(contains(done.err, words)) << done.err;
    EXPECT_FALSE(there("wrong.toml"));
  };
  std::string um = "# kind: axis\n# axis: X\ncommand[mm],actual[mm]\n", rad = um, turned = um;
  rad = "# kind: axis\n# axis: C\ncommand[deg],actual[deg]\n";
  for (int i = 0; i < 36; ++i) {
    um += std::to_string(10.0 * i) + "," + std::to_string(1e4 * i) + "\n";
    rad += std::to_string(10.0 * i) + "," + std::to_string(10.0 * i * 3.14159265 / 180.0) + "\n";
    turned += std::to_string(10.0 * i) + "," + std::to_string(-10.0 * i) + "\n";
  }
  refused(um, "actual is in um");
  refused(rad, "actual is in radians");
  refused(turned, "runs the other way");
}

TEST_F(MeasurementMistakes, UnitsOfThePositions) {
  rows(scaled({"X", "Y", "Z"}, 1.0 / 25.4));
  expect_refused({"X, Y and Z are in inch", "write [in] after their names"});
  write(replaced("X[mm],Y[mm],Z[mm]", "X[in],Y[in],Z[in]"), [](Fields&) {});
  expect_refused({"X, Y and Z are in mm", "write [mm] after their names"});
  write(replaced("C[deg]", "C[rad]"), [](Fields&) {});
  expect_refused({"the column C is in degrees", "write C[deg]"});
  rows(scaled({"A"}, 3.14159265358979 / 180.0));
  expect_refused({"the column A is in radians", "write A[rad]"});
  rows([](Fields& at) {  // two units at once
    scaled({"A", "C"}, 3.14159265358979 / 180.0)(at);
    scaled({"X", "Y", "Z"}, 1e3)(at);
  });
  expect_refused({"no machine model fits the readings", "check the units of deviations and"});
  rows(scaled({"X"}, 1.0 / 25.4));
  expect_refused({"the column X is in inch", "write X[in]"});
}

// A slip of the pen in one row: no unit and no sign mends it, and the others fit without it.
TEST_F(MeasurementMistakes, OneRow) {
  for (const int wrong : {1, 20, 57}) {
    int row = 0;
    rows([&](Fields& at) {
      if (++row == wrong) at["C"] = std::to_string(std::stod(at["C"]) + 57.0);
    });
    expect_refused({("fits row " + std::to_string(wrong) + " of wrong.csv").c_str(),
                    "correct the row, or leave it out"});
  }
}

TEST_F(MeasurementMistakes, SignsAndColumns) {
  rows(scaled({"dX"}, -1.0));
  expect_refused({"the column dX has the wrong sign", "turn its sign"});
  rows(scaled({"C"}, -1.0));
  expect_refused({"the column C runs the other way", "axes.C.direction"});
  rows(swapped("dX", "dY"));
  expect_refused({"the columns dX and dY are exchanged", "exchange them"});
  rows(swapped("A", "C"));
  expect_refused({"C and A are exchanged"});
  rows(swapped("X", "Y"));
  expect_refused({"Y and X are exchanged"});
}

// With the axes on the ball all signs turned are a machine with all errors turned: it fits as well.
// If the axes are off the ball by more than its errors, as a probe leaves them, they do not.
TEST_F(MeasurementMistakes, AllSigns) {
  rows(scaled({"dX", "dY", "dZ"}, -1.0));
  EXPECT_EQ(
      command("machine calibrate --machine " + machine_ + " wrong.csv -o wrong.toml").exit_code, 0);
  std::filesystem::remove(folder_ / "wrong.toml");
  int count = 0;
  rows([&](Fields& at) {
    char number[40];
    const double off_um[3] = {200.0 * std::cos(1.7 * count), 200.0 * std::sin(2.9 * count),
                              200.0 * std::cos(4.1 * count + 1.0)};
    const char* const axes[3] = {"X", "Y", "Z"};
    const char* const deviations[3] = {"dX", "dY", "dZ"};
    ++count;
    for (int k = 0; k < 3; ++k) {  // Y carries the part: the table goes against +Y
      std::snprintf(number, sizeof number, "%.12g", std::stod(at[axes[k]]) + 1e-3 * off_um[k]);
      at[axes[k]] = number;
      std::snprintf(number, sizeof number, "%.12g", std::stod(at[deviations[k]]) - off_um[k]);
      at[deviations[k]] = number;
    }
  });
  ASSERT_EQ(command("machine calibrate --machine " + machine_ + " wrong.csv -o off.toml").exit_code,
            0);
  std::filesystem::rename(folder_ / "wrong.csv", folder_ / "ball.csv");
  rows(scaled({"dX", "dY", "dZ"}, -1.0));
  expect_refused({"dX, dY and dZ have the wrong sign", "turn their signs"});
}

}  // namespace
}  // namespace trueaxis::testing
