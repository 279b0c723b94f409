// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "diagnose/refit/known_effect.hpp"
#include "trueaxis/virtual_lathe.hpp"

/// What an effect that is not in the model costs: the bias of the identified axis per unit of it.
namespace trueaxis::study {

/// One way in which an effect can lie, per unit of its size.
struct AxisBiasDirection {
  std::vector<double> linear;  ///< the model's free linear parameters
  /// What of the effect is no more than another place of the part: moves the axis, and is in no
  /// column. The axis with the effect fitted is that of the part so moved.
  AxisEnds rigid{};
  /// The lathe's effect of a size, where it is another than that of the term (see lathe_effects).
  std::function<virtual_lathe::Effect(double size)> lathe{};
};

/// An effect of the catalogue in one form, at a size that is small enough for its second order.
struct AxisBiasCase {
  std::string effect, form;  ///< "part.roundness", "ovality"
  KnownEffect known;
  /// Two of an effect with a phase or direction: the bias is then that of the worst phase.
  std::vector<AxisBiasDirection> directions;
  double size = 1e-3;              ///< mm, rad, s or 1
  std::string unit = "mm";         ///< at the edge: mm, deg, s or 1
  double edge = 1.0;               ///< edge value of one inside unit
  std::optional<double> stated{};  ///< what the catalogue says, mm per edge unit
};

/// Largest distance of the axis over the probed length in the worst phase, mm per edge unit.
struct AxisBiasRow {
  AxisBiasCase of;
  double lathe = 0.0;         ///< simulated at the size, the surface fitted alone
  double lathe_half = 0.0;    ///< at half the size
  double limit = 0.0;         ///< 2 × half − whole: the second order cancels, the third remains
  double predicted = 0.0;     ///< the effect's column projected on the surface's columns
  double second_order = 0.0;  ///< between whole and half; as much is left between half and limit
  double off = 0.0;           ///< between limit and prediction
  double off_whole = 0.0, off_half = 0.0;  ///< between lathe and prediction at both sizes
  double rounding = 0.0;                   ///< of all these
  bool agrees = false;                     ///< off ≤ second_order + rounding
  double left = 0.0;                       ///< share of the effect that the surface leaves
  bool separable = false;                  ///< whether surface and effect can be fitted together
  double u_ratio = 0.0;                    ///< u(axis) with the effect fitted over that without
  double extended = 0.0, extended_half = 0.0;  ///< bias with the effect fitted, at both sizes
};

/// Fits noise-free readings of the virtual lathe. The scenario's noise and effects are not used.
/// Eq. 129.
/// @throws InputError when the part cannot be probed, the surface not be fitted, or the axis moves
/// between set-ups of one clamping.
AxisBiasRow axis_bias_of(const virtual_lathe::Scenario& scenario, const AxisBiasCase& of);

}  // namespace trueaxis::study
