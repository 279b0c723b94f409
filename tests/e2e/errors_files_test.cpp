// SPDX-License-Identifier: Apache-2.0
// Errors of a machine and of its workpiece from several files.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "support/command_fixture.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

class ErrorsFiles : public CommandTest {
 protected:
  /// The numbers of the only row of `pose` at the worked example of docs/reference/machine.md.
  std::vector<double> pose(const std::string& errors) {
    const CommandStreams done = command("machine pose --machine " + machine_ + ' ' + data_ +
                                        "trunnion_ac_positions.csv --errors " + errors);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    std::istringstream lines(done.out);
    std::string row;
    std::getline(lines, row);
    std::getline(lines, row);
    std::vector<double> out;
    std::istringstream fields(row);
    for (std::string field; std::getline(fields, field, ',');) out.push_back(std::stod(field));
    return out;
  }
  void expect_actual(const std::vector<double>& row) {
    const double wanted[] = {-1.850358534818, 97.210312596243, 59.190929118170};
    ASSERT_GE(row.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(row[i], wanted[i], 1e-11);
  }

  std::string data_ = places::source() + "/data/five_axis/";
  std::string machine_ = data_ + "trunnion_ac.toml";
};

// The worked example with the errors of the workpiece in a file of their own, which says
// moving_part as `locate` and `datum` do: the sign is that of the file with component errors, in
// either order.
TEST_F(ErrorsFiles, OfTheWorkpieceHaveNoSign) {
  const std::string all = read_text(data_ + "trunnion_ac_errors.toml");
  const std::size_t from = all.find("[[error]]\nname = \"X0W\"");
  ASSERT_NE(from, std::string::npos);
  ASSERT_NE(all.find("tool_minus_workpiece"), std::string::npos);
  file("machine.toml", all.substr(0, from));
  file("part.toml", "schema = \"trueaxis.errors/1\"\nsign = \"moving_part\"\n" + all.substr(from));
  expect_actual(pose("machine.toml --errors part.toml"));
  expect_actual(pose("part.toml --errors machine.toml"));
  // Written as one file they say the sign of the first.
  ASSERT_EQ(command("machine errors --machine " + machine_ +
                    " --errors part.toml --errors machine.toml -o both.toml")
                .exit_code,
            0);
  EXPECT_TRUE(contains(read_text(folder_ / "both.toml"), "sign = \"tool_minus_workpiece\""));
  expect_actual(pose("both.toml"));
}

// What `locate` writes in addition to a machine's errors: both displacements, and both
// uncertainties.
TEST_F(ErrorsFiles, LocatedPartOnAMachineWithErrors) {
  ASSERT_EQ(command("setup locators " + data_ + "hong.toml -o part.toml").exit_code, 0);
  ASSERT_EQ(command("machine calibrate --machine " + machine_ + ' ' + data_ +
                    "trunnion_ac_ball.csv -o machine.toml")
                .exit_code,
            0);
  const auto U_with = [&](const std::string& errors) {
    const CommandStreams done =
        command("machine compensate " + data_ + "example.nc --machine " + machine_ + " --errors " +
                errors + " -o cut.nc --tolerance-um 20 --json c.json --force");
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return result("c.json").at("U").at("value").get<double>();
  };
  const double part = U_with("part.toml"), machine = U_with("machine.toml"),
               both = U_with("part.toml --errors machine.toml");
  // At the worst block of each: squares add there, and nowhere can they be more than of all.
  EXPECT_LE(both, std::hypot(part, machine) * (1.0 + 1e-9));
  EXPECT_GE(both, std::max(part, machine) * (1.0 - 1e-9));
}

// Found terms are uncertain together with the location errors: EXC of order 2 in the example.
TEST_F(ErrorsFiles, DiagnoseWritesTheCovarianceOfWhatItFinds) {
  ASSERT_EQ(command("machine diagnose " + data_ + "trunnion_ac_ball.csv --machine " + machine_ +
                    " -o d.toml --json d.json")
                .exit_code,
            0);
  const std::string text = read_text(folder_ / "d.toml");
  EXPECT_TRUE(contains(text, "[covariance]"));
  EXPECT_TRUE(contains(text, "{name = \"EXC\", cos = 2, period_deg = 360},"));
  EXPECT_TRUE(contains(text, "name = \"trunnion AC\""));
  const CommandStreams done =
      command("machine compensate " + data_ + "example.nc --machine " + machine_ +
              " --errors d.toml -o cut.nc --tolerance-um 20 --json c.json");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_GT(result("c.json").at("U").at("value").get<double>(), 0.0);
}

// A second calibration by the same readings moves nothing by more than its u, and what it writes
// counts no uncertainty twice: what is estimated anew is not added to what it was.
TEST_F(ErrorsFiles, CalibrateGoesOnFromItsOwnErrors) {
  const std::string ball = data_ + "trunnion_ac_ball.csv";
  const auto once =
      command("machine calibrate --machine " + machine_ + ' ' + ball + " -o e.toml --json e.json");
  ASSERT_EQ(once.exit_code, 0) << once.err;
  const auto again = command("machine calibrate --machine " + machine_ + ' ' + ball +
                             " --errors e.toml -o f.toml --json f.json");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const nlohmann::json first = result("e.json").at("parameters"),
                       second = result("f.json").at("parameters");
  ASSERT_EQ(first.size(), second.size());
  for (const auto& [name, one] : second.items()) {
    const double u = first.at(name).at("u"), now = one.at("u");
    EXPECT_LT(std::abs(one.at("value").get<double>()), u) << name;
    EXPECT_LE(now, 1.01 * u) << name;
    EXPECT_GE(u, first.at(name).at("u_noise").get<double>() * 0.999) << name;
  }
  // X0C once with a u, that of its last entry.
  const std::string text = read_text(folder_ / "f.toml");
  std::size_t entries = 0, amounts = 0;
  for (std::size_t at = 0; (at = text.find("[[error]]\nname = \"X0C\"", at)) != std::string::npos;
       ++at)
    ++entries;
  for (std::size_t at = 0; (at = text.find("{name = \"X0C\"}", at)) != std::string::npos; ++at)
    ++amounts;
  EXPECT_EQ(entries, 2U);
  EXPECT_EQ(amounts, 1U);
}

// ISG and Etalon tables do not say what is beyond 0 … 360°. One that ends as it begins goes round,
// and is written as it was read. The wave in a table is off by c (Δ/2)²/2 ≤ 5 · 0.0314²/2
// µm between its points.
TEST_F(ErrorsFiles, ATableOfAWholeTurnGoesRound) {
  file("four.toml",
       "schema = \"trueaxis.errors/1\"\nsign = \"moving_part\"\n[[error]]\nname = \"EXC\"\n"
       "kind = \"fourier\"\nterms_um = [[1, 3, -4]]\n");
  const std::string call = "machine errors --machine " + machine_ + " --errors ";
  for (const std::string format : {"isg", "etalon"}) {
    const std::string name = format == "isg" ? "four.csv" : "four.etalon", again = "again-" + name;
    const std::string write = " --output-sign moving_part --format " + format + " -o ";
    ASSERT_EQ(command(call + "four.toml" + write + name).exit_code, 0);
    for (const double deg : {-190.0, -30.0, 17.0, 330.0, 400.0, 719.0}) {
      const CommandStreams done =
          command(call + name + " --sign moving_part --json - --at C=" + std::to_string(deg));
      ASSERT_EQ(done.exit_code, 0) << done.err;
      const double c = deg * std::numbers::pi / 180.0,
                   value = nlohmann::json::parse(done.out).at("component").at("EXC").at("value");
      EXPECT_NEAR(value, 1e-3 * (3.0 * std::cos(c) - 4.0 * std::sin(c)), 2.5e-6) << deg;
    }
    ASSERT_EQ(command(call + name + " --sign moving_part" + write + again).exit_code, 0);
    const std::string first = read_text(folder_ / name), second = read_text(folder_ / again);
    EXPECT_EQ(std::ranges::count(second, '\n'), std::ranges::count(first, '\n'));
    EXPECT_EQ(second.substr(0, 2000), first.substr(0, 2000));  // the end may differ by rounding
  }
}

// A format without a place for the pivot of angular errors: their translations are about the
// origin. The same file was written with a pivot and without, and the tip was off by angle × pivot.
TEST_F(ErrorsFiles, ATableIsAboutTheOriginWhereTheErrorsHaveAPivot) {
  file("pivot.toml",
       "schema = \"trueaxis.errors/1\"\nsign = \"moving_part\"\n"
       "reference_mm.X = [100, -30, 50]\nreference_mm.Y = [0, 20, -60]\n"
       "[[error]]\nname = \"EBX\"\nvalue_urad = 40\n"
       "[[error]]\nname = \"ECX\"\nvalue_urad = -70\n"
       "[[error]]\nname = \"EAY\"\nkind = \"table\"\n"
       "at_mm = [-200, 0, 200]\nvalues_urad = [60, -20, 50]\n");
  const std::vector<double> wanted = pose("pivot.toml");
  for (const std::string format : {"isg", "etalon"})
    for (const std::string sign : {"moving_part", "tool_minus_workpiece"}) {
      const std::string name = sign + (format == "isg" ? ".csv" : ".etalon");
      const CommandStreams done =
          command("machine errors --machine " + machine_ + " --errors pivot.toml --format " +
                  format + " --output-sign " + sign + " -o " + name);
      ASSERT_EQ(done.exit_code, 0) << done.err;
      const std::vector<double> row = pose(name + " --sign " + sign);
      ASSERT_EQ(row.size(), wanted.size());
      // Between the places of the table E is linear up to the square of its angle: 60 mm (60
      // µrad)².
      for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(row[i], wanted[i], 1e-6) << name;
    }
}

// A format without a place for it: the table goes as far as programs may, and the screen says so.
TEST_F(ErrorsFiles, ATableStatesHowFarItsErrorsAreKnown) {
  file("known.toml",
       "schema = \"trueaxis.errors/1\"\nsign = \"moving_part\"\n[[error]]\nname = \"EXX\"\n"
       "kind = \"polynomial\"\ncoefficients_um = [0, 10, 30]\nscale_mm = 300\n"
       "known_mm = [-100, 100]\n");
  const CommandStreams done =
      command("machine errors --machine " + machine_ +
              " --errors known.toml --format isg --output-sign moving_part -o known.csv");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.out.find("the table of X covers -120 to 120 mm, beyond which"), std::string::npos);
  const std::string text = read_text(folder_ / "known.csv");
  EXPECT_NE(text.find("\n-120 "), std::string::npos) << text;
  EXPECT_TRUE(text.substr(0, text.size() - 1).rfind("\n120 ") != std::string::npos) << text;
}

// Written in steps from 0, the last step to 360° is not there.
TEST_F(ErrorsFiles, ATableOfAWholeTurnButForAStepGoesRound) {
  std::string isg = "C EXC\n";
  for (int k = 0; k < 36; ++k)
    isg += std::to_string(10 * k) + " " + std::to_string(1e-3 * std::min(k, 36 - k)) + "\n";
  file("steps.csv", isg);
  for (const auto& [deg, um] : {std::pair{-90.0, 9.0}, {355.0, 0.5}, {450.0, 9.0}, {20.0, 2.0}}) {
    const CommandStreams done =
        command("machine errors --machine " + machine_ +
                " --errors steps.csv --sign moving_part --json - --at C=" + std::to_string(deg));
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const double value = nlohmann::json::parse(done.out).at("component").at("EXC").at("value");
    EXPECT_NEAR(value, 1e-3 * um, 1e-9) << deg;
  }
}

// Sizes that no machine has are refused (tests/refusals/errors_*), and accepted if the file, the
// command line or a job says that they are intended; what is written of them is read again.
TEST_F(ErrorsFiles, AsLargeAsNoMachineHasThemOnlyWhereItIsSaid) {
  const std::string head = "schema = \"trueaxis.errors/1\"\nsign = \"moving_part\"\n",
                    entry = "[[error]]\nname = \"X0C\"\nvalue_mm = 5.5\n";
  const auto X0C = [&](const std::string& call) {
    const CommandStreams done =
        command("machine errors --machine " + machine_ + " --json - --errors " + call);
    return done.exit_code == 0
               ? nlohmann::json::parse(done.out).at("location").at("X0C").at("value").get<double>()
               : -done.exit_code;
  };
  file("plain.toml", head + entry);
  file("meant.toml", head + "large_errors = true\n" + entry);
  file("isg.csv", "X0C\n5.5\n");
  file("etalon.txt", "[X0C]\nVALUE = 5.5\n");
  EXPECT_EQ(X0C("plain.toml"), -3);
  EXPECT_EQ(X0C("isg.csv --sign moving_part"), -3);
  EXPECT_EQ(X0C("etalon.txt --sign moving_part"), -3);
  EXPECT_EQ(X0C("meant.toml"), 5.5);
  EXPECT_EQ(X0C("plain.toml --large-errors"), 5.5);
  EXPECT_EQ(X0C("isg.csv --sign moving_part --large-errors"), 5.5);
  EXPECT_EQ(X0C("etalon.txt --sign moving_part --large-errors -o written.toml"), 5.5);
  EXPECT_EQ(X0C("written.toml"), 5.5);
  const std::string job = "[machine]\nfile = \"" + data_ +
                          "zxacy.toml\"\nerrors = [\"plain.toml\"]\nLARGE\n[measure]\ndata = [\"" +
                          data_ + "zxacy_ball.csv\"]\n";
  for (const std::string& said : {std::string(), std::string("large_errors = true")}) {
    std::string text = job;
    file("job.toml", text.replace(text.find("LARGE"), 5, said));
    EXPECT_EQ(command("run job.toml -o there --check").exit_code, said.empty() ? 3 : 0) << said;
  }
  // The limit itself is allowed.
  file("plain.toml", head + "[[error]]\nname = \"X0C\"\nvalue_um = 5000\n");
  EXPECT_EQ(X0C("plain.toml"), 5.0);
}

// Errors that do not state their machine count as those of the one that is given, and every command
// that uses them says so; errors of a workpiece hold on any machine.
TEST_F(ErrorsFiles, ThatDoNotSayTheirMachineAreTakenWithAWord) {
  const std::string said = "own.toml does not name the machine of its errors",
                    head = "schema = \"trueaxis.errors/1\"\nsign = \"moving_part\"\n";
  file("own.toml", head + "[[error]]\nname = \"X0C\"\nvalue_um = 25\n");
  file("part.toml", head + "[[error]]\nname = \"X0W\"\nvalue_um = 25\n");
  ASSERT_EQ(command("machine errors --machine " + machine_ + " --errors own.toml -o stated.toml")
                .exit_code,
            0);
  const std::string ball = data_ + "trunnion_ac_ball.csv";
  const struct {
    std::string before, behind;
  } calls[] = {
      {"machine compensate " + data_ + "example.nc --tolerance-um 20 --machine " + machine_,
       " -o o.nc --json j.json"},
      {"machine calibrate --machine " + machine_ + ' ' + ball, " -o o.toml --json j.json"},
      {"machine diagnose " + ball + " --machine " + machine_, " -o d.toml --json j.json"},
      {"machine errors --machine " + machine_, " --json j.json"},
      {"machine pose --machine " + machine_ + ' ' + data_ + "trunnion_ac_positions.csv", ""}};
  for (const auto& [before, behind] : calls)
    for (const std::string name : {"own.toml", "stated.toml", "part.toml"}) {
      const auto done =
          command(before + " --errors " + name + behind + (behind.empty() ? "" : " --force"));
      ASSERT_EQ(done.exit_code, 0) << before << done.err;
      EXPECT_EQ(contains(done.out + done.err, said), name == "own.toml") << before << name;
      if (behind.empty()) continue;
      const std::string json = result("j.json").at("remarks").dump();
      EXPECT_EQ(contains(json, said), name == "own.toml") << before << name << json;
    }
}

TEST_F(ErrorsFiles, OfAnotherMachineAreRefused) {
  ASSERT_EQ(command("machine calibrate --machine " + machine_ + ' ' + data_ +
                    "trunnion_ac_ball.csv -o e.toml")
                .exit_code,
            0);
  std::string other = read_text(machine_);
  const std::string point = "point_mm = [0, 15, -40]";
  ASSERT_NE(other.find(point), std::string::npos);
  other.replace(other.find(point), point.size(), "point_mm = [0, 15.2, -40]");
  file("other.toml", other);
  for (const std::string& call :
       {"machine compensate " + data_ + "example.nc --machine other.toml --errors e.toml -o cut.nc",
        "machine pose --machine other.toml " + data_ + "trunnion_ac_positions.csv --errors e.toml",
        "machine calibrate --machine other.toml " + data_ +
            "trunnion_ac_ball.csv --errors e.toml -o f.toml"}) {
    const CommandStreams done = command(call);
    EXPECT_EQ(done.exit_code, 3) << call;
    EXPECT_TRUE(contains(done.err, "e.toml:")) << done.err;
    EXPECT_TRUE(contains(done.err,
                         "\"A about 1 0 0 through 0 15 -40\", and this machine \"A about "
                         "1 0 0 through 0 15.2 -40\""))
        << done.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cut.nc"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "f.toml"));
  // The workpiece's are of no machine.
  ASSERT_EQ(command("setup locators " + data_ + "hong.toml -o part.toml").exit_code, 0);
  EXPECT_EQ(command("machine compensate " + data_ +
                    "example.nc --machine other.toml --errors part.toml -o cut.nc")
                .exit_code,
            0);
}

}  // namespace
}  // namespace trueaxis::testing
