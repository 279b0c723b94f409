// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "form/files/form_files.hpp"
#include "format/text_layout.hpp"

namespace trueaxis {
namespace {

using layout::padded;

constexpr std::size_t name_width = 16, cell_width = 21, sections_shown = 6;
constexpr double nothing_mm = 1e-9;   // rounding
constexpr double least_shown = 1e-4;  // of U, in µm

const FormValue* find(std::span<const FormValue> values, std::string_view name,
                      std::string_view reference = "") {
  for (const FormValue& one : values)
    if (one.name == name && (reference.empty() || one.reference == reference)) return &one;
  return nullptr;
}

/// In µm; slopes in µm a degree, angles in mrad.
std::string cell(const FormValue* one, double k) {
  if (!one) return "";
  if (size_of(*one) < nothing_mm && (one->unresolved || one->estimate.u < nothing_mm)) return "0";
  const bool slope = one->estimate.unit == "mm/rad";
  const double scale = slope ? rad_per_deg / mm_per_um : 1e3;
  if (one->estimate.determined() && scale * k * one->estimate.u < least_shown)
    return fmt::format("{:.4f} ± < {:g}", scale * one->estimate.value, least_shown);
  if (one->unresolved) return "< " + layout::bound(scale * one->estimate.interval->back());
  const double within = bound_factor(k) * one->estimate.u;
  if (one->estimate.determined() && one->estimate.value <= within)
    return "< " + layout::bound(scale * (one->estimate.value + within));
  return layout::plus_minus(one->estimate, k, scale, "");
}

std::string filter_text(const FormOptions& options) {
  if (options.filter == ProfileFilter::none) return "no filter";
  constexpr const char* names[] = {"", "Gaussian", "robust Gaussian", "spline"};
  return fmt::format("{} {:g}-{:g} UPR", names[static_cast<std::size_t>(options.filter)],
                     options.low_upr, options.high_upr);
}

std::string heading(const FormResult& result) {
  if (result.sections.empty())
    return fmt::format("Values in µm ± U (k = {:g}), < a bound (95 % confidence), no filter\n",
                       result.options.coverage_factor);
  const SectionForm& first = result.sections.front();
  if (result.surface)
    return fmt::format(
        "{}, one surface of {} readings at {} stations; values in µm ± U (k = {:g}), < a "
        "bound (95 % confidence)\n",
        filter_text(result.options), result.surface->readings, result.sections.size(),
        result.options.coverage_factor);
  std::string text =
      fmt::format("{}, {} section{} of {} readings", filter_text(result.options),
                  result.sections.size(), result.sections.size() == 1 ? "" : "s", first.readings);
  if (first.points_per_cycle > 0.0)
    text += fmt::format(", {:.3g} a wave at the cut-off", first.points_per_cycle);
  return text + fmt::format("; values in µm ± U (k = {:g}), < a bound (95 % confidence)\n",
                            result.options.coverage_factor);
}

/// A table of one kind of value about several references, a row a name.
std::string table(std::span<const FormValue> values, std::span<const char* const> names,
                  std::span<const char* const> references, double k) {
  std::string text = padded("", name_width);
  for (const char* reference : references) text += padded(reference, cell_width);
  text.erase(text.find_last_not_of(' ') + 1);
  text += '\n';
  for (const char* name : names) {
    std::string row = padded(name, name_width);
    for (const char* reference : references)
      row += padded(cell(find(values, name, reference), k), cell_width);
    row.erase(row.find_last_not_of(' ') + 1);
    text += row + '\n';
  }
  return text;
}

std::string line(const char* head, const std::string& text) {
  return padded(head, name_width) + text + '\n';
}

std::string harmonics_text(const SectionForm& section, std::size_t most) {
  std::vector<FormHarmonic> list;
  for (const FormHarmonic& one : section.harmonics)
    if (one.order >= 2) list.push_back(one);
  std::ranges::stable_sort(list, std::ranges::greater{}, &FormHarmonic::amplitude_mm);
  if (list.size() > most) list.resize(most);
  std::string text;
  for (const FormHarmonic& one : list)
    text += fmt::format("{}{}: {:.3g} at {:.0f}°", text.empty() ? "" : ", ", one.order,
                        one.amplitude_mm / mm_per_um, one.phase_rad / rad_per_deg);
  return text;
}

std::string one_section(const SectionForm& section, double k) {
  constexpr const char* names[] = {"RONt", "RONp", "RONv", "RONq"};
  constexpr const char* circles[] = {"LSCI", "MZCI", "MCCI", "MICI"};
  std::string text = table(section.values, names, circles, k);
  const FormCircle& least = section.circles.front();
  if (const FormValue* eccentricity = find(section.values, "eccentricity"))
    text += line("eccentricity",
                 cell(eccentricity, k) +
                     fmt::format(" at {:.1f}°", std::atan2(least.y_mm, least.x_mm) / rad_per_deg));
  if (const FormValue* radius = find(section.values, "radius"))
    text += line("radius", layout::plus_minus(radius->estimate, k, 1.0, "mm"));
  text += line("slope", cell(find(section.values, "slope"), k) + " µm/deg at most");
  if (section.lobes == 0) return text + line("lobes", "none above the noise");
  text += line("lobes",
               fmt::format("{} ({:.0f} % of the mean square); largest orders, µm: {}",
                           section.lobes, 100.0 * section.lobes_share, harmonics_text(section, 4)));
  return text;
}

std::string section_rows(const FormResult& result, bool all) {
  const double k = result.options.coverage_factor;
  std::string text = padded("Z in mm", 12) + padded("RONt LSCI", cell_width) +
                     padded("RONt MZCI", cell_width) + padded("eccentricity", cell_width) +
                     "lobes\n";
  std::vector<const SectionForm*> shown;
  for (const SectionForm& section : result.sections) shown.push_back(&section);
  const auto worst = [](const SectionForm* section) {
    return size_of(*find(section->values, "RONt", "MZCI"));
  };
  if (!all && shown.size() > sections_shown) {
    std::ranges::stable_sort(shown, std::ranges::greater{}, worst);
    shown.resize(sections_shown);
    std::ranges::stable_sort(shown, {}, [](const SectionForm* one) { return *one->z_mm; });
  }
  for (const SectionForm* section : shown)
    text += padded(fmt::format("{:.4f}", section->z_mm.value_or(0.0)), 12) +
            padded(cell(find(section->values, "RONt", "LSCI"), k), cell_width) +
            padded(cell(find(section->values, "RONt", "MZCI"), k), cell_width) +
            padded(cell(find(section->values, "eccentricity"), k), cell_width) +
            (section->lobes > 0
                 ? fmt::format("{} ({:.0f} %)\n", section->lobes, 100.0 * section->lobes_share)
                 : "none\n");
  if (shown.size() < result.sections.size())
    text += fmt::format("the {} least round of {} {}; --verbose prints all\n", shown.size(),
                        result.sections.size(), result.surface ? "stations" : "sections");
  return text;
}

/// Names and values of a group after each other, several per line.
std::string run_on(const FormGroup& group, std::span<const char* const> names, double k) {
  std::string text;
  for (const char* name : names)
    for (const FormValue& one : group.values)
      if (one.name == name)
        text += fmt::format("{}{}{} {}{}", text.empty() ? "" : ", ", one.name,
                            one.reference.empty() ? "" : " " + one.reference, cell(&one, k),
                            one.estimate.unit == "rad" ? " mrad" : "");
  return text;
}

std::string group_text(const FormGroup& group, const FormResult& result) {
  const double k = result.options.coverage_factor;
  constexpr const char* cylinders[] = {"LSCY", "MZCY", "MCCY", "MICY"};
  constexpr const char* total[] = {"CYLt"};
  constexpr const char* parts[] = {"CYLrr", "CYLtt", "CYLat", "STRsa", "STRsg", "CONt"};
  constexpr const char* flat[] = {"FLTt", "FLTp", "FLTv", "FLTq"};
  constexpr const char* straight[] = {"STRt", "STRp", "STRv", "STRq"};
  constexpr const char* planes[] = {"LSPL", "MZPL"};
  constexpr const char* lines[] = {"LSLI", "MZLI"};
  if (group.name == "cylindricity")
    return table(group.values, total, cylinders, k) +
           layout::wrapped(padded("parts", name_width), run_on(group, parts, k));
  if (group.name == "flatness") return table(group.values, flat, planes, k);
  if (group.name == "straightness") return table(group.values, straight, lines, k);
  std::vector<const char*> names;
  for (const FormValue& one : group.values) names.push_back(one.name.c_str());
  return layout::wrapped(
      padded(result.datum_source.empty() ? "to the spindle" : "to the datum", name_width),
      run_on(group, names, k));
}

std::string harmonics_table(const FormResult& result) {
  std::string text;
  for (const SectionForm& section : result.sections) {
    text += section.z_mm ? fmt::format("\norders at Z = {:.4f} mm\n", *section.z_mm) : "\norders\n";
    for (const FormHarmonic& one : section.harmonics)
      text += fmt::format(
          "{:>5}  {:>10.4f} ± {:.4f} µm  {:>6.1f}°\n", one.order, one.amplitude_mm / mm_per_um,
          result.options.coverage_factor * one.u_mm / mm_per_um, one.phase_rad / rad_per_deg);
  }
  return text;
}

}  // namespace

std::string form_value_text(const FormValue& one, double k, double scale, const std::string& unit) {
  if (!one.unresolved) return layout::size_plus_minus(one.estimate, k, scale, unit);
  return layout::below(scale * one.estimate.interval->back(), unit);
}

std::string swallowed_words(const FormResult& result) {
  std::string text;
  for (const SwallowedLobes& one : result.swallowed) {
    const Estimate size{one.amplitude_mm, one.u_mm, "mm", ""};
    text += fmt::format(
        "{}{} lobes of {} ({:.0f} % pass {:g} UPR)", text.empty() ? "" : ", ", one.order,
        layout::plus_minus(size, result.options.coverage_factor, 1.0 / mm_per_um, "µm"),
        100.0 * one.passed, result.options.high_upr);
  }
  return text;
}

std::string form_text(const FormResult& result, bool verbose) {
  const double k = result.options.coverage_factor;
  std::string text = heading(result);
  if (result.sections.size() == 1) text += one_section(result.sections.front(), k);
  if (result.sections.size() > 1) text += section_rows(result, verbose);
  if (!result.swallowed.empty())
    text += layout::wrapped("lobes ", swallowed_words(result) + ": no RONt at this cut-off");
  for (const FormGroup& group : result.groups) text += group_text(group, result);
  for (const std::string& note : result.notes) text += layout::wrapped("note: ", note);
  return verbose ? text + harmonics_table(result) : text;
}

}  // namespace trueaxis
