// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "associate/minimax.hpp"

namespace trueaxis {

/// The element of a criterion of extremes over all points; `best.contacts` name them by their
/// places in the cloud. `why` is not empty where there is none.
struct ExtremeElement {
  Minimax best;
  std::string why;
  int starts = 1;
  bool global = false;
};

/// From the Gaussian element and, where the criterion is not convex, from places about it. If there
/// are many points, those that may matter are solved for; all are compared, and those beyond are
/// added until there is none (Eq. 251).
ExtremeElement extreme_element(const Placed& gaussian, const PointCloud& cloud, Criterion criterion,
                               int max_iterations);

}  // namespace trueaxis
