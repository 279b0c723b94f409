// SPDX-License-Identifier: Apache-2.0
#include "calibrate/estimate/determined.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "math/linear_algebra.hpp"

namespace trueaxis::calibrate_detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double takes_part = 0.1;  // of the largest member
constexpr double rank_of_places = 1e-9;

/// Orthonormal columns, to which one is added at a time.
class Basis {
 public:
  Basis(const MatrixXd& first, Index room) : q_(first.rows(), first.cols() + room) {
    if (first.cols() == 0) return;
    const MatrixXd basis = linear::orthonormal_basis(first, rank_of_places);
    size_ = basis.cols();
    q_.leftCols(size_) = basis;
  }
  VectorXd beside(VectorXd v) const {
    for (int twice = 0; twice < 2; ++twice)
      v -= q_.leftCols(size_) * (q_.leftCols(size_).transpose() * v);
    return v;
  }
  void add(const VectorXd& left) { q_.col(size_++) = left.normalized(); }
  bool full() const { return size_ == q_.rows(); }

 private:
  MatrixXd q_;
  Index size_ = 0;
};

MatrixXd columns(const MatrixXd& of, const std::vector<std::size_t>& which) {
  MatrixXd out(of.rows(), static_cast<Index>(which.size()));
  for (std::size_t k = 0; k < which.size(); ++k)
    out.col(static_cast<Index>(k)) = of.col(static_cast<Index>(which[k]));
  return out;
}

/// Which of the kept unknowns make up the column of a held one, and whether the places do.
void explain(Held& held, const MatrixXd& unknowns, const MatrixXd& places,
             const std::vector<std::size_t>& kept, double tells) {
  MatrixXd all(unknowns.rows(), places.cols() + static_cast<Index>(kept.size()));
  all << places, columns(unknowns, kept);
  const VectorXd column = unknowns.col(static_cast<Index>(held.unknown));
  const VectorXd share = linear::least_squares(all, column);
  const double least = std::max(tells, takes_part * column.norm());
  held.places = (places * share.head(places.cols())).norm() >= least;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Index c = places.cols() + static_cast<Index>(k);
    if (std::abs(share[c]) * all.col(c).norm() >= least) held.alike.push_back(kept[k]);
  }
}

/// The direction of least effect among the kept ones: its σ, and its members.
double weakest(const MatrixXd& beside_places, VectorXd& direction) {
  const linear::Spectrum of = linear::spectrum(linear::gram(beside_places));
  direction = of.vectors.col(0);
  return std::sqrt(std::max(0.0, of.values[0]));
}

}  // namespace

Determined determine(const MatrixXd& unknowns, const MatrixXd& places, double tells) {
  Determined out;
  Basis basis(places, unknowns.cols());
  const Basis of_places = basis;
  for (Index j = 0; j < unknowns.cols(); ++j) {
    const VectorXd left = basis.beside(unknowns.col(j));
    if (!basis.full() && left.norm() >= tells) {
      basis.add(left);
      out.kept.push_back(static_cast<std::size_t>(j));
    } else {
      out.held.push_back(
          {static_cast<std::size_t>(j), {}, false, unknowns.col(j).norm(), left.norm()});
    }
  }
  MatrixXd beside(unknowns.rows(), unknowns.cols());
  for (Index j = 0; j < unknowns.cols(); ++j) beside.col(j) = of_places.beside(unknowns.col(j));
  VectorXd direction;
  while (!out.kept.empty()) {
    const double effect = weakest(columns(beside, out.kept), direction);
    if (effect >= tells) break;
    const double part = 0.3 * direction.cwiseAbs().maxCoeff();
    std::size_t last = out.kept.size() - 1;
    while (std::abs(direction[static_cast<Index>(last)]) < part) --last;
    const std::size_t unknown = out.kept[last];
    out.kept.erase(out.kept.begin() + static_cast<std::ptrdiff_t>(last));
    out.held.push_back(
        {unknown, {}, false, unknowns.col(static_cast<Index>(unknown)).norm(), effect});
  }
  for (Held& held : out.held) explain(held, unknowns, places, out.kept, tells);
  std::ranges::sort(out.held, {}, &Held::unknown);
  return out;
}

}  // namespace trueaxis::calibrate_detail
