// SPDX-License-Identifier: Apache-2.0
#include "diagnose/regression/size_prior.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "infer/size_posterior.hpp"

namespace trueaxis::diagnose_detail {
namespace {

using boost::math::quadrature::gauss_kronrod;

double normal(double x, double sigma) {
  return std::exp(-0.5 * x * x / (sigma * sigma)) / (sigma * std::sqrt(2.0 * std::numbers::pi));
}

/// −2 ln of ∫∫ L(a)/L(0) N(a; 0, s²) p(ln s) da d ln s for a column of Gram `gram` that is found at
/// `a_hat`, σ = 1.
double by_quadrature(double gram, double a_hat, double median, double spread) {
  const auto over_scale = [&](double log_scale) {
    const double s = median * std::exp(log_scale);
    const auto over_size = [&](double a) {
      return std::exp(-0.5 * gram * (a - a_hat) * (a - a_hat)) * normal(a, s);
    };
    const double width = std::min(s, 1.0 / std::sqrt(gram));
    const double about = a_hat * s * s / (s * s + 1.0 / gram);
    return normal(log_scale, spread) * gauss_kronrod<double, 31>::integrate(
                                           over_size, about - 9.0 * width, about + 9.0 * width, 8);
  };
  const double integral =
      gauss_kronrod<double, 31>::integrate(over_scale, -5.0 * spread, 5.0 * spread, 8);
  return -2.0 * std::log(integral) - gram * a_hat * a_hat;
}

Weighed weighed(double gram, double a_hat, double median, double spread) {
  const SizePrior prior{Eigen::VectorXd::Constant(1, median), spread};
  const double rss = 1e6 + gram * a_hat * a_hat;  // so many readings that σ is known: 1
  return weigh(prior, Eigen::MatrixXd::Constant(1, 1, gram),
               Eigen::VectorXd::Constant(1, gram * a_hat), Eigen::VectorXd::Constant(1, gram), rss,
               1e6 + 1.0);
}

// Nine scales a spread apart stand for the integral over all: 2 ln of their sum is off by tenths
// where the data choose one scale, and by what the tail is heavier beyond three spreads.
TEST(SizePrior, TheMarginalLikelihoodIsTheIntegral) {
  int compared = 0;
  for (const double spread : {1.0, 1.4}) {
    for (const double a_hat : {0.0, 0.05, 0.2, 1.0, 3.0, 8.0}) {
      for (const double gram : {1e-2, 1.0, 1e2, 1e4}) {
        if (gram * a_hat * a_hat > 500.0) continue;  // beyond it σ is not known well enough
        EXPECT_NEAR(weighed(gram, a_hat, 0.5, spread).criterion,
                    by_quadrature(gram, a_hat, 0.5, spread), 0.5)
            << "a " << a_hat << ", gram " << gram << ", spread " << spread;
        ++compared;
      }
    }
  }
  EXPECT_EQ(compared, 2 * (3 * 4 + 3 + 2 + 2));  // spreads; of each a those within
}

/// Eq. 80 written out for columns that are not at right angles.
Weighed by_equation_80(const SizePrior& prior, const Eigen::MatrixXd& gram,
                       const Eigen::VectorXd& right, double rss, double freedom) {
  const Eigen::Index n = gram.rows();
  const double left = rss - right.dot(gram.inverse() * right);
  const double variance = left / (freedom - static_cast<double>(n));
  double sum = 0.0;
  Weighed out;
  out.mean = out.precision = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(n, n);
  for (const double at : {-2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 4.5, 6.0, 8.0}) {
    if (prior.most.size() > 0 && std::exp(prior.spread * at) * prior.median(0) > prior.most(0))
      continue;  // impossible sizes
    const double weight = at <= 3.0 ? normal(at, 1.0) : at < 5.0 ? 1e-4 : at < 7.0 ? 1e-5 : 1e-6;
    const Eigen::VectorXd s2 = (std::exp(prior.spread * at) * prior.median).array().square();
    const Eigen::MatrixXd adds = variance * Eigen::MatrixXd(s2.cwiseInverse().asDiagonal());
    const Eigen::MatrixXd inverse = (gram + adds).inverse();
    const Eigen::VectorXd mean = inverse * right;
    const Eigen::MatrixXd widths =
        Eigen::MatrixXd::Identity(n, n) + s2.asDiagonal() * gram / variance;
    const double posterior = weight * std::pow(1.0 - right.dot(mean) / rss, -0.5 * freedom) /
                             std::sqrt(widths.determinant());
    sum += posterior;
    out.mean += posterior * mean;
    out.precision += posterior * adds.diagonal();
    squares += posterior * (variance * inverse + mean * mean.transpose());
  }
  out.criterion = -2.0 * std::log(sum);
  out.mean /= sum, out.precision /= sum;
  out.covariance = squares / sum - out.mean * out.mean.transpose();
  return out;
}

// Sizes from below the median to eight spreads above it. Densities that are rounded to 1 % move the
// criterion by 0.02, and the moments by 1 % of what they are about.
TEST(SizePrior, IsEquation80OverNineScales) {
  const Eigen::Vector2d median(0.05, 0.2);
  const Eigen::Matrix2d gram{{40.0, 9.0}, {9.0, 5.0}};
  const Eigen::Vector2d most = std::exp(0.8 * 1.5) * median;
  for (const SizePrior& prior : {SizePrior{median, 0.8}, SizePrior{median, 0.8, -most, most}})
    for (const double spreads : {-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 4.5, 6.0, 8.0}) {
      const Eigen::Vector2d size =
          std::exp(0.8 * spreads) * median.cwiseProduct(Eigen::Vector2d(1.0, -0.7));
      for (const double sds : {0.5, 3.0, 12.0}) {  // how well the readings show it
        const Eigen::Vector2d right = gram * size;
        const double square = size.dot(right), rss = square * (1.0 + 28.0 / (sds * sds));
        const Weighed found = weigh(prior, gram, right, gram.diagonal(), rss, 30.0);
        const Weighed expected = by_equation_80(prior, gram, right, rss, 30.0);
        SCOPED_TRACE(testing::Message() << spreads << " spreads, " << sds << " of its u");
        EXPECT_NEAR(found.criterion, expected.criterion, 0.02);
        EXPECT_LT((found.mean - expected.mean).norm(), 0.01 * size.norm());
        EXPECT_LT((found.covariance - expected.covariance).norm(),
                  0.02 * (expected.covariance.norm() + size.squaredNorm()));
        EXPECT_LT((found.precision - expected.precision).norm(), 0.02 * expected.precision.norm());
      }
    }
}

// One normal a scale: together they have weigh's mean and covariance. Few rows, so that their
// number counts.
TEST(SizePrior, ThePartsOfThePosteriorHaveItsMoments) {
  Eigen::MatrixXd table(9, 4);
  for (Eigen::Index i = 0; i < table.rows(); ++i) {
    const auto x = static_cast<double>(i);
    table.row(i) << 0.4 * std::cos(2.0 * x) + std::sin(0.7 * x * x), 1.0, std::cos(2.0 * x),
        std::cos(2.0 * x) + 0.3 * std::sin(x);
  }
  const Eigen::MatrixXd gram = table.transpose() * table;
  const infer::Projection beside(gram, {1});
  const SizePrior prior{Eigen::Vector2d(0.1, 0.3), 1.0};
  const Weighed whole = infer::weigh(prior, beside, {2, 3}, 9);
  double sum = 0.0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  for (const infer::SizePart& part : infer::size_posterior(prior, beside, {2, 3}, 9)) {
    sum += part.weight;
    mean += part.weight * part.mean;
    squares += part.weight * (part.covariance + part.mean * part.mean.transpose());
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_LT((mean - whole.mean).norm(), 1e-12);
  EXPECT_LT((squares - mean * mean.transpose() - whole.covariance).norm(), 1e-12);
}

TEST(SizePrior, WhatTheDataDoNotDetermineShrinksAndWhatTheyDoStays) {
  EXPECT_NEAR(weighed(1e6, 0.7, 0.5, 1.0).mean(0), 0.7, 1e-5);
  const Weighed loose = weighed(0.05, 6.0, 0.2, 1.0);  // 6.0 ± 4.5 where 0.2 is usual
  EXPECT_LT(std::abs(loose.mean(0)), 1.0);
  EXPECT_LT(loose.covariance(0, 0), 1.0 / 0.05);
  EXPECT_GT(loose.criterion, -1.0);  // hardly better than none
}

TEST(SizePrior, AColumnThatTheSurfaceTakesInSaysNothing) {
  const SizePrior prior{Eigen::VectorXd::Constant(1, 0.5), 1.0};
  const Weighed none =
      weigh(prior, Eigen::MatrixXd::Constant(1, 1, 1e-12), Eigen::VectorXd::Constant(1, 1e-9),
            Eigen::VectorXd::Constant(1, 1e4), 1e3, 1e3);
  EXPECT_NEAR(none.criterion, 0.0, 1e-2);
  EXPECT_EQ(none.mean(0), 0.0);
  EXPECT_GT(none.covariance(0, 0), 0.25);  // the prior alone
}

// Without a known size it is the BIC: ln N of a column that the surface leaves whole.
TEST(SizePrior, AnUnknownSizeIsTheBic) {
  const double n = 2000.0, gram = 500.0, a_hat = 0.3, rss = n + gram * a_hat * a_hat;
  const SizePrior unknown{Eigen::VectorXd::Zero(1), 1.0};
  const double criterion =
      weigh(unknown, Eigen::MatrixXd::Constant(1, 1, gram),
            Eigen::VectorXd::Constant(1, gram * a_hat), Eigen::VectorXd::Constant(1, gram), rss, n)
          .criterion;
  EXPECT_NEAR(criterion, n * std::log(1.0 - gram * a_hat * a_hat / rss) + std::log(n), 0.1);
}

// A column x in another unit has the same criterion, and a size in that unit. If there is one
// degree of freedom, of which x explains the share q, S = y²/x² and σ² = (1 − q) y² in Eq. 80.
TEST(SizePrior, AnUnknownSizeHasNoUnit) {
  const SizePrior unknown{Eigen::VectorXd::Zero(1), 1.0};
  constexpr double square = 0.3, share = 0.4;
  for (const double unit : {1e-4, 1.0, 1e3}) {
    const auto one = [](double value) { return Eigen::VectorXd::Constant(1, value); };
    const Eigen::VectorXd norm2 = one(5.0 * unit * unit);
    const Weighed found = weigh(unknown, Eigen::MatrixXd(norm2),
                                one(std::sqrt(share * norm2(0) * square)), norm2, square, 1.0);
    EXPECT_NEAR(found.criterion,
                std::log(1.0 - share / (2.0 - share)) + std::log(1.0 + 1.0 / (1.0 - share)), 1e-9);
    EXPECT_NEAR(found.mean(0) * unit, std::sqrt(share * square / 5.0) / (2.0 - share), 1e-9);
  }
  // A column of zeros has no size and costs nothing.
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(1);
  const Weighed none = weigh(unknown, Eigen::MatrixXd(zero), zero, zero, square, 10.0);
  EXPECT_EQ(none.criterion, 0.0);
  EXPECT_EQ(none.mean(0), 0.0);
}

// A sensor whose gain is 79 % off does not exist: however well the readings show it.
TEST(SizePrior, WhatIsBeyondAnySizeIsNotPossible) {
  const SizePrior gain = size_prior(of_effect("probe.gain", {}));
  EXPECT_TRUE(gain.allows(Eigen::VectorXd::Constant(1, -0.19)));
  EXPECT_FALSE(gain.allows(Eigen::VectorXd::Constant(1, -0.79)));
  const SizePrior lag = size_prior(of_effect("probe.lag", {}));
  EXPECT_FALSE(lag.allows(Eigen::VectorXd::Constant(1, -1e-4)));
  const auto found = [&](double size, double u) {
    const double gram = 1.0 / (u * u);
    return weigh(gain, Eigen::MatrixXd::Constant(1, 1, gram),
                 Eigen::VectorXd::Constant(1, gram * size), Eigen::VectorXd::Constant(1, gram),
                 1e6 + gram * size * size, 1e6 + 1.0);
  };
  EXPECT_TRUE(found(0.02, 1e-3).possible);
  EXPECT_FALSE(found(-0.79, 1e-2).possible);
  // Nor does U have such a size from what remains open: 0.2 is the largest scale.
  EXPECT_LT(found(0.0, 10.0).covariance(0, 0), 0.2 * 0.2);
}

// What σ is known by: the readings less what is fitted next to the column. Of 12 readings it tells.
TEST(SizePrior, CountsTheFreedomThatIsLeft) {
  Eigen::MatrixXd table(12, 4);
  for (Eigen::Index i = 0; i < table.rows(); ++i) {
    const auto x = static_cast<double>(i);
    table.row(i) << 0.3 * std::cos(2.0 * x) + std::sin(0.7 * x * x), 1.0, x, std::cos(2.0 * x);
  }
  const Eigen::MatrixXd gram = table.transpose() * table;
  const infer::Columns readings{0}, own{3};
  const infer::Projection beside(gram, {1, 2});
  const SizePrior prior{Eigen::VectorXd::Constant(1, 0.5), 1.0};
  const Weighed counted = infer::weigh(prior, beside, own, 12);
  const Weighed stated = weigh(prior, beside.gram(own, own), beside.gram(own, readings),
                               Eigen::VectorXd::Constant(1, gram(3, 3)), beside.rss, 12.0 - 2.0);
  EXPECT_EQ(counted.criterion, stated.criterion);
  EXPECT_EQ(counted.mean(0), stated.mean(0));
}

// Three spreads above a median of 0.5 are 0.5 e³ = 10.04, where ln of the scale has a spread of 1.
TEST(SizePrior, ASizeBeyondThreeSpreadsIsExtraordinary) {
  for (const double sign : {1.0, -1.0}) {
    EXPECT_FALSE(weighed(1e6, sign * 9.8, 0.5, 1.0).extraordinary);
    EXPECT_TRUE(weighed(1e6, sign * 10.3, 0.5, 1.0).extraordinary);
    EXPECT_FALSE(weighed(1e6, sign * 10.3, 0.0, 1.0).extraordinary);  // no size is known
    EXPECT_FALSE(weighed(1e6, sign * 0.39, 0.02, 1.0).extraordinary);
    EXPECT_TRUE(weighed(1e6, sign * 0.42, 0.02, 1.0).extraordinary);
  }
}

// 95 % of a normal law lie within 2 × 1.96 of its standard deviation.
TEST(SizePrior, TheSpreadIsThatOfARangeAndNeverSharperThanAHandbook) {
  EXPECT_NEAR(infer::spread_of_size(10.0), 10.0 / (2.0 * 1.959964), 1e-4);
  EXPECT_EQ(infer::spread_of_size(0.0), 0.7);
}

// A statement that is wrong with probability d: its likelihood counts 1 − d, that of a typical size
// d. The criterion is −2 ln of the likelihood, and the mean is weighed by it.
TEST(SizePrior, AStatedSizeThatIsDoubtedIsAMixture) {
  const double gram = 40.0, a_hat = 0.9, rss = 1e6 + gram * a_hat * a_hat;
  const auto of = [&](double stated, double doubt) {
    SizePrior prior{Eigen::VectorXd::Constant(1, 0.5), 1.0};
    prior.stated = stated, prior.doubt = doubt;
    return weigh(prior, Eigen::MatrixXd::Constant(1, 1, gram),
                 Eigen::VectorXd::Constant(1, gram * a_hat), Eigen::VectorXd::Constant(1, gram),
                 rss, 1e6 + 1.0);
  };
  const Weighed typical = of(0.0, 1.0), stated = of(0.2, 0.0);
  // A normal prior of 0.2 medians alone: its variance is 1 + gram s² times that of the posterior.
  const double s2 = 0.1 * 0.1, wider = 1.0 + gram * s2;
  EXPECT_NEAR(stated.mean(0), a_hat * gram * s2 / wider, 1e-5);
  EXPECT_NEAR(stated.criterion, std::log(wider) - gram * a_hat * a_hat * gram * s2 / wider, 1e-3);
  EXPECT_NEAR(stated.covariance(0, 0), s2 / wider, 1e-5 * s2);
  EXPECT_NEAR(stated.precision(0), 1.0 / s2, 1e-4 / s2);
  for (const double doubt : {0.05, 0.5}) {
    const Weighed both = of(0.2, doubt);
    const double a = (1.0 - doubt) * std::exp(-0.5 * stated.criterion);
    const double b = doubt * std::exp(-0.5 * typical.criterion);
    EXPECT_NEAR(both.criterion, -2.0 * std::log(a + b), 1e-8);
    EXPECT_NEAR(both.mean(0), (a * stated.mean(0) + b * typical.mean(0)) / (a + b), 1e-8);
    EXPECT_NEAR(both.precision(0), (a * stated.precision(0) + b * typical.precision(0)) / (a + b),
                1e-6);
  }
}

}  // namespace
}  // namespace trueaxis::diagnose_detail
