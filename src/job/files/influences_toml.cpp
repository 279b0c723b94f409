// SPDX-License-Identifier: Apache-2.0
#include "job/files/influences_toml.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "base/diagnostics.hpp"
#include "format/nearest_key.hpp"
#include "format/units.hpp"
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

/// The keys of a known value as its users write them: those that are listed, and all units of them.
struct InfluenceKeys {
  std::vector<std::string> listed, accepted;
};

InfluenceKeys keys_of_influences() {
  InfluenceKeys keys;
  for (const InfluenceInfo& info : influence_catalogue()) {
    const std::string stated(info.stated);
    keys.listed.push_back(info.has_value ? stated : "u_" + stated);
    for (const KeySpelling& one : key_spellings(info.key)) {
      if (info.has_value) keys.accepted.push_back(one.key);
      keys.accepted.push_back("u_" + one.key);
    }
  }
  keys.accepted.insert(keys.accepted.begin(), keys.listed.begin(), keys.listed.end());
  return keys;
}

/// What is wrong with the key of a known value; empty: nothing.
std::string wrong_key(const std::string& key) {
  const InfluenceKeys keys = keys_of_influences();
  if (std::ranges::find(keys.accepted, key) != keys.accepted.end()) return "";
  const std::string near = nearest_key(key, keys.accepted);
  return fmt::format("there is no key `{}`{} Known keys: {}", key,
                     near.empty() ? "." : ", did you mean `" + near + "`?",
                     fmt::join(keys.listed, ", "));
}

struct StatedValue {
  std::string key, value, u;
};

/// "lag_ms=0.4±0.1"
StatedValue stated_value(const std::string& said) {
  const std::size_t equals = std::min(said.find('='), said.size());
  StatedValue out{said.substr(0, equals), said.substr(std::min(equals + 1, said.size())), ""};
  for (const std::string_view between : {"\u00b1", "+/-", "+-"}) {
    const std::size_t at = out.value.find(between);
    if (at == std::string::npos) continue;
    out.u = out.value.substr(at + between.size());
    out.value.resize(at);
    break;
  }
  return out;
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
  constexpr const char* option = "--known";
  std::vector<StatedValue> all;
  std::ranges::transform(said, std::back_inserter(all), stated_value);
  std::vector<Diagnostic> wrong;
  std::string content;
  for (const StatedValue& one : all) {
    std::string why = wrong_key(one.key);
    const bool alone = one.u.empty() && !one.key.starts_with("u_") &&
                       std::ranges::find(all, "u_" + one.key, &StatedValue::key) == all.end();
    if (why.empty() && alone)
      why =
          fmt::format("`{0}` needs its standard uncertainty: write {0}={1}±u", one.key, one.value);
    if (!why.empty()) {
      wrong.push_back({option, 0, 0, why});
      continue;
    }
    content += one.key + " = " + one.value + "\n";
    if (!one.u.empty()) content += "u_" + one.key + " = " + one.u + "\n";
  }
  std::vector<Influence> out;
  gather(wrong, [&] {
    TomlDocument document(content, option);
    TomlTable root = document.root();
    out = read_influences(root);
    document.finish();
  });
  for (Diagnostic& one : wrong) one.line = one.column = 0;  // nobody wrote the lines of `content`
  if (!wrong.empty()) throw InputError(std::move(wrong));
  return out;
}

}  // namespace trueaxis
