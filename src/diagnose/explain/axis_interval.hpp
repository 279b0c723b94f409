// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/explain/averaged_axis.hpp"

namespace trueaxis::diagnose_detail {

/// Scales what the causes add so that 2 u is the 95.45 % interval of the mixture about its mean
/// (Eq. 95c). It is that in the worse direction of the axis at the worse end. Few of the causes
/// that are not seen are present, and few of those are large, so that 2 standard deviations hold
/// more or less.
void set_interval(const LinearisationPoint& point, AveragedAxis& average);

/// What u of the axis comes from, the largest share first.
std::vector<AxisLimit> limits_of(const LinearisationPoint& point, const AveragedAxis& average);

}  // namespace trueaxis::diagnose_detail
