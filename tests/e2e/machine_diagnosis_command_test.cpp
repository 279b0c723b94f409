// SPDX-License-Identifier: Apache-2.0
// `diagnose --machine` and `advise --machine` as a user meets them.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/command.hpp"
#include "support/open_page.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

using nlohmann::json;

const std::string data = places::source() + "/data/five_axis/";
const std::string machine = data + "trunnion_ac.toml", ball = data + "trunnion_ac_ball.csv";

json diagnosed(const std::string& more = "") {
  const auto folder = fresh_folder("machine_diagnosis");
  const std::string out = (folder / "diagnosis.json").string();
  const auto ran = trueaxis_command("machine diagnose " + ball + " --machine " + machine +
                                    " --json " + out + more);
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
  return read_json(out);
}

std::set<std::string> keys(const json& object) {
  std::set<std::string> out;
  for (const auto& [key, value] : object.items()) out.insert(key);
  return out;
}

// Every key of a surface's diagnosis is one of a machine's, but those that speak of a surface.
TEST(MachineDiagnosisCommand, HasTheKeysOfADiagnosis) {
  const auto folder = fresh_folder("machine_diagnosis_keys");
  write_text(folder / "part.toml",
             "seed = 1\n[part]\nkind = \"cylinder\"\nradius_mm = 40\n[noise]\nsigma_um = 2\n"
             "[[pass]]\nz_start_mm = 0\nz_end_mm = 60\nfeed_mm_per_rev = 1\n"
             "readings_per_revolution = 23.7\nspeed_rpm = 60\n"
             "[[effect]]\nid = \"part.roundness\"\norder = 3\namplitude_um = 5\nphase_deg = 10\n");
  const std::string at = folder.string();
  auto ran = trueaxis_command("simulate " + at + "/part.toml -o " + at + "/part.csv");
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  ran = trueaxis_command("diagnose " + at + "/part.csv --surface cylinder --json " + at +
                         "/part.json");
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const json of_surface = read_json(folder / "part.json"), of_machine = diagnosed();
  const auto expect_keys = [](const json& from, const json& in, std::set<std::string> less) {
    const auto there = keys(in);
    for (const std::string& key : keys(from))
      EXPECT_TRUE(less.contains(key) || there.contains(key)) << key;
  };
  expect_keys(of_surface, of_machine,
              {"form", "input", "named", "shares", "limits", "u_frame", "spectrum"});
  ASSERT_FALSE(of_surface.at("findings").empty());
  ASSERT_FALSE(of_machine.at("findings").empty());
  const json &one = of_surface.at("findings")[0], &other = of_machine.at("findings")[0];
  expect_keys(one, other, {"axis_bias", "frame", "name"});
  expect_keys(one.at("term"), other.at("term"), {"slot"});
  expect_keys(of_surface.at("checks")[0], of_machine.at("checks")[0], {});
}

TEST(MachineDiagnosisCommand, SaysTheTermWithItsNumbers) {
  const json d = diagnosed();
  const json& term = d.at("findings")[0].at("term");
  EXPECT_EQ(d.at("findings")[0].at("effect"), "EXC.harmonic2");
  EXPECT_EQ(term.at("shape").at("order").at("value"), 2.0);
  ASSERT_EQ(term.at("linear").size(), 2U);
  const double u = d.at("findings")[0].at("parameters").at("cos").at("u");
  EXPECT_NEAR(term.at("covariance")[0][0].get<double>(), u * u, 1e-9 * u * u);
  EXPECT_GT(d.at("effective_hypotheses").get<double>(), 10.0);
  EXPECT_LT(d.at("effective_hypotheses").get<double>(), d.at("hypotheses").get<double>());
  // Every 30 degrees order 10 reads as order 2.
  EXPECT_EQ(d.at("findings")[0].at("alias"), "order 10");
}

// A reader of the result takes no id apart: title, kind, axis and error of each come with it.
TEST(MachineDiagnosisCommand, SaysWhatIsBehindEveryId) {
  const json d = diagnosed();
  const json& effects = d.at("effects");
  EXPECT_EQ(effects.at("EXC.harmonic2"),
            json({{"title", "along X, as C moves, 2 times per revolution"},
                  {"kind", "position"},
                  {"axis", "C"},
                  {"error", "EXC"}}));
  EXPECT_EQ(effects.at("reversal.C").at("kind"), "sense");
  EXPECT_EQ(effects.at("reversal.C").at("axis"), "C");
  EXPECT_EQ(effects.at("drift.Z").at("kind"), "tip_drift");
  EXPECT_TRUE(effects.at("drift.Z").at("axis").is_null());
  EXPECT_EQ(effects.at("ball.slip").at("kind"), "ball_step");
  std::set<std::string> named;
  for (const json& finding : d.at("findings"))
    for (const std::string id : finding.at("class")) named.insert(id);
  for (const json& unseen : d.at("not_observable")) named.insert(unseen.at("effect"));
  EXPECT_GT(named.size(), 3U);
  for (const std::string& id : named) {
    ASSERT_TRUE(effects.contains(id)) << id;
    EXPECT_NE(effects.at(id).at("title"), "") << id;
  }
}

// EXC is a motion along X before C turns the part: its size is what it does to a tip, wherever the
// program has C where the harmonic peaks; at every block it is that or less.
TEST(MachineDiagnosisCommand, WeighsTheHarmOnAProgram) {
  const json d = diagnosed(" --program " + data + "blade.nc");
  const json& program = d.at("program");
  const json& first = program.at("by_effect")[0];
  EXPECT_EQ(first.at("effect"), "EXC.harmonic2");
  EXPECT_TRUE(first.at("found").get<bool>());
  const double size = d.at("findings")[0].at("size").at("value"), tip = first.at("tip").at("value");
  EXPECT_LE(tip, size * (1 + 1e-9));
  EXPECT_GT(tip, 0.95 * size);
  const double U = program.at("U_without_place_of_part").at("value");
  EXPECT_GT(U, 0.0);
  ASSERT_EQ(program.at("plans").size(), d.at("plans").size());
  for (const json& plan : program.at("plans"))  // further readings never tell less
    EXPECT_LE(plan.at("U_without_place_of_part").at("value").get<double>(), U * (1 + 1e-6)) << plan;
}

TEST(MachineDiagnosisCommand, AdvisesBeforeAnyDataAndAfter) {
  auto ran = trueaxis_command("advise --machine " + machine + " --program " + data + "blade.nc");
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
  EXPECT_EQ(ran.output.find("NEXT: B1"), 0U) << ran.output;
  EXPECT_NE(ran.output.find("\nU      of the tip "), std::string::npos);
  ran = trueaxis_command("advise " + ball + " --machine " + machine);
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
  EXPECT_NE(ran.output.find("L2: "), std::string::npos) << ran.output;
}

// The plan as a table has the columns of a measurement: empty it is refused row by row, filled in
// it is read as one.
TEST(MachineDiagnosisCommand, WritesThePositionsOfTheNextMeasurement) {
  const auto folder = fresh_folder("machine_plan");
  const std::string plan = (folder / "plan.csv").string(), out = (folder / "all.json").string();
  auto ran = trueaxis_command("advise --machine " + machine + " -o " + plan + " --json " + out);
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const json measurement = read_json(out).at("next_measurement").at("measurement");
  std::string text = read_text(plan);
  EXPECT_EQ(text.find("# schema: trueaxis.measurement_plan/1\n# plan B1"), 0U) << text;
  const auto lines = std::ranges::count(text, '\n');
  const auto rows = static_cast<std::ptrdiff_t>(measurement.at("rows").size());
  EXPECT_GT(rows, 100);
  const std::string table = text.substr(text.find("setup,ball"));
  EXPECT_EQ(std::ranges::count(table, ','), (rows + 1) * 10);  // eleven columns
  EXPECT_GT(lines, rows);
  ran = trueaxis_command("machine diagnose " + plan + " --machine " + machine);
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_NE(ran.output.find("dX is empty"), std::string::npos) << ran.output;
  // Three readings a row, of a wavy pattern: any numbers will do.
  std::string filled;
  int row = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text.compare(at, 4, ",,,\n") == 0) {
      for (const int period : {3, 5, 7}) filled.append(",").append(std::to_string(row % period));
      filled.append("\n");
      ++row;
      at += 3;
    } else {
      filled += text[at];
    }
  }
  EXPECT_EQ(row, rows);
  write_text(folder / "filled.csv", filled);
  ran = trueaxis_command("machine diagnose " + (folder / "filled.csv").string() + " --machine " +
                         machine);
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
  ran = trueaxis_command("advise " + ball + " --machine " + machine + " -o " + ball);
  EXPECT_EQ(ran.exit_code, 3) << ran.output;  // never over what is read
  EXPECT_EQ(trueaxis_command("advise " + ball + " --surface cone -o " + plan).exit_code, 2);
}

TEST(MachineDiagnosisCommand, RefusesAProgramThatMovesNothing) {
  const auto folder = fresh_folder("machine_no_program");
  write_text(folder / "empty.nc", "");
  write_text(folder / "words.nc", "%\nO1 (nothing)\nG90 G21\nM30\n%\n");
  for (const char* name : {"empty.nc", "words.nc"}) {
    const std::string program = (folder / name).string();
    for (const std::string& command :
         {"machine diagnose " + ball + " --machine " + machine + " --program " + program,
          "machine compensate " + program + " --machine " + machine + " --errors " + data +
              "trunnion_ac_errors.toml -o " + (folder / "out.nc").string()}) {
      const auto ran = trueaxis_command(command);
      EXPECT_EQ(ran.exit_code, 3) << command << ran.output;
      EXPECT_NE(ran.output.find("moves no axis"), std::string::npos) << ran.output;
    }
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out.nc"));
}

TEST(MachineDiagnosisCommand, RefusesWhatIsOfTheOther) {
  EXPECT_EQ(trueaxis_command("advise").exit_code, 2);
  EXPECT_EQ(trueaxis_command("advise " + ball + " --surface cone --machine " + machine).exit_code,
            2);
  EXPECT_EQ(trueaxis_command("diagnose " + ball + " --surface cone --program p.nc").exit_code, 2);
  const auto ran = trueaxis_command("machine diagnose " + ball + " --machine " + machine +
                                    " --program " + machine);
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_NE(ran.output.find("trunnion_ac.toml:2:"), std::string::npos) << ran.output;
}

// Readings in µm that are called mm: no machine is so far from its model.
TEST(MachineDiagnosisCommand, RefusesWhatCannotBeRight) {
  const auto folder = fresh_folder("machine_diagnosis_refused");
  std::string text = read_text(ball);
  for (std::size_t at; (at = text.find("[um]")) != std::string::npos;) text.replace(at, 4, "[mm]");
  write_text(folder / "ball.csv", text);
  const std::string at = folder.string();
  const auto ran = trueaxis_command("machine diagnose " + at + "/ball.csv --machine " + machine +
                                    " --json " + at + "/out.json -o " + at + "/errors.toml");
  EXPECT_EQ(ran.exit_code, 1) << ran.output;
  EXPECT_NE(ran.output.find("write [um] after their names"), std::string::npos) << ran.output;
  EXPECT_FALSE(std::filesystem::exists(folder / "out.json"));
  EXPECT_FALSE(std::filesystem::exists(folder / "errors.toml"));
}

// The page of a diagnosis: opened as a reader would, with and without a program; its verdict and
// next step are those of the screen, and what each effect does on the program is in it.
TEST(MachineDiagnosisCommand, WritesAPage) {
  const auto folder = fresh_folder("machine_diagnosis_page");
  const std::string page = (folder / "d.html").string(), json_file = (folder / "d.json").string();
  const std::string zxacy =
      "machine diagnose " + data + "zxacy_ball.csv --machine " + data + "zxacy.toml";
  for (const std::string& program : {std::string(), " --program " + data + "blade.nc"}) {
    const auto ran = trueaxis_command(zxacy + program + " --report " + page + " --json " +
                                      json_file + " --force");
    ASSERT_EQ(ran.exit_code, 0) << ran.output;
    EXPECT_NE(ran.output.find("\nreport " + page), std::string::npos) << ran.output;
    const std::string text = read_text(page);
    const std::string begin = "<script id=\"data\" type=\"application/json\">";
    const std::size_t at = text.find(begin) + begin.size();
    const json shown = json::parse(text.substr(at, text.find("</script>", at) - at));
    EXPECT_EQ(shown.at("schema"), "trueaxis.machine_report/1");
    EXPECT_EQ(shown.at("verdict").at("outcome"), "effects");
    EXPECT_TRUE(shown.at("verdict").at("next").get<std::string>().starts_with(
        "Measure the same positions"));
    EXPECT_EQ(shown.at("diagnosis").at("findings"), read_json(json_file).at("findings"));
    EXPECT_FALSE(shown.at("maps").empty());
    EXPECT_EQ(shown.contains("harm"), !program.empty());
    if (!program.empty()) {
      EXPECT_EQ(shown.at("harm").at("by_effect"),
                read_json(json_file).at("program").at("by_effect"));
    }
    if (!example::can_open_pages()) continue;
    const auto opinion = program.empty() ? example::open_page(text, "machine_diagnosis", "--wide")
                                         : example::open_page(text, "machine_diagnosis_part");
    EXPECT_TRUE(opinion.sound) << opinion.log;
  }
  const auto same = trueaxis_command(zxacy + " --report " + page + " --json " + page);
  EXPECT_EQ(same.exit_code, 2) << same.output;
}

}  // namespace
}  // namespace trueaxis::testing
