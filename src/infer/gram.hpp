// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <vector>

namespace trueaxis::infer {

/// Columns of a Gram matrix; column 0 is the readings.
using Columns = std::vector<std::size_t>;

/// Least squares over some columns: coefficients (0 where a combination is undetermined) and the
/// inverse of their normal matrix.
struct Solution {
  Columns columns;
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd inverse;
  double rss = 0.0;
  std::size_t rank = 0;
};
Solution solve(const Eigen::MatrixXd& gram, const Columns& columns);

/// The residual of every column once some are taken out by least squares. Eq. 58.
class Projection {
 public:
  /// @param gram outlives this
  Projection(const Eigen::MatrixXd& gram, const Columns& taken)
      : Projection(gram, solve(gram, taken)) {}
  /// The same by least squares over the chosen columns, which are those of this matrix.
  Projection(const Eigen::MatrixXd& gram, const Solution& taken);

  Eigen::VectorXd norm2;  ///< of the columns before
  double rss = 0.0;       ///< of column 0
  std::size_t rank = 0;   ///< of what was taken out

  /// An entry of the Schur complement; made where it is asked for.
  double gram(Eigen::Index i, Eigen::Index j) const {
    return (*whole_)(i, j) - cross_.col(i).dot(weighted_.col(j));
  }
  Eigen::MatrixXd gram(const Columns& rows, const Columns& columns) const;

 private:
  const Eigen::MatrixXd* whole_;
  Eigen::MatrixXd cross_, weighted_;  ///< of the chosen columns, and times the inverse of their own
};
inline Projection project(const Eigen::MatrixXd& gram, const Columns& taken) {
  return {gram, taken};
}

/// What more columns take off the sum of squares.
struct Score {
  double gain = 0.0;     ///< decrease of the residual sum of squares
  std::size_t rank = 0;  ///< columns that are not absorbed
};
/// Eq. 59.
Score score(const Projection& projection, const Columns& columns);

/// Sum of squares of a block, predicted by columns fitted to the other blocks (Eq. 82).
double held_out(const Eigen::MatrixXd& total, const Eigen::MatrixXd& fold, const Columns& columns);
/// The same to rounding, and faster: where the columns are independent beyond doubt their
/// coefficients are from a Cholesky factor.
double held_out_fast(const Eigen::MatrixXd& total, const Eigen::MatrixXd& fold,
                     const Columns& columns);

}  // namespace trueaxis::infer
