// SPDX-License-Identifier: Apache-2.0
#include "spindle/files/spindle_json.hpp"

#include <cmath>

#include "format/json.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

Json angle_json(double rad) { return with_unit(rad / rad_per_deg, "deg"); }

Json harmonic_json(const SpindleHarmonic& one) {
  return {{"amplitude", number(one.amplitude_mm())},
          {"phase", number(one.phase_rad() / rad_per_deg)},
          {"cos", number(one.cos_mm)},
          {"sin", number(one.sin_mm)},
          {"u", number(one.u_mm)}};
}

Json orders_json(const ErrorMotion& motion) {
  const bool has_form = motion.form.determined();
  Json list = Json::array();
  for (const SeparatedOrder& one : motion.orders) {
    Json json{{"order", one.order}, {"condition", number(one.condition)}};
    if (!one.suppressed.empty()) json["suppressed"] = one.suppressed;
    if (has_form) json["form"] = harmonic_json(one.form);
    json["sensitive"] = harmonic_json(one.sensitive);
    if (motion.across_seen) json["across"] = harmonic_json(one.across);
    list.push_back(std::move(json));
  }
  return list;
}

Json values_json(const MotionValues& values) {
  return {{"synchronous", to_json(values.synchronous)},
          {"asynchronous", to_json(values.asynchronous)},
          {"total", to_json(values.total)}};
}

Json runs_json(const ErrorMotion& motion) {
  Json list = Json::array();
  for (const SpindleRun& run : motion.runs) {
    list.push_back({{"stream", run.stream},
                    {"setup", run.setup},
                    {"sensors", run.sensors},
                    {"readings", run.readings},
                    {"left_out", run.left_out},
                    {"turns", run.turns},
                    {"readings_per_turn", run.readings_per_turn},
                    {"asynchronous_rms", with_unit(run.asynchronous_rms_mm, "mm")},
                    {"eccentricity", to_json(run.eccentricity)},
                    {"eccentricity_angle", angle_json(run.eccentricity_angle_rad)}});
  }
  return list;
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
  if (!axial) json["sensitive_direction"] = angle_json(motion.sensitive_rad);
  json["values"] = values_json(motion.sensitive);
  if (motion.across_seen) json["values_across"] = values_json(motion.across);
  if (axial) {
    if (motion.fundamental.determined()) json["fundamental"] = to_json(motion.fundamental);
    if (motion.residual.determined()) json["residual_synchronous"] = to_json(motion.residual);
  }
  json["form"] = to_json(motion.form);
  json["suppressed"] = suppressed_json(motion);
  json["disagreement"] = number(motion.disagreement);
  json["runs"] = runs_json(motion);
  json["order_unit"] = {{"amplitude", "mm"}, {"phase", "deg"}, {"u", "mm"}};
  json["orders"] = orders_json(motion);
  return json;
}

}  // namespace

std::string spindle_json(const SpindleResult& result, const SpindleOptions& options) {
  Json inputs = Json::array();
  for (std::size_t i = 0; i < result.sources.size(); ++i)
    inputs.push_back({{"file", result.sources[i]}, {"hash", result.input_hashes[i]}});
  Json json{{"schema", "trueaxis.spindle/1"},
            {"version", TRUEAXIS_VERSION},
            {"inputs", std::move(inputs)},
            {"coverage_factor", result.coverage_factor},
            {"order_max", options.order_max},
            {"u_angle", angle_json(options.u_angle_rad)},
            {"u_reindex", angle_json(options.u_reindex_rad)}};
  if (result.radial) json["radial"] = motion_json(*result.radial, false);
  if (result.axial) json["axial"] = motion_json(*result.axial, true);
  json["notes"] = result.notes;
  return json_text(json);
}

}  // namespace trueaxis
