// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace trueaxis {

/// A surface of revolution of one's own: the radius over the height along an axis, with up to
/// `most` parameters. fit() associates it with a stream together with its axis, so the result
/// has x0, y0, l, m and then the profile's parameters:
///
///     FitOptions options;
///     options.profile = std::make_shared<Barrel>();  // examples/own_surface.cpp
///     const FitResult result = fit(stream, options);
///
/// The radius must be smooth (Newton's method follows it along the probe line) and the readings
/// absolute contact points: no relative gauge and no ball. Diagnosis and correction know the
/// surfaces of the catalogue only.
class RevolvedProfile {
 public:
  static constexpr std::size_t most = 4;

  struct Parameter {
    std::string name;
    std::string unit;        ///< as the result prints it
    double start = 0.0;      ///< where the association starts
    double length_mm = 1.0;  ///< what one unit moves the surface by, roughly: for the conditioning
  };
  /// The radius and its derivatives.
  struct Radius {
    double mm = 0.0;
    double per_height = 0.0;  ///< mm per mm
    std::array<double, most> per_parameter{};
  };

  virtual ~RevolvedProfile() = default;
  virtual std::vector<Parameter> parameters() const = 0;
  /// At a height along the axis, mm from where the axis pierces the plane Z = 0.
  virtual Radius radius(double height_mm, std::span<const double> parameters) const = 0;
};

}  // namespace trueaxis
