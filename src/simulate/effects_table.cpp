// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include "simulate/chain.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::virtual_lathe {
namespace {

const std::vector<EffectEntry>& entries() {
  static const std::vector<EffectEntry> all = [] {
    std::vector<EffectEntry> list;
    for (const auto part :
         {part_effects(), machine_effects(), probe_effects(), extra_effects(), pattern_effects()}) {
      list.insert(list.end(), part.begin(), part.end());
    }
    return list;
  }();
  return all;
}

const EffectEntry& find_entry(std::string_view id) {
  std::string known;
  for (const EffectEntry& entry : entries()) {
    if (entry.kind.id == id) return entry;
    known += (known.empty() ? "" : ", ") + std::string(entry.kind.id);
  }
  throw InputError("scenario",
                   "no effect has the id `" + std::string(id) + "`; known ids: " + known);
}

}  // namespace

std::span<const EffectKind> effect_kinds() {
  static const std::vector<EffectKind> kinds = [] {
    std::vector<EffectKind> list;
    for (const EffectEntry& entry : entries()) list.push_back(entry.kind);
    return list;
  }();
  return kinds;
}

const EffectKind& find_effect_kind(std::string_view id) { return find_entry(id).kind; }

void validate(const Effect& effect) {
  const EffectKind& kind = find_effect_kind(effect.id);
  std::vector<Diagnostic> wrong;
  std::string known;
  for (const EffectParameter& parameter : kind.parameters) {
    known += (known.empty() ? "" : ", ") + std::string(parameter.name);
    if (!parameter.fallback && !effect.parameters.contains(std::string(parameter.name))) {
      wrong.push_back(
          {"scenario", 0, 0, effect.id + " needs `" + std::string(parameter.name) + "`"});
    }
  }
  for (const auto& [name, value] : effect.parameters) {
    const auto same = [&](const EffectParameter& parameter) { return parameter.name == name; };
    if (std::any_of(kind.parameters.begin(), kind.parameters.end(), same)) continue;
    wrong.push_back({"scenario", 0, 0,
                     effect.id + " has no parameter `" + name + "`; known parameters: " + known});
  }
  if (!wrong.empty()) throw InputError(std::move(wrong));
}

double parameter(const Effect& effect, std::string_view name) {
  const auto given = effect.parameters.find(std::string(name));
  if (given != effect.parameters.end()) return given->second;
  for (const EffectParameter& known : find_effect_kind(effect.id).parameters) {
    if (known.name == name && known.fallback) return *known.fallback;
  }
  throw ContractViolation("effect " + effect.id + ": expects parameter " + std::string(name));
}

Chain make_chain(const std::vector<Effect>& effects) {
  for (const Effect& effect : effects) validate(effect);
  Chain chain;
  for (const EffectEntry& entry : entries()) {
    for (const Effect& effect : effects) {
      if (effect.id == entry.kind.id) entry.enter(Values(effect), chain);
    }
  }
  return chain;
}

}  // namespace trueaxis::virtual_lathe
