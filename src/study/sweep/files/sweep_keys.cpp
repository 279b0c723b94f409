// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "format/nearest_key.hpp"
#include "format/units.hpp"
#include "study/sweep/files/sweep_axes.hpp"

namespace trueaxis {

using namespace study;

std::string sweep_label(double value) { return fmt::format("{:.10g}", value); }

SweepKeys::SweepKeys(const virtual_lathe::Scenario& base, const std::vector<GridAxis>& lists,
                     const std::string& of) {
  add({base, of, false, false, false, {}, {}});
  for (const GridAxis& axis : lists) {
    const auto replaces = [&](auto list) {
      return std::ranges::any_of(
          axis.points, [&](const AxisPoint& point) { return (point.lists.*list).has_value(); });
    };
    for (const AxisPoint& point : axis.points) {
      Variant variant{base,
                      "the case \"" + point.label + "\" of \"" + axis.name + "\"",
                      replaces(&Lists::passes),
                      replaces(&Lists::setups),
                      replaces(&Lists::effects),
                      {},
                      {}};
      point.lists.put_into(variant.scenario);
      add(std::move(variant));
    }
  }
}

void SweepKeys::add(Variant variant) {
  for (const ScenarioParameter& parameter : scenario_parameters(variant.scenario)) {
    const std::vector<KeySpelling> spellings = key_spellings(parameter.path);
    for (const KeySpelling& spelling : spellings)
      variant.known[spelling.key] = {parameter, spelling.factor};
    variant.usual.push_back(spellings.front().key);
  }
  variants_.push_back(std::move(variant));
}

/// A key belongs to one list at most: where cases replace it, it is theirs alone.
std::vector<const SweepKeys::Variant*> SweepKeys::that_matter_for(const std::string& key) const {
  std::vector<const Variant*> out;
  for (const Variant& variant : variants_) {
    if ((variant.passes && key.starts_with("pass.")) ||
        (variant.setups && key.starts_with("setup.")) ||
        (variant.effects && key.starts_with("effect.")))
      out.push_back(&variant);
  }
  if (out.empty() && !variants_.empty()) out.push_back(&variants_.front());
  return out;
}

/// The keys of the same table, as "noise.sigma_mm, noise.rho"; empty where there is no such table.
static std::string keys_beside(const std::string& key, const std::vector<std::string>& usual) {
  const std::string table = key.substr(0, key.rfind('.') + 1);
  std::string out;
  for (const std::string& one : usual)
    if (!table.empty() && one.substr(0, one.rfind('.') + 1) == table) add_to_list(out, one);
  return out;
}

std::optional<KnownKey> SweepKeys::find(TomlTable& table, std::string_view at,
                                        const std::string& key) const {
  const std::vector<const Variant*> all = that_matter_for(key);
  const auto lacks = [&](const Variant* one) { return !one->known.contains(key); };
  const auto lacking = std::ranges::find_if(all, lacks);
  if (lacking == all.end())
    return all.empty() ? std::nullopt : std::optional(all.front()->known.find(key)->second);
  std::vector<std::string> words = (*lacking)->usual;  // of equals the usual unit
  for (const auto& [word, known] : (*lacking)->known) words.push_back(word);
  const std::string near = nearest_key(key, words);
  const std::string who = (*lacking)->of.empty() ? "the scenario" : (*lacking)->of;
  const std::string there = keys_beside(key, (*lacking)->usual);
  table.complain(at, "names \"" + key + "\", which " + who + " does not have" +
                         (near.empty() ? "." : ": did you mean \"" + near + "\"?") +
                         (there.empty() ? "" : " It has: " + there));
  return std::nullopt;
}

bool SweepKeys::same_number(const std::string& a, const std::string& b) const {
  if (a == b) return true;
  const auto [place, first] = same_.try_emplace({a, b}, false);
  if (first) {
    place->second = std::ranges::any_of(variants_, [&](const Variant& variant) {
      return write_same_number(variant.scenario, a, b);
    });
  }
  return place->second;
}

void SweepKeys::check_range(TomlTable& table, std::string_view at, const KnownKey& known,
                            double value) {
  const ScenarioParameter& p = known.parameter;
  const double inside = value * known.factor;
  if (!std::isfinite(inside)) return;  // said already
  if (p.open ? inside > p.low && inside < p.high : inside >= p.low && inside <= p.high) return;
  std::string allowed =
      std::isinf(p.low) ? ""
                        : (p.open ? "more than " : "at least ") + sweep_label(p.low / known.factor);
  if (!std::isinf(p.high)) {
    allowed += (allowed.empty() ? "" : " and ") +
               ((p.open ? "less than " : "at most ") + sweep_label(p.high / known.factor));
  }
  table.complain(at, "gives " + sweep_label(value) + " but must give " + allowed);
}

}  // namespace trueaxis
