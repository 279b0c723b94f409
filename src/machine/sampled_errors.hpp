// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "trueaxis/machine.hpp"

namespace trueaxis {

/// The component errors of an axis as a table that others read: linear between the positions.
struct SampledErrors {
  AxisName axis = AxisName::X;
  std::vector<double> positions;              ///< mm or rad, ascending
  std::array<std::vector<double>, 6> values;  ///< EXK EYK EZK EAK EBK ECK; empty: none of it

  bool operator==(const SampledErrors&) const = default;
};

/// Every axis that has component errors, in the order X … C, with the sign asked for: where it is
/// not the model's own, E of an axis of the workpiece is inverted at every position, exactly. Such
/// tables have no pivot: E of a linear axis is about the origin of M. The positions are those of
/// the tables, and for anything that is not a table `points` over the limits of the axis. A rotary
/// axis without limits has one turn, if its errors repeat every turn. Positions go as far as the
/// errors are known. @throws InputError for an axis without either whose errors are not tables.
std::vector<SampledErrors> sample_components(const Machine& machine, const ErrorModel& errors,
                                             ErrorSign sign, int points);

/// What such a table cannot state: beyond which positions its errors are not known.
std::vector<std::string> where_known(const Machine& machine, const ErrorModel& errors);

/// How far such tables, linear between their positions, are off the errors at most.
struct SamplingLoss {
  double length_mm = 0.0, angle_rad = 0.0;
};
SamplingLoss sampling_loss(const Machine& machine, const ErrorModel& errors, ErrorSign sign,
                           int points);

/// The sum of the constants of a location error; 0 where there is none.
double location_value(const ErrorModel& errors, const ErrorName& name);

}  // namespace trueaxis
