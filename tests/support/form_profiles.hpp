// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>

#include "trueaxis/form.hpp"

/// Streams of parts whose form is known by analysis.
namespace trueaxis::testing {

/// Distance from the spindle axis at an angle and a Z.
using PartShape = std::function<double(double angle_rad, double z_mm)>;

/// Sections of `readings` even readings at each Z; Z = NaN: a stream without Z.
inline ProbeStream part_stream(const PartShape& shape, std::size_t readings,
                               const std::vector<double>& z_mm) {
  ProbeStream stream;
  stream.source = "part";
  for (std::size_t section = 0; section < z_mm.size(); ++section)
    for (std::size_t i = 0; i < readings; ++i) {
      const double z = z_mm[section];
      const double angle = two_pi * static_cast<double>(i) / static_cast<double>(readings);
      stream.c_rad.push_back(angle + two_pi * static_cast<double>(section));
      stream.reading_mm.push_back(shape(angle, std::isnan(z) ? 0.0 : z));
      if (!std::isnan(z)) stream.position_mm.push_back(z);
    }
  return stream;
}

inline ProbeStream section_stream(const std::function<double(double)>& shape,
                                  std::size_t readings) {
  return part_stream([&](double angle, double) { return shape(angle); }, readings, {NAN});
}

/// A circle of radius R about (e, 0) met from the origin.
inline double eccentric(double radius_mm, double e_mm, double angle_rad) {
  const double across = e_mm * std::sin(angle_rad);
  return e_mm * std::cos(angle_rad) + std::sqrt(radius_mm * radius_mm - across * across);
}

inline const FormValue& value_of(const std::vector<FormValue>& values, const std::string& name,
                                 const std::string& reference = "") {
  for (const FormValue& one : values)
    if (one.name == name && (reference.empty() || one.reference == reference)) return one;
  throw std::out_of_range(name);
}

inline const std::vector<FormValue>& group_of(const FormResult& result, const std::string& name) {
  for (const FormGroup& group : result.groups)
    if (group.name == name) return group.values;
  throw std::out_of_range(name);
}

/// Few trials: for tests of values, not of U.
inline FormOptions quick(ProfileFilter filter = ProfileFilter::none, double high_upr = 50.0) {
  FormOptions options;
  options.filter = filter;
  options.high_upr = high_upr;
  options.trials = 10;
  return options;
}

}  // namespace trueaxis::testing
