// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "calibrate/search.hpp"
#include "trueaxis/machine_diagnosis.hpp"

namespace trueaxis::calibrate_detail {

inline constexpr double told_apart = 3.2897;  ///< d with Φ(d/2) = 0.95
/// d at which a rival leaves the class with 90 %: d² − 1.28 · 2 d = 7 in 2 ln L (Eq. 188).
inline constexpr double surely_told_apart = 4.22;
inline constexpr double sure_power = 0.9;

/// A found term with its sizes beside all others, and its class: every other effect whose best fit
/// stays within d = 3.29 of its prediction, or does not lose 7 in 2 ln L; none beyond d = 6.6
/// (Eq. 181). Its `rms_mm` is left over σ and summed: |μ|.
MachineFinding finding_of(const Regression& regression, const std::vector<Term>& terms,
                          const Regression::Set& set, std::size_t at, const SearchOptions& options);

/// λ of the noncentral F distribution that is found with a power (Eq. 182).
double detectable_lambda(double rank, double freedom, double single_level, double power);

/// Size of a term that is found with power one half, mm or rad; nothing where none is.
std::optional<double> detectable_size(const Regression& regression, std::size_t term,
                                      double variance, const SearchOptions& options);

/// Size that is found with power 0.9 in whatever phase, mm or rad; nothing where none is.
std::optional<double> surely_shown_size(const Regression& regression, std::size_t term,
                                        double variance, const SearchOptions& options);

/// RMS of what the base and the terms predict of blocks of rotary positions that were left out, mm
/// (Eq. 183). @param columns over σ
struct HeldOutRms {
  HeldOut rms;
  std::size_t blocks = 0;
};
HeldOutRms held_out(const Problem& problem, const Eigen::MatrixXd& columns,
                    const Eigen::VectorXd& readings);

}  // namespace trueaxis::calibrate_detail
