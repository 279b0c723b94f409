// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "trueaxis/surface/axis.hpp"

namespace trueaxis {

/// One reference surface as the target axis sees it.
struct Reference {
  std::string name;
  AxisEstimate axis;
  double weight = 1.0;
  double face_radius_mm = 0.0;  ///< > 0: a plane; only its tilt counts, × this radius
};

/// What is left at one reference when the part is cut about the target axis.
struct Remainder {
  std::string name;
  double offset_start_mm = 0.0,
         offset_end_mm = 0.0;  ///< distance of the axes at both ends of the cut
  double tilt_rad = 0.0;
  double coaxiality_mm = 0.0;  ///< ISO 1101: a diameter; for a plane the axial run-out 2 R tilt
  /// Of the part cut about the target axis: the target is a number by then, so it is the reference
  /// that is known no better than this (twice its u at the worse end, in the worse direction).
  double u_coaxiality_mm = 0.0;
};

struct TargetAxis {
  AxisEstimate axis;
  std::vector<Remainder> remainders;
};

/// The axis that minimises Σ w_i ∫ |Δ_i(Z)|² dZ over [z_start, z_end] (key idea 4 of Constantin et
/// al.), Δ_i the vector from reference axis i; a plane enters as tilt × face radius. Closed form.
/// @throws Refusal if the references leave it open (planes alone fix no position).
/// A face asks for a direction only: with `needs_position` false, planes alone are enough and the
/// axis then passes the spindle axis at mid length.
TargetAxis solve_target_axis(std::span<const Reference> references, double z_start_mm,
                             double z_end_mm, bool needs_position = true);

/// ISO 1101 coaxiality of `toleranced` over [z_start, z_end] with `datum` as the datum axis: a
/// diameter, mm.
double coaxiality_mm(const Axis& toleranced, const Axis& datum, double z_start_mm, double z_end_mm);

}  // namespace trueaxis
