// SPDX-License-Identifier: Apache-2.0

#include "calibrate/files/calibration_files.hpp"
#include "calibrate/files/edge_json.hpp"

namespace trueaxis {
namespace {

Json covariance_json(const Calibration& c) {
  const auto name = [](const CalibratedParameter& one) { return one.name; };
  const auto factor = [&](std::size_t i) { return edge_factor(c.parameters[i].estimate.unit); };
  const auto value = [&](std::size_t i, std::size_t j) {
    return factor(i) * factor(j) * c.covariance(i, j);
  };
  return {{"parameters", list_of(c.parameters, name)},
          {"unit", "mm and deg"},
          {"matrix", square_json(c.parameters.size(), value)}};
}

/// u and, of it, what noise alone would leave.
Json calibrated_json(const std::vector<CalibratedParameter>& parameters) {
  Json json = parameters_json(parameters);
  for (const CalibratedParameter& one : parameters)
    if (one.u_noise > 0.0)
      json[one.name]["u_noise"] = number(one.u_noise * edge_factor(one.estimate.unit));
  return json;
}

Json components_json(const Calibration& c) {
  Json json = Json::object();
  for (const CalibratedComponent& one : c.components) {
    Json& entry = json[one.name] = to_json(one.rms);
    entry["rms"] = entry["value"];
    entry.erase("value");
    entry["plausible"] = number(one.plausible * edge_factor(one.rms.unit));
    entry["shown"] = one.shown;
    entry["beyond"] = one.beyond;
  }
  return json;
}

Json ball_json(const PlacedBall& ball, const Calibration& c) {
  Json json{{"file", c.sources[ball.file]}, {"setup", ball.setup}};
  if (ball.ball != 0) json["ball"] = ball.ball;
  json["centre"] = {{"value", ball.centre_mm}, {"unit", "mm"}};
  if (ball.ball == 0) json["direction"] = ball.direction;
  return json;
}

Json read_out_json(const AxisReadOut& one) {
  const bool rotary = is_rotary(one.axis);
  const double factor = rotary ? 1.0 / rad_per_deg : 1.0;
  const char* const unit = rotary ? "deg" : "mm";
  const auto order_json = [&](const AxisReadOut::Order& order) -> Json {
    return {{"order", order.order},
            {"amplitude", with_unit(factor * order.amplitude(), unit)},
            {"cos", to_json(order.cos)},
            {"sin", to_json(order.sin)}};
  };
  const auto coefficient = [](const Estimate& of) { return to_json(of); };
  return {{"axis", std::string(1, letter_of(one.axis))},
          {"readings", one.readings},
          {"range", {{"low", factor * one.low}, {"high", factor * one.high}, {"unit", unit}}},
          {"period", one.period > 0.0 ? with_unit(factor * one.period, unit) : Json(nullptr)},
          {"orders", list_of(one.orders, order_json)},
          {"legendre", list_of(one.polynomial, coefficient)},
          {"reversal_value", one.reversal ? to_json(*one.reversal) : Json(nullptr)},
          {"rms_before", with_unit(factor * one.rms_before, unit)},
          {"rms_after", with_unit(factor * one.rms_after, unit)},
          {"noise", with_unit(factor * one.noise, unit)}};
}

/// Of a calibration that has one: read-outs of rotary axes alone have theirs each.
Json overall(const Calibration& c, double value_mm) {
  return c.noise_basis == NoiseBasis::none ? Json(nullptr) : with_unit(value_mm, "mm");
}

}  // namespace

std::string calibration_json(const Calibration& c, const Machine& machine,
                             const std::vector<std::string>& remarks) {
  const auto ball = [&](const PlacedBall& one) { return ball_json(one, c); };
  return json_text(
      {{"schema", "trueaxis.calibration/1"},
       {"version", TRUEAXIS_VERSION},
       {"machine", machine.name},
       {"inputs", inputs_json(c)},
       {"converged", c.converged},
       {"parameters", calibrated_json(c.parameters)},
       {"not_determined", not_determined_json(c)},
       {"gauge", c.gauge},
       {"remarks", remarks},
       {"covariance", covariance_json(c)},
       {"component_errors", components_json(c)},
       {"balls", list_of(c.balls, ball)},
       {"equations", c.equations},
       {"unknowns", c.unknowns},
       {"rms", {{"before", overall(c, c.rms_before_mm)}, {"after", overall(c, c.rms_after_mm)}}},
       {"noise", {{"sigma", overall(c, c.noise_mm)}, {"source", to_string(c.noise_basis)}}},
       {"read_outs", list_of(c.read_outs, read_out_json)}});
}

}  // namespace trueaxis
