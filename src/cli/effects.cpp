// SPDX-License-Identifier: Apache-2.0
#include <fmt/ranges.h>

#include <iostream>
#include <memory>

#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "effect/files/effects_files.hpp"
#include "trueaxis/effect.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

struct EffectsArguments {
  std::string id;
  bool json = false, markdown = false;
};

const Effect& known_effect(const std::string& id) {
  if (const Effect* effect = find_effect(id)) return *effect;
  throw InputError(
      id, fmt::format("is not in the catalogue; the nearest are {} (trueaxis effects lists "
                      "all)",
                      fmt::join(nearest_effects(id), ", ")));
}

int execute(const EffectsArguments& options) {
  std::vector<const Effect*> chosen;
  if (!options.id.empty()) chosen.push_back(&known_effect(options.id));
  if (options.markdown) {
    std::cout << effects_markdown();
  } else if (options.json) {
    if (options.id.empty()) {
      for (const Effect& effect : effect_catalogue()) chosen.push_back(&effect);
    }
    std::cout << effects_json(chosen);
  } else {
    std::cout << (chosen.empty() ? effects_list_text() : effect_text(*chosen.front()));
  }
  return done;
}

}  // namespace

void add_effects(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<EffectsArguments>();
  command->add_option("id", options->id, "cause to explain, as part.bow");
  command->add_flag("--markdown", options->markdown, "print the catalogue as a page");
  command->add_flag("--json", options->json, "print as JSON (trueaxis.effects/1)");
  command->callback([options, &exit_code] { exit_code = execute(*options); });
}

}  // namespace trueaxis::cli
