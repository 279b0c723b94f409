// SPDX-License-Identifier: Apache-2.0
#include "resimulate/diagnosis_scenario.hpp"

#include <algorithm>
#include <cmath>

#include "resimulate/finding_effects.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using virtual_lathe::Chucking;
using virtual_lathe::PartKind;
using virtual_lathe::Scenario;

/// An axis through (x, y, 0) of the spindle frame with slopes dx/dz, dy/dz.
struct WrittenAxis {
  double x_mm = 0.0, y_mm = 0.0, slope_x = 0.0, slope_y = 0.0;

  /// Of a fit's `axis`.
  static WrittenAxis of_axis(const Json& axis) {
    WrittenAxis out{inside_value(axis.at("x")), inside_value(axis.at("y")),
                    inside_value(axis.at("slope_x")), inside_value(axis.at("slope_y"))};
    const double z_ref = inside_value(axis.at("z_ref"));
    out.x_mm -= out.slope_x * z_ref;
    out.y_mm -= out.slope_y * z_ref;
    return out;
  }
  /// Of the parameters x0, y0, l, m; a section has no l, m.
  static WrittenAxis of_parameters(const Json& parameters) {
    WrittenAxis out{inside_value(parameters.at("x0")), inside_value(parameters.at("y0"))};
    if (!parameters.contains("l")) return out;
    const double l = inside_value(parameters.at("l")), m = inside_value(parameters.at("m"));
    const double n = std::sqrt(1.0 - l * l - m * m);
    out.slope_x = l / n;
    out.slope_y = m / n;
    return out;
  }
  double secant() const { return std::sqrt(1.0 + slope_x * slope_x + slope_y * slope_y); }
};

bool at_rear(const ProbeStream& stream, const SetUp& set_up) {
  if (set_up.rear || stream.indication == Indication::relative) return set_up.rear;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    if (stream.setup.empty() || stream.setup[i] == set_up.number) return stream.reading_mm[i] < 0.0;
  }
  return false;
}

/// The part as it stands in a set-up. The lathe's frame moves along Z with the part: the axis is
/// asked for where it pierces z = z_shift.
Chucking chucking_of(const ProbeStream& stream, const SetUp& set_up, const WrittenAxis& axis) {
  Chucking out;
  out.number = set_up.number;
  out.reindex_rad = set_up.reindex_rad;
  out.z_shift_mm = set_up.z_shift_mm;
  out.rear = at_rear(stream, set_up);
  out.x_jog_mm = set_up.x_jog_mm;
  out.clamp_force_ratio = set_up.clamp_force_ratio;
  out.x0_mm = axis.x_mm + axis.slope_x * set_up.z_shift_mm;
  out.y0_mm = axis.y_mm + axis.slope_y * set_up.z_shift_mm;
  out.l = axis.slope_x / axis.secant();
  out.m = axis.slope_y / axis.secant();
  return out;
}

/// Part and set-ups of a fit, its radius about the axis as it stands in the last set-up.
void place_part(const Json& fit, const ProbeStream& stream, Scenario& scenario) {
  if (fit.at("status") != "converged")
    throw InputError("diagnosis", "its fit is not converged (" +
                                      fit.at("status").get<std::string>() +
                                      "): there is nothing to simulate");
  const WrittenAxis last = WrittenAxis::of_axis(fit.at("axis"));
  const std::vector<SetUp> set_ups = list_set_ups(stream);
  for (std::size_t i = 0; i < set_ups.size(); ++i) {
    const bool several = fit.contains("set_ups");
    const WrittenAxis axis =
        several ? WrittenAxis::of_parameters(fit.at("set_ups").at(i).at("parameters")) : last;
    scenario.plan.setups.push_back(chucking_of(stream, set_ups[i], axis));
  }
  virtual_lathe::Part& part = scenario.part;
  const Chucking& now = scenario.plan.setups.back();
  part.x0_mm = *now.x0_mm;
  part.y0_mm = *now.y0_mm;
  part.l = *now.l;
  part.m = *now.m;
  part.bore = fit.at("feature") == "bore";
  part.radius_mm = inside_value(fit.at("shape").at("radius"));
  if (fit.at("surface") != "cone") return;
  part.kind = PartKind::cone;
  part.half_angle_rad = std::atan(inside_value(fit.at("shape").at("tan_half_angle")));
  part.radius_at_mm =
      (inside_value(fit.at("axis").at("z_ref")) - set_ups.back().z_shift_mm) * last.secant();
}

DiagnosisFrame frame_of(const Json& json, const ProbeStream& stream) {
  DiagnosisFrame frame;
  frame.z_mid_mm = inside_value(json.at("u_frame").at("z_mid"));
  frame.z_half_mm = inside_value(json.at("u_frame").at("z_half"));
  if (!stream.time_s.empty()) {
    frame.time_start_s = stream.time_s.front();
    frame.time_end_s = stream.time_s.back();
  }
  return frame;
}

virtual_lathe::Noise noise_of(const Json& json) {
  virtual_lathe::Noise noise;
  noise.sigma_mm = inside_value(json.at("sigma"));
  noise.autoregression = json.at("autoregression").get<std::vector<double>>();
  return noise;
}

std::vector<bool> masked_of(const Json& rows, std::size_t count) {
  std::vector<bool> masked(count, false);
  for (const Json& entry : rows) {
    const std::size_t row = entry.at("row");
    if (row >= 1 && row <= count) masked[row - 1] = true;
  }
  return masked;
}

Json parsed(std::string_view text) {
  Json json = Json::parse(text);
  if (json.at("schema") != "trueaxis.diagnosis/1")
    throw InputError("diagnosis",
                     "is no trueaxis.diagnosis/1: write one with 'trueaxis diagnose "
                     "--json'");
  return json;
}

/// Errors of the text, under its path.
template <class Read>
auto reading(const std::string& path, const Read& read) {
  try {
    return read();
  } catch (const Json::exception& error) {
    throw InputError(path,
                     std::string("cannot be read as trueaxis.diagnosis/1 (") + error.what() + ")");
  } catch (const InputError& error) {
    std::vector<Diagnostic> diagnostics = error.diagnostics();
    for (Diagnostic& d : diagnostics) {
      if (d.file == "diagnosis") d.file = path;
    }
    throw InputError(std::move(diagnostics));
  }
}

}  // namespace

DiagnosisInput diagnosis_input(std::string_view json, const std::string& path) {
  return reading(path, [&] {
    const Json input = parsed(json).at("input");
    return DiagnosisInput{input.at("file"), input.at("hash")};
  });
}

DiagnosedScenarios diagnosed_scenarios(std::string_view text, const std::string& path,
                                       const ProbeStream& stream, double ball_radius_mm) {
  return reading(path, [&] {
    const Json json = parsed(text);
    const std::string hash = json.at("input").at("hash");
    if (hash != stream.input_hash) {
      throw InputError(path, "is the diagnosis of another stream: its input was " + hash + ", " +
                                 stream.source + " is " + stream.input_hash);
    }
    DiagnosedScenarios out;
    const DiagnosisFrame frame = frame_of(json, stream);
    Scenario common;
    common.noise = noise_of(json.at("noise"));
    common.probe.ball_radius_mm = std::max(ball_radius_mm, stream.ball_radius_mm.value_or(0.0));
    common.probe.nominal_radius_mm = stream.nominal_radius_mm;
    if (stream.indication == Indication::relative) common.probe.relative_zero_mm = 0.0;
    common.u_start_mm = frame.z_mid_mm - frame.z_half_mm;
    common.u_end_mm = frame.z_mid_mm + frame.z_half_mm;
    out.before = out.after = common;
    out.before.name = "the ideal surface of " + json.at("input").at("file").get<std::string>();
    out.after.name = "the extended model of " + json.at("input").at("file").get<std::string>();
    place_part(json.at("baseline"), stream, out.before);
    place_part(json.at("extended"), stream, out.after);
    for (const Json& finding : json.at("findings")) {
      for (auto& effect : effects_of_finding(finding, frame))
        out.after.effects.push_back(std::move(effect));
    }
    for (const Json& pattern : json.at("unexplained"))
      out.after.effects.push_back(effect_of_unexplained(pattern, frame));
    out.masked = masked_of(json.at("noise").at("masked"), stream.size());
    out.rejected = masked_of(json.at("baseline").at("rejected"), stream.size());
    out.rms_mm = inside_value(json.at("baseline").at("rms"));
    return out;
  });
}

}  // namespace trueaxis
