// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "blind/blind_case.hpp"

namespace trueaxis::blind {

/// The share of cases that docs/evidence/blind_study.md wants right.
double goal(Kind kind, PlanId plan);

/// The share of recommended measurements, taken in the virtual lathe, that resolve the class (issue
/// 3).
inline constexpr double advice_goal = 0.90;

/// A class member may be this far, in σ, from the truth: Φ(d/2) = 0.95.
inline constexpr double demanded_distance = 3.29;

/// The engine may also keep a rival cause that its second rule, the likelihood ratio of the data,
/// cannot exclude; beyond Φ(d/2) = 0.9995 no data leave that open.
inline constexpr double allowed_distance = 6.6;

/// A test fails if so few right ones have less than this probability at the goal. Seeds are fixed:
/// it is met anew only where a change moves the results.
inline constexpr double test_level = 1e-3;

/// The least count of `cases` that a test accepts.
std::size_t least_right(std::size_t cases, double goal_share);

struct Share {
  double value = 0.0, low = 0.0, high = 0.0;
};

/// right/cases with its 95 % interval after Clopper and Pearson.
Share share(std::size_t right, std::size_t cases);

}  // namespace trueaxis::blind
