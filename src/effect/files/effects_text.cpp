// SPDX-License-Identifier: Apache-2.0
#include "effect/files/effects_text.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "format/toml_units.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {
namespace {

using fmt::format;

struct DisplayUnit {
  double scale;
  std::string name;
};

// The unit in which the larger size reads without powers of ten.
DisplayUnit display_unit(std::string_view unit, double high) {
  if (unit == "mm" && high > 0.0 && high < 0.5) return {1.0 / mm_per_um, "um"};
  if (unit == "rad" && high == 0.0) return {1.0, "deg"};
  if (unit == "rad" && high < 1e-3) return {1e6, "urad"};
  if (unit == "rad" && high < 0.01) return {1e3, "mrad"};
  if (unit == "rad") return {1.0 / rad_per_deg, "deg"};
  if (unit == "s" && high < 1.0 && high > 0.0) return {1e3, "ms"};
  if (unit == "mm/s") return {600.0 / mm_per_um, "um per 10 min"};
  return {1.0, unit == "1" ? "" : std::string(unit)};
}

const char* slot_text(Slot slot) {
  static constexpr const char* words[] = {
      "the arguments C and Z", "the probe line",        "the part's surface, along its normal",
      "added to machine X",    "the sensor's response", "the noise"};
  return words[static_cast<std::size_t>(slot)];
}

std::string_view family(std::string_view id) { return id.substr(0, id.find('.')); }

std::size_t widest_id() {
  std::size_t width = 0;
  for (const Effect& effect : effect_catalogue()) width = std::max(width, effect.id.size());
  return width;
}

std::string list(bool checks) {
  std::string out;
  std::string_view last;
  for (const Effect& effect : effect_catalogue()) {
    if (effect.check.has_value() != checks) continue;
    if (!checks && family(effect.id) != last) out += '\n';
    last = family(effect.id);
    out += format("  {:<{}}{}\n", effect.id, widest_id() + 2, effect.title);
  }
  return out;
}

std::string line(std::string_view name, std::string_view value) {
  return value.empty() ? "" : format("{:<16}{}\n", name, value);
}

/// What a scenario's [[effect]] takes of the virtual lathe's effect of this id.
std::string scenario_keys_text(std::string_view id) {
  std::string out;
  for (const virtual_lathe::EffectKind& kind : virtual_lathe::effect_kinds()) {
    if (kind.id != id) continue;
    for (const virtual_lathe::LatheParameter& key : kind.parameters) {
      const std::vector<KeySpelling> spellings = key_spellings(key.name);
      std::string text = format("{:<22}", spellings.front().key);
      text += key.fallback ? format("({:g})", *key.fallback / spellings.front().factor)
                           : "must be given";
      for (std::size_t i = 1; i < spellings.size(); ++i)
        text += (i > 1 ? ", " : "  or ") + spellings[i].key;
      out += line(&key == kind.parameters.data() ? "[[effect]] keys" : " ", text);
    }
  }
  return out;
}

}  // namespace

std::string typical_size(const EffectParameter& parameter) {
  const DisplayUnit unit = display_unit(parameter.unit, parameter.high);
  if (parameter.low == 0.0 && parameter.high == 0.0) return unit.name;
  std::string text = format("{:.4g}", parameter.low * unit.scale);
  if (parameter.low != parameter.high) text += format(" to {:.4g}", parameter.high * unit.scale);
  return unit.name.empty() ? text : text + ' ' + unit.name;
}

std::string effects_list_text() {
  return "Effects that the ideal surface misses ('trueaxis effects ID' explains one)\n" +
         list(false) + "\nChecks of the data: handled and reported, never a name for a form\n\n" +
         list(true);
}

std::string effect_text(const Effect& effect) {
  std::string out =
      format("{}: {}{}\n\n", effect.id, effect.title, effect.check ? " (a check of the data)" : "");
  out += line("term", effect.formula);
  out += line("slot", format("{}, {}", to_string(effect.slot), slot_text(effect.slot)));
  out += line("fixed to", to_string(effect.frame));
  for (const EffectParameter& parameter : effect.parameters) {
    out +=
        line(&parameter == effect.parameters.data() ? "parameters" : " ",
             format("{:<15}{:<26}{}", parameter.name, typical_size(parameter), parameter.meaning));
  }
  out += scenario_keys_text(effect.id);
  out += line("signature", effect.signature);
  out += line("confused with", format("{}", fmt::join(effect.confounders, ", ")));
  out += line("absorbed by", effect.absorbed_by);
  for (const Separation& separation : effect.separations) {
    const auto known = std::ranges::find(separators(), separation.code, &Separator::code);
    out += line(&separation == effect.separations.data() ? "told apart by" : " ",
                format("{} ({}): {}", separation.code, known->what, separation.how));
  }
  if (effect.axis_bias)
    out += line("axis bias", format("{}, to the axis when left out", effect.axis_bias->text));
  return out + line("source", effect.source);
}

}  // namespace trueaxis
