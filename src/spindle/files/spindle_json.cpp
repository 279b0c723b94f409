// SPDX-License-Identifier: Apache-2.0
#include "format/json.hpp"
#include "spindle/files/spindle_files.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

Json harmonic_json(const SpindleHarmonic& one) {
  return {{"amplitude", number(one.amplitude_mm())},
          {"phase", number(one.phase_rad() / rad_per_deg)},
          {"cos", number(one.cos_mm)},
          {"sin", number(one.sin_mm)},
          {"u", number(one.u_mm)}};
}

Json orders_json(const ErrorMotion& motion) {
  const bool has_form = motion.form_seen();
  return list_of(motion.orders, [&](const SeparatedOrder& one) {
    Json json{{"order", one.order}, {"condition", number(one.condition)}};
    if (!one.suppressed.empty()) json["suppressed"] = one.suppressed;
    if (has_form) json["form"] = harmonic_json(one.form);
    json["sensitive"] = harmonic_json(one.sensitive);
    if (motion.across_seen) json["across"] = harmonic_json(one.across);
    return json;
  });
}

Json values_json(const MotionValues& values) {
  return {{"synchronous", to_json(values.synchronous)},
          {"asynchronous", to_json(values.asynchronous)},
          {"total", to_json(values.total)}};
}

Json run_json(const SpindleRun& run) {
  return {{"stream", run.stream},
          {"setup", run.setup},
          {"sensors", run.sensors},
          {"readings", run.readings},
          {"left_out", run.left_out},
          {"turns", run.turns},
          {"readings_per_turn", run.readings_per_turn},
          {"asynchronous_rms", mm_json(run.asynchronous_rms_mm)},
          {"eccentricity", to_json(run.eccentricity)},
          {"eccentricity_angle", deg_json(run.eccentricity_angle_rad)}};
}

Json suppressed_json(const ErrorMotion& motion) {
  Json list = Json::array();
  for (const SeparatedOrder& one : motion.orders) {
    if (!one.suppressed.empty())
      list.push_back(
          {{"order", one.order}, {"condition", number(one.condition)}, {"why", one.suppressed}});
  }
  return list;
}

Json motion_json(const ErrorMotion& motion, bool axial) {
  Json json;
  if (!axial) json["sensitive_direction"] = deg_json(motion.sensitive_rad);
  json["values"] = values_json(motion.sensitive);
  if (motion.across_seen) json["values_across"] = values_json(motion.across);
  if (axial) {
    if (motion.fundamental.determined()) {
      json["fundamental"] = to_json(motion.fundamental);
      json["residual_synchronous"] = to_json(motion.residual);
    }
  }
  json["form"] = to_json(motion.form);
  json["suppressed"] = suppressed_json(motion);
  json["disagreement"] = number(motion.disagreement);
  json["runs"] = list_of(motion.runs, run_json);
  json["order_unit"] = {{"amplitude", "mm"}, {"phase", "deg"}, {"u", "mm"}};
  json["orders"] = orders_json(motion);
  return json;
}

}  // namespace

std::string spindle_json(const SpindleResult& result, const SpindleOptions& options) {
  Json json{{"schema", "trueaxis.spindle/1"},
            {"version", TRUEAXIS_VERSION},
            {"inputs", files_json(result.sources, result.input_hashes)},
            {"coverage_factor", result.coverage_factor},
            {"order_max", options.order_max},
            {"u_angle", deg_json(options.u_angle_rad)},
            {"u_reindex", deg_json(options.u_reindex_rad)}};
  if (result.radial) json["radial"] = motion_json(*result.radial, false);
  if (result.axial) json["axial"] = motion_json(*result.axial, true);
  json["notes"] = result.notes;
  return json_text(json);
}

}  // namespace trueaxis
