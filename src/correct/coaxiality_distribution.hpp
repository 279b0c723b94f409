// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "trueaxis/correction.hpp"

namespace trueaxis {

/// What the coaxiality of the worst reference with the cut part may be, given that each reference's
/// axis is known as its covariance says: propagation of the distributions (JCGM 101) of
/// 2 max |m(Z) + e(Z)| over both ends of the cut and all references (Eq. 119). The squared length
/// is a quadratic form in correlated components, so that no factor of u gives its quantiles: with
/// nothing left by the compromise (m = 0) and equal components it is Rayleigh's, 95 % at 2.45 u.
class CoaxialityDistribution {
 public:
  /// @param target the axis that is cut about: a number once it is in the table
  CoaxialityDistribution(std::span<const Reference> references, const Axis& target,
                         double z_start_mm, double z_end_mm);

  /// mm; NaN when a reference has no uncertainty. @param probability in (0, 1)
  double quantile(double probability) const;
  /// Probability that the coaxiality is at most this; NaN as above.
  double within(double coaxiality_mm) const;

 private:
  std::vector<double> sorted_mm_;
};

}  // namespace trueaxis
