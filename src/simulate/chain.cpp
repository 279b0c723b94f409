// SPDX-License-Identifier: Apache-2.0
#include "simulate/chain.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <string>

#include "simulate/effects.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::virtual_lathe {
namespace {

const std::vector<EffectEntry>& entries() {
  static const std::vector<EffectEntry> all = [] {
    std::vector<EffectEntry> list;
    for (const auto part :
         {part_effects(), machine_effects(), probe_effects(), face_effects(), extra_effects()})
      list.insert(list.end(), part.begin(), part.end());
    return list;
  }();
  return all;
}

}  // namespace

std::span<const EffectKind> effect_kinds() {
  static const std::vector<EffectKind> kinds = [] {
    std::vector<EffectKind> list;
    for (const EffectEntry& entry : entries()) {
      const auto* end = std::ranges::find(entry.parameters, "", &LatheParameter::name);
      list.push_back({entry.id, entry.what, {entry.parameters, end}});
    }
    return list;
  }();
  return kinds;
}

const EffectKind& find_effect_kind(std::string_view id) {
  const auto kinds = effect_kinds();
  const auto at = std::ranges::find(kinds, id, &EffectKind::id);
  if (at != kinds.end()) return *at;
  std::vector<std::string_view> known;
  for (const EffectKind& kind : kinds) known.push_back(kind.id);
  throw InputError("scenario", fmt::format("no effect has the id `{}`; known ids: {}", id,
                                           fmt::join(known, ", ")));
}

void validate(const Effect& effect) {
  const EffectKind& kind = find_effect_kind(effect.id);
  std::vector<Diagnostic> wrong;
  std::vector<std::string_view> known;
  for (const LatheParameter& parameter : kind.parameters) {
    known.push_back(parameter.name);
    if (!parameter.fallback && !effect.parameters.contains(std::string(parameter.name))) {
      wrong.push_back(
          {"scenario", 0, 0, effect.id + " needs `" + std::string(parameter.name) + "`"});
    }
  }
  for (const auto& [name, value] : effect.parameters) {
    if (std::ranges::find(known, name) != known.end()) continue;
    wrong.push_back({"scenario", 0, 0,
                     fmt::format("{} has no parameter `{}`; known parameters: {}", effect.id, name,
                                 fmt::join(known, ", "))});
  }
  if (!wrong.empty()) throw InputError(std::move(wrong));
}

double parameter(const Effect& effect, std::string_view name) {
  const auto given = effect.parameters.find(std::string(name));
  if (given != effect.parameters.end()) return given->second;
  for (const LatheParameter& known : find_effect_kind(effect.id).parameters) {
    if (known.name == name && known.fallback) return *known.fallback;
  }
  throw ContractViolation("effect " + effect.id + ": expects parameter " + std::string(name));
}

Chain make_chain(const std::vector<Effect>& effects) {
  for (const Effect& effect : effects) validate(effect);
  Chain chain;
  for (const EffectEntry& entry : entries()) {
    for (const Effect& effect : effects) {
      if (effect.id == entry.id) entry.enter(Values(effect), chain);
    }
  }
  return chain;
}

}  // namespace trueaxis::virtual_lathe
