// SPDX-License-Identifier: Apache-2.0
#include "form/low_pass.hpp"

#include <Eigen/Sparse>
#include <cmath>
#include <numbers>

#include "form/regression_rows.hpp"
#include "math/statistics.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::form {
namespace {

/// α of ISO 16610-21: exp(−π α²) = 1/2.
const double alpha = std::sqrt(std::numbers::ln2 / std::numbers::pi);
/// γ of the regression of second degree, (1 + π γ²) exp(−π γ²) = 1/2 (ISO 16610-31: 0.7309).
constexpr double gamma_of_second_degree = 0.7309134280946759;
/// 3 σ of Gaussian readings in medians of their absolute values.
constexpr double medians_to_cut = 4.4478;
constexpr int most_reweightings = 100;
constexpr double cut_settled = 1e-5;

}  // namespace

double longest_step(double cutoff) { return 0.5 * cutoff; }

double gaussian_transmission(double cutoff, double wavelength) {
  const double f = alpha * cutoff / wavelength;
  return std::exp(-std::numbers::pi * f * f);
}

double robust_transmission(double cutoff, double wavelength) {
  const double f = gamma_of_second_degree * cutoff / wavelength, u = std::numbers::pi * f * f;
  return (1.0 + u) * std::exp(-u);
}

std::unique_ptr<LowPass> gaussian_low_pass(const Trace& trace, double cutoff) {
  return std::make_unique<RegressionRows>(trace, RegressionRows::Kernel{alpha * cutoff, 1},
                                          shares_of(trace, longest_step(cutoff)));
}

std::unique_ptr<LowPass> robust_low_pass(const Trace& trace, double cutoff) {
  const RegressionRows::Kernel kernel{gamma_of_second_degree * cutoff, 2};
  const std::vector<double> shares = shares_of(trace, longest_step(cutoff));
  auto rows = std::make_unique<RegressionRows>(trace, kernel, shares);
  double before = 0.0;
  for (int round = 0; round < most_reweightings; ++round) {
    std::vector<double> off = (*rows)(trace.value_mm);
    for (std::size_t i = 0; i < off.size(); ++i) off[i] = std::abs(trace.value_mm[i] - off[i]);
    const double cut = medians_to_cut * median(off);
    if (!(cut > 0.0) || std::abs(cut - before) <= cut_settled * cut) break;
    before = cut;
    std::vector<double> weight(shares);
    for (std::size_t i = 0; i < off.size(); ++i) {
      const double t = off[i] / cut;
      weight[i] *= t < 1.0 ? (1.0 - t * t) * (1.0 - t * t) : 0.0;
    }
    rows = std::make_unique<RegressionRows>(trace, kernel, weight);
  }
  return rows;
}

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Second differences by the true places in units of the `step`² of even ones, each times the root
/// of its share; none reaches over a gap. Eq. 264.
Sparse second_differences(const Trace& trace, double step, double longest) {
  const auto n = static_cast<Eigen::Index>(trace.size());
  std::vector<Eigen::Triplet<double>> entries;
  const Eigen::Index begin = trace.closed() ? 0 : 1, end = trace.closed() ? n : n - 1;
  for (Eigen::Index i = begin; i < end; ++i) {
    const Eigen::Index before = (i + n - 1) % n, behind = (i + 1) % n;
    const double h1 = trace.step(static_cast<std::size_t>(before)) / step;
    const double h2 = trace.step(static_cast<std::size_t>(i)) / step;
    if (h1 * step > longest || h2 * step > longest) continue;
    const double share = std::sqrt(0.5 * (h1 + h2)), both = h1 + h2;
    entries.emplace_back(i, before, share * 2.0 / (h1 * both));
    entries.emplace_back(i, i, -share * 2.0 / (h1 * h2));
    entries.emplace_back(i, behind, share * 2.0 / (h2 * both));
  }
  Sparse differences(n, n);
  differences.setFromTriplets(entries.begin(), entries.end());
  return differences;
}

class SplineFilter final : public LowPass {
 public:
  SplineFilter(const Trace& trace, double cutoff) {
    std::vector<double> steps;
    for (std::size_t i = 0; i + (trace.closed() ? 0 : 1) < trace.size(); ++i)
      steps.push_back(trace.step(i));
    const double step = median(steps), longest = longest_step(cutoff);
    share_ = shares_of(trace, longest);
    for (double& one : share_) one /= step;
    // α⁴ of Eq. 264; beyond the shortest wave that the readings show nothing is smoothed.
    const double s = 2.0 * std::sin(std::numbers::pi * std::min(0.5, step / cutoff));
    const Sparse d = second_differences(trace, step, longest);
    Sparse matrix = d.transpose() * d;
    matrix *= 1.0 / (s * s * s * s);
    for (std::size_t i = 0; i < share_.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      matrix.coeffRef(at, at) += share_[i];
    }
    matrix.makeCompressed();
    solver_.compute(matrix);
    expects(solver_.info() == Eigen::Success, "the matrix of a spline filter is positive definite");
  }

  std::vector<double> operator()(std::span<const double> value_mm) const override {
    expects(value_mm.size() == share_.size(), "a value for every place");
    Eigen::VectorXd right(static_cast<Eigen::Index>(share_.size()));
    for (std::size_t i = 0; i < share_.size(); ++i)
      right[static_cast<Eigen::Index>(i)] = share_[i] * value_mm[i];
    const Eigen::VectorXd out = solver_.solve(right);
    return {out.begin(), out.end()};
  }

 private:
  std::vector<double> share_;
  Eigen::SimplicialLDLT<Sparse> solver_;
};

}  // namespace

double spline_transmission(double cutoff, double wavelength, double step) {
  const double ratio =
      std::sin(std::numbers::pi * step / wavelength) / std::sin(std::numbers::pi * step / cutoff);
  return 1.0 / (1.0 + ratio * ratio * ratio * ratio);
}

std::unique_ptr<LowPass> spline_low_pass(const Trace& trace, double cutoff) {
  return std::make_unique<SplineFilter>(trace, cutoff);
}

}  // namespace trueaxis::form
