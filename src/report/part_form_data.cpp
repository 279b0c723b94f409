// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "job/files/job_results.hpp"
#include "report/chart_readings.hpp"
#include "report/page_data.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t rows_shown = 12;    // of the sections, the worst
constexpr std::size_t most_angles = 720;  // of a polar plot
constexpr std::array<const char*, 2> shown[] = {
    {"RONt", "MZCI"},  {"CYLt", "MZCY"},        {"CONt", "MZCO"},     {"STRsa", ""},
    {"FLTt", "MZPL"},  {"runout_circular", ""}, {"runout_total", ""}, {"axial_runout_circular", ""},
    {"coaxiality", ""}};

const FormValue* of(const SectionForm& section, const char* name, const char* reference) {
  for (const FormValue& one : section.values)
    if (one.name == name && one.reference == reference) return &one;
  return nullptr;
}

/// For a cone these hold its taper, and conicity replaces them.
bool of_cylinder(std::string_view name) { return name == "CYLt" || name == "runout_total"; }

/// A cone's circumscribed and inscribed cylinders are of no use: the page does not have them.
bool of_cylinders(const std::string& note) {
  return note.find("minimum_circumscribed") != std::string::npos ||
         note.find("maximum_inscribed") != std::string::npos;
}

Json estimate_data(const FormValue* one) {
  if (!one) return nullptr;
  if (one->estimate.interval) return {{"at_most_mm", one->estimate.interval->back()}};
  return {{"mm", one->estimate.value}, {"u_mm", one->estimate.u}};
}

/// A row a value, a column a case.
Json values_data(const std::vector<const FormResult*>& cases) {
  Json rows = Json::array();
  const bool cone = is_tapered(*cases.front());
  for (const auto& [name, reference] : shown) {
    if (!worst_value(*cases.front(), name, reference)) continue;
    if (cone && of_cylinder(name)) continue;
    const auto of_case = [&](const FormResult* one) {
      return estimate_data(worst_value(*one, name, reference));
    };
    rows.push_back({{"name", name}, {"reference", reference}, {"cases", list_of(cases, of_case)}});
  }
  return rows;
}

std::vector<std::size_t> worst_sections(const FormResult& form) {
  std::vector<std::pair<double, std::size_t>> all;
  for (std::size_t i = 0; i < form.sections.size(); ++i)
    if (const FormValue* round = of(form.sections[i], "RONt", "MZCI"))
      all.emplace_back(-size_of(*round), i);
  std::ranges::stable_sort(all);
  if (all.size() > rows_shown) all.resize(rows_shown);
  std::vector<std::size_t> out;
  for (const auto& [value, i] : all) out.push_back(i);
  return out;
}

/// The section of a case at the place of section `i` of the last one: each has stations of its own
/// where its form is largest.
const SectionForm* at_place(const FormResult& form, const SectionForm& section, std::size_t i) {
  const std::vector<SectionForm>& all = form.sections;
  if (i < all.size() && all[i].z_mm == section.z_mm) return &all[i];
  const auto away = [&](const SectionForm& one) {
    return one.z_mm && section.z_mm ? std::abs(*one.z_mm - *section.z_mm)
                                    : std::numeric_limits<double>::infinity();
  };
  const auto nearest = std::ranges::min_element(all, {}, away);
  return nearest != all.end() && std::isfinite(away(*nearest)) ? &*nearest : nullptr;
}

Json sections_data(const std::vector<const FormResult*>& cases) {
  std::vector<std::size_t> list = worst_sections(*cases.back());
  std::ranges::sort(list);
  return list_of(list, [&](std::size_t i) -> Json {
    const SectionForm& section = cases.back()->sections[i];
    const auto of_case = [&](const FormResult* one) {
      const SectionForm* there = at_place(*one, section, i);
      return estimate_data(there ? of(*there, "RONt", "MZCI") : nullptr);
    };
    return {{"z_mm", section.z_mm ? Json(*section.z_mm) : Json(nullptr)},
            {"readings", section.readings},
            {"cases", list_of(cases, of_case)},
            {"lobes", section.lobes}};
  });
}

Json column_of(std::span<const double> values, double scale, int decimals, std::size_t step) {
  std::vector<double> out;
  for (std::size_t i = 0; i < values.size(); i += step) out.push_back(values[i] * scale);
  return column(out, decimals);
}

/// Distance of a circle from that of least squares at the angles of a profile, µm.
Json circle_data(const SectionForm& section, const FormCircle& circle, double off_mm,
                 std::size_t step) {
  const FormCircle& least = section.circles.front();
  std::vector<double> um;
  for (std::size_t i = 0; i < section.profile.angle_rad.size(); i += step) {
    const double a = section.profile.angle_rad[i];
    um.push_back(((circle.x_mm - least.x_mm) * std::cos(a) +
                  (circle.y_mm - least.y_mm) * std::sin(a) + circle.radius_mm - least.radius_mm +
                  off_mm) /
                 mm_per_um);
  }
  return column(um, 4);
}

/// The section whose RONt is the largest: its trace, the filtered profile, the minimum zone's
/// circles, its values and harmonics.
Json worst_data(const FormResult& form) {
  const std::vector<std::size_t> worst = worst_sections(form);
  if (worst.empty()) return nullptr;
  const SectionForm& section = form.sections[worst.front()];
  const FormProfile& profile = section.profile;
  const std::size_t step = 1 + profile.angle_rad.size() / most_angles;
  Json data{{"z_mm", section.z_mm ? Json(*section.z_mm) : Json(nullptr)},
            {"readings", section.readings},
            {"lobes", section.lobes},
            {"c_deg", column_of(profile.angle_rad, 1.0 / rad_per_deg, 2, step)},
            {"raw_um", column_of(profile.raw_mm, 1.0 / mm_per_um, 4, step)},
            {"um", column_of(profile.filtered_mm, 1.0 / mm_per_um, 4, step)},
            {"orders", Json::array()},
            {"values", Json::array()}};
  for (const FormCircle& circle : section.circles) {
    const FormValue* peak = of(section, "RONp", "MZCI");
    const FormValue* valley = of(section, "RONv", "MZCI");
    if (circle.criterion != Criterion::minimum_zone || !circle.why_not.empty() || !peak ||
        !valley || !peak->estimate.determined() || !valley->estimate.determined())
      continue;
    data["outer_um"] = circle_data(section, circle, peak->estimate.value, step);
    data["inner_um"] = circle_data(section, circle, -valley->estimate.value, step);
  }
  for (const FormHarmonic& one : section.harmonics)
    if (one.order >= 2 && one.order <= form.options.high_upr)
      data["orders"].push_back({{"order", one.order},
                                {"amplitude_um", rounded(one.amplitude_mm / mm_per_um, 4)},
                                {"phase_deg", rounded(one.phase_rad / rad_per_deg, 1)}});
  for (const char* name : {"RONt", "RONp", "RONv", "RONq"}) {
    Json row{{"name", name}, {"about", Json::array()}};
    for (const char* circle : {"LSCI", "MZCI"})
      row["about"].push_back(estimate_data(of(section, name, circle)));
    data["values"].push_back(std::move(row));
  }
  return data;
}

}  // namespace

Json part_form_data(const PartForm& form) {
  const auto judgement = [&](const FormJudgement& one) -> Json {
    return {{"conformity", to_string(one.conformity)}, {"text", judgement_text(form, one)}};
  };
  Json data{{"why_not", form.why_not}, {"judgements", list_of(form.judgements, judgement)}};
  if (!form.why_not.empty()) return data;
  std::vector<const FormResult*> cases{&form.probed};
  if (form.less_motion) cases.push_back(&*form.less_motion);
  if (form.less_open) cases.push_back(&*form.less_open);
  const bool filtered = !form.probed.sections.empty();
  data["filter"] = filtered ? filter_words(form.probed.options) : "not filtered";
  data["carried_upr"] = form.carried_upr;
  data["high_upr"] = form.probed.options.high_upr;
  data["surface_readings"] =
      form.probed.surface ? Json(form.probed.surface->readings) : Json(nullptr);
  data["section_count"] = cases.back()->sections.size();
  data["motion"] = form.motion;
  data["open"] = form.open;
  data["k"] = form.probed.options.coverage_factor;
  data["values"] = values_data(cases);
  data["sections"] = sections_data(cases);
  data["worst"] = filtered ? worst_data(form.with_open()) : Json(nullptr);
  data["notes"] = Json::array();
  for (std::string note : form.probed.notes) {
    if (is_tapered(form.probed) && of_cylinders(note)) continue;
    constexpr std::string_view option = " (--ball-radius-mm)";
    if (const std::size_t at = note.find(option); at != std::string::npos)
      note.erase(at, option.size());
    data["notes"].push_back(note);
  }
  return data;
}

}  // namespace trueaxis
