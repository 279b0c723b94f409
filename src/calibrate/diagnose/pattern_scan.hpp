// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "calibrate/diagnose/pattern.hpp"
#include "calibrate/diagnose/term.hpp"

namespace trueaxis::calibrate_detail {

/// Patterns that no effect makes, thousands of them, each as a gain only. A pattern is an error of
/// an axis (or a shift of the tip or the part) times functions of the row. Its products with
/// whatever is fitted are therefore sums over the rows of few columns (Eq. 184).
class PatternScan {
 public:
  PatternScan(const Problem& problem, const Geometry& geometry, const MatrixXd& base, bool timed);

  std::size_t size() const { return entries_.size(); }

  /// The best patterns after columns that are orthogonal to the base, by what they gain less their
  /// price. @param beside over σ, of any rank
  std::vector<std::size_t> best(const MatrixXd& beside, const VectorXd& residuals,
                                std::size_t most) const;

  Term term(std::size_t entry) const;
  /// The same pattern at places near its own; empty where it has none.
  std::vector<Term> finer(const Term& term) const;

 private:
  struct Entry {
    std::size_t unit = 0, function = 0;
    MatrixXd products;  ///< of its columns after the base
  };
  void add(std::size_t unit, const std::vector<std::size_t>& functions);
  std::vector<std::size_t> keep(std::vector<PatternFunction> functions);
  MatrixXd folded(std::size_t unit, const MatrixXd& columns) const;
  Term term_of(std::size_t unit, const PatternFunction& function) const;

  const Problem& problem_;
  MatrixXd units_;    ///< columns over σ: six errors an axis, the tip's shifts, the part's
  MatrixXd raw_;      ///< the same, per mm or rad
  MatrixXd squares_;  ///< of each row and unit
  MatrixXd base_;
  std::vector<PatternFunction> functions_;
  std::vector<Entry> entries_;
};

}  // namespace trueaxis::calibrate_detail
