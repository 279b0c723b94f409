// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.hpp"
#include "format/file.hpp"
#include "simulate/files/scenario_files.hpp"
#include "simulate/noise.hpp"

namespace trueaxis {
namespace {

using namespace virtual_lathe;

/// `feature = "bore"`, or `bore = true` as before.
bool read_bore(TomlTable& table) {
  if (table.name_of("feature", "bore") == "bore") return table.flag("bore", false);
  return table.choice<bool>("feature", {{"shaft", false}, {"bore", true}}, false);
}

constexpr double right_angle = 0.5 * std::numbers::pi;

void read_shape(TomlTable& table, Part& part) {
  if (part.kind == PartKind::face) {
    part.d_mm = table.required_number("d_mm");
    return;
  }
  part.bore = read_bore(table);
  if (part.kind == PartKind::cone) part.apex_mm = table.maybe_number("k_mm");
  if (part.kind == PartKind::cone) {
    const Range angle =
        part.apex_mm ? Range::inside(0.0, right_angle) : Range::inside(-right_angle, right_angle);
    part.half_angle_rad = table.required_number("half_angle_rad", angle);
  }
  if (part.apex_mm) {
    if (table.has("radius_mm")) {
      table.complain("radius_mm", "contradicts `k_mm`: give the apex or a radius");
    }
    return;
  }
  part.radius_mm = table.required_number("radius_mm", Range::positive());
  if (part.kind == PartKind::cone) part.radius_at_mm = table.number("radius_at_mm", 0.0);
}

void read_part(TomlTable table, Scenario& scenario) {
  Part& part = scenario.part;
  part.kind = table.required_choice<PartKind>(table.name_of("surface", "kind"),
                                              {{"cylinder", PartKind::cylinder},
                                               {"cone", PartKind::cone},
                                               {"face", PartKind::face},
                                               {"plane", PartKind::face}});
  part.x0_mm = table.number("x0_mm", 0.0);
  part.y0_mm = table.number("y0_mm", 0.0);
  part.l = table.number("l", 0.0, Range::inside(-1.0, 1.0));
  part.m = table.number("m", 0.0, Range::inside(-1.0, 1.0));
  if (part.l * part.l + part.m * part.m >= 1.0) {
    table.complain("l", "and `m` are direction cosines: l^2 + m^2 must be less than 1");
  }
  read_shape(table, part);
  scenario.u_start_mm = table.maybe_number("u_start_mm");
  scenario.u_end_mm = table.maybe_number("u_end_mm");
}

Probe read_probe(TomlTable table) {
  Probe probe;
  probe.ball_radius_mm = table.number("ball_radius_mm", 0.0, Range::non_negative());
  probe.relative_zero_mm = table.maybe_number("relative_zero_mm");
  probe.nominal_radius_mm = table.maybe_number("nominal_radius_mm", Range::positive());
  probe.states_noise = table.flag("states_noise", true);
  probe.sensor_angles_rad = table.numbers("sensor_angles_rad");
  return probe;
}

Noise read_noise(TomlTable table) {
  Noise noise;
  noise.sigma_mm = table.number("sigma_mm", 0.0, Range::non_negative());
  noise.uniform_mm = table.number("uniform_mm", 0.0, Range::non_negative());
  noise.rho = table.number("rho", 0.0, Range::inside(-1.0, 1.0));
  noise.autoregression = table.numbers("autoregression");
  if (!noise.autoregression.empty() && noise.rho != 0.0)
    table.complain("autoregression", "contradicts `rho`: keep one of them");
  if (!is_stationary(noise.autoregression))
    table.complain("autoregression", "is not stationary: make its numbers smaller");
  noise.student_dof = table.number("student_dof", 0.0, {.low = 2.0, .low_open = true});
  noise.incidence = table.number("incidence", 0.0, Range::non_negative());
  noise.outlier_fraction = table.number("outlier_fraction", 0.0, Range::fraction());
  noise.outlier_size_mm = table.number("outlier_size_mm", 0.0, Range::non_negative());
  noise.outliers_one_sided = table.flag("outliers_one_sided", false);
  noise.quantisation_mm = table.number("quantisation_mm", 0.0, Range::non_negative());
  return noise;
}

PlannedPass read_pass(TomlTable table, bool face) {
  PlannedPass pass;
  const std::string axis = face ? "x" : "z";
  if (const std::optional<double> at = table.maybe_number(axis + "_mm")) {
    pass.start_mm = pass.end_mm = *at;
    for (const std::string& key : {axis + "_start_mm", axis + "_end_mm"}) {
      if (table.has(key)) table.complain(key, "contradicts `" + axis + "_mm`: keep one of them");
    }
  } else {
    pass.start_mm = table.required_number(axis + "_start_mm");
    pass.end_mm = table.required_number(axis + "_end_mm");
  }
  pass.speed_rpm = table.number("speed_rpm", pass.speed_rpm);
  pass.feed_mm_per_rev = table.number("feed_mm_per_rev", pass.feed_mm_per_rev, Range::positive());
  pass.readings_per_revolution =
      table.number("readings_per_revolution", pass.readings_per_revolution, Range::positive());
  const bool stationary = pass.speed_rpm == 0.0, dwell = pass.start_mm == pass.end_mm;
  pass.revolutions = table.number("revolutions", 0.0, Range::positive());
  pass.duration_s = table.number("duration_s", 0.0, Range::positive());
  pass.rate_hz = table.number("rate_hz", 0.0, Range::positive());
  if (stationary && !(table.has("duration_s") && table.has("rate_hz"))) {
    table.complain("speed_rpm", "is 0, a stationary capture: give duration_s and rate_hz");
  }
  if (stationary && !dwell && std::isfinite(pass.start_mm + pass.end_mm)) {
    table.complain(axis + "_end_mm", "differs from the start, but the spindle stands still");
  }
  if (!stationary && dwell && !table.has("revolutions")) {
    table.complain(axis + "_mm", "makes a dwell: give its `revolutions`");
  }
  pass.jitter = table.number("jitter", 0.0, {.low = 0.0, .high = 1.0, .high_open = true});
  pass.pause_s = table.number("pause_s", pass.pause_s, Range::non_negative());
  pass.c_start_rad = table.maybe_number("c_start_rad");
  pass.setup = static_cast<int>(table.integer("setup", 1, 1, 1000));
  return pass;
}

Chucking read_setup(TomlTable table) {
  Chucking setup;
  if (!table.has("number")) table.complain("number", "is missing: number the set-up");
  setup.number = static_cast<int>(table.integer("number", 1, 1, 1000));
  setup.reindex_rad = table.number("reindex_rad", 0.0);
  setup.z_shift_mm = table.number("z_shift_mm", 0.0);
  setup.rear = table.choice("side", {{"front", false}, {"rear", true}}, false);
  setup.x_jog_mm = table.number("x_jog_mm", 0.0);
  setup.clamp_force_ratio = table.number("clamp_force_ratio", 1.0, Range::non_negative());
  setup.x0_mm = table.maybe_number("x0_mm");
  setup.y0_mm = table.maybe_number("y0_mm");
  setup.l = table.maybe_number("l", Range::inside(-0.7, 0.7));
  setup.m = table.maybe_number("m", Range::inside(-0.7, 0.7));
  return setup;
}

std::optional<Effect> read_effect(TomlTable table) {
  Effect effect;
  effect.id = table.required_text("id");
  const auto kinds = effect_kinds();
  const auto kind = std::ranges::find(kinds, effect.id, &EffectKind::id);
  if (kind == kinds.end()) {
    if (!effect.id.empty())
      table.complain("id", "is not known; known ids: " + word_list(kinds, ", ", &EffectKind::id));
    table.ignore_rest();
    return std::nullopt;
  }
  for (const LatheParameter& parameter : kind->parameters) {
    const std::string name(parameter.name);
    if (!parameter.fallback) {
      effect.parameters[name] = table.required_number(name);
    } else if (const std::optional<double> value = table.maybe_number(name)) {
      effect.parameters[name] = *value;
    }
  }
  return effect;
}

CutTarget read_target(TomlTable table) {
  CutTarget target;
  target.kind = table.choice<CutKind>(
      table.name_of("surface", "kind"),
      {{"cylinder", CutKind::cylinder}, {"cone", CutKind::cone}, {"face", CutKind::face}},
      CutKind::cylinder);
  const bool face = target.kind == CutKind::face;
  const std::string_view start =
      face ? table.name_of("radius_start_mm", "x_start_mm") : "z_start_mm";
  const std::string_view end = face ? table.name_of("radius_end_mm", "x_end_mm") : "z_end_mm";
  target.start_mm = table.required_number(start);
  target.end_mm = table.required_number(end);
  if (target.start_mm == target.end_mm)
    table.complain(end, "equals the start: give the cut a length");
  if (face) {
    target.z_face_mm = table.required_number(table.name_of("z_mm", "z_face_mm"));
    return target;
  }
  target.bore = read_bore(table);
  target.radius_mm = table.required_number("radius_mm", Range::positive());
  if (target.kind == CutKind::cone) {
    // As a job says it, opening to one side, or with its sign.
    const bool opens = table.has("opens");
    const double sign = table.choice<double>("opens", {{"+z", 1.0}, {"-z", -1.0}}, 1.0);
    target.half_angle_rad =
        sign * table.required_number("half_angle_rad",
                                     Range::inside(opens ? 0.0 : -right_angle, right_angle));
  }
  return target;
}

CutTool read_tool(TomlTable table) {
  CutTool tool;
  tool.nose_radius_mm = table.number("nose_radius_mm", 0.0, Range::non_negative());
  tool.height_mm = table.number(table.name_of("tool_height_mm", "height_mm"), 0.0);
  tool.angle_from_probe_rad = table.number("angle_from_probe_rad", 0.0);
  tool.speed_rpm = table.number("speed_rpm", tool.speed_rpm, Range::positive());
  tool.sense =
      table.choice<int>("sense", {{"+c", 1}, {"-c", -1}, {"1", 1}, {"-1", -1}}, tool.sense);
  tool.feed_mm_per_rev = table.number("feed_mm_per_rev", tool.feed_mm_per_rev, Range::positive());
  tool.c_start_rad = table.number("c_start_rad", 0.0);
  return tool;
}

CutActuator read_actuator(TomlTable table) {
  CutActuator actuator;
  actuator.perfect = table.flag("perfect", false);
  actuator.natural_frequency_hz =
      table.number("natural_frequency_hz", actuator.natural_frequency_hz, Range::positive());
  actuator.damping = table.number("damping", actuator.damping, Range::positive());
  actuator.delay_s = table.number("delay_s", 0.0, Range::non_negative());
  actuator.sampling_hz = table.number("sampling_hz", actuator.sampling_hz, Range::positive());
  return actuator;
}

CutProgram read_cut_program(TomlTable table) {
  CutProgram cut;
  cut.use = table.choice<CutUse>(
      "use", {{"command", CutUse::command}, {"wanted", CutUse::wanted}, {"none", CutUse::none}},
      CutUse::command);
  cut.table = table.maybe_path("table").value_or("");
  cut.target = read_target(table.required_table("target"));
  if (const auto tool = table.maybe_table("tool")) cut.tool = read_tool(*tool);
  if (const auto actuator = table.maybe_table("actuator")) cut.actuator = read_actuator(*actuator);
  return cut;
}

}  // namespace

std::vector<PlannedPass> read_passes(TomlTable table, bool face) {
  std::vector<PlannedPass> passes;
  for (const TomlTable& one : table.tables("pass")) passes.push_back(read_pass(one, face));
  if (passes.empty())
    table.complain("pass", table.has("pass") ? "is empty: give at least one pass"
                                             : "is missing: add a [[pass]]");
  return passes;
}

std::vector<Chucking> read_setups(TomlTable table) {
  std::vector<Chucking> setups;
  for (const TomlTable& one : table.tables("setup")) setups.push_back(read_setup(one));
  return setups;
}

std::vector<Effect> read_effects(TomlTable table) {
  std::vector<Effect> effects;
  for (const TomlTable& one : table.tables("effect")) {
    if (auto effect = read_effect(one)) effects.push_back(std::move(*effect));
  }
  return effects;
}

void read_scenario_tables(TomlTable root, virtual_lathe::Scenario& scenario) {
  read_part(root.required_table("part"), scenario);
  if (const auto probe = root.maybe_table("probe")) scenario.probe = read_probe(*probe);
  if (const auto noise = root.maybe_table("noise")) scenario.noise = read_noise(*noise);
  scenario.plan.passes = read_passes(root, scenario.part.kind == PartKind::face);
  scenario.plan.setups = read_setups(root);
  scenario.effects = read_effects(root);
  if (const auto cut = root.maybe_table("cut")) scenario.cut = read_cut_program(*cut);
}

virtual_lathe::Scenario parse_scenario_toml(std::string_view content, const std::string& path) {
  TomlDocument document(content, path);
  TomlTable root = document.root();
  Scenario scenario;
  scenario.name = root.text("name");
  scenario.seed =
      static_cast<std::uint64_t>(root.integer("seed", 1, 0, std::numeric_limits<long long>::max()));
  read_scenario_tables(root, scenario);
  document.finish();
  return scenario;
}

virtual_lathe::Scenario read_scenario_toml(const std::string& path) {
  return parse_scenario_toml(read_file(path), path);
}

}  // namespace trueaxis
