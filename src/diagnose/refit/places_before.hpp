// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "diagnose/geometry/hypothesis.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::diagnose_detail {

/// Where a part was before every step at once among some terms, first of all before the first: the
/// inverse of Eq. 46 on the axis of every clamping.
/// @param found sizes of all terms, term after term @param after where the part is in the end
std::vector<Clamping> places_before(const LinearisationPoint& point,
                                    std::span<const Hypothesis> terms, const Eigen::VectorXd& found,
                                    const std::vector<Clamping>& after);

/// Whether a term is a step.
bool is_slip(const Hypothesis& h);

/// Whether a term is a step at once: one that takes its time has no two places.
bool is_step_at_once(const Hypothesis& h);

}  // namespace trueaxis::diagnose_detail
