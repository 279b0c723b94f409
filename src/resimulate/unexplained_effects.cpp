// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "resimulate/finding_effects.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using virtual_lathe::Effect;

/// A pattern as the file has it.
struct WrittenPattern {
  explicit WrittenPattern(const Json& json)
      : order(json.at("order")),
        degree(json.at("degree")),
        frequency_per_mm(inside_value(json.at("z_frequency"))),
        along_time(json.at("along") == "time"),
        in_spindle(json.at("frame") == "spindle"),
        harmonic(json.at("harmonic")),
        dependence(json.at("dependence")) {
    const Json& factors = json.at("linear");
    if (factors.empty()) throw InputError("diagnosis", "an unexplained pattern has no factors");
    first = inside_value(factors.at(0));
    wave = Wave::of(first, factors.size() > 1 ? inside_value(factors.at(1)) : 0.0);
  }

  std::map<std::string, double> parameters() const {
    return {{"order", order}, {"amplitude_mm", wave.amplitude}, {"phase_rad", wave.phase_rad}};
  }

  double order;
  int degree;
  double frequency_per_mm;
  bool along_time, in_spindle;
  std::string harmonic, dependence;
  double first = 0.0;
  Wave wave;
};

/// Place and size of a local form stand in its description only.
Effect bump(const WrittenPattern& of) {
  double angle = 0.0, width = 0.0, position = 0.0, length = 0.0;
  const int read = std::sscanf(of.dependence.c_str(), "at %lf° (± %lf°), Z %lf mm (± %lf mm)",
                               &angle, &width, &position, &length);
  if (read < 2 || !(width > 0.0))
    throw InputError("diagnosis", "a local form without its place: `" + of.dependence + "`");
  return {"extra.bump",
          {{"amplitude_mm", of.first},
           {"angle_rad", angle * rad_per_deg},
           {"width_rad", width * rad_per_deg},
           {"position_mm", position},
           {"length_mm", length}}};
}

Effect line(const WrittenPattern& of) {
  std::map<std::string, double> parameters = of.parameters();
  if (!of.along_time) {
    if (of.frequency_per_mm == 0.0) return {"extra.form_cell", parameters};
    parameters["period_mm"] = 1.0 / of.frequency_per_mm;
    return {"extra.form_line", parameters};
  }
  double frequency_hz = 0.0;  // as a bump's place
  if (std::sscanf(of.dependence.c_str(), "turning with %lf Hz", &frequency_hz) != 1)
    throw InputError("diagnosis", "a line in time without its frequency: `" + of.dependence + "`");
  parameters["frequency_hz"] = frequency_hz;
  return {"extra.motion_line", parameters};
}

Effect cell(const WrittenPattern& of, const DiagnosisFrame& frame) {
  std::map<std::string, double> parameters = of.parameters();
  parameters["degree"] = of.degree;
  if (!of.along_time) return {of.in_spindle ? "extra.motion_cell" : "extra.form_cell", parameters};
  if (!of.in_spindle)
    throw InputError("diagnosis", "a form of the part that changes with time has no place");
  parameters["start_s"] = frame.time_start_s;
  parameters["end_s"] = frame.time_end_s;
  return {"extra.motion_time_cell", parameters};
}

}  // namespace

Effect effect_of_unexplained(const Json& unexplained, const DiagnosisFrame& frame) {
  const WrittenPattern pattern(unexplained);
  if (pattern.harmonic == "local form") return bump(pattern);
  return pattern.degree < 0 ? line(pattern) : cell(pattern, frame);
}

}  // namespace trueaxis
