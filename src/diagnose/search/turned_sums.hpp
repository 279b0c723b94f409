// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "diagnose/search/scan_list.hpp"
#include "math/fourier_sums.hpp"

namespace trueaxis::diagnose_detail {

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
