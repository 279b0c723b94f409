// SPDX-License-Identifier: Apache-2.0
// `trueaxis simulate --from`: the virtual lathe hides an effect, the diagnosis finds it, and the
// part measured again differs from the first measurement by what the effect was, and no more.
#include <cmath>
#include <sstream>

#include "support/command_fixture.hpp"
#include "support/hidden_effect.hpp"

namespace trueaxis::testing {
namespace {

using nlohmann::json;

class SimulateFrom : public CommandTest {
 protected:
  void hide(const HiddenEffect& hidden) {
    hidden_ = hidden;
    file("part.toml", hidden.scenario());
    ASSERT_EQ(command("simulate part.toml -o part.csv").exit_code, 0);
    ASSERT_EQ(command("diagnose part.csv --surface cylinder --json d.json").exit_code, 0);
  }
  json compared(const std::string& arguments = "") {
    const CommandStreams done = command("simulate --from d.json --json c.json " + arguments);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return result("c.json");
  }
  HiddenEffect hidden_;
};

TEST_F(SimulateFrom, LobesAreGoneFromTheDiscrepancy) {
  hide({});
  const json c = compared();
  EXPECT_EQ(c.at("schema"), "trueaxis.comparison/2");
  EXPECT_EQ(c.at("diagnosis"), "d.json");
  EXPECT_EQ(c.at("input").at("hash"), result("d.json").at("input").at("hash"));
  expect_effect_taken_out(c, hidden_);
  const double line_mm = 5.0 * hidden_.sigma_mm * std::sqrt(2.0 / hidden_.readings);
  const json& first = c.at("lines").at(0);
  EXPECT_EQ(first.at("order"), 3.0);
  EXPECT_NEAR(first.at("before").at("value").get<double>(), hidden_.amplitude_mm, line_mm);
  EXPECT_LT(first.at("after").at("value").get<double>(), line_mm);
  const CommandStreams text = command("simulate --from d.json --compare");
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_EQ(first_line(text.out), "measured against simulated, 1669 readings");
  EXPECT_TRUE(contains(text.out, "\n  3.000 ")) << text.out;
}

// No catalogued cause has P2 along Z: it stays a pattern, and is played back as one.
TEST_F(SimulateFrom, APatternWithoutACauseIsPlayedBack) {
  HiddenEffect hidden;
  hidden.effect = "id = \"extra.form_cell\"\norder = 5\ndegree = 2\namplitude_um = 5\n";
  hidden.amplitude_mm = 0.005;
  hidden.mean_square = 0.5 / 5.0;  // of cos², and ∫P2² du/2 = 1/(2·2 + 1)
  hide(hidden);
  EXPECT_EQ(result("d.json").at("verdict"), "unexplained");
  expect_effect_taken_out(compared(), hidden_);
}

TEST_F(SimulateFrom, AGaugesZeroIsFound) {
  HiddenEffect hidden;
  hidden.probe = "[probe]\nrelative_zero_mm = 39.2\nnominal_radius_mm = 40\n";
  hide(hidden);
  const json c = compared();
  expect_effect_taken_out(c, hidden_);
  ASSERT_EQ(command("simulate --from d.json --noise-free -o again.csv").exit_code, 0);
  // Mean of the gauge's readings: those of a centred part, 40 − 39.2, and noise.
  double sum = 0.0, count = 0.0;
  for (const double reading : column(read_text(folder_ / "again.csv"), "X_M[mm]")) {
    sum += reading;
    count += 1.0;
  }
  EXPECT_EQ(count, hidden_.readings);
  EXPECT_NEAR(sum / count, 0.8, 5.0 * hidden_.sigma_mm / std::sqrt(count) + hidden_.uneven_mm);
}

TEST_F(SimulateFrom, TheMeasuredPartComesBackAsAStream) {
  hide({});
  ASSERT_EQ(command("simulate --from d.json -o again.csv --truth truth.json").exit_code, 0);
  ASSERT_EQ(command("simulate --from d.json --before -o before.csv").exit_code, 0);
  ASSERT_EQ(command("simulate --from d.json --seed 2 -o other.csv").exit_code, 0);
  const std::string measured = read_text(folder_ / "part.csv");
  const std::string again = read_text(folder_ / "again.csv");
  for (const char* name : {"C[rad]", "Z[mm]", "t[s]"}) {
    const auto was = column(measured, name), is = column(again, name);
    ASSERT_EQ(was.size(), is.size()) << name;
    for (std::size_t i = 0; i < was.size(); ++i) ASSERT_NEAR(is[i], was[i], 1e-9) << name;
  }
  EXPECT_NE(column(read_text(folder_ / "other.csv"), "X_M[mm]"), column(again, "X_M[mm]"));
  const json truth = result("truth.json");
  EXPECT_EQ(truth.at("effects").at(0).at("effect"), "part.roundness");
  // For the named model, whose effects are simulated; what is stated is an average.
  const json named = result("d.json").at("named").at("parameters");
  for (const char* name : {"x0", "y0", "l", "m"}) {
    EXPECT_NEAR(truth.at("parameters").at(name).at("value").get<double>(),
                named.at(name).at("value").get<double>(), 1e-12)
        << name;
  }
  // Diagnosed as the first was; without the effect there is nothing to find (false alarms 1 %,
  // seeded).
  const auto diagnosed = [&](const std::string& stream) {
    const CommandStreams done = command("diagnose " + stream + " --surface cylinder --json -");
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return json::parse(done.out);
  };
  const json second = diagnosed("again.csv");
  ASSERT_EQ(second.at("findings").size(), 1u);
  const auto amplitude = [](const json& d) {
    return d.at("findings").at(0).at("parameters").at("amplitude");
  };
  const json first = amplitude(result("d.json")), now = amplitude(second);
  const double u = now.at("u").get<double>();
  EXPECT_NEAR(now.at("value").get<double>(), first.at("value").get<double>(), 5.0 * u);
  EXPECT_EQ(diagnosed("before.csv").at("verdict"), "ideal");
}

TEST_F(SimulateFrom, NoiseFreeReadingsLeaveTheDiscrepancyThatIsStated) {
  hide({});
  const json c = compared();
  const auto measured = column(read_text(folder_ / "part.csv"), "X_M[mm]");
  for (const char* which : {"before", "after"}) {
    const std::string flag = which == std::string("before") ? " --before" : "";
    ASSERT_EQ(command("simulate --from d.json --noise-free -o clean.csv" + flag).exit_code, 0);
    const auto clean = column(read_text(folder_ / "clean.csv"), "X_M[mm]");
    ASSERT_EQ(clean.size(), measured.size());
    double squares = 0.0;
    for (std::size_t i = 0; i < clean.size(); ++i)
      squares += (measured[i] - clean[i]) * (measured[i] - clean[i]);
    const double rms = std::sqrt(squares / static_cast<double>(clean.size()));
    EXPECT_NEAR(rms, c.at(which).at("rms").at("value").get<double>(), 1e-8) << which;
  }
}

TEST_F(SimulateFrom, TheStreamIsFoundBesideTheDiagnosisOrWhereItIsSaidToBe) {
  hide({});
  std::filesystem::create_directories(folder_ / "kept");
  for (const char* name : {"part.csv", "d.json"})
    std::filesystem::rename(folder_ / name, folder_ / "kept" / name);
  EXPECT_EQ(command("simulate --from kept/d.json --compare").exit_code, 0);
  std::filesystem::rename(folder_ / "kept/part.csv", folder_ / "moved.csv");
  expect_input_error("simulate --from kept/d.json --compare", "say where it is with --stream");
  EXPECT_EQ(command("simulate --from kept/d.json --stream moved.csv --compare").exit_code, 0);
}

TEST_F(SimulateFrom, RefusesWhatDoesNotBelongTogether) {
  hide({});
  HiddenEffect another;
  another.seed = 9;
  file("another.toml", another.scenario());
  ASSERT_EQ(command("simulate another.toml -o another.csv").exit_code, 0);
  expect_input_error("simulate --from d.json --stream another.csv --compare",
                     "is the diagnosis of another stream");
  expect_input_error("simulate --from d.json --diameter --compare", "correct one");
  expect_input_error("simulate --from d.json --ball-radius-mm 2 --compare", "--diameter");
  expect_input_error("simulate --from gone.json --compare", "gone.json: cannot be read");
  expect_input_error("simulate --from part.csv --compare", "trueaxis.diagnosis/3");
  file("empty.json", "{}");
  expect_input_error("simulate --from empty.json --compare", "trueaxis.diagnosis/3");
  ASSERT_EQ(command("fit part.csv --surface cylinder --json fit.json").exit_code, 0);
  expect_input_error("simulate --from fit.json --compare",
                     "its schema is not trueaxis.diagnosis/3");
  json open = result("d.json");
  open.at("named").at("status") = "rank_deficient";
  file("open.json", open.dump());
  expect_input_error("simulate --from open.json --compare", "not converged (rank_deficient)");
  json unknown = result("d.json");
  unknown.at("findings").at(0).at("effect") = "part.bogus";
  file("unknown.json", unknown.dump());
  expect_input_error("simulate --from unknown.json --compare", "has no `part.bogus`");
}

TEST_F(SimulateFrom, UsageErrors) {
  for (const char* arguments :
       {"simulate --from d.json", "simulate s.toml --from d.json -o s.csv",
        "simulate --from d.json --compare -o s.csv", "simulate s.toml --before -o s.csv",
        "simulate s.toml --compare", "simulate s.toml --diameter -o s.csv",
        "simulate --from d.json --table t.csv -o s.csv",
        "simulate --from d.json --truth t.json --compare",
        "simulate --from d.json --json - -o -"}) {
    const CommandStreams done = command(arguments);
    EXPECT_EQ(done.exit_code, 2) << arguments << '\n' << done.err;
    EXPECT_EQ(done.out, "") << arguments;
    EXPECT_EQ(files_in(folder_), std::vector<std::string>{}) << arguments;
  }
}

}  // namespace
}  // namespace trueaxis::testing
