// SPDX-License-Identifier: Apache-2.0
#include "simulate/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::virtual_lathe {
namespace {

SetUp stated(const Chucking& setup) {
  return {setup.number, setup.reindex_rad, setup.z_shift_mm,
          setup.rear,   setup.x_jog_mm,    setup.clamp_force_ratio};
}

void describe_setup(const SetUp& setup, std::map<std::string, std::string>& metadata) {
  const std::string prefix = "setup." + std::to_string(setup.number) + '.';
  const auto put = [&](const char* key, double value, const char* unit) {
    metadata[prefix + key] = fmt::format("{:.12g}{}", value, unit);
  };
  if (setup.reindex_rad != 0.0) put("reindex", setup.reindex_rad / rad_per_deg, " deg");
  if (setup.z_shift_mm != 0.0) put("z_shift", setup.z_shift_mm, " mm");
  if (setup.x_jog_mm != 0.0) put("x_jog", setup.x_jog_mm, " mm");
  if (setup.clamp_force_ratio != 1.0) put("clamp_force_ratio", setup.clamp_force_ratio, "");
  if (setup.rear) metadata[prefix + "side"] = "rear";
}

}  // namespace

void validate(const Part& part) {
  std::vector<Diagnostic> wrong;
  const auto need = [&](bool condition, const char* message) {
    if (!condition) wrong.push_back({"scenario", 0, 0, std::string("part: ") + message});
  };
  constexpr double right_angle = 90.0 * rad_per_deg;
  need(part.l * part.l + part.m * part.m < 1.0, "l^2 + m^2 must be less than 1");
  if (part.kind == PartKind::cylinder || (part.kind == PartKind::cone && !part.apex_mm)) {
    need(part.radius_mm > 0.0, "the radius must be more than 0");
  }
  if (part.kind == PartKind::cone) {
    need(std::abs(part.half_angle_rad) < right_angle, "the half angle must be less than 90 deg");
    need(!part.apex_mm || part.half_angle_rad > 0.0,
         "with an apex the half angle must be more than 0; the side of the apex says how it opens");
  }
  need(part.kind != PartKind::face || !part.bore, "a face cannot be a bore");
  if (!wrong.empty()) throw InputError(std::move(wrong));
}

void need_one_sensor(const Scenario& scenario) {
  if (!scenario.probe.sensor_angles_rad.empty())
    throw InputError("scenario", "probe: one sensor only here: take sensor_angles out");
}

Recording recording_of(const Scenario& scenario, const Chain& chain) {
  const double rounding =
      chain.quantisation_mm > 0.0 ? chain.quantisation_mm : scenario.noise.quantisation_mm;
  return {scenario.noise,
          scenario.seed,
          chain.lag_s,
          chain.play_mm,
          {scenario.probe.relative_zero_mm.value_or(0.0), chain.low_mm, chain.high_mm, rounding}};
}

void describe(const Scenario& scenario, ProbeStream& stream) {
  stream.kind = scenario.part.kind == PartKind::face ? StreamKind::face : StreamKind::lateral;
  if (scenario.probe.relative_zero_mm) stream.indication = Indication::relative;
  stream.metadata["x_convention"] = "radius";
  stream.nominal_radius_mm = scenario.probe.nominal_radius_mm;
  if (scenario.noise.sigma_mm > 0.0 && scenario.probe.states_noise) {
    stream.sensor_noise_mm = scenario.noise.sigma_mm;
  }
  const auto& passes = scenario.plan.passes;
  const auto same_speed = [&](const PlannedPass& pass) {
    return pass.speed_rpm == passes.front().speed_rpm;
  };
  if (std::all_of(passes.begin(), passes.end(), same_speed) && passes.front().speed_rpm != 0.0) {
    stream.spindle_rpm = passes.front().speed_rpm;
  }
  stream.setups.clear();
  for (const Chucking& setup : scenario.plan.setups) stream.setups.push_back(stated(setup));
  stream.setups = list_set_ups(stream);
  for (const SetUp& setup : stream.setups) describe_setup(setup, stream.metadata);
  stream.sensor_angles_rad = scenario.probe.sensor_angles_rad;
  if (scenario.probe.ball_radius_mm > 0.0) stream.ball_radius_mm = scenario.probe.ball_radius_mm;
}

}  // namespace trueaxis::virtual_lathe
