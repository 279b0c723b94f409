// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "fit/files/fit_files.hpp"
#include "fit/probe_height.hpp"
#include "format/json.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

bool withdrawn(const FitParameter& parameter) {
  return !parameter.estimate.determined() && !parameter.estimate.why_not.empty();
}

bool withdrawn(const FitResult& result, std::string_view name) {
  return std::ranges::any_of(result.parameters, [&](const FitParameter& parameter) {
    return parameter.name == name && withdrawn(parameter);
  });
}

Json estimates(const std::vector<FitParameter>& parameters) {
  Json object = Json::object();
  for (const FitParameter& p : parameters) object[p.name] = to_json(p.estimate);
  return object;
}

/// Covariance of the parameters; null where one of the two was not determined.
Json covariance_object(const FitResult& result) {
  const auto name = [](const FitParameter& one) { return one.name; };
  const auto to_edge = [&](std::size_t i) {
    const FitParameter& one = result.parameters[i];
    return withdrawn(one) ? none : edge_factor(one.estimate.unit);
  };
  const auto value = [&](std::size_t i, std::size_t j) {
    return result.covariance(i, j) * to_edge(std::min(i, j)) * to_edge(std::max(i, j));
  };
  return {{"order", list_of(result.parameters, name)},
          {"matrix", square_json(result.covariance.size(), value)}};
}

Json budget(const FitResult& result) {
  return list_of(result.budget, [&](const BudgetLine& line) -> Json {
    Json u = Json::object();
    for (std::size_t i = 0; i < line.u.size(); ++i) {
      u[result.parameters[i].name] = edge_size(withdrawn(result.parameters[i]) ? none : line.u[i],
                                               result.parameters[i].estimate.unit);
    }
    return {{"source", line.source}, {"type", std::string(1, line.type)}, {"u", u}};
  });
}

/// What was done before each set-up, and the part as it was then.
Json set_up_object(const SetUpFit& one) {
  const SetUp& set_up = one.set_up;
  return {{"number", set_up.number},
          {"side", one.side == Root::rear ? "rear" : "front"},
          {"reindex", deg_json(set_up.reindex_rad)},
          {"z_shift", mm_json(set_up.z_shift_mm)},
          {"x_jog", mm_json(set_up.x_jog_mm)},
          {"clamp_force_ratio", with_unit(set_up.clamp_force_ratio, "1")},
          {"parameters", estimates(one.parameters)}};
}

/// The axis and the shape as determined: NaN where the readings leave them open. (The axis of a
/// cone that cannot be told from a cylinder is determined.)
AxisEstimate determined_axis(const FitResult& result) {
  AxisEstimate estimate = result.axis;
  if (withdrawn(result, "l") || withdrawn(result, "m") || withdrawn(result, "x0") ||
      withdrawn(result, "y0")) {
    estimate.axis = {none, none, none, none, estimate.axis.z_ref_mm};
    estimate.covariance.by_rows.fill(none);
  }
  return estimate;
}

Json shape_object(const FitResult& result) {
  const bool open = result.status != FitStatus::converged;
  const bool taper_open = open && withdrawn(result, "half_angle");
  const bool radius_open = open && (withdrawn(result, "radius") || withdrawn(result, "x0"));
  return {{"radius", with_unit(radius_open ? none : result.shape.radius_mm, "mm")},
          {"tan_half_angle", with_unit(taper_open ? none : result.shape.tan_half_angle, "1")}};
}

Json axis_object(const AxisEstimate& estimate) {
  const Axis& axis = estimate.axis;
  return {{"x", with_unit(axis.x_mm, "mm")},
          {"y", with_unit(axis.y_mm, "mm")},
          {"slope_x", with_unit(axis.slope_x, "1")},
          {"slope_y", with_unit(axis.slope_y, "1")},
          {"z_ref", with_unit(axis.z_ref_mm, "mm")},
          {"covariance",
           {{"order", {"x", "y", "slope_x", "slope_y"}},
            {"matrix", square_json(4, [&](std::size_t i, std::size_t j) {
               return estimate.covariance.by_rows[4 * i + j];
             })}}}};
}

/// The file, what was assumed that it does not state, and what of it was not used.
Json input_object(const FitResult& result) {
  Json json{{"file", result.source}, {"hash", result.input_hash}, {"notes", result.input_notes}};
  if (result.x_convention) {
    const auto [diameter, by] = *result.x_convention;
    json["x_convention"] = {{"taken", diameter ? "diameter" : "radius"},
                            {"said", by == SaidBy::nobody ? Json(false) : Json(to_string(by))}};
  }
  return json;
}

double value(const Json& object, const char* key) { return object.at(key).at("value"); }

FitStatus status_from(const std::string& text) {
  for (const FitStatus status :
       {FitStatus::converged, FitStatus::max_iterations, FitStatus::rank_deficient,
        FitStatus::too_few, FitStatus::implausible}) {
    if (text == to_string(status)) return status;
  }
  throw InputError("fit", "a fit does not end with `" + text + "`");
}

/// The place of the parameters x0, y0, l, m; a section has no l, m, a plane no x0, y0.
Axis axis_from_parameters(const Json& parameters) {
  Axis axis;
  if (parameters.contains("x0")) axis = {value(parameters, "x0"), value(parameters, "y0")};
  if (!parameters.contains("l")) return axis;
  const double l = value(parameters, "l"), m = value(parameters, "m");
  const double n = std::sqrt(1.0 - l * l - m * m);
  axis.slope_x = l / n;
  axis.slope_y = m / n;
  return axis;
}

}  // namespace

Json rejected_json(const std::vector<Rejected>& rows) {
  return list_of(rows, [](const Rejected& one) -> Json {
    return {{"row", one.row}, {"why", one.why}};
  });
}

std::vector<Rejected> rejected_from(const Json& json) {
  std::vector<Rejected> rows;
  for (const Json& row : json) rows.push_back({row.at("row"), row.at("why")});
  return rows;
}

Json fit_object(const FitResult& result) {
  Json json;
  json["schema"] = "trueaxis.fit/1";
  json["version"] = TRUEAXIS_VERSION;
  json["input"] = input_object(result);
  json["surface"] = to_string(result.surface);
  json["feature"] = result.bore ? "bore" : "shaft";
  json["criterion"] = "probe";
  json["loss"] = to_string(result.loss);
  json["status"] = to_string(result.status);
  json["message"] = result.message;
  json["not_determined"] = result.not_determined;
  json["notes"] = result.notes;
  json["parameters"] = estimates(result.parameters);
  json["derived"] = estimates(result.derived);
  json["covariance"] = covariance_object(result);
  json["coverage_factor"] = result.coverage_factor;
  json["budget"] = budget(result);
  if (holds_on_centre_height(result)) json["radius_holds_for"] = "a probe on centre height";
  json["axis"] = axis_object(determined_axis(result));
  json["shape"] = shape_object(result);
  if (result.set_ups.size() > 1) json["set_ups"] = list_of(result.set_ups, set_up_object);
  json["rms"] = with_unit(result.rms_mm, "mm");
  json["noise"] = {{"sigma", with_unit(result.sigma_mm, "mm")},
                   {"source", to_string(result.sigma_source)},
                   {"autocorrelation", number(result.autocorrelation)},
                   {"u_factor", number(result.u_factor)}};
  if (result.widened > 1.0) json["noise"]["widened"] = result.widened;
  json["points"] = result.points;
  json["range"] = {{"min", with_unit(result.position_min_mm, "mm")},
                   {"max", with_unit(result.position_max_mm, "mm")}};
  json["rejected"] = rejected_json(result.rejected);
  json["iterations"] = result.iterations;
  return json;
}

std::string fit_json(const FitResult& result) { return json_text(fit_object(result)); }

FitResult fit_from_object(const Json& json) {
  FitResult fit;
  fit.source = json.at("input").at("file");
  fit.input_hash = json.at("input").at("hash");
  fit.surface = surface_from_id(json.at("surface").get<std::string>());
  fit.bore = json.at("feature") == "bore";
  fit.status = status_from(json.at("status"));
  fit.message = json.value("message", "");
  fit.coverage_factor = json.value("coverage_factor", 2.0);
  if (fit.status != FitStatus::converged) return fit;
  for (const auto& [name, one] : json.at("parameters").items()) {
    if (!one.at("value").is_null() || name.starts_with("radius") || name == "half_angle") continue;
    fit.status = FitStatus::implausible;
    fit.message = "the axis is not known: " + one.value("why", "");
    return fit;
  }
  const Json& axis = json.at("axis");
  fit.axis.axis = {value(axis, "x"), value(axis, "y"), value(axis, "slope_x"),
                   value(axis, "slope_y"), value(axis, "z_ref")};
  const Json& covariance = axis.at("covariance").at("matrix");
  for (std::size_t i = 0; i < 16; ++i)
    fit.axis.covariance.by_rows[i] = number_from(covariance.at(i / 4).at(i % 4));
  fit.shape = {fit.axis.axis, value(json.at("shape"), "radius"),
               value(json.at("shape"), "tan_half_angle")};
  const auto read = [](const Json& parameters, std::vector<FitParameter>& to) {
    for (const auto& [name, estimate] : parameters.items())
      to.push_back({name, estimate_from(estimate)});
  };
  for (const Json& set_up : json.value("set_ups", Json::array())) {
    fit.set_ups.emplace_back().axis.axis = axis_from_parameters(set_up.at("parameters"));
    read(set_up.at("parameters"), fit.set_ups.back().parameters);
  }
  read(json.at("parameters"), fit.parameters);
  read(json.at("derived"), fit.derived);
  fit.notes = json.at("notes").get<std::vector<std::string>>();
  fit.rms_mm = value(json, "rms");
  const Json& noise = json.at("noise");
  fit.sigma_mm = number_from(noise.at("sigma").at("value"));
  for (const SigmaSource source : {SigmaSource::residuals, SigmaSource::robust_residuals,
                                   SigmaSource::whitened_residuals, SigmaSource::sensor})
    if (noise.at("source") == to_string(source)) fit.sigma_source = source;
  fit.autocorrelation = number_from(noise.at("autocorrelation"));
  fit.u_factor = number_from(noise.at("u_factor"));
  fit.widened = noise.value("widened", 1.0);
  fit.points = json.at("points");
  fit.rejected = rejected_from(json.at("rejected"));
  fit.position_min_mm = value(json.at("range"), "min");
  fit.position_max_mm = value(json.at("range"), "max");
  return fit;
}

FitResult fit_from_json(std::string_view text, const std::string& path) {
  const auto unreadable = [&](const std::string& why) {
    return InputError(path, "cannot be read as trueaxis.fit/1 (" + why + ")");
  };
  try {
    const Json json = Json::parse(text);
    if (json.at("schema") != "trueaxis.fit/1")
      throw InputError(path, "is not a trueaxis.fit/1 file: write one with 'trueaxis fit --json'");
    const std::string status = json.at("status");
    if (status != to_string(FitStatus::converged))
      throw InputError(path,
                       "its fit is not converged (" + status + "): it cannot give a correction");
    FitResult fit = fit_from_object(json);
    for (const double covariance : fit.axis.covariance.by_rows) {
      if (!std::isfinite(covariance)) throw unreadable("its axis has no covariance");
    }
    for (const AxisRow i : {AxisRow::x, AxisRow::y, AxisRow::slope_x, AxisRow::slope_y}) {
      if (fit.axis.covariance(i, i) < 0.0)
        throw InputError(path, "has a negative variance in its axis covariance");
    }
    return fit;
  } catch (const Json::exception& error) {
    throw unreadable(error.what());
  }
}

}  // namespace trueaxis
