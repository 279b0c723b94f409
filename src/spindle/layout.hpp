// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <span>
#include <vector>

namespace trueaxis {

/// One sensor in one set-up: what it sees of the form and of the motion.
struct Channel {
  std::size_t run = 0;          ///< of the set-up
  std::size_t sensor = 0;       ///< within the run
  std::size_t bracket = 0;      ///< the same sensor in other set-ups of its stream
  double form_angle_rad = 0.0;  ///< θ + ρ: it reads the form at C + this
  double along = 1.0,
         across = 0.0;  ///< its share of the motion along the sensitive direction, 90° on
  bool sees_form = true;
};

/// The unknowns of an order: form, motion along and across, as far as the channels see them.
class Layout {
 public:
  explicit Layout(std::vector<Channel> channels);

  const std::vector<Channel>& channels() const { return channels_; }
  bool has_form() const { return form_ >= 0; }
  bool has_across() const { return across_ >= 0; }
  Eigen::Index unknowns() const { return unknowns_; }
  Eigen::Index form() const { return form_; }      ///< column, −1: none
  Eigen::Index along() const { return along_; }    ///< column
  Eigen::Index across() const { return across_; }  ///< column, −1: none

  /// Rows are channels: z_n = A_n (f_n, a_n, b_n)ᵀ (Eq. 141).
  Eigen::MatrixXcd matrix(int order) const;

 private:
  std::vector<Channel> channels_;
  Eigen::Index form_ = -1, along_ = -1, across_ = -1, unknowns_ = 0;
};

/// Of σ_min over σ_max: below it a matrix is singular.
inline constexpr double singular = 1e-7;

/// σ_max/σ_min of A_n (Eq. 145), infinite where it is singular to 1e-7 or has fewer rows than
/// columns.
double condition_of(const Eigen::MatrixXcd& matrix);

/// Sensors at these angles in one set-up, the sensitive direction along X.
Layout layout_of_sensors(std::span<const double> angles_rad);

}  // namespace trueaxis
