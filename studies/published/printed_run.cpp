// SPDX-License-Identifier: Apache-2.0
#include "studies/published/printed_run.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace trueaxis::study {

PrintedRun::Likelihood PrintedRun::of(std::span<const double> errors, double factor) const {
  const auto count = static_cast<Eigen::Index>(errors.size());
  Eigen::MatrixXd variance = factor * factor * covariance;
  for (Eigen::Index i = 0; i < count; ++i) {
    const double rounding = step[static_cast<std::size_t>(i)];
    variance(i, i) += rounding * rounding / 12.0;
  }
  // Parameters of 1e-5 and of 1: the correlation matrix is what is factored.
  const Eigen::VectorXd sd = variance.diagonal().cwiseSqrt();
  const Eigen::MatrixXd correlation =
      sd.cwiseInverse().asDiagonal() * variance * sd.cwiseInverse().asDiagonal();
  const Eigen::LLT<Eigen::MatrixXd> factored(correlation);
  const Eigen::VectorXd scaled =
      Eigen::Map<const Eigen::VectorXd>(errors.data(), count).cwiseQuotient(sd);
  const Eigen::MatrixXd lower = factored.matrixL();
  const double chi_squared = lower.triangularView<Eigen::Lower>().solve(scaled).squaredNorm();
  const double log_root = sd.array().log().sum() + lower.diagonal().array().log().sum();
  return {chi_squared, -0.5 * chi_squared - log_root -
                           0.5 * static_cast<double>(count) * std::log(2.0 * std::numbers::pi) -
                           log_printed_per_error};
}

std::vector<double> PrintedRun::in_sd(double factor) const {
  std::vector<double> out;
  for (std::size_t i = 0; i < error.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    out.push_back(error[i] / (factor * std::sqrt(covariance(at, at))));
  }
  return out;
}

double PrintedRun::as_printed(std::size_t i, double exact) const {
  return std::round((truth[i] + exact) / step[i]) * step[i] - truth[i];
}

PrintedRun printed_run(const PublishedRow& row, const PublishedReading& reading,
                       const std::vector<std::size_t>& quantity, const std::vector<double>& truth,
                       const Bound& bound) {
  const std::size_t all = truth.size(), count = quantity.size();
  PrintedRun run;
  run.covariance.resize(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const PrintedNumber& number = row.values[i];
    const double factor = reading.printed_per_error[i];
    const int decimals = std::max(number.decimals, reading.least_decimals[i]);
    run.truth.push_back(truth[quantity[i]]);
    run.error.push_back((number.value - truth[quantity[i]]) / factor);
    run.step.push_back(std::pow(10.0, -decimals) / factor);
    run.log_printed_per_error += std::log(factor);
    for (std::size_t j = 0; j < count; ++j) {
      run.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          bound.covariance[quantity[i] * all + quantity[j]];
    }
  }
  return run;
}

}  // namespace trueaxis::study
