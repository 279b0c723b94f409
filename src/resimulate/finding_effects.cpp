// SPDX-License-Identifier: Apache-2.0
#include "resimulate/finding_effects.hpp"

#include <cmath>
#include <map>
#include <string_view>

#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using virtual_lathe::Effect;
using Effects = std::vector<Effect>;

/// A term of the file: what it is linear in, and its shape.
class WrittenTerm {
 public:
  explicit WrittenTerm(const Json& term) : shape_(term.at("shape")) {
    for (const Json& entry : term.at("linear")) linear_[entry.at("name")] = inside_value(entry);
  }

  double linear(const std::string& name) const {
    const auto found = linear_.find(name);
    if (found == linear_.end()) throw InputError("diagnosis", "a term has no `" + name + "`");
    return found->second;
  }
  /// c cos + s sin.
  Wave wave(const std::string& of = "amplitude") const {
    return Wave::of(linear(of + "_cos"), linear(of + "_sin"));
  }
  /// The same with the phase added: a cos(angle + phase).
  Wave advanced() const { return Wave::of(linear("amplitude_cos"), -linear("amplitude_sin")); }
  double shape(const char* name) const { return inside_value(shape_.at(name)); }

 private:
  std::map<std::string, double> linear_;
  const Json& shape_;
};

using Translate = Effects (*)(const std::string& id, const WrittenTerm& of,
                              const DiagnosisFrame& frame);

Effects roundness(const std::string& id, const WrittenTerm& of, const DiagnosisFrame&) {
  const Wave constant = of.wave(), growth = of.wave("growth");
  const double order = of.shape("order");
  return {
      {id,
       {{"order", order}, {"amplitude_mm", constant.amplitude}, {"phase_rad", constant.phase_rad}}},
      {id,
       {{"order", order},
        {"amplitude_mm", 0.0},
        {"growth_mm", growth.amplitude},
        {"phase_rad", growth.phase_rad}}}};
}

Effects chuck_lobing(const std::string&, const WrittenTerm& of, const DiagnosisFrame&) {
  const auto harmonic = [&](double order, const Wave& wave) {
    return Effect{"extra.jaw_harmonic",
                  {{"order", order},
                   {"amplitude_mm", wave.amplitude},
                   {"phase_rad", wave.phase_rad},
                   {"decay_length_mm", of.shape("decay_length")},
                   {"jaw_position_mm", of.shape("lever_from")}}};
  };
  const double jaws = of.shape("order");
  return {harmonic(jaws, of.wave()), harmonic(2.0 * jaws, of.wave("second"))};
}

Effects bow(const std::string& id, const WrittenTerm& of, const DiagnosisFrame& frame) {
  const Wave wave = of.wave();
  return {{id,
           {{"sagitta_mm", wave.amplitude},
            {"length_mm", 2.0 * frame.z_half_mm},
            {"middle_mm", frame.z_mid_mm},
            {"direction_rad", wave.phase_rad}}}};
}

Effects slip(const std::string& id, const WrittenTerm& of, const DiagnosisFrame&) {
  return {{id,
           {{"time_s", of.shape("onset")},
            {"dx_mm", of.linear("dx")},
            {"dy_mm", of.linear("dy")},
            {"turn_rad", of.linear("turn")}}}};
}

Effects synchronous(const std::string& id, const WrittenTerm& of, const DiagnosisFrame&) {
  const Wave wave = of.wave();
  return {{id,
           {{"order", of.shape("order")},
            {"amplitude_mm", wave.amplitude},
            {"phase_rad", wave.phase_rad}}}};
}

Effects spindle_tilt(const std::string& id, const WrittenTerm& of, const DiagnosisFrame&) {
  const Wave wave = of.wave();
  return {{id,
           {{"order", of.shape("order")},
            {"amplitude_rad", wave.amplitude},
            {"phase_rad", wave.phase_rad},
            {"bearing_mm", of.shape("lever_from")}}}};
}

Effects encoder_eccentricity(const std::string& id, const WrittenTerm& of, const DiagnosisFrame&) {
  const Wave wave = of.wave();
  return {{id, {{"amplitude_rad", wave.amplitude}, {"phase_rad", wave.phase_rad}}}};
}

/// a cos(k x + phase) with the period under the lathe's name for it.
template <const char* const& shape, const char* const& name>
Effects periodic(const std::string& id, const WrittenTerm& of, const DiagnosisFrame&) {
  const Wave wave = of.advanced();
  return {
      {id,
       {{name, of.shape(shape)}, {"amplitude_mm", wave.amplitude}, {"phase_rad", wave.phase_rad}}}};
}

constexpr const char* order = "order";
constexpr const char* period = "period";
constexpr const char* frequency = "frequency";
constexpr const char* wavelength_mm = "wavelength_mm";
constexpr const char* feed_mm_per_rev = "feed_mm_per_rev";
constexpr const char* pitch_mm = "pitch_mm";
constexpr const char* period_mm = "period_mm";
constexpr const char* frequency_hz = "frequency_hz";

Effects straightness(const std::string& id, const WrittenTerm& of, const DiagnosisFrame&) {
  Effects list;
  const int last = static_cast<int>(std::lround(of.shape("degree")));
  for (int degree = 2; degree <= last; ++degree) {
    list.push_back(
        {id,
         {{"degree", degree}, {"amplitude_mm", of.linear("amplitude_" + std::to_string(degree))}}});
  }
  return list;
}

Effects barrel(const std::string& id, const WrittenTerm& of, const DiagnosisFrame&) {
  return {
      {id, {{"amplitude_mm", of.linear("amplitude_2")}, {"cubic_mm", of.linear("amplitude_3")}}}};
}

Effects gain(const std::string& id, const WrittenTerm& of, const DiagnosisFrame&) {
  return {{id, {{"gain", of.linear("gain")}, {"reference_mm", of.shape("reference_x")}}}};
}

Effects nonlinearity(const std::string& id, const WrittenTerm& of, const DiagnosisFrame&) {
  return {{id,
           {{"quadratic_mm", of.linear("quadratic")},
            {"cubic_mm", of.linear("cubic")},
            {"reference_mm", of.shape("reference_x")},
            {"range_mm", of.shape("range")}}}};
}

Effects pretravel(const std::string& id, const WrittenTerm& of, const DiagnosisFrame&) {
  const Wave lobing = of.wave("lobing");
  return {{id,
           {{"amplitude_mm", of.linear("amplitude")},
            {"lobing_mm", lobing.amplitude},
            {"order", of.shape("order")},
            {"phase_rad", lobing.phase_rad}}}};
}

Effects drift(const std::string& id, const WrittenTerm& of, const DiagnosisFrame&) {
  return {{id,
           {{"rate_mm_per_s", of.linear("rate")},
            {"amplitude_mm", of.linear("amplitude")},
            {"time_constant_s", of.shape("time_constant")}}}};
}

Effects backlash(const std::string& id, const WrittenTerm& of, const DiagnosisFrame&) {
  return {{id, {{"along_mm", of.linear("along")}, {"across_mm", of.linear("across")}}}};
}

/// One number under the lathe's name for it.
template <const char* const& written, const char* const& name>
Effects single(const std::string& id, const WrittenTerm& of, const DiagnosisFrame&) {
  return {{id, {{name, of.linear(written)}}}};
}

constexpr const char* amplitude_1 = "amplitude_1";
constexpr const char* amplitude_mm = "amplitude_mm";
constexpr const char* slope = "slope";
constexpr const char* slope_rad = "slope_rad";
constexpr const char* height = "height";
constexpr const char* height_mm = "height_mm";
constexpr const char* tilt = "tilt";
constexpr const char* angle = "angle";
constexpr const char* angle_rad = "angle_rad";
constexpr const char* radius = "radius";
constexpr const char* radius_mm = "radius_mm";
constexpr const char* delay = "delay";
constexpr const char* delay_s = "delay_s";
constexpr const char* time_constant = "time_constant";
constexpr const char* time_constant_s = "time_constant_s";

constexpr std::pair<std::string_view, Translate> translations[] = {
    {"part.chuck_lobing", chuck_lobing},
    {"part.roundness", roundness},
    {"part.barrel", barrel},
    {"part.taper", single<amplitude_1, amplitude_mm>},
    {"part.waviness", periodic<period, wavelength_mm>},
    {"part.feed_marks", periodic<period, feed_mm_per_rev>},
    {"part.bow", bow},
    {"part.slip", slip},
    {"spindle.radial_synchronous", synchronous},
    {"spindle.tilt_synchronous", spindle_tilt},
    {"spindle.axial_synchronous", synchronous},
    {"spindle.asynchronous", periodic<order, order>},
    {"slide.z_straightness", straightness},
    {"slide.xz_parallelism", single<slope, slope_rad>},
    {"slide.leadscrew_periodic", periodic<period, pitch_mm>},
    {"slide.backlash", backlash},
    {"probe.height", single<height, height_mm>},
    {"probe.tilt", single<tilt, angle_rad>},
    {"probe.gain", gain},
    {"probe.nonlinearity", nonlinearity},
    {"probe.cyclic", periodic<period, period_mm>},
    {"probe.ball_radius", single<radius, radius_mm>},
    {"probe.pretravel", pretravel},
    {"probe.latency", single<delay, delay_s>},
    {"probe.lag", single<time_constant, time_constant_s>},
    {"encoder.offset", single<angle, angle_rad>},
    {"encoder.eccentricity", encoder_eccentricity},
    {"thermal.drift", drift},
    {"environment.vibration", periodic<frequency, frequency_hz>},
};

}  // namespace

double inside_value(const Json& quantity) {
  const double value = quantity.at("value");
  const std::string unit = quantity.at("unit");
  if (unit == "deg") return value * rad_per_deg;
  return value;
}

Wave Wave::of(double c, double s) { return {std::hypot(c, s), std::atan2(s, c)}; }

Effects effects_of_finding(const Json& finding, const DiagnosisFrame& frame) {
  const std::string id = finding.at("effect");
  for (const auto& [known, translate] : translations) {
    if (known == id) return translate(id, WrittenTerm(finding.at("term")), frame);
  }
  throw InputError("diagnosis", "the virtual lathe has no `" + id + "`");
}

}  // namespace trueaxis
