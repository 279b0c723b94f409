// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "machine/uncertainty.hpp"

namespace trueaxis::calibrate_detail {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A number of the machine that is estimated: it multiplies `unit` in the errors.
struct Unknown {
  std::string name;
  ErrorTerm unit;                                                    ///< of size 1 mm or 1 rad
  double largest = 0.0;                                              ///< plausible size
  double step() const { return unit.name.angular() ? 1e-5 : 1e-3; }  ///< of a difference
};

ErrorFunction scaled(const ErrorFunction& function, double factor);

/// Every location error of the axes that has an effect, X0S Y0S Z0S, A0S and B0S. If the data
/// cannot tell two apart, the later one is held: lines of the rotary axes come first, then
/// squareness (X is the reference, as ISO 230-1 has it), zeros, the spindle.
std::vector<Unknown> location_unknowns(const Machine& machine, double largest_length_mm,
                                       double largest_angle_rad);

/// `given` and what was found of each unknown, without zeros.
ErrorModel with(const ErrorModel& given, const std::vector<Unknown>& unknowns,
                const VectorXd& values);

}  // namespace trueaxis::calibrate_detail
