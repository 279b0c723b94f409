// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibrate/diagnose/term.hpp"
#include "infer/size_prior.hpp"

namespace trueaxis::calibrate_detail {

/// Terms beside what is always fitted, as the Gram matrix of residuals and columns over σ,
/// projected (Eq. 178): column 0 the residuals, then those of the terms. The columns of a term are
/// made orthonormal; those of its directions that stay below one σ at their largest plausible size
/// are dropped (Eq. 174).
class Regression {
 public:
  struct Block {
    infer::Columns columns;
    Eigen::MatrixXd back;      ///< coefficients of the term from those of its orthonormal columns
    double information = 0.0;  ///< mean of |column|² per mm² or rad², over σ²
    double weakest = 0.0;      ///< of the direction that is seen least
    infer::SizePrior prior{};  ///< of the coefficients of the orthonormal columns
  };

  /// @param base columns over σ, of any rank
  Regression(const std::vector<Term>& terms, const Eigen::MatrixXd& base,
             const Eigen::VectorXd& weights, double largest_length_mm, double largest_angle_rad);

  /// Residuals over σ, already orthogonal to the base or not.
  void take(const Eigen::VectorXd& residuals);

  using Set = std::vector<std::size_t>;
  const Block& block(std::size_t term) const { return blocks_[term]; }
  std::size_t rows() const { return rows_; }  ///< that the base leaves
  const Eigen::MatrixXd& gram() const { return gram_; }
  infer::Columns columns_of(const Set& set) const;
  infer::Projection beside(const Set& set) const { return {gram_, columns_of(set)}; }
  infer::Solution fitted(const Set& set) const { return infer::solve(gram_, columns_of(set)); }
  double gain(const Set& set) const { return gram_(0, 0) - fitted(set).rss; }
  double variance(const Set& set) const;  ///< of a residual over its σ

  const Eigen::MatrixXd& basis() const { return basis_; }  ///< orthonormal, of the base
  /// The orthonormal columns of a set, over σ and beside the base.
  Eigen::MatrixXd columns(const Set& set) const { return all_(Eigen::all, columns_of(set)); }
  auto residuals() const { return all_.col(0); }  ///< beside the base

 private:
  std::vector<Block> blocks_;
  Eigen::MatrixXd all_, basis_, gram_;
  std::size_t rows_ = 0;
};

/// A set without one of its terms, and with it behind all others.
Regression::Set without(Regression::Set set, std::size_t at);
Regression::Set with_last(const Regression::Set& set, std::size_t at);

}  // namespace trueaxis::calibrate_detail
