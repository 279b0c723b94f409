// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "simulate/files/scenario_files.hpp"
#include "support/places.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {
namespace {

using namespace virtual_lathe;

const std::string folder = places::source() + "/data/scenarios/";

TEST(SimulateScenario, TheConeOfThePaperIsReadAndProbed) {
  const Scenario scenario = read_scenario_toml(folder + "cone_shaft.toml");
  EXPECT_EQ(scenario.part.kind, PartKind::cone);
  EXPECT_EQ(scenario.part.apex_mm, 402.0);
  EXPECT_DOUBLE_EQ(scenario.part.half_angle_rad, 15.5 * rad_per_deg);
  EXPECT_DOUBLE_EQ(scenario.noise.sigma_mm, 0.01);
  const ProbeStream stream = simulate(scenario);
  EXPECT_EQ(stream.size(), 2001u);  // 40 mm at 0.2 mm/rev, ten readings per revolution, both ends
  EXPECT_EQ(stream.sensor_noise_mm, 0.01);
  EXPECT_EQ(stream.spindle_rpm, 60.0);
  EXPECT_DOUBLE_EQ(stream.time_s.back(), 200.0);
}

TEST(SimulateScenario, TheBoreHasThreePassesAndItsEffects) {
  const Scenario scenario = read_scenario_toml(folder + "bore_cylinder.toml");
  ASSERT_EQ(scenario.effects.size(), 2u);
  EXPECT_DOUBLE_EQ(scenario.effects[0].parameters.at("amplitude_mm"), 0.004);
  EXPECT_DOUBLE_EQ(scenario.effects[0].parameters.at("phase_rad"), 30.0 * rad_per_deg);
  const Simulation simulation = simulate_with_truth(scenario);
  EXPECT_EQ(simulation.stream.pass.back(), 3);
  EXPECT_EQ(simulation.stream.c_rad.back(), simulation.stream.c_rad[simulation.stream.size() - 2]);
  EXPECT_EQ(simulation.stream.spindle_rpm, std::nullopt);
  EXPECT_EQ(simulation.stream.ball_radius_mm, 1.0);
}

TEST(SimulateScenario, TruthHasEveryNumberWithItsUnit) {
  Scenario scenario = read_scenario_toml(folder + "bore_cylinder.toml");
  const auto json = nlohmann::json::parse(truth_json(simulate_with_truth(scenario).truth));
  EXPECT_EQ(json["schema"], "trueaxis.truth/1");
  EXPECT_EQ(json["surface"], "cylinder");
  EXPECT_EQ(json["parameters"]["x0"]["value"], -0.04);
  EXPECT_EQ(json["parameters"]["x0"]["unit"], "mm");
  EXPECT_EQ(json["parameters"]["radius"]["value"], 25.0);
  EXPECT_EQ(json["effects"][0]["effect"], "part.roundness");
  EXPECT_NEAR(json["effects"][0]["parameters"]["phase"]["value"].get<double>(), 30.0, 1e-12);
  EXPECT_EQ(json["effects"][0]["parameters"]["phase"]["unit"], "deg");
  EXPECT_EQ(json["seed"], 7);
  EXPECT_GT(json["outlier_rows"].size(), 0u);
}

struct BadScenario {
  const char* content;
  std::size_t line;
  const char* message;
};

class BadScenarios : public ::testing::TestWithParam<BadScenario> {};
void PrintTo(const BadScenario& bad, std::ostream* out) { *out << bad.message; }

TEST_P(BadScenarios, AreReportedWithTheirPlace) {
  const BadScenario& bad = GetParam();
  try {
    parse_scenario_toml(bad.content, "bad.toml");
    FAIL() << "was read";
  } catch (const InputError& error) {
    ASSERT_EQ(error.diagnostics().size(), 1u) << error.what();
    const Diagnostic& diagnostic = error.diagnostics().front();
    EXPECT_EQ(diagnostic.file, "bad.toml");
    EXPECT_EQ(diagnostic.line, bad.line) << error.what();
    EXPECT_GT(diagnostic.column, 0u);
    EXPECT_NE(diagnostic.message.find(bad.message), std::string::npos) << error.what();
  }
}

#define CYLINDER "[part]\nkind = 'cylinder'\nradius_mm = 20\n"
#define PASS "[[pass]]\nz_start_mm = 0\nz_end_mm = 5\n"

INSTANTIATE_TEST_SUITE_P(
    SimulateScenario, BadScenarios,
    ::testing::Values(
        BadScenario{CYLINDER, 1, "`pass` in the top level is missing"},
        BadScenario{"[part]\nkind = 'sphere'\nradius_mm = 2\n" PASS, 2, "must be one of"},
        BadScenario{CYLINDER "x0 = 1\n" PASS, 4, "did you mean `x0_mm`"},
        BadScenario{CYLINDER "x0_mm = '1'\n" PASS, 4, "is a string"},
        BadScenario{CYLINDER "l = 0.8\nm = 0.8\n" PASS, 4, "l^2 + m^2"},
        BadScenario{"[part]\nkind = 'cone'\nk_mm = 9\nhalf_angle_deg = 90\n" PASS, 4, "(0, 90)"},
        BadScenario{"[part]\nkind = 'cone'\nk_mm = 9\nhalf_angle_deg = 9\nradius_mm = 1\n" PASS, 5,
                    "contradicts `k_mm`"},
        BadScenario{CYLINDER "[[pass]]\nz_mm = 3\n", 5, "give its `revolutions`"},
        BadScenario{CYLINDER "[[pass]]\nz_mm = 3\nspeed_rpm = 0\n", 6, "give duration_s"},
        BadScenario{CYLINDER PASS "feed_mm_per_rev = -1\n", 7, "more than 0"},
        BadScenario{CYLINDER PASS "[noise]\nrho = 1\n", 8, "must be in (-1, 1)"},
        BadScenario{CYLINDER PASS "[[effect]]\nid = 'part.rondness'\nfoo = 1\n", 8, "known ids"},
        BadScenario{CYLINDER PASS "[[effect]]\nid = 'part.taper'\n", 7, "needs `amplitude_mm`"},
        BadScenario{CYLINDER PASS "[[effect]]\nid = 'part.taper'\namplitude_um = 1\norder = 2\n",
                    10, "no key `order`"},
        BadScenario{CYLINDER PASS "[cut]\nuse = 'all'\ntable = 't'\n[cut.target]\nz_start_mm = 0\n"
                                  "z_end_mm = 9\nradius_mm = 2\n",
                    8, "must be one of: command, wanted, none"},
        BadScenario{CYLINDER PASS "[cut]\nuse = 'none'\n[cut.target]\nz_start_mm = 0\n"
                                  "z_end_mm = 9\nradius_mm = 2\n[cut.tool]\nsense = 0\n",
                    14, "must be one of: +c, -c"},
        BadScenario{"a = \n", 1, "is not valid TOML"}));

TEST(SimulateScenario, EveryEffectCanBeReadFromItsOwnDescription) {
  for (const EffectKind& kind : effect_kinds()) {
    std::string text = CYLINDER PASS "[[effect]]\nid = '" + std::string(kind.id) + "'\n";
    Effect expected{std::string(kind.id), {}};
    for (const LatheParameter& parameter : kind.parameters) {
      std::string name(parameter.name);
      expected.parameters[name] = 2.0;
      text += name + " = 2\n";
    }
    const Scenario scenario = parse_scenario_toml(text, "s.toml");
    ASSERT_EQ(scenario.effects.size(), 1u);
    EXPECT_EQ(scenario.effects[0].id, kind.id);
    EXPECT_EQ(scenario.effects[0].parameters, expected.parameters) << kind.id;
  }
}

TEST(SimulateScenario, ACutIsRead) {
  const Scenario scenario = parse_scenario_toml(
      CYLINDER PASS
      "[cut]\ntable = 'path.csv'\n[cut.target]\nkind = 'cone'\nz_start_mm = 0\nz_end_mm = -9\n"
      "radius_mm = 20\nhalf_angle_deg = -5\n[cut.tool]\nnose_radius_mm = 0.4\nsense = -1\n"
      "[cut.actuator]\nperfect = true\n",
      "/jobs/s.toml");
  ASSERT_TRUE(scenario.cut.has_value());
  EXPECT_EQ(scenario.cut->table, "/jobs/path.csv");
  EXPECT_EQ(scenario.cut->target.kind, CutKind::cone);
  EXPECT_DOUBLE_EQ(scenario.cut->target.half_angle_rad, -5.0 * rad_per_deg);
  EXPECT_EQ(scenario.cut->tool.sense, -1);
  EXPECT_TRUE(scenario.cut->actuator.perfect);
}

}  // namespace
}  // namespace trueaxis
