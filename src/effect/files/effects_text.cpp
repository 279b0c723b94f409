// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/text.hpp"
#include "effect/files/effects_files.hpp"
#include "format/units.hpp"
#include "trueaxis/effect.hpp"
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

constexpr std::string_view head = R"(# The catalogue of effects

This page lists the effects of the catalogue: what the readings of a real turned part contain and an ideal cone, cylinder or
plane does not. `trueaxis effects --markdown` writes it, and a test compares it with the catalogue. The equations are in
[theory.md](../explanation/theory.md).

An effect is a term in one slot of the measuring chain,

    (C, Z, t) → A arguments C', Z' → B probe line → C part's surface → D machine X → E sensor's response → X_M, with noise ε

and is fixed to a frame: part, chuck, spindle, machine, probe or time. The frame decides how it changes if the part is
clamped again, the spindle reversed, the speed changed or the probe sent back. This decides which measurement tells two effects apart.
Typical sizes are what machines show, not limits.

In the formulas rho is the form of the part along the normal of its surface, theta the polar angle about the part's own axis, and s the
place along it. The length u is Z (for effects of the part: s) scaled to −1 … 1 over the probed length. P_l is Legendre's polynomial of
degree l, and alpha the half angle of a cone. The speed of the spindle is omega, that of Z v_z. On a face r (and R at the end) is the
distance from the axis, and i is the angle of the normal to the probe line. A face is read along Z at (C, X): X_M is then its Z, u runs
over the X probed, and s is the distance from the axis.

)";

/// As GitHub makes it of a heading.
std::string anchor(std::string_view id) {
  std::string out(id);
  std::erase(out, '.');
  return out;
}

std::string link(std::string_view id) { return fmt::format("[`{}`](#{})", id, anchor(id)); }

/// A cell of a table: its bars are text.
std::string cell(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

void index(std::string& out) {
  out += "| effect | what it is | slot | fixed to |\n|---|---|---|---|\n";
  for (const Effect& e : effect_catalogue()) {
    out +=
        fmt::format("| {} | {}{} | {} | {} |\n", link(e.id), cell(e.title),
                    e.check ? " (a check of the data)" : "", to_string(e.slot), to_string(e.frame));
  }
  out += "\n| measurement | what is done |\n|---|---|\n";
  for (const Separator& s : separators()) out += fmt::format("| {} | {} |\n", s.code, cell(s.what));
}

void row(std::string& out, std::string_view name, const std::string& value) {
  if (!value.empty()) out += fmt::format("| {} | {} |\n", name, value);
}

/// What is probed where it is seen; empty: faces and lateral surfaces alike.
std::string_view seen_on(const Effect& effect) {
  if (!effect.needs.stream) return "";
  return *effect.needs.stream == StreamKind::face ? "faces, probed along Z"
                                                  : "lateral surfaces, probed along X";
}

void section(std::string& out, const Effect& e) {
  out += fmt::format("\n## {}\n\n{}{}.\n\n| | |\n|---|---|\n", e.id, e.title,
                     e.check ? "; a check of the data, never named as the cause of a form" : "");
  row(out, "term", e.formula.empty() ? "" : fmt::format("`{}`", cell(e.formula)));
  row(out, "slot, frame",
      fmt::format("{}; fixed to the {}", to_string(e.slot), to_string(e.frame)));
  row(out, "seen on", std::string(seen_on(e)));
  for (const EffectParameter& p : e.parameters) {
    const std::string sizes = typical_size(p), possible = possible_size(p);
    row(out, fmt::format("`{}`", p.name),
        std::string(cell(p.meaning)) + (sizes.empty() ? "" : fmt::format(" ({})", sizes)) +
            (possible.empty() ? "" : ", " + possible));
  }
  row(out, "signature", cell(e.signature));
  row(out, "consequence", cell(e.consequence));
  row(out, "confused with", word_list(e.confounders, ", ", link));
  row(out, "absorbed by", cell(e.absorbed_by));
  std::string apart;
  for (const Separation& s : e.separations)
    apart += fmt::format("{}{}: {}", apart.empty() ? "" : "<br>", s.code, cell(s.how));
  row(out, "told apart by", apart);
  if (e.axis_bias) row(out, "bias of the axis if not modelled", cell(e.axis_bias->text));
  row(out, "source", cell(e.source));
}

}  // namespace

std::string typical_size(const EffectParameter& parameter) {
  const DisplayUnit unit = display_unit(parameter.unit, parameter.high);
  if (parameter.low == 0.0 && parameter.high == 0.0) return unit.name;
  std::string text = format("{:.4g}", parameter.low * unit.scale);
  if (parameter.low != parameter.high) text += format(" to {:.4g}", parameter.high * unit.scale);
  return unit.name.empty() ? text : text + ' ' + unit.name;
}

std::string possible_size(const EffectParameter& parameter) {
  const EffectParameter any{};
  const DisplayUnit unit = display_unit(parameter.unit, parameter.high);
  const std::string size =
      format("{:.4g}{}{}", parameter.most * unit.scale, unit.name.empty() ? "" : " ", unit.name);
  if (parameter.most == any.most) return parameter.least == any.least ? "" : "never negative";
  return parameter.least < 0.0 ? format("at most {} either way", size)
                               : format("never negative, at most {}", size);
}

std::string effects_list_text() {
  return "Effects that an ideal fit misses ('trueaxis effects ID' explains one)\n" + list(false) +
         "\nChecks of the data: handled and reported, never named as the cause of a form\n\n" +
         list(true);
}

std::string effect_text(const Effect& effect) {
  std::string out =
      format("{}: {}{}\n\n", effect.id, effect.title, effect.check ? " (a check of the data)" : "");
  out += line("term", effect.formula);
  out += line("slot", format("{}, {}", to_string(effect.slot), slot_text(effect.slot)));
  out += line("fixed to", to_string(effect.frame));
  out += line("seen on", seen_on(effect));
  for (const EffectParameter& parameter : effect.parameters) {
    const std::string possible = possible_size(parameter);
    out += line(&parameter == effect.parameters.data() ? "parameters" : " ",
                format("{:<15}{:<26}{}{}", parameter.name, typical_size(parameter),
                       parameter.meaning, possible.empty() ? "" : ", " + possible));
  }
  out += scenario_keys_text(effect.id);
  out += line("signature", effect.signature);
  out += line("consequence", effect.consequence);
  out += line("confused with", format("{}", fmt::join(effect.confounders, ", ")));
  out += line("absorbed by", effect.absorbed_by);
  for (const Separation& separation : effect.separations) {
    const auto known = std::ranges::find(separators(), separation.code, &Separator::code);
    out += line(&separation == effect.separations.data() ? "told apart by" : " ",
                format("{} ({}): {}", separation.code, known->what, separation.how));
  }
  if (effect.axis_bias)
    out += line("axis bias", format("{}, to the axis if not modelled", effect.axis_bias->text));
  return out + line("source", effect.source);
}

std::string effects_markdown() {
  std::string out(head);
  index(out);
  for (const Effect& effect : effect_catalogue()) section(out, effect);
  return out;
}

}  // namespace trueaxis
