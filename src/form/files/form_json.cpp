// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "form/files/form_files.hpp"
#include "format/json.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

Json value_json(const FormValue& one) {
  Json json{{"name", one.name}};
  if (!one.reference.empty()) json["reference"] = one.reference;
  const Estimate edge = at_edge(one.estimate);
  json["value"] = number(edge.value);
  json["u"] = number(edge.u);
  json["unit"] = edge.unit;
  json["bias_by_noise"] = number(edge_factor(one.estimate.unit) * one.bias_mm);
  if (edge.interval) {
    json["why"] = edge.why_not;
    json["at_most"] = number(edge.interval->back());
  }
  if (one.unresolved) json["unresolved"] = true;
  return json;
}

Json circle_json(const FormCircle& circle, bool limacon) {
  Json json{{"reference", name_of(circle.criterion)},
            {"x", with_unit(circle.x_mm, "mm")},
            {"y", with_unit(circle.y_mm, "mm")}};
  if (!circle.why_not.empty()) json["why"] = circle.why_not;
  if (!limacon) json["radius"] = with_unit(circle.radius_mm, "mm");
  if (!circle.touches.empty())
    json["touches"] = list_of(circle.touches, [](const auto& one) -> Json {
      return {{"angle", number(one[0] / rad_per_deg)}, {"multiplier", one[1]}};
    });
  return json;
}

Json section_json(const SectionForm& section, bool limacon) {
  Json json;
  if (section.z_mm) json["z"] = with_unit(*section.z_mm, "mm");
  json["readings"] = section.readings;
  json["turns"] = number(section.turns);
  json["points_per_cycle"] = number(section.points_per_cycle);
  json["transmission_at_cut_off"] = number(section.transmission);
  json["gaps"] = with_unit(section.gaps_rad / rad_per_deg, "deg");
  json["noise"] = with_unit(section.noise_mm, "mm");
  json["values"] = list_of(section.values, value_json);
  json["circles"] = list_of(section.circles,
                            [&](const FormCircle& circle) { return circle_json(circle, limacon); });
  json["lobes"] = section.lobes;
  json["lobes_share"] = number(section.lobes_share);
  json["harmonic_unit"] = {{"amplitude", "mm"}, {"phase", "deg"}, {"u", "mm"}};
  json["harmonics"] = list_of(section.harmonics, [](const FormHarmonic& one) -> Json {
    return {{"order", one.order},
            {"amplitude", number(one.amplitude_mm)},
            {"phase", number(one.phase_rad / rad_per_deg)},
            {"u", number(one.u_mm)}};
  });
  return json;
}

Json options_json(const FormOptions& options) {
  Json filter{{"kind", to_string(options.filter)}};
  if (options.filter != ProfileFilter::none) filter["upr"] = {options.low_upr, options.high_upr};
  Json json{{"filter", std::move(filter)}, {"side", options.bore ? "bore" : "shaft"}};
  json["ball_radius"] =
      options.ball_radius_mm > 0.0 ? with_unit(options.ball_radius_mm, "mm") : Json(nullptr);
  json["spindle_orders_taken_off"] = options.spindle.size();
  json["spindle_range"] = with_unit(options.spindle_range_mm, "mm");
  json["trials"] = options.trials;
  json["seed"] = options.seed;
  return json;
}

}  // namespace

Json swallowed_json(const FormResult& result) {
  return list_of(result.swallowed, [](const SwallowedLobes& one) -> Json {
    return {{"order", one.order},
            {"amplitude", to_json(Estimate{one.amplitude_mm, one.u_mm, "mm", ""})},
            {"passed", number(one.passed)}};
  });
}

Json surface_json(const FormSurface& surface) {
  return {{"readings", surface.readings},
          {"turns", number(surface.turns)},
          {"orders", surface.orders},
          {"degrees_along_z", surface.degrees},
          {"noise", with_unit(surface.noise_mm, "mm")},
          {"orders_found", surface.orders_found}};
}

std::string form_json(const FormResult& result) {
  Json json{{"schema", "trueaxis.form/1"}, {"version", TRUEAXIS_VERSION}};
  json["input"] = {{"file", result.source}, {"hash", result.input_hash}};
  json["datum"] =
      result.datum_source.empty()
          ? Json("spindle axis")
          : Json{{"file", result.datum_source}, {"association", name_of(result.options.datum)}};
  json["coverage_factor"] = result.options.coverage_factor;
  json["options"] = options_json(result.options);
  json["radius_known"] = result.radius_known;
  json["groups"] = list_of(result.groups, [](const FormGroup& group) -> Json {
    return {{"name", group.name}, {"values", list_of(group.values, value_json)}};
  });
  json["sections"] = list_of(result.sections, [&](const SectionForm& section) {
    return section_json(section, !result.radius_known);
  });
  json["swallowed"] = swallowed_json(result);
  if (result.surface) json["surface"] = surface_json(*result.surface);
  json["notes"] = result.notes;
  return json_text(json);
}

std::string form_profile_csv(const FormResult& result) {
  std::string text = "# schema: trueaxis.form_profile/1\n# of each ";
  text += result.surface
              ? "station of the surface about its least-squares circle: before the filter"
              : "section about its least-squares circle: the readings";
  text += ", and what the filter lets through\nsection,Z[mm],C[deg],raw[um],filtered[um]\n";
  for (std::size_t s = 0; s < result.sections.size(); ++s) {
    const SectionForm& section = result.sections[s];
    for (std::size_t i = 0; i < section.profile.angle_rad.size(); ++i)
      text += fmt::format("{},{:.6g},{:.6f},{:.6f},{:.6f}\n", s + 1, section.z_mm.value_or(0.0),
                          section.profile.angle_rad[i] / rad_per_deg,
                          section.profile.raw_mm[i] / mm_per_um,
                          section.profile.filtered_mm[i] / mm_per_um);
  }
  return text;
}

}  // namespace trueaxis
