// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "form/surface_sums.hpp"

namespace trueaxis::form {

/// A bump or dent of a surface about an angle and a place: Gaussian, with columns for what its own
/// shape differs by, He_a(u) He_b(v) exp(−(u² + v²)/2), u = (θ − θ₀)/w, v = (t − t₀)/l, He_a the
/// Hermite polynomials. Eq. 320a.
struct LocalForm {
  struct Degrees {
    int a, b;
    double variance;  ///< of its coefficient, over that of the first
  };
  /// Height, place, width and length, inclination, and flatter or more pointed. The first five
  /// change as the Gaussian's own numbers do.
  static constexpr std::array<Degrees, 9> shapes{{{0, 0, 1.0},
                                                  {1, 0, 0.0625},
                                                  {2, 0, 0.0625},
                                                  {0, 1, 0.0625},
                                                  {0, 2, 0.0625},
                                                  {1, 1, 0.16},
                                                  {4, 0, 0.0025},
                                                  {2, 2, 0.01},
                                                  {0, 4, 0.0025}}};
  static constexpr Eigen::Index columns = shapes.size();
  double angle_rad = 0.0, width_rad = 0.0, t = 0.0, length = 0.0;

  /// By more than a twentieth of width or length, which the columns follow.
  bool differs(const LocalForm& from) const;

  using Row = Eigen::Matrix<double, 1, columns>;
  using Pair = Eigen::Matrix<double, 2, columns>;
  Row at(double angle, double place) const;
  /// Amplitudes of cos and sin of an order of He_a exp(−u²/2) of every column.
  Pair around(int order) const;
  /// He_b exp(−v²/2) of every column.
  Row along(double place) const;
};

/// Readings of a surface: angle, length t in [−1, 1], height.
struct SurfaceData {
  std::span<const double> angle_rad, t, height_mm;
  double turns = 1.0;
};

/// What the terms and local forms of a surface are together at a reading.
/// @param q their coefficients, those of the local forms last
double height_of(const SurfaceTerms& terms, std::span<const LocalForm> local,
                 const Eigen::VectorXd& q, double angle_rad, double t);

/// Looks for the local form that explains most of what others leave. It is at least so wide and
/// long that several readings meet it.
class LocalFormSearch {
 public:
  LocalFormSearch(const SurfaceTerms& terms, const SurfaceData& data);

  struct Found {
    LocalForm form;
    double log_evidence;  ///< with every place looked at counted
  };
  /// @param q coefficients of all that is there already
  std::optional<Found> best(std::span<const LocalForm> local, const Eigen::VectorXd& q,
                            double variance) const;
  /// The place and size of one of them anew. @param q coefficients, of this one 0
  LocalForm refined(std::span<const LocalForm> local, const Eigen::VectorXd& q,
                    std::size_t which) const;
  double log_tests() const { return log_tests_; }

 private:
  struct Cell {
    Eigen::Index angle, length;
  };
  struct Size {
    double width_rad, length;
    Eigen::MatrixXd around, along, squares;  ///< kernels over cells, and Σ of their squares
  };
  std::vector<double> left_mm(std::span<const LocalForm> local, const Eigen::VectorXd& q) const;
  double gain_without_strongest(const std::vector<double>& left, const LocalForm& form) const;
  double gain_all_round(const std::vector<double>& left, const LocalForm& form) const;
  void refine(const std::vector<double>& left_mm, LocalForm& form, double& gain) const;

  SurfaceTerms terms_;
  SurfaceData data_;
  std::vector<std::size_t> some_;  ///< readings that are looked at
  std::vector<Cell> cell_;         ///< of each of them
  std::vector<Size> sizes_;
  double least_width_rad_ = 0.0, least_length_ = 0.0, log_tests_ = 0.0;
};

}  // namespace trueaxis::form
