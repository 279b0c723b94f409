// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "simulate/files/scenario_files.hpp"
#include "support/command.hpp"
#include "support/places.hpp"
#include "trueaxis/effect.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::testing {
namespace {

TEST(EffectsCommand, ListsEveryEffect) {
  const CommandResult list = trueaxis_command("effects");
  EXPECT_EQ(list.exit_code, 0);
  for (const Effect& effect : effect_catalogue()) {
    EXPECT_NE(list.output.find("  " + std::string(effect.id) + " "), std::string::npos)
        << effect.id;
  }
}

TEST(EffectsCommand, ExplainsEachWithAllThatTheEntrySays) {
  for (const Effect& effect : effect_catalogue()) {
    const CommandResult page = trueaxis_command("effects " + std::string(effect.id));
    ASSERT_EQ(page.exit_code, 0) << effect.id;
    const auto says = [&](std::string_view text) {
      EXPECT_NE(page.output.find(text), std::string::npos) << effect.id << ": " << text;
    };
    for (const std::string_view text :
         {effect.title, effect.formula, effect.signature, effect.consequence, effect.absorbed_by,
          to_string(effect.frame), effect.source})
      says(text);
    for (const std::string_view id : effect.confounders) says(id);
    for (const EffectParameter& parameter : effect.parameters) says(parameter.meaning);
    for (const Separation& separation : effect.separations) says(separation.how);
    if (effect.axis_bias) says(effect.axis_bias->text);
  }
  // 5-20 seconds of arc, the unit of the page.
  EXPECT_NE(trueaxis_command("effects encoder.eccentricity").output.find("24 to 97 urad"),
            std::string::npos);
}

// A scenario written from what is listed, every key at 1, is read.
TEST(EffectsCommand, ListsTheKeysOfAScenariosEffect) {
  std::size_t keys = 0;
  for (const virtual_lathe::EffectKind& kind : virtual_lathe::effect_kinds()) {
    const std::string id(kind.id);
    if (find_effect(id) == nullptr) continue;
    const auto json = nlohmann::json::parse(trueaxis_command("effects " + id + " --json -").output);
    const std::string page = trueaxis_command("effects " + id).output;
    std::string text = "[[effect]]\nid = \"" + id + "\"\n";
    for (const auto& key : json.at("effects").at(0).at("scenario_keys")) {
      const std::string name = key.at("key");
      EXPECT_NE(page.find(name), std::string::npos) << id << ' ' << name;
      text += name + " = 1\n";
      ++keys;
    }
    EXPECT_NO_THROW(
        parse_scenario_toml("[part]\nkind = \"cylinder\"\nradius_mm = 9\n[[pass]]\n"
                            "z_start_mm = 0\nz_end_mm = 1\n" +
                                text,
                            id))
        << text;
  }
  EXPECT_GT(keys, 50U);
}

TEST(EffectsCommand, JsonIsInTheUnitsOfTheContract) {
  const CommandResult all = trueaxis_command("effects --json -");
  ASSERT_EQ(all.exit_code, 0);
  const auto json = nlohmann::json::parse(all.output);
  EXPECT_EQ(json.at("schema"), "trueaxis.effects/1");
  EXPECT_EQ(json.at("effects").size(), effect_catalogue().size());
  EXPECT_EQ(json.at("measurements").size(), separators().size());
  const auto one = nlohmann::json::parse(trueaxis_command("effects probe.tilt --json -").output);
  ASSERT_EQ(one.at("effects").size(), 1u);
  const auto tilt = one.at("effects").at(0).at("parameters").at(0);
  EXPECT_EQ(tilt.at("unit"), "deg");
  EXPECT_NEAR(tilt.at("typical").at(1).get<double>(), 0.114592, 1e-6);  // 2 mrad
}

TEST(EffectsCommand, DocsEffectsIsTheCatalogueOfToday) {
  const CommandResult page = trueaxis_command("effects --markdown");
  ASSERT_EQ(page.exit_code, 0);
  EXPECT_EQ(page.output,
            read_text(std::filesystem::path(places::source()) / "docs/reference/effects.md"))
      << "write it anew: trueaxis effects --markdown > docs/reference/effects.md";
  for (const Effect& effect : effect_catalogue())
    EXPECT_NE(page.output.find("\n## " + std::string(effect.id) + "\n"), std::string::npos);
}

TEST(EffectsCommand, AnUnknownIdNamesTheNearest) {
  const CommandResult wrong = trueaxis_command("effects part.bwo");
  EXPECT_EQ(wrong.exit_code, 3);
  EXPECT_NE(wrong.output.find("part.bow"), std::string::npos) << wrong.output;
  EXPECT_EQ(trueaxis_command("effects part.bow part.slip").exit_code, 2);
}

}  // namespace
}  // namespace trueaxis::testing
