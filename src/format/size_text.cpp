// SPDX-License-Identifier: Apache-2.0
#include "format/size_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "format/text_layout.hpp"

namespace trueaxis::layout {

std::string below(double value, const std::string& unit) {
  return fmt::format("below {} {} (95 % confidence)", bound(value), unit);
}

std::string size_plus_minus(const Estimate& estimate, double coverage_factor, double scale,
                            const std::string& unit) {
  const double within = bound_factor(coverage_factor) * estimate.u;
  if (!estimate.determined() || !std::isfinite(within) || estimate.value > within)
    return plus_minus(estimate, coverage_factor, scale, unit);
  return below(scale * (estimate.value + within), unit);
}

}  // namespace trueaxis::layout
