// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "format/json.hpp"
#include "simulate/files/scenario_files.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using namespace virtual_lathe;

Json part_json(const Part& part) {
  static constexpr const char* kinds[] = {"cone", "cylinder", "plane"};
  Json parameters;
  if (part.kind != PartKind::face) {
    parameters["x0"] = mm_json(part.x0_mm);
    parameters["y0"] = mm_json(part.y0_mm);
  }
  parameters["l"] = with_unit(part.l, "1");
  parameters["m"] = with_unit(part.m, "1");
  if (part.kind == PartKind::face) parameters["d"] = mm_json(part.d_mm);
  if (part.kind == PartKind::cylinder) parameters["radius"] = mm_json(part.radius_mm);
  if (part.kind == PartKind::cone) {
    const double tangent = std::tan(part.half_angle_rad);
    parameters["k"] = mm_json(part.apex_mm.value_or(part.radius_at_mm - part.radius_mm / tangent));
    parameters["half_angle"] = deg_json(std::abs(part.half_angle_rad));
  }
  return {{"surface", kinds[static_cast<std::size_t>(part.kind)]},
          {"bore", part.bore},
          {"parameters", parameters}};
}

Json noise_json(const Noise& noise) {
  return {{"sigma", mm_json(noise.sigma_mm)},
          {"uniform", mm_json(noise.uniform_mm)},
          {"rho", with_unit(noise.rho, "1")},
          {"autoregression", noise.autoregression},
          {"student_dof", with_unit(noise.student_dof, "1")},
          {"incidence", with_unit(noise.incidence, "1")},
          {"outlier_fraction", with_unit(noise.outlier_fraction, "1")},
          {"outlier_size", mm_json(noise.outlier_size_mm)},
          {"outliers_one_sided", noise.outliers_one_sided},
          {"quantisation", mm_json(noise.quantisation_mm)}};
}

Json effects_json(const std::vector<Effect>& effects) {
  return list_of(effects, [](const Effect& effect) -> Json {
    Json parameters = Json::object();
    for (const LatheParameter& known : find_effect_kind(effect.id).parameters) {
      const NameAndUnit written = name_and_unit(known.name);
      parameters[written.name] =
          with_unit(written.factor * parameter(effect, known.name), written.unit);
    }
    return {{"effect", effect.id}, {"parameters", parameters}};
  });
}

Json setups_json(const std::vector<Chucking>& setups) {
  return list_of(setups, [](const Chucking& setup) {
    Json entry{{"number", setup.number},
               {"reindex", deg_json(setup.reindex_rad)},
               {"z_shift", mm_json(setup.z_shift_mm)},
               {"side", setup.rear ? "rear" : "front"},
               {"x_jog", mm_json(setup.x_jog_mm)},
               {"clamp_force_ratio", with_unit(setup.clamp_force_ratio, "1")}};
    if (setup.x0_mm) entry["x0"] = mm_json(*setup.x0_mm);
    if (setup.y0_mm) entry["y0"] = mm_json(*setup.y0_mm);
    if (setup.l) entry["l"] = with_unit(*setup.l, "1");
    if (setup.m) entry["m"] = with_unit(*setup.m, "1");
    return entry;
  });
}

}  // namespace

std::string truth_json(const Truth& truth) {
  const Scenario& scenario = truth.scenario;
  Json json{{"schema", "trueaxis.truth/1"}, {"name", scenario.name}};
  json.update(part_json(scenario.part));
  json["effects"] = effects_json(scenario.effects);
  json["noise"] = noise_json(scenario.noise);
  json["setups"] = setups_json(scenario.plan.setups);
  json["probe"] = {{"ball_radius", mm_json(scenario.probe.ball_radius_mm)}};
  if (scenario.probe.relative_zero_mm) {
    json["probe"]["relative_zero"] = mm_json(*scenario.probe.relative_zero_mm);
  }
  if (!scenario.probe.sensor_angles_rad.empty()) {
    json["probe"]["sensor_angles"] = list_of(scenario.probe.sensor_angles_rad, deg_json);
  }
  json["seed"] = scenario.seed;
  json["points"] = truth.clean_mm.size();
  json["outlier_rows"] = truth.outlier_rows;
  json["clipped_rows"] = truth.clipped_rows;
  return json_text(json);
}

}  // namespace trueaxis
