// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "diagnose/regression/normal_equations.hpp"

namespace trueaxis::diagnose_detail {

/// Sums of the residuals over windows in (θ, s): where a local form may be. In which window of
/// every size a reading lies is worked out once.
class BumpScanner {
 public:
  /// @param point, mask outlive this
  BumpScanner(const LinearisationPoint& point, const ObservationMask& mask);

  /// The best window of every size.
  /// @param equations of the same readings
  std::vector<Hypothesis> operator()(const NormalEquations& equations,
                                     std::span<const double> remainder_mm) const;
  double tests() const { return tests_; }  ///< how many windows are looked at

 private:
  /// Windows of one size.
  struct Grid {
    std::size_t sectors, lengths;
    std::vector<std::uint16_t> window;  ///< of every reading
    std::vector<std::size_t> count;     ///< readings of every window
    std::vector<char> seen;             ///< whether it is looked at
  };
  Grid grid_of(std::size_t sectors, std::size_t lengths) const;
  /// @returns whether one is exceptional, as `best`
  bool best_of(const Grid& grid, std::span<const double> weighted, Hypothesis& best) const;

  const LinearisationPoint* point_;
  const ObservationMask* mask_;
  std::size_t least_readings_;
  std::vector<char> rear_;
  std::vector<Grid> grids_;
  double tests_ = 0.0;
};

}  // namespace trueaxis::diagnose_detail
