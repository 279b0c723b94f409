// SPDX-License-Identifier: Apache-2.0
#include "effect/files/effects_markdown.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "effect/files/effects_text.hpp"
#include "trueaxis/effect.hpp"

namespace trueaxis {
namespace {

constexpr std::string_view head = R"(# The catalogue of effects

Written by `trueaxis effects --markdown`; a test holds this page against the catalogue. The equations are in
[theory.md](theory.md).

What real probing of a turned part shows and the ideal surface misses. An effect is a term in one slot of the measuring chain,

    (C, Z, t) → A arguments C', Z' → B probe line → C part's surface → D machine X → E sensor's response → X_M, with noise ε

and is fixed to a frame: part, chuck, spindle, machine, probe or time. The frame decides what becomes of it when the part is
clamped again, the spindle reversed, the speed changed or the probe sent back, and so which measurement tells two effects apart.
Typical sizes are what machines show; they are no limits. u is Z (of the part: s, along its axis) from −1 to 1 over the probed length,
θ the polar angle about the part's own axis.

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

void section(std::string& out, const Effect& e) {
  out += fmt::format("\n## {}\n\n{}{}.\n\n| | |\n|---|---|\n", e.id, e.title,
                     e.check ? "; a check of the data, never a name for a form" : "");
  row(out, "term", e.formula.empty() ? "" : fmt::format("`{}`", cell(e.formula)));
  row(out, "slot, frame",
      fmt::format("{}; fixed to the {}", to_string(e.slot), to_string(e.frame)));
  for (const EffectParameter& p : e.parameters) {
    const std::string sizes = typical_size(p);
    row(out, fmt::format("`{}`", p.name),
        std::string(cell(p.meaning)) + (sizes.empty() ? "" : fmt::format(" ({})", sizes)));
  }
  row(out, "signature", cell(e.signature));
  std::string others;
  for (const std::string_view id : e.confounders) others += (others.empty() ? "" : ", ") + link(id);
  row(out, "confused with", others);
  row(out, "absorbed by", cell(e.absorbed_by));
  std::string apart;
  for (const Separation& s : e.separations)
    apart += fmt::format("{}{}: {}", apart.empty() ? "" : "<br>", s.code, cell(s.how));
  row(out, "told apart by", apart);
  if (e.axis_bias) row(out, "bias of the axis when left out", cell(e.axis_bias->text));
  row(out, "source", cell(e.source));
}

}  // namespace

std::string effects_markdown() {
  std::string out(head);
  index(out);
  for (const Effect& effect : effect_catalogue()) section(out, effect);
  return out;
}

}  // namespace trueaxis
