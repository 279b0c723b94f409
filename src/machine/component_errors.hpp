// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "machine/compiled.hpp"

namespace trueaxis {

/// The six component errors of an axis at a commanded position, or their slopes.
struct ComponentErrors {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero(), rotation = Eigen::Vector3d::Zero();

  /// Ê = Tr(r) E^± Tr(−r), E = Tr(shift) exp(rotation).
  rigid::Motion motion(const Joint& joint) const;
};

ComponentErrors component_errors(const Joint& joint, double position);

struct ComponentErrorsAndSlopes {
  ComponentErrors errors, slopes;
};
ComponentErrorsAndSlopes component_errors_and_slopes(const Joint& joint, double position);

}  // namespace trueaxis
