// SPDX-License-Identifier: Apache-2.0
#include "job/files/influences_toml.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

#include "trueaxis/effect.hpp"

namespace trueaxis {
namespace {

/// What the parameter of the cause may be at all.
Range possible(Influence::Kind kind) {
  const auto effect =
      std::ranges::find(effect_catalogue(), std::optional(kind), &Effect::stated_as);
  if (effect == effect_catalogue().end()) return {};
  for (const LinearParameter& one : linear_parameters(effect->term, {}))
    if (const EffectParameter* size = size_for(*effect, one))
      return Range::between(size->least, size->most);
  return {};
}

}  // namespace

std::vector<Influence> read_influences(TomlTable& table) {
  std::vector<Influence> out;
  for (const InfluenceInfo& info : influence_catalogue()) {
    const std::string key(info.key);
    const auto u = table.maybe_number("u_" + key, Range::non_negative());
    std::optional<double> value;
    if (info.has_value) value = table.maybe_number(key, possible(info.kind));
    if (value && !u)
      table.complain(
          key, "is stated without its standard uncertainty: add u_" + std::string(info.stated));
    if (u) out.push_back({info.kind, *u, value.value_or(0.0)});
  }
  return out;
}

std::vector<Influence> influences_of(const std::vector<std::string>& said) {
  std::string content;
  for (const std::string& one : said) {
    const std::size_t equals = std::min(one.find('='), one.size());
    const std::string key = one.substr(0, equals);
    std::string value = one.substr(std::min(equals + 1, one.size())), u;
    for (const std::string_view between : {"\u00b1", "+/-", "+-"}) {
      const std::size_t at = value.find(between);
      if (at == std::string::npos) continue;
      u = value.substr(at + between.size());
      value.resize(at);
      break;
    }
    content += key + " = " + value + "\n";
    if (!u.empty()) content += "u_" + key + " = " + u + "\n";
  }
  TomlDocument document(content, "--known");
  TomlTable root = document.root();
  std::vector<Influence> out = read_influences(root);
  document.finish();
  return out;
}

}  // namespace trueaxis
