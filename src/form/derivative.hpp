// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "form/trace.hpp"

namespace trueaxis::form {

/// dr/dθ of values at the places of a trace: that of the polynomial of fourth degree through five
/// neighbours, none of them across a gap. Exact to (2π/points a wave)⁴/30 of a wave's own.
class Derivative {
 public:
  Derivative(const Trace& trace, double longest_step);
  std::vector<double> operator()(std::span<const double> value) const;

 private:
  struct Stencil {
    std::array<std::size_t, 5> reading;
    std::array<double, 5> weight;
  };
  std::vector<Stencil> stencils_;  ///< none for a stretch of fewer than five readings
  std::vector<bool> known_;
};

}  // namespace trueaxis::form
