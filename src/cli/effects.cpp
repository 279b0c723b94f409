// SPDX-License-Identifier: Apache-2.0
#include <fmt/ranges.h>

#include <iostream>
#include <memory>

#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/results.hpp"
#include "effect/files/effects_files.hpp"
#include "format/outputs.hpp"
#include "trueaxis/effect.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

struct EffectsArguments {
  std::string id;
  Results results;
  bool markdown = false;
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
    return done;
  }
  Outputs outputs(options.results.force);
  options.results.name_to(outputs);
  outputs.check();
  options.results.write(outputs, "--json", [&] {
    std::vector<const Effect*> written = chosen;
    if (written.empty())
      for (const Effect& effect : effect_catalogue()) written.push_back(&effect);
    return effects_json(written);
  });
  outputs.commit();
  if (!options.results.printed()) {
    std::cout << (chosen.empty() ? effects_list_text() : effect_text(*chosen.front()));
  }
  return done;
}

}  // namespace

void add_effects(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<EffectsArguments>();
  command->add_option("id", options->id, "cause to explain, as part.bow");
  command->add_flag("--markdown", options->markdown, "print the catalogue as a page");
  add_json(*command, options->results, "trueaxis.effects");
  add_force(*command, options->results.force);
  command->callback([options, &exit_code] { exit_code = execute(*options); });
}

}  // namespace trueaxis::cli
