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
constexpr double no_weight = 1e-9;      // of scales that are not looked at

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

/// The scale of a last pair over that of the first, in spreads.
constexpr std::array ratios{-5.0, -4.0, -3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0};

/// Weight of a scale that many spreads above the median: the law whose nodes those above are.
double weight_at(double spreads) {
  const double beyond = std::max(0.0, std::abs(spreads) - 4.5);
  return std::max(0.399 * std::exp(-0.5 * spreads * spreads),
                  1e-4 * std::pow(10.0, -beyond / 1.75));
}

/// A term's columns after others, and the residual of the readings without it.
struct Beside {
  const Eigen::MatrixXd& gram;
  const Eigen::VectorXd &right, &norm2;
  double rss, freedom;
};

/// The columns in units of their scales, which are up to a common factor, along the axes of their
/// normal matrix.
struct Scaled {
  SmallVector scale, values, along;
  Small axes;
  double floor = 0.0;  ///< of a value: below it nothing of the column is left
  double ratio = 0.0;  ///< of the scale of the last pair, in spreads

  Scaled(const Beside& beside, const SmallVector& scales, double of_last)
      : scale(scales), ratio(of_last) {
    const Small scaled = scale.asDiagonal() * beside.gram * scale.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Small> eigen(scaled);
    values = eigen.eigenvalues(), axes = eigen.eigenvectors();
    along = axes.transpose() * (scale.asDiagonal() * beside.right);
    floor = absorbed * scale.cwiseProduct(scale).dot(beside.norm2);
  }
  bool is_left(Eigen::Index j) const { return values(j) > floor; }
};

/// Scales of a term, one for all columns or, for the last pair, one of several ratios.
std::vector<Scaled> scaled_of(const SizePrior& prior, const Beside& beside,
                              const SmallVector& scale) {
  if (!prior.own_scale_of_last) return {Scaled(beside, scale, 0.0)};
  std::vector<Scaled> out;
  for (const double ratio : ratios) {
    SmallVector with = scale;
    with.tail(2) *= std::exp(prior.spread * ratio);
    out.emplace_back(beside, with, ratio);
  }
  return out;
}

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
  const std::vector<Scaled> scaled = scaled_of(prior, beside, scale);
  double gain = 0.0;
  for (Eigen::Index j = 0; j < n; ++j)
    if (scaled.front().is_left(j))
      gain += scaled.front().along(j) * scaled.front().along(j) / scaled.front().values(j);
  const double variance =
      std::max(rss - gain, 1e-12 * rss) / std::max(freedom - static_cast<double>(n), 1.0);

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
  const auto criterion_of = [&](const Scaled& at, std::size_t k) {
    double shrunk = 0.0, widths = 0.0;
    for (Eigen::Index j = 0; j < n; ++j) {
      if (!at.is_left(j)) continue;
      const double value = at.values(j) + variance / factor2(k);
      shrunk += at.along(j) * at.along(j) / value;
      widths += std::log(value * factor2(k) / variance);
    }
    const double out = freedom * std::log(std::max(1.0 - shrunk / rss, 1e-12)) + widths;
    if (!known) return out;
    const double of_last = prior.own_scale_of_last ? weight_at(nodes[k].at + at.ratio) : 1.0;
    return out - 2.0 * std::log(weight_of(k) * of_last);
  };
  std::array<std::array<double, nodes.size() + 1>, ratios.size()> criterion{};
  double best = 1e300;
  for (std::size_t r = 0; r < scaled.size(); ++r)
    for (std::size_t k = 0; k < count; ++k)
      best = std::min(best, criterion[r][k] = criterion_of(scaled[r], k));

  Weighed out;
  double sum = 0.0;
  Eigen::VectorXd first = Eigen::VectorXd::Zero(n), precision = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd second = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t r = 0; r < scaled.size(); ++r) {
    const Scaled& at = scaled[r];
    const Small back = at.scale.asDiagonal() * at.axes;
    SmallVector mean_along = SmallVector::Zero(n), own = SmallVector::Zero(n);
    for (std::size_t k = 0; k < count; ++k) {
      const double weight = std::exp(-0.5 * (criterion[r][k] - best));
      if (weight < no_weight && scaled.size() > 1) continue;
      for (Eigen::Index j = 0; j < n; ++j) {
        const double value = std::max(at.values(j), 0.0) + variance / factor2(k);
        mean_along(j) = at.is_left(j) ? at.along(j) / value : 0.0;
        own(j) = variance / value;
      }
      const SmallVector mean = back * mean_along;
      const Small covariance = back * own.asDiagonal() * back.transpose();
      first += weight * mean;
      second += weight * (mean * mean.transpose() + covariance);
      for (Eigen::Index j = 0; j < n; ++j)
        if (at.scale(j) > 0.0)
          precision(j) += weight * variance / (factor2(k) * at.scale(j) * at.scale(j));
      sum += weight;
      if (parts) parts->push_back({weight, mean, covariance});
    }
  }
  out.criterion = best - 2.0 * std::log(sum);
  if (parts)
    for (SizePart& part : *parts) part.weight /= sum;
  out.mean = first / sum;
  out.possible = prior.allows(out.mean);
  const Eigen::VectorXd most = prior.scale(far);
  for (Eigen::Index j = 0; j < n; ++j)
    out.extraordinary |= most(j) > 0.0 && std::abs(out.mean(j)) > most(j);
  out.covariance = second / sum - out.mean * out.mean.transpose();
  out.precision = precision / sum;
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
