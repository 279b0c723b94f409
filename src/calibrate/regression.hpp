// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibrate/term.hpp"

namespace trueaxis::calibrate_detail {

/// Terms beside what is always fitted, as products only: residuals and columns over σ, projected
/// (Eq. 178). The columns of a term are made orthonormal; those of its directions that stay below
/// one σ at their largest plausible size are dropped (Eq. 174).
class Regression {
 public:
  struct Block {
    Eigen::Index first = 0, rank = 0;
    Eigen::MatrixXd back;      ///< coefficients of the term from those of its orthonormal columns
    double information = 0.0;  ///< mean of |column|² per mm² or rad², over σ²
    double weakest = 0.0;      ///< of the direction that is seen least
  };

  /// @param base columns over σ, of any rank
  Regression(const std::vector<Term>& terms, const Eigen::MatrixXd& base,
             const Eigen::VectorXd& weights, double largest_length_mm, double largest_angle_rad);

  /// Residuals over σ, already orthogonal to the base or not.
  void take(const Eigen::VectorXd& residuals);

  using Set = std::vector<std::size_t>;
  std::size_t size() const { return blocks_.size(); }
  const Block& block(std::size_t term) const { return blocks_[term]; }
  double rss() const { return rss_; }
  double freedom() const { return freedom_; }
  Eigen::Index rank(const Set& set) const;
  double gain(const Set& set) const;
  /// Of the orthonormal columns of all terms of a set, one after the other.
  Eigen::VectorXd coefficients(const Set& set) const;

  /// Products of two terms, and of one with the residuals, beside further ones.
  struct Beside {
    Eigen::MatrixXd products;
    Eigen::VectorXd right;
    double rss = 0.0, freedom = 0.0;
  };
  Beside beside(const Set& others) const;
  const Eigen::MatrixXd& products() const { return products_; }
  const Eigen::MatrixXd& basis() const { return basis_; }  ///< orthonormal, of the base
  /// The orthonormal columns of a set, over σ and beside the base.
  Eigen::MatrixXd columns(const Set& set) const {
    return orthonormal_(Eigen::all, columns_of(set));
  }
  const Eigen::VectorXd& residuals() const { return residuals_; }  ///< beside the base

 private:
  std::vector<Eigen::Index> columns_of(const Set& set) const;

  std::vector<Block> blocks_;
  Eigen::MatrixXd orthonormal_, basis_, products_;
  Eigen::VectorXd right_, residuals_;
  double rss_ = 0.0, freedom_ = 0.0;
};

/// Gain of a block and what it is: cᵀ G⁻¹ c with directions left out that others take up wholly.
double gain_of(const Eigen::MatrixXd& products, const Eigen::VectorXd& right);

}  // namespace trueaxis::calibrate_detail
