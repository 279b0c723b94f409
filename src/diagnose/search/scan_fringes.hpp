// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/search/line_norms.hpp"
#include "diagnose/search/scan_list.hpp"

namespace trueaxis::diagnose_detail {

/// A range of bins of a scan, and the gain that none of them exceeds.
struct FringeCell {
  std::size_t first = 0, bins = 0;
  double most = 0.0;
};

/// From both sides a line of what is sensed makes fringes: the sums F of the front and R of the
/// rear change only over a cycle of the swing, their phase against each other over one of the
/// diameter. No fringe of a cell is brighter than (|F| + |R|)²: the cells of a band, the brightest
/// first. Empty where they would save nothing.
/// @param left whitened twice, see weighted()
std::vector<FringeCell> fringe_cells(const LineNorms& norms, const LinearisationPoint& point,
                                     const Scan& scan, const std::vector<double>& left, double low,
                                     double df, std::size_t bins);

}  // namespace trueaxis::diagnose_detail
