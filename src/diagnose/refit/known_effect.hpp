// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "trueaxis/effect.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis {

/// An effect of the catalogue whose shape is known: nothing is searched for.
struct KnownEffect {
  std::string effect;             ///< id
  TermShape shape;                ///< of its term
  std::vector<std::size_t> free;  ///< which linear parameters are fitted; empty: all
};

/// x and y of the axis at the lowest and at the highest probed Z, mm.
using AxisEnds = std::array<double, 4>;
AxisEnds ends_of(const FitResult& fit);

/// What an effect does to the axis of a lateral surface if it is not modelled, and if it is.
struct EffectOnAxis {
  FitResult alone;  ///< the surface fitted as if there were no effect
  /// Of `alone` after one more linear step: the fit stops where a step is worth 1e-9 of its cost,
  /// which here is the effect and not noise.
  AxisEnds alone_ends{};
  FitResult extended;  ///< surface and effect fitted together; u: of the joint covariance
  /// First order: how the axis of `alone` moves per unit of each free linear parameter, about the
  /// surface as it was found: (JᵀJ)⁻¹Jᵀ of the effect's column.
  std::vector<AxisEnds> shift_per_unit;
  std::vector<double> linear;  ///< free linear parameters as fitted; mm, rad, s
  double left = 0.0;           ///< share of the effect's columns that the surface leaves, RMS
  bool separable = false;      ///< whether the readings determine surface and effect together
  /// Standard uncertainty of the axis with the effect fitted over that without (white noise): what
  /// the larger model costs.
  double u_ratio = 0.0;
  double z_mid_mm = 0.0, z_half_mm = 1.0;  ///< of the terms: u = (s − z_mid)/z_half, ±1 at the ends
  double sensed_mid_mm = 0.0;  ///< middle of what the sensor meets of the surface, outwards
  double indication_mm = 0.0;  ///< mean of reading less X of the surface: minus a gauge's zero
};

/// Eq. 128.
/// @throws InputError as fit() does, ContractViolation for an unknown effect, a check, or a face.
EffectOnAxis effect_on_axis(const ProbeStream& stream, const FitOptions& options,
                            const KnownEffect& known);

}  // namespace trueaxis
