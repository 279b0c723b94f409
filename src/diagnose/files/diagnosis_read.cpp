// SPDX-License-Identifier: Apache-2.0
#include "diagnose/files/diagnosis_read.hpp"

#include <cmath>

#include "diagnose/files/diagnosis_json.hpp"
#include "diagnose/files/diagnosis_term_json.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

double value(const Json& object, const char* key) { return object.at(key).at("value"); }

FitStatus status_from(const std::string& text) {
  for (const FitStatus status : {FitStatus::converged, FitStatus::max_iterations,
                                 FitStatus::rank_deficient, FitStatus::too_few}) {
    if (text == to_string(status)) return status;
  }
  throw InputError("diagnosis", "no fit ends `" + text + "`");
}

/// Of the parameters x0, y0, l, m; a section has no l, m.
Axis axis_from_parameters(const Json& parameters) {
  Axis axis{value(parameters, "x0"), value(parameters, "y0")};
  if (!parameters.contains("l")) return axis;
  const double l = value(parameters, "l"), m = value(parameters, "m");
  const double n = std::sqrt(1.0 - l * l - m * m);
  axis.slope_x = l / n;
  axis.slope_y = m / n;
  return axis;
}

std::vector<Rejected> rows_from(const Json& list) {
  std::vector<Rejected> rows;
  for (const Json& entry : list) rows.push_back({entry.at("row"), entry.at("why")});
  return rows;
}

/// A fit that did not converge has no numbers: its status says so.
FitResult fit_from(const Json& json) {
  FitResult fit;
  fit.source = json.at("input").at("file");
  fit.input_hash = json.at("input").at("hash");
  fit.surface = surface_from_id(json.at("surface").get<std::string>());
  fit.bore = json.at("feature") == "bore";
  fit.status = status_from(json.at("status"));
  if (fit.status != FitStatus::converged) return fit;
  const Json& axis = json.at("axis");
  fit.axis.axis = {value(axis, "x"), value(axis, "y"), value(axis, "slope_x"),
                   value(axis, "slope_y"), value(axis, "z_ref")};
  fit.shape = {fit.axis.axis, value(json.at("shape"), "radius"),
               value(json.at("shape"), "tan_half_angle")};
  for (const Json& set_up : json.value("set_ups", Json::array())) {
    fit.set_ups.emplace_back().axis.axis = axis_from_parameters(set_up.at("parameters"));
  }
  fit.rms_mm = value(json, "rms");
  fit.rejected = rows_from(json.at("rejected"));
  return fit;
}

Diagnosis diagnosis_from(const Json& json) {
  if (json.at("schema") != diagnosis_schema)
    throw InputError("diagnosis", std::string("is no ") + diagnosis_schema +
                                      ": write one with 'trueaxis diagnose --json'");
  Diagnosis d;
  d.baseline = fit_from(json.at("baseline"));
  d.extended = fit_from(json.at("extended"));
  d.z_mid_mm = value(json.at("u_frame"), "z_mid");
  d.z_half_mm = value(json.at("u_frame"), "z_half");
  for (const Json& finding : json.at("findings"))
    d.findings.emplace_back().term = effect_term_from(finding.at("effect"), finding.at("term"));
  for (const Json& pattern : json.at("unexplained"))
    d.unexplained.emplace_back().term = pattern_term_from(pattern.at("term"));
  d.noise.sigma_mm = value(json.at("noise"), "sigma");
  d.noise.autoregression = json.at("noise").at("autoregression").get<std::vector<double>>();
  d.noise.masked = rows_from(json.at("noise").at("masked"));
  return d;
}

}  // namespace

Diagnosis diagnosis_from_json(std::string_view text, const std::string& path) {
  try {
    return diagnosis_from(Json::parse(text));
  } catch (const Json::exception& error) {
    throw InputError(
        path, std::string("cannot be read as ") + diagnosis_schema + " (" + error.what() + ")");
  } catch (const InputError& error) {
    throw InputError(path, error.diagnostics().front().message);
  }
}

}  // namespace trueaxis
