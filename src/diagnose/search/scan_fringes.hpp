// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "diagnose/search/line_norms.hpp"
#include "diagnose/search/scan_list.hpp"
#include "math/fourier_sums.hpp"

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

/// Whether the readings at the rear have the other sign than in front; on one side it does not
/// matter.
inline bool is_turned_round(const Scan& scan, const LinearisationPoint& point) {
  return scan.form && point.two_sided;
}

/// Sums of one scan over g cos nθ and g sin nθ, from which those of +n and −n are made.
struct TurnedSums {
  double order = 0.0;
  bool spindle = false, turned_round = false;
  FourierSums::Sums cosine, sine;

  bool serves(const Scan& scan, const LinearisationPoint& point) const {
    return !cosine.empty() && order == std::abs(scan.turns) &&
           turned_round == is_turned_round(scan, point) &&
           (order == 0.0 || spindle == scan.spindle);
  }
};

/// @param left of every reading, of a form to be turned round at the rear
TurnedSums turned_sums(const FourierSums& plan, const LinearisationPoint& point, const Scan& scan,
                       const std::vector<double>& left);

}  // namespace trueaxis::diagnose_detail
