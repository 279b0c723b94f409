// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "calibrate/estimate/geometry.hpp"
#include "calibrate/estimate/random_effects.hpp"

namespace trueaxis::calibrate_detail {

/// A component error as a sum of amounts. Its RMS over the axis' travel is log-normal about
/// `plausible` (Eq. 210).
struct PlausibleError {
  ErrorName name;
  double plausible = 0.0;  ///< mm or rad
  std::vector<UncertainAmount> amounts;
  std::vector<double> shares;  ///< of the mean square of the error, over that of the amount: Var/s²
  std::size_t group = 0;       ///< of those that share a size
};

/// The assumed sizes of component errors before anything is measured: the medians of machining
/// centres in good order, chosen, and the factor within which two in three lie.
struct PlausibleSizes {
  double linear_length_mm = 3e-3;   ///< position and straightness of a linear axis over its travel
  double linear_angle_rad = 12e-6;  ///< its roll, pitch and yaw
  double rotary_length_mm = 2e-3;   ///< radial and axial motion of a rotary axis
  double rotary_angle_rad = 12e-6;  ///< its tilt and its position
  double location_length_mm = 20e-3, location_angle_rad = 50e-6;  ///< of location errors
  double factor = 2.0;

  double of(bool rotary, bool angular) const {
    return rotary ? (angular ? rotary_angle_rad : rotary_length_mm)
                  : (angular ? linear_angle_rad : linear_length_mm);
  }
};

/// The component errors of every axis that `known` does not name: Legendre polynomials over the
/// travel of a linear axis up to degree 3 (of straightness from 2 on: degree 1 is squareness),
/// harmonics 1 to 4 of a rotary one. Amounts fall off as the order. @param polynomials errors of
/// rotary axes that may as well be a polynomial over what was read: half of the variance is that of
/// degrees 1 to 3
std::vector<PlausibleError> plausible_errors(const Problem& problem,
                                             const std::vector<ErrorName>& known,
                                             const std::vector<ErrorName>& polynomials = {},
                                             const PlausibleSizes& sizes = {});

/// Groups of random columns that share a size: an error each, but the two directions across a
/// rotary axis together. Its sizes are then the same in whichever directions X and Y are laid.
std::vector<RandomGroup> groups_of(std::vector<PlausibleError>& errors);

/// Columns of the readings per mm or rad of every amount, each of a component error.
MatrixXd amount_columns(const Problem& problem, const Geometry& geometry,
                        const std::vector<UncertainAmount>& amounts);

/// Mean square of an amount's function over its range.
double mean_square(const UncertainAmount& amount);

}  // namespace trueaxis::calibrate_detail
