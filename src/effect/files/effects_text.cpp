// SPDX-License-Identifier: Apache-2.0
#include "effect/files/effects_text.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "format/toml_units.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {
namespace {

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

std::string_view slot_text(Slot slot) {
  switch (slot) {
    case Slot::arguments:
      return "the arguments C and Z";
    case Slot::probe_line:
      return "the probe line";
    case Slot::part:
      return "the part's surface, along its normal";
    case Slot::machine:
      return "added to machine X";
    case Slot::sensor:
      return "the sensor's response";
    case Slot::noise:
      break;
  }
  return "the noise";
}

std::string_view family(std::string_view id) { return id.substr(0, id.find('.')); }

std::size_t widest_id() {
  std::size_t width = 0;
  for (const Effect& effect : effect_catalogue()) width = std::max(width, effect.id.size());
  return width;
}

void list(std::ostream& out, bool checks) {
  std::string_view last;
  for (const Effect& effect : effect_catalogue()) {
    if (effect.check.has_value() != checks) continue;
    if (!checks && family(effect.id) != last) out << '\n';
    last = family(effect.id);
    out << "  " << std::left << std::setw(static_cast<int>(widest_id()) + 2) << effect.id
        << effect.title << '\n';
  }
}

void line(std::ostream& out, std::string_view name, std::string_view value) {
  if (value.empty()) return;
  out << std::left << std::setw(16) << name << value << '\n';
}

/// What a scenario's [[effect]] takes of the virtual lathe's effect of this id.
void scenario_keys(std::ostream& out, std::string_view id) {
  for (const virtual_lathe::EffectKind& kind : virtual_lathe::effect_kinds()) {
    if (kind.id != id) continue;
    for (const virtual_lathe::LatheParameter& key : kind.parameters) {
      const std::vector<KeySpelling> spellings = key_spellings(key.name);
      std::ostringstream text;
      text << std::left << std::setw(22) << spellings.front().key;
      if (key.fallback) {
        text << '(' << *key.fallback / spellings.front().factor << ')';
      } else {
        text << "must be given";
      }
      for (std::size_t i = 1; i < spellings.size(); ++i)
        text << (i > 1 ? ", " : "  or ") << spellings[i].key;
      line(out, &key == kind.parameters.data() ? "[[effect]] keys" : " ", text.str());
    }
  }
}

}  // namespace

std::string typical_size(const EffectParameter& parameter) {
  const bool sized = parameter.low != 0.0 || parameter.high != 0.0;
  const DisplayUnit unit = display_unit(parameter.unit, parameter.high);
  std::ostringstream text;
  text << std::setprecision(4);
  if (sized) text << parameter.low * unit.scale;
  if (sized && parameter.low != parameter.high) text << " to " << parameter.high * unit.scale;
  if (sized && !unit.name.empty()) text << ' ';
  text << unit.name;
  return text.str();
}

std::string effects_list_text() {
  std::ostringstream out;
  out << "Effects that the ideal surface misses ('trueaxis effects ID' explains one)\n";
  list(out, false);
  out << "\nChecks of the data: handled and reported, never a name for a form\n\n";
  list(out, true);
  return out.str();
}

std::string effect_text(const Effect& effect) {
  std::ostringstream out;
  out << effect.id << ": " << effect.title << (effect.check ? " (a check of the data)" : "")
      << "\n\n";
  line(out, "term", effect.formula);
  line(out, "slot",
       std::string(to_string(effect.slot)) + ", " + std::string(slot_text(effect.slot)));
  line(out, "fixed to", to_string(effect.frame));
  for (const EffectParameter& parameter : effect.parameters) {
    line(out, &parameter == effect.parameters.data() ? "parameters" : " ", [&] {
      std::ostringstream text;
      text << std::left << std::setw(15) << parameter.name << std::setw(26)
           << typical_size(parameter) << parameter.meaning;
      return text.str();
    }());
  }
  scenario_keys(out, effect.id);
  line(out, "signature", effect.signature);
  std::string ids;
  for (const std::string_view id : effect.confounders) {
    ids += (ids.empty() ? "" : ", ") + std::string(id);
  }
  line(out, "confused with", ids);
  line(out, "absorbed by", effect.absorbed_by);
  for (const Separation& separation : effect.separations) {
    const auto known = std::find_if(separators().begin(), separators().end(),
                                    [&](const Separator& s) { return s.code == separation.code; });
    line(out, &separation == effect.separations.data() ? "told apart by" : " ",
         std::string(separation.code) + " (" + std::string(known->what) +
             "): " + std::string(separation.how));
  }
  if (effect.axis_bias)
    line(out, "axis bias", std::string(effect.axis_bias->text) + ", to the axis when left out");
  line(out, "source", effect.source);
  return out.str();
}

}  // namespace trueaxis
