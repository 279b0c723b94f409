// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/number.hpp"
#include "base/text.hpp"
#include "form/files/form_files.hpp"
#include "format/text_layout.hpp"
#include "job/files/job_results.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

/// What a screen shows of the whole: its name and what it is about.
constexpr std::array<const char*, 2> shown[] = {
    {"RONt", "MZCI"}, {"CYLt", "MZCY"}, {"CONt", "MZCO"}, {"FLTt", "MZPL"}};

constexpr double least_taper_mm = 0.1;  // of a cone that is meant to be one

/// A cylinder's cylindricity, a cone's conicity.
bool counts(const FormResult& form, std::string_view name) {
  const bool cone = is_tapered(form);
  return name == "CYLt" ? !cone : name == "CONt" ? cone : true;
}

std::string value_text(const FormValue& one, double k) {
  return form_value_text(one, k, 1.0 / mm_per_um, "µm");
}

std::string values_text(const FormResult& form) {
  std::vector<std::string> words;
  for (const auto& [name, reference] : shown)
    if (const FormValue* one = worst_value(form, name, reference); one && counts(form, name))
      words.push_back(fmt::format("{} {}", name, value_text(*one, form.options.coverage_factor)));
  return word_list(words);
}

/// Of the first that is there: "RONt 7.3 ± 2.9 µm".
std::string first_value_text(const FormResult& form, bool named = true) {
  for (const auto& [name, reference] : shown)
    if (const FormValue* one = worst_value(form, name, reference))
      return (named ? std::string(name) + " " : "") +
             value_text(*one, form.options.coverage_factor);
  return "no value";
}

const char* word_of(Conformity conformity) {
  constexpr const char* words[] = {"MET", "NOT MET", "NOT PROVEN", "NOT JUDGED"};
  return words[static_cast<std::size_t>(conformity)];
}

/// "1-4 UPR, which is all that the readings carry"
std::string band_words(const PartForm& form) {
  if (form.probed.sections.empty()) return "not filtered";
  return filter_words(form.probed.options);
}

/// "worst of 40 sections"
std::string place_words(const FormResult& form) {
  if (form.surface) return fmt::format("one surface of {} readings", form.surface->readings);
  return fmt::format("worst of {} section{}", form.sections.size(),
                     form.sections.size() == 1 ? "" : "s");
}

/// "with local forms of 8.5 µm at most: "
std::string not_in_surface(const PartForm& form) {
  std::string text;
  if (const FormResult& all = form.with_open(); !all.swallowed.empty())
    text = swallowed_words(all) + "; ";
  if (form.local_mm > 0.0)
    text += fmt::format("with local forms of {} µm at most: ",
                        layout::bound(form.local_mm / mm_per_um));
  return text;
}

}  // namespace

bool is_tapered(const FormResult& form) {
  const FormValue* taper = worst_value(form, "CYLtt", "");
  return taper && std::abs(taper->estimate.value) > least_taper_mm;
}

std::string filter_words(const FormOptions& options) {
  constexpr const char* names[] = {"no filter", "Gaussian", "robust Gaussian", "spline"};
  const char* name = names[static_cast<std::size_t>(options.filter)];
  if (options.filter == ProfileFilter::none) return name;
  return fmt::format("{} {:g}-{:g} UPR", name, options.low_upr, options.high_upr);
}

std::string judgement_text(const PartForm& form, const FormJudgement& one) {
  const double k = form.probed.options.coverage_factor;
  const std::string head = fmt::format("{} {}: ", one.what, word_of(one.conformity));
  const std::string tolerance = fmt::format("tolerance {:g} µm", one.tolerance_mm / mm_per_um);
  if (one.conformity == Conformity::not_judged) return head + one.why + "; " + tolerance;
  std::string value = value_text(one.high, k);
  if (const std::string low = value_text(one.low, k); low != value)
    value = fmt::format("{} or {}, depending on whether the motion found belongs to the part", low,
                        value);
  const std::string place = one.z_mm ? fmt::format(" at Z {:.4g} mm", hundredths(*one.z_mm)) : "";
  return fmt::format("{}{}{}, {} ({})", head, value, place, tolerance, band_words(form));
}

std::string part_form_screen(const PartForm& form, const std::string& name) {
  const std::string of = name.empty() ? "" : name + ": ";
  std::string text;
  for (const FormJudgement& one : form.judgements)
    text += "form   " + of + judgement_text(form, one) + "\n";
  if (!form.judgements.empty()) return text;
  if (!form.why_not.empty()) return "form   " + of + "not assessed: " + form.why_not + "\n";
  text = "form   " + of;
  if (const FormResult& all = form.with_open(); !all.swallowed.empty() || form.local_mm > 0.0)
    return text + not_in_surface(form) + values_text(all) + "\n";
  if (form.less_open)
    text += first_value_text(form.with_open()) + ", or " +
            first_value_text(*form.less_open, false) + " if the machine made it ";
  else if (form.less_motion)
    text += first_value_text(*form.less_motion) + " (as probed " +
            first_value_text(form.probed, false) + "), ";
  else
    text += values_text(form.probed) + ", ";
  // The filter's name would not fit the line of two values.
  text += form.less_open && !form.probed.sections.empty()
              ? fmt::format("({:g}-{:g} UPR)", form.probed.options.low_upr,
                            form.probed.options.high_upr)
              : band_words(form);
  return text + "\n";
}

std::string part_form_text(const PartForm& form) {
  std::string text;
  const auto line = [&](const std::string& one) { text += layout::wrapped("form        ", one); };
  if (!form.why_not.empty()) line("not assessed: " + form.why_not);
  if (form.why_not.empty()) {
    line(fmt::format("as probed {}{} ({}; {})",
                     form.local_mm > 0.0 ? not_in_surface(form) : std::string(),
                     values_text(form.probed), band_words(form), place_words(form.probed)));
    if (form.less_motion)
      line(
          fmt::format("less {}: {}", fmt::join(form.motion, ", "), values_text(*form.less_motion)));
    if (form.less_open)
      line(fmt::format("less {} as well, which may or may not belong to the part: {}",
                       fmt::join(form.open, ", "), values_text(*form.less_open)));
  }
  for (const FormJudgement& one : form.judgements) line(judgement_text(form, one));
  return text;
}

}  // namespace trueaxis
