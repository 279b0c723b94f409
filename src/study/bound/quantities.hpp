// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trueaxis/fit.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::study {

/// What is compared with the truth: the surface's parameters as they are reported (edge units). For
/// a cone or cylinder also where its axis runs at both ends of the probed length (x_at_min_z …) and
/// the radius in its middle (a cone's radius_mid).
struct Quantity {
  std::string name, unit;
};
std::vector<Quantity> quantities(SurfaceKind surface);

/// Surface of the catalogue that a part is.
SurfaceKind surface_of(virtual_lathe::PartKind kind);

/// Lowest and highest position of the readings since the part was last moved.
struct Probed {
  double low_mm = 0.0, high_mm = 0.0;
  double end_s = 0.0;  ///< of the last of them
};
Probed probed_length(const ProbeStream& stream);

/// For the part as it is in the set-up of the highest number, in the order of quantities(); NaN
/// where there is none (the apex of a cone of half angle 0). A section lies in the middle of
/// `probed`.
std::vector<double> true_values(const virtual_lathe::Scenario& scenario, const Probed& probed,
                                SurfaceKind surface);

/// The same of a fit, with standard uncertainties; NaN where the fit withholds a number.
struct Estimated {
  std::vector<double> value, u;
};
Estimated estimated(const FitResult& fit);

}  // namespace trueaxis::study
