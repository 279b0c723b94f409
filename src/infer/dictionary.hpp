// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "infer/fitted.hpp"

namespace trueaxis::infer {

/// A hypothesis whose columns are known before the search.
struct Hypothesis {
  std::string name;                             ///< id of an effect, or a pattern in words
  Eigen::MatrixXd columns;                      ///< over σ, per unit of their coefficients
  double largest = 1.0;                         ///< size that is plausible at most
  double size_median = 0.0, size_spread = 1.0;  ///< of a coefficient, of its logarithm; 0: unknown
  double tests = 1.0;                           ///< how many places of it were tried
  bool pattern = false;                         ///< no effect, only a residual
  bool barred = false;                          ///< a pattern that an effect makes at these rows
};

/// Hypotheses after what is always fitted, as the Gram matrix of residuals and columns over σ,
/// projected (Eq. 178): column 0 the residuals, then those of the hypotheses. The columns of one
/// are made orthonormal; those of its directions that stay below one σ at their largest plausible
/// size are dropped (Eq. 174).
class Dictionary {
 public:
  struct Block {
    std::string name;
    Columns columns;
    Eigen::MatrixXd back;  ///< coefficients of the term from those of its orthonormal columns
    double largest = 1.0, tests = 1.0;
    bool pattern = false, barred = false;
    SizePrior prior{};  ///< of the coefficients of the orthonormal columns
  };

  /// @param base columns over σ, of any rank
  Dictionary(const std::vector<Hypothesis>& hypotheses, const Eigen::MatrixXd& base);

  /// Residuals over σ, already orthogonal to the base or not.
  void take(const Eigen::VectorXd& residuals);
  void bar(std::size_t term, bool barred) { blocks_[term].barred = barred; }

  using Set = std::vector<std::size_t>;
  std::size_t size() const { return blocks_.size(); }
  const Block& block(std::size_t term) const { return blocks_[term]; }
  std::size_t rows() const { return rows_; }  ///< that the base leaves
  const Eigen::MatrixXd& gram() const { return gram_; }
  Fitted model(const Set& set) const;
  Columns columns_of(const Set& set) const { return model(set).besides(); }
  Projection beside(const Set& set) const { return {gram_, columns_of(set)}; }
  Solution fitted(const Set& set) const { return solve(gram_, columns_of(set)); }
  double gain(const Set& set) const { return gram_(0, 0) - fitted(set).rss; }
  double variance(const Set& set) const;  ///< of a residual over its σ

  /// ln p of the F test of a hypothesis after others (Eq. 179).
  double log_p(const Projection& others, std::size_t term) const {
    return log_p_of(others, blocks_[term].columns, rows_);
  }
  /// Data and prior of a hypothesis, whose columns are these, after others, with what its choice
  /// among many and that it is a pattern cost (Eqs. 78, 80).
  Weighed weighed(std::size_t term, const Projection& others, const Columns& columns) const;
  Weighed weighed(std::size_t term, const Projection& others) const {
    return weighed(term, others, blocks_[term].columns);
  }
  /// How many effects are tried that have a direction these rows show, at every place.
  double tests() const;
  /// What these tests are worth as independent ones: of the eigenvalues λ of the correlations of
  /// their columns Σ [λ ≥ 1] + λ − ⌊λ⌋ (Li and Ji 2005; Eq. 187).
  double independent_tests() const;

  const Eigen::MatrixXd& basis() const { return basis_; }  ///< orthonormal, of the base
  /// The orthonormal columns of a set, over σ and after the base.
  Eigen::MatrixXd columns(const Set& set) const { return all_(Eigen::all, columns_of(set)); }
  auto residuals() const { return all_.col(0); }  ///< after the base

 private:
  std::vector<Block> blocks_;
  Eigen::MatrixXd all_, basis_, gram_;
  std::size_t rows_ = 0;
};

/// A set with one of its terms after all others.
Dictionary::Set with_last(const Dictionary::Set& set, std::size_t at);

}  // namespace trueaxis::infer
