// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/geometry/hypothesis.hpp"
#include "diagnose/geometry/linearisation_point.hpp"

namespace trueaxis::diagnose_detail {

bool is_lag(const Hypothesis& h);
bool is_delay(const Hypothesis& h);

/// What a lag or a delay does to X, one a reading, mm. In C the surface is one harmonic, which a
/// delay turns and a lag turns and makes smaller (Eq. 52); both in all orders. Along Z both are
/// late by as much.
std::vector<double> timing_mm(const Hypothesis& h, double seconds, const LinearisationPoint& point);

}  // namespace trueaxis::diagnose_detail
