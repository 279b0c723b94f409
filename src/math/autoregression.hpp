// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <hwy/aligned_allocator.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "math/lower_triangle.hpp"

namespace trueaxis {

/// φ of ε_i = Σ φ_j ε_{i−j} + e_i; empty: white.
struct Autoregression {
  std::vector<double> phi;
  double rss = 0.0;      ///< of the residuals, whitened; 0: there were too few readings to tell
  double freedom = 0.0;  ///< of it: readings beyond the columns
  Eigen::VectorXd coefficients;  ///< of the columns of the model, 0 if one depends on others
};

/// Columns of some rows, and of those one and more before each of them: aligned and padded as of a
/// WideBlock.
class LaggedColumns {
 public:
  /// @param lags how many: 1 the rows alone
  LaggedColumns(const Eigen::MatrixXd& x, std::span<const Eigen::Index> rows, std::size_t lags);

  std::size_t rows() const { return rows_; }
  std::size_t lags() const { return lags_; }
  std::size_t count() const { return column_.size() / lags_; }    ///< columns of each lag
  std::span<const double* const> all() const { return column_; }  ///< lag by lag

 private:
  std::size_t rows_, lags_;
  hwy::AlignedFreeUniquePtr<double[]> memory_;
  std::vector<const double*> column_;
};

/// Readings that show the noise together: rows with two others before them, rows where a run of
/// readings begins, and rows that are the second of theirs.
struct LaggedRows {
  LaggedColumns later, first, second;
};

/// Products of columns with those one and two readings earlier, all over the same readings. The
/// first column shows the noise, the others are those of the model.
class LaggedGram {
 public:
  explicit LaggedGram(Eigen::Index columns);

  /// Adds rows of `x`; the two rows before each of them are those of the two readings before.
  void add(const Eigen::MatrixXd& x, std::span<const Eigen::Index> rows);
  /// Adds readings.
  void add(const LaggedRows& rows);
  /// Adds the products of more readings.
  void add(const LaggedGram& other);
  /// The same readings with room for more columns at the end.
  LaggedGram widened(Eigen::Index columns) const;
  /// Adds the products of columns that are last with each other and with those before them, of
  /// readings whose products those before have already.
  void add_columns(const LaggedRows& before, const LaggedRows& last);
  /// Adds the products of x · t for x whose products are `other`.
  void add_transformed(const LaggedGram& other, const Eigen::MatrixXd& t);

  double rows() const { return rows_ + first_rows_ + second_rows_; }
  double first_rows() const { return first_rows_; }
  double second_rows() const { return second_rows_; }
  const Eigen::MatrixXd& at(std::size_t a, std::size_t b) const { return gram_[a][b]; }

 private:
  friend class WhitenedGram;
  using Lags = std::array<std::array<Eigen::MatrixXd, 3>, 3>;  ///< products of the lags a ≤ b
  static void add(const LaggedColumns& x, std::size_t at, Lags& to);
  static void add_cross(const LaggedColumns& before, const LaggedColumns& last, Lags& to);
  /// by(own, the other's) for all products.
  template <typename Change>
  void change(const LaggedGram& other, const Change& by);

  Lags gram_;            ///< of rows with two readings before them
  Lags first_, second_;  ///< of rows where a run begins, and of the second of a run
  double rows_ = 0.0, first_rows_ = 0.0, second_rows_ = 0.0;
};

/// Products of some columns of a LaggedGram and of its first, which comes last, as whitening makes
/// them: sums of the products of lags times those of 1, −φ₁, −φ₂.
class WhitenedGram {
 public:
  WhitenedGram(const LaggedGram& gram, std::vector<Eigen::Index> columns);
  /// Those of ε_i − φ₁ ε_{i−1} − φ₂ ε_{i−2}, of the first readings of runs as RunStart has them;
  /// the caller may change them.
  LowerTriangle& by(double phi1, double phi2);
  /// Those made last, as the caller changed them.
  const LowerTriangle& made() const { return whitened_; }

 private:
  enum class Of { later, first, second };  ///< readings of a run
  struct Part {
    Of rows;
    std::size_t a, b;  ///< lags
    LowerTriangle products;
  };
  std::vector<Part> parts_;
  LowerTriangle whitened_;
};

/// Autoregression of the first column after the others by restricted maximum likelihood (Patterson
/// and Thompson 1971). It has order 0, 1 or 2, each one only if the likelihood ratio passes 5 %.
/// The second needs to be noise: `is_form(φ₁, φ₂)` must be false (Eqs. 64, 65).
Autoregression find_autoregression(const LaggedGram& gram,
                                   const std::function<bool(double, double)>& is_form);

/// The partial correlations a₁, a₂ … of φ, the φ of its partial correlations (Levinson): any below
/// 1 are those of a stationary process, and a₁ is the correlation of neighbours.
std::vector<double> partial_correlations(const std::vector<double>& phi);
std::vector<double> phi_of(const std::vector<double>& partial_correlations);

/// Goes on from an autoregression of the second order to higher ones, by Burg's lattice over runs
/// of residuals: each order only if its likelihood ratio passes 5 % (Eq. 65a).
Autoregression with_higher_orders(Autoregression second,
                                  std::span<const std::vector<double>> residual_runs);

/// Whether an autoregression of the second order rings with the spindle, whose angles at the
/// readings are given: nothing random does, but what turns with it and is not explained looks so.
/// A hump of the spectrum that is many orders wide does not.
bool rings_with_spindle(double phi1, double phi2, std::span<const double> c_rad);

/// How the first readings of a run are whitened, so that a run is as likely as all of its readings
/// are: e_k = g_k (ε_k − Σ_j a_kj ε_{k−j}), predicted from the k before it and of the same variance
/// as every innovation after them. Without them what differs from run to run, such as the sides of
/// a delay, would be free (Prais and Winsten 1954, Eq. 66b).
class RunStart {
 public:
  explicit RunStart(const std::vector<double>& phi);
  /// g_k of the reading k of a run; from the order on 1.
  double scale(std::size_t k) const { return scale_[std::min(k, scale_.size() - 1)]; }
  /// a_k1, a_k2 …
  const std::vector<double>& phi(std::size_t k) const { return phi_[std::min(k, phi_.size() - 1)]; }

 private:
  std::vector<double> scale_;
  std::vector<std::vector<double>> phi_;
};

/// Variance of one reading over that of the innovation e.
double variance_over_innovation(const std::vector<double>& phi);

}  // namespace trueaxis
