// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <complex>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "spindle/layout.hpp"
#include "spindle/recording.hpp"
#include "spindle/synchronous.hpp"
#include "spindle/values.hpp"
#include "trueaxis/spindle.hpp"

namespace trueaxis {

/// An angle of a sensor or of a re-indexing that is known with u.
struct AngleInfluence {
  double u_rad = 0.0;
  std::vector<std::size_t> channels;  ///< that it turns
  bool turns_motion = true;           ///< a sensor's angle; a re-indexing turns the form alone
};

/// The unknowns of one order, by generalised least squares (Eq. 144).
struct OrderSolution {
  double condition = 1.0;          ///< of A_n
  double largest_condition = 1.0;  ///< above which it is suppressed (Eq. 146)
  std::vector<bool> determined;    ///< of every unknown
  Eigen::VectorXcd unknowns;       ///< zero where it is not determined
  Eigen::VectorXcd guessed;        ///< the shortest solution where it is not determined
  Eigen::VectorXd u_mm;            ///< of either component, but for the angles
  Eigen::VectorXd u_not_noise_mm;  ///< what of it is more than the noise of all orders
  /// What one u of every influence moves, unknowns by influences (Eq. 147).
  Eigen::MatrixXcd moved_mm;
  double chi_squared = 0.0, freedom = 0.0;        ///< of what channels contradict (both components)
  double read_mm2 = 0.0, contradicted_mm2 = 0.0;  ///< |z|² of a channel, and left of all of them
};

/// Which orders are solved, and how.
struct SeparationTask {
  int order_min = 2, order_max = 100;
  double largest_condition = 100.0, coverage_factor = 2.0;
  double remainder_mm = 0.0;  ///< of one amplitude: what the second order leaves (Eq. 149)
};

/// Solves the orders. @param parts one for every run.
std::vector<OrderSolution> separate(const Layout& layout, std::span<const SynchronousPart> parts,
                                    std::span<const AngleInfluence> influences,
                                    const SeparationTask& task);

/// All runs of one kind, from readings to the solutions of every order: what repeats in each run,
/// without chips, the separation, and both again less what the linear equation neglects.
class JointEstimate {
 public:
  /// @throws InputError for a layout without a solution, or too few readings per revolution.
  JointEstimate(std::vector<RunReadings> runs, const SpindleOptions& options);

  const std::vector<RunReadings>& runs() const { return runs_; }
  const std::vector<SynchronousFit>& fits() const { return fits_; }
  const std::vector<SynchronousPart>& parts() const { return parts_; }
  const Layout& layout() const { return layout_; }
  const std::vector<OrderSolution>& orders() const { return orders_; }
  bool axial() const { return axial_; }
  double sensitive_rad() const { return sensitive_rad_; }
  int order_min() const { return order_min_; }
  int order_max() const { return order_max_; }
  bool has_radius() const;

  /// e exp(−iφ) of the part in a run, the mean over the sensors; the fundamental motion is in it.
  std::complex<double> eccentricity(std::size_t run) const;

  /// An unknown (a column of the layout, −1: none) over the orders; 0 where it is suppressed.
  UncertainSeries series(Eigen::Index unknown) const;

  /// What does not repeat, along the sensitive direction or across it, of the runs that see it.
  std::vector<AsynchronousMotion> asynchronous(bool across) const;

  /// χ²/ν of what sensors and set-ups contradict (NaN: none to spare), and what it does to u.
  double disagreement() const { return disagreement_; }
  double widening() const { return widening_; }
  /// Whether they contradict each other by more than `refused_share` of what they read.
  bool contradicts() const { return widening_ > 1.0 && contradicted_share_ > refused_share; }
  double contradicted_share() const { return contradicted_share_; }

 private:
  static constexpr double refused_share = 0.3;  // gains and angles that are off a little do less
  void set_influences();
  void fit();
  void leave_outliers_out();
  void solve();
  void correct();
  void correct_until_settled();
  Series guessed(Eigen::Index unknown) const;
  double remainder(const Series& form, const Series& along) const;

  std::vector<RunReadings> runs_;
  SpindleOptions options_;
  bool axial_;
  double sensitive_rad_;
  Layout layout_;
  int order_min_, order_max_ = 0;
  std::vector<AngleInfluence> influences_;
  std::vector<SynchronousFit> fits_;
  std::vector<SynchronousPart> parts_;
  std::vector<Eigen::MatrixXcd> linear_;  ///< harmonics of the parts as they were read
  std::vector<OrderSolution> orders_;
  double disagreement_ = std::numeric_limits<double>::quiet_NaN();
  double widening_ = 1.0, remainder_mm_ = 0.0, contradicted_share_ = 0.0;
};

}  // namespace trueaxis
