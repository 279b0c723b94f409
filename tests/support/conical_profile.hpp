// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "trueaxis/surface.hpp"

namespace trueaxis::testing {

/// A cone as a profile of one's own: radius at height 0, and how it grows.
class ConicalProfile final : public RevolvedProfile {
 public:
  std::vector<Parameter> parameters() const override {
    return {{.name = "radius_at_0", .unit = "mm", .start = 30.0},
            {.name = "taper", .unit = "1", .start = 0.0, .length_mm = 40.0}};
  }
  Radius radius(double height_mm, std::span<const double> p) const override {
    return {.mm = p[0] + p[1] * height_mm, .per_height = p[1], .per_parameter = {1.0, height_mm}};
  }
};

}  // namespace trueaxis::testing
