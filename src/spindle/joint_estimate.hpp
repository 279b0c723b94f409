// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

#include "spindle/recording.hpp"
#include "spindle/second_order.hpp"
#include "spindle/separation.hpp"
#include "spindle/synchronous.hpp"
#include "spindle/values.hpp"
#include "trueaxis/spindle.hpp"

namespace trueaxis {

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

 private:
  void set_influences();
  void fit();
  void leave_outliers_out();
  void solve();
  void correct();
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
  double widening_ = 1.0, remainder_mm_ = 0.0;
};

}  // namespace trueaxis
