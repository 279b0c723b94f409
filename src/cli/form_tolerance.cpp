// SPDX-License-Identifier: Apache-2.0
#include "cli/form_tolerance.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <set>
#include <sstream>

#include "base/number.hpp"
#include "base/text.hpp"
#include "format/text_layout.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

/// About the minimum zone where a value is about something; what has no such value is about least
/// squares.
bool counts(const FormValue& one, const std::string& name) {
  return one.name == name && (one.reference.empty() || one.reference.starts_with("MZ") ||
                              name == "CYLrr" || name == "CYLtt" || name == "eccentricity");
}

std::vector<const FormValue*> all_values(const FormResult& result) {
  std::vector<const FormValue*> list;
  for (const SectionForm& section : result.sections)
    for (const FormValue& one : section.values) list.push_back(&one);
  for (const FormGroup& group : result.groups)
    for (const FormValue& one : group.values) list.push_back(&one);
  return list;
}

}  // namespace

std::vector<FormTolerance> parse_form_tolerances(const std::string& text) {
  std::vector<FormTolerance> list;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::size_t equals = part.find('=');
    double um = 0.0;
    if (equals == 0 || equals == std::string::npos ||
        !parse_number(std::string_view(part).substr(equals + 1), um) || !(um > 0.0))
      throw CLI::ValidationError("--tolerance-um", part + " is not a tolerance such as RONt=2");
    list.push_back({part.substr(0, equals), um * mm_per_um});
  }
  return list;
}

std::string form_line(const FormResult& result) {
  const double k = result.options.coverage_factor;
  const auto values = all_values(result);
  std::string text;
  for (const char* const name : {"RONt", "CYLt", "CONt", "FLTt", "STRt"}) {
    const FormValue* worst = nullptr;
    for (const FormValue* one : values)
      if (counts(*one, name) && (!worst || most_of(*one, k) > most_of(*worst, k))) worst = one;
    if (worst)
      text += std::string(text.empty() ? "" : ", ") + name + ' ' +
              form_value_text(*worst, k, 1.0 / mm_per_um, "µm");
  }
  return "FORM: " + (text.empty() ? "no value of the whole surface" : text) + '\n';
}

FormVerdict judge_form(const FormResult& result, const std::vector<FormTolerance>& tolerances) {
  FormVerdict verdict;
  const double k = result.options.coverage_factor;
  for (const FormTolerance& tolerance : tolerances) {
    const FormValue* worst = nullptr;
    std::set<std::string> names;
    for (const FormValue* one : all_values(result)) {
      if (one->estimate.unit != "mm" || one->name == "radius") continue;
      names.insert(one->name);
      if (!counts(*one, tolerance.name)) continue;
      if (!worst || most_of(*one, k) > most_of(*worst, k)) worst = one;
    }
    if (!worst) {
      throw InputError("--tolerance-um", "there is no value " + tolerance.name +
                                             " here to compare with a tolerance; there are " +
                                             word_list(names));
    }
    const bool met = most_of(*worst, k) <= tolerance.limit_mm;
    verdict.met = verdict.met && met;
    verdict.text += fmt::format("{}: {} {}{}, tolerance {:g} µm (ISO 14253-1)\n",
                                met                                        ? "MET"
                                : least_of(*worst, k) > tolerance.limit_mm ? "NOT MET"
                                                                           : "NOT PROVEN",
                                worst->name, worst->reference.empty() ? "" : worst->reference + " ",
                                form_value_text(*worst, k, 1.0 / mm_per_um, "µm"),
                                tolerance.limit_mm / mm_per_um);
  }
  return verdict;
}

}  // namespace trueaxis::cli
