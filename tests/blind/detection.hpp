// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "blind/goals.hpp"
#include "blind/study.hpp"

namespace trueaxis::blind {

/// How often three lobes of a given λ are found, in one helical pass of a cone, against theory.
struct DetectionPoint {
  double lambda = 0.0;
  std::size_t cases = 0, found = 0;
  double threshold = 0.0;  ///< mean over the streams, as the command states it
  double expected = 0.0;   ///< 1 − F_nc(threshold/2; 2, N − p − 2, λ)
};

/// Power of an F test with two columns whose statistic (2 F) is compared with `threshold`.
double power(double threshold, double lambda, double readings, double parameters);

std::vector<DetectionPoint> detection_curve(const std::vector<double>& lambdas,
                                            std::size_t cases_each, std::uint64_t seed,
                                            const StudyOptions& options);

}  // namespace trueaxis::blind
