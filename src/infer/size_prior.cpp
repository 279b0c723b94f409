// SPDX-License-Identifier: Apache-2.0
#include "infer/size_prior.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "infer/size_posterior.hpp"

namespace trueaxis::infer {
namespace {

using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 8, 8>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 8, 1>;

constexpr double ends_of_range = 3.92;  // widths of a normal law that hold 95 % of it
constexpr double least_spread = 0.7;    // of ln: no range of a handbook is sharper than that
constexpr double absorbed = 1e-9;       // share of a column below which nothing is left
constexpr double far = 3.0;             // spreads: sizes beyond are extraordinary

/// Scales in spreads about the median, and their weights: log-normal, with a tail that lets an
/// extraordinary part be what it is.
struct Node {
  double at, weight;
};
constexpr std::array<Node, 9> nodes{{{-2.0, 0.054},
                                     {-1.0, 0.242},
                                     {0.0, 0.399},
                                     {1.0, 0.242},
                                     {2.0, 0.054},
                                     {3.0, 0.0044},
                                     {4.5, 1e-4},
                                     {6.0, 1e-5},
                                     {8.0, 1e-6}}};

/// A term's columns after others, and the residual of the readings without it.
struct Beside {
  const Eigen::MatrixXd& gram;
  const Eigen::VectorXd &right, &norm2;
  double rss, freedom;
};

Weighed weighed(const SizePrior& prior, const Beside& beside, std::vector<SizePart>* parts) {
  const auto& [gram, right, norm2, rss, freedom] = beside;
  const Eigen::Index n = gram.rows();
  const double first_variance = rss / std::max(freedom, 1.0);
  SmallVector scale(n);  // of the coefficients
  bool known = false;
  for (Eigen::Index j = 0; j < n; ++j) {
    known |= prior.median(j) > 0.0;
    scale(j) = prior.median(j) > 0.0 ? prior.median(j)
               : norm2(j) > 0.0      ? std::sqrt(first_variance * freedom / norm2(j))
                                     : 0.0;
  }
  const Small scaled = scale.asDiagonal() * gram * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Small> eigen(scaled);
  const SmallVector along = eigen.eigenvectors().transpose() * (scale.asDiagonal() * right);
  const double floor = absorbed * (scale.cwiseProduct(scale)).dot(norm2);
  double gain = 0.0;
  for (Eigen::Index j = 0; j < n; ++j)
    if (eigen.eigenvalues()(j) > floor) gain += along(j) * along(j) / eigen.eigenvalues()(j);
  const double variance =
      std::max(rss - gain, 1e-12 * rss) / std::max(freedom - static_cast<double>(n), 1.0);

  std::array<double, nodes.size() + 1> criterion{};
  double best = 1e300;
  auto count = known ? nodes.size() : 1;
  while (count > 1 && !prior.allows(prior.scale(nodes[count - 1].at))) --count;
  const bool stated = known && prior.stated > 0.0;
  if (stated) count = prior.doubt > 0.0 ? count + 1 : 1;  // first what is stated, then the nodes
  const auto factor2 = [&](std::size_t k) {
    if (stated && k == 0) return prior.stated * prior.stated;
    return known ? std::exp(2.0 * prior.spread * nodes[stated ? k - 1 : k].at) : 1.0;
  };
  const auto weight_of = [&](std::size_t k) {
    if (stated && k == 0) return 1.0 - prior.doubt;
    return prior.doubt * nodes[stated ? k - 1 : k].weight;
  };
  for (std::size_t k = 0; k < count; ++k) {
    double shrunk = 0.0, widths = 0.0;
    for (Eigen::Index j = 0; j < n; ++j) {
      if (!(eigen.eigenvalues()(j) > floor)) continue;
      const double value = eigen.eigenvalues()(j) + variance / factor2(k);
      shrunk += along(j) * along(j) / value;
      widths += std::log(value * factor2(k) / variance);
    }
    criterion[k] = freedom * std::log(std::max(1.0 - shrunk / rss, 1e-12)) + widths;
    if (known) criterion[k] -= 2.0 * std::log(weight_of(k));
    best = std::min(best, criterion[k]);
  }
  Weighed out;
  double sum = 0.0, inverse2 = 0.0;
  SmallVector first = SmallVector::Zero(n), second = SmallVector::Zero(n);
  Small outer = Small::Zero(n, n);
  const Small back = scale.asDiagonal() * Small(eigen.eigenvectors());
  for (std::size_t k = 0; k < count; ++k) {
    const double weight = std::exp(-0.5 * (criterion[k] - best));
    SmallVector mean = SmallVector::Zero(n), own(n);
    for (Eigen::Index j = 0; j < n; ++j) {
      const double value = std::max(eigen.eigenvalues()(j), 0.0) + variance / factor2(k);
      if (eigen.eigenvalues()(j) > floor) mean(j) = along(j) / value;
      own(j) = variance / value;
      second(j) += weight * variance / value;
    }
    first += weight * mean;
    outer += weight * (mean * mean.transpose());
    inverse2 += weight / factor2(k);
    sum += weight;
    if (parts) parts->push_back({weight, back * mean, back * own.asDiagonal() * back.transpose()});
  }
  out.criterion = best - 2.0 * std::log(sum);
  const SmallVector mean = first / sum;
  const Small spread = (outer / sum - mean * mean.transpose()) + Small((second / sum).asDiagonal());
  if (parts)
    for (SizePart& part : *parts) part.weight /= sum;
  out.mean = back * mean;
  out.possible = prior.allows(out.mean);
  const Eigen::VectorXd most = prior.scale(far);
  for (Eigen::Index j = 0; j < n; ++j)
    out.extraordinary |= most(j) > 0.0 && std::abs(out.mean(j)) > most(j);
  out.covariance = back * spread * back.transpose();
  out.precision = Eigen::VectorXd::Zero(n);
  for (Eigen::Index j = 0; j < n; ++j)
    if (scale(j) > 0.0) out.precision(j) = variance * inverse2 / sum / (scale(j) * scale(j));
  return out;
}

}  // namespace

double spread_of_size(double log_high_over_low) {
  return std::max(least_spread, log_high_over_low / ends_of_range);
}

bool SizePrior::allows(const Eigen::VectorXd& size) const {
  if (most_of_first > 0.0 && size.size() == 4 &&
      size.tail(2).norm() > most_of_first * size.head(2).norm())
    return false;
  return least.size() == 0 ||
         ((size.array() >= least.array()).all() && (size.array() <= most.array()).all());
}

Weighed weigh(const SizePrior& prior, const Eigen::MatrixXd& gram, const Eigen::VectorXd& right,
              const Eigen::VectorXd& norm2, double rss, double freedom) {
  return weighed(prior, {gram, right, norm2, rss, freedom}, nullptr);
}

Weighed weigh(const SizePrior& prior, const Projection& projection, const Columns& own,
              std::size_t count) {
  return weigh(prior, projection.gram(own, own), projection.gram(own, {0}), projection.norm2(own),
               projection.rss, static_cast<double>(count - std::min(count, projection.rank)));
}

std::vector<SizePart> size_posterior(const SizePrior& prior, const Projection& projection,
                                     const Columns& own, std::size_t count) {
  const Eigen::MatrixXd gram = projection.gram(own, own);
  const Eigen::VectorXd right = projection.gram(own, {0}), norm2 = projection.norm2(own);
  std::vector<SizePart> parts;
  weighed(prior,
          {gram, right, norm2, projection.rss,
           static_cast<double>(count - std::min(count, projection.rank))},
          &parts);
  return parts;
}

}  // namespace trueaxis::infer
