// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <complex>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "spindle/recording.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {

/// Re Σ z_n exp(in α), n = 0 … : a form or a motion.
using Series = std::vector<std::complex<double>>;
double value_at(const Series& series, double angle_rad);

/// What is known of the part in a run.
struct PartInRun {
  std::complex<double> eccentricity;  ///< it is off by Re(e exp(iψ)) towards ψ = C + θ
  const Series &form, &along, &across;
};

/// What the linear equation leaves out of a sensor's reading (Eq. 148): the exact reading of a part
/// that is off-centre, moves and has a form, less the sum of the three, as harmonics of C of order
/// 0 … `order_max`, mm.
Series second_order(const RunReadings& run, std::size_t sensor, double sensitive_rad,
                    const PartInRun& part, int order_max);

/// A form or a motion with what is known of its harmonics.
struct UncertainSeries {
  Series harmonics;          ///< of order 0 …
  std::vector<double> u_mm;  ///< of either component, from noise; independent between orders
  std::vector<double> u_not_noise_mm;  ///< from what moves and folds, likewise
  Eigen::MatrixXcd moved_mm;           ///< orders by influences: what one u of each moves
};

/// What does not repeat, along one direction, of one run.
struct AsynchronousMotion {
  std::vector<double> c_rad, motion_mm;
};

struct ResolvedSeries;

/// Largest − smallest over a turn of the mean of all draws, u their RMS distance from it; where
/// that is nothing beyond the noise, an interval that ends at its 95 % bound.
Estimate range_estimate(const ResolvedSeries& series);

/// The widest band at one angle over all turns, and largest − smallest of what repeats and what
/// does not together. Their u is how much they differ between recordings as long, from series of
/// the same spectrum with phases drawn anew (Theiler et al. 1992).
std::pair<Estimate, Estimate> asynchronous_and_total(const ResolvedSeries& series,
                                                     std::span<const AsynchronousMotion> runs,
                                                     double per_turn);

/// Which of some places evenly around the turn is nearest.
std::size_t place_in_turn(double c_rad, std::size_t places);

/// How far values lie outside the middle half (Tukey's hinges) of those at about the same angle: 0
/// for what more than a quarter of the turns have, as motion of order ½ or ⅓ is. A chip that has
/// moved the mean of its angle does not make its neighbours of other turns look like chips.
std::vector<double> outside_usual(std::span<const double> c_rad, std::span<const double> value,
                                  double per_turn);

/// u of the curve at every angle.
std::vector<double> u_of_curve(const ResolvedSeries& series, std::span<const double> angle_rad);

}  // namespace trueaxis
