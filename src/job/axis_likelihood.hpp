// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "trueaxis/fit.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

/// The axis of a reference as it is compared with the others.
struct HeldAxis {
  AxisEstimate estimate;
  double z_mid_mm = 0.0;  ///< middle of the probed length
  bool plane = false;     ///< only its direction counts
  bool diameter = false;  ///< X was read as a diameter
};

/// A number that a mistake leaves open, by what it does to an axis.
enum class OpenNumber { c_zero, z_zero };
struct OpenMistake {
  std::size_t reference = 0;
  OpenNumber number = OpenNumber::c_zero;
  double value = 0.0;  ///< rad or mm
};

HeldAxis held_axis(const FitResult& fit);

/// How far two axes are apart half-way between their lengths, and how probable that is (Eq. 131).
Disagreement difference_of(const HeldAxis& first, const HeldAxis& second, double coverage_factor);

/// ln of the likelihood of the axes as those of one part, whose surfaces are as far out of a common
/// axis as parts are: 1 to 64 µm and, apart from that, 0.01 to 0.64 mrad, each scale as probable
/// (Eqs. 152, 153). Up to a constant of the references.
/// @param open what a mistake leaves open, taken at its best value: its width is paid for
double log_likelihood(std::span<const HeldAxis> axes, std::optional<OpenMistake> open = {});

/// The same of axes of which each is of another clamping: 1 mm and 10 mrad apart.
double log_likelihood_clamped_anew(std::span<const HeldAxis> axes);

}  // namespace trueaxis
