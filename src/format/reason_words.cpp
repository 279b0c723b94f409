// SPDX-License-Identifier: Apache-2.0
#include "format/reason_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "base/number.hpp"
#include "base/text.hpp"
#include "format/text_layout.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

/// "1.25" of 1.2543 and ".3g"; two digits (`two`), of a bound (`up`, `down`), one decimal below 10
/// (`one`).
std::string shown(double value, std::string_view how) {
  if (how == "up" || how == "down") return layout::bound(value, how == "up");
  if (how == "two") return fmt::format("{:.{}f}", value, decimals_of(value, 0));
  if (how == "one") return fmt::format("{:.{}f}", value, value < 10.0 ? 1 : 0);
  return without_exponent(fmt::format(fmt::runtime("{:" + std::string(how) + "}"), value), value);
}

/// "12.3 µm" or "1.25 mm"
std::string length(double mm) {
  return std::abs(mm) < 1.0 ? fmt::format("{:.4g} µm", mm / mm_per_um)
                            : fmt::format("{:.4g} mm", mm);
}

double in_unit(double value, std::string_view unit) {
  return unit == "um"                     ? value / mm_per_um
         : unit == "deg"                  ? value / rad_per_deg
         : unit == "mrad" || unit == "ms" ? 1e3 * value
         : unit == "%"                    ? 100.0 * value
                                          : value;
}

/// "3.00 ± 0.20 ms" of seconds, degrees of radians; others as they are inside.
std::string usual(const ReasonNumber& one) {
  const std::string_view inside = one.unit;
  const std::string_view unit = inside == "s" ? "ms" : inside == "rad" ? "deg" : inside;
  const double U = in_unit(one.U, unit);
  const int decimals = U > 0.0 ? decimals_of(U, 1) : 3;
  return fmt::format("{:.{}f} ± {:.{}f}", in_unit(one.value, unit), decimals, U, decimals) +
         (unit == "1" ? "" : " " + std::string(unit));
}

ReasonCode code_of(std::string_view id) {
  std::size_t i = 0;
  while (i < reason_codes && id != to_string(static_cast<ReasonCode>(i))) ++i;
  expects(i < reason_codes, "the id of a reason");
  return static_cast<ReasonCode>(i);
}

class Words {
 public:
  Words(const Reason& reason, Spoken references) : reason_(reason), spoken_(references) {}

  /// Nothing if a place has nothing to fill it.
  std::optional<std::string> filled(std::string_view text) const {
    std::string out;
    for (std::size_t at = 0; at < text.size(); ++at) {
      if (text[at] == '<') {
        const std::size_t end = text.find('>', at);
        out += filled(text.substr(at + 1, end - at - 1)).value_or("");
        at = end;
      } else if (text[at] == '{') {
        const std::size_t end = text.find('}', at);
        const auto one = place(text.substr(at + 1, end - at - 1));
        if (!one) return {};
        out += *one;
        at = end;
      } else {
        out += text[at];
      }
    }
    return out;
  }

 private:
  const SpokenReference* reference(std::size_t which) const {
    const std::size_t i =
        which < reason_.references.size() ? reason_.references[which] : spoken_.size();
    return i < spoken_.size() ? &spoken_[i] : nullptr;
  }

  /// "seat (seat.csv)"
  static std::string with_file(const SpokenReference& of) {
    return of.name + (of.file.empty() ? "" : " (" + of.file + ")");
  }

  std::optional<std::string> place(std::string_view what) const {
    if (what.starts_with('@')) return filled(template_of(code_of(what.substr(1))));
    const std::size_t colon = std::min(what.find(':'), what.size());
    const std::string_view key = what.substr(0, colon),
                           how = what.substr(std::min(colon + 1, what.size()));
    const bool second = key.ends_with('2');
    const SpokenReference* of = reference(second ? 1 : 0);
    if (key == "ref") return of && !of->name.empty() ? of->name + ": " : "";
    if (key == "name" || key == "name2") return of ? std::optional(of->name) : std::nullopt;
    if (key == "file" || key == "file2") return of ? std::optional(with_file(*of)) : std::nullopt;
    if (key == "parts" || key == "remedies") {
      const Reasons& list = key == "parts" ? reason_.parts : reason_.remedies;
      return list.empty() ? std::nullopt : std::optional(words_of(list, how, spoken_));
    }
    for (const ReasonName& one : reason_.names)
      if (one.key == key) return one.value.empty() ? std::nullopt : std::optional(one.value);
    const std::size_t dot = std::min(key.find('.'), key.size());
    for (const ReasonNumber& one : reason_.numbers)
      if (one.name == key.substr(0, dot)) return number(one, dot < key.size(), how);
    return {};
  }

  static std::string number(const ReasonNumber& one, bool its_U, std::string_view how) {
    const std::size_t colon = std::min(how.find(':'), how.size());
    const std::string_view unit = how.substr(0, colon),
                           digits = how.substr(std::min(colon + 1, how.size()));
    if (unit == "usual") return usual(one);
    if (unit == "length") return length(its_U ? one.U : one.value);
    if (unit == "missing") return length(-one.value);
    const double value = in_unit(its_U ? one.U : one.value, unit), U = in_unit(one.U, unit);
    if (digits == "pm")
      return fmt::format("{:.{}f} ± {:.{}f}", value, decimals_of(U, 1), U, decimals_of(U, 1));
    if (digits == "of U") return fmt::format("{:.{}f}", value, decimals_of(U, 0));
    return shown(value, digits);
  }

  const Reason& reason_;
  Spoken spoken_;
};

}  // namespace

std::string words_of(const Reason& reason, Spoken references) {
  return Words(reason, references)
      .filled(template_of(reason.code))
      .value_or(to_string(reason.code));
}

std::string words_of(const Reasons& reasons, std::string_view between, Spoken references) {
  std::vector<std::string> said;
  for (const Reason& one : reasons) {
    std::string words = words_of(one, references);
    if (std::ranges::find(said, words) == said.end()) said.push_back(std::move(words));
  }
  return word_list(said, between);
}

Json reason_object(const Reason& reason, Spoken references) {
  Json json{{"code", to_string(reason.code)}};
  for (const std::size_t i : reason.references)
    json["references"].push_back(i < references.size() ? Json(references[i].name) : Json(nullptr));
  for (const ReasonNumber& one : reason.numbers) {
    const bool angle = std::string_view(one.unit) == "rad";
    const double unit = angle ? rad_per_deg : 1.0;
    Json& json_of = json["numbers"][one.name] =
        with_unit(one.value / unit, angle ? "deg" : one.unit);
    if (one.U > 0.0) json_of["U"] = number(one.U / unit);
  }
  for (const ReasonName& one : reason.names) json["names"][one.key] = one.value;
  if (!reason.parts.empty()) json["parts"] = reasons_array(reason.parts, references);
  if (!reason.remedies.empty()) json["remedies"] = reasons_array(reason.remedies, references);
  json["words"] = words_of(reason, references);
  return json;
}

Json reasons_array(const Reasons& reasons, Spoken references) {
  return list_of(reasons, [&](const Reason& one) { return reason_object(one, references); });
}

}  // namespace trueaxis
