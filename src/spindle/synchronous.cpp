// SPDX-License-Identifier: Apache-2.0
#include "spindle/synchronous.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "math/fourier_sums.hpp"
#include "math/statistics.hpp"
#include "spindle/near_motion.hpp"
#include "spindle/values.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

constexpr int most_orders = 360;          // beyond it what repeats counts as asynchronous
constexpr std::size_t lines_wanted = 32;  // of a covariance: u to 9 %
constexpr double trace = 0.01;            // RMS over that of all orders: what the second order does
constexpr double least_excess = 4.0;      // σ of a mean power above that of noise

/// Legendre P1 … P3 over the order of the readings, −1 … 1.
std::vector<std::vector<double>> drift_columns(std::size_t readings, std::size_t degrees) {
  std::vector<std::vector<double>> columns(degrees, std::vector<double>(readings));
  for (std::size_t i = 0; i < readings; ++i) {
    const double u = 2.0 * static_cast<double>(i) / static_cast<double>(readings - 1) - 1.0;
    double before = 1.0, now = u;
    for (std::size_t l = 1; l <= degrees; ++l) {
      columns[l - 1][i] = now;
      const double k = static_cast<double>(l);
      const double next = ((2.0 * k + 1.0) * u * now - k * before) / (k + 1.0);
      before = now, now = next;
    }
  }
  return columns;
}

/// Mean of the lines. One that is far above the others is a motion of its own, which reaches
/// the order by its leakage only: |sin(πj)/(πj)|², ½/(πj)² in the mean over where it really lies.
Eigen::MatrixXcd covariance_of(const std::vector<NearLine>& near) {
  std::vector<double> powers;
  for (const NearLine& line : near) powers.push_back(line.at.squaredNorm());
  const double usual = median(powers);
  const Index sensors = near.front().at.size();
  Eigen::MatrixXcd mean = Eigen::MatrixXcd::Zero(sensors, sensors);
  Eigen::MatrixXcd leakage = mean;
  double taken = 0.0;
  for (const NearLine& line : near) {
    const double phase = 0.5 * two_pi * line.away;
    if (std::abs(line.away) >= least_away && line.at.squaredNorm() > standing_out * usual) {
      leakage += 0.5 / (phase * phase) * line.at * line.at.adjoint();
    } else {
      mean += line.at * line.at.adjoint();
      taken += 1.0;
    }
  }
  return mean / taken + leakage;
}

}  // namespace

std::string gap_words(const Gap& gap) {
  return fmt::format("from C = {:.1f}° to {:.1f}° ({:.1f}° of every revolution)",
                     gap.from_rad / rad_per_deg, std::fmod(gap.to_rad / rad_per_deg, 360.0),
                     (gap.to_rad - gap.from_rad) / rad_per_deg);
}

SynchronousFit::SynchronousFit(std::span<const double> c_rad, int wanted)
    : c_rad_(c_rad.begin(), c_rad.end()),
      drift_(drift_columns(c_rad.size(), drift)),
      wanted_(wanted) {
  const double readings = static_cast<double>(c_rad.size());
  const auto [low, high] = std::ranges::minmax(c_rad);
  turns_ = (high - low) / two_pi * readings / (readings - 1.0);
  const int nyquist = static_cast<int>(std::floor(0.5 * (readings / turns_ - 1.0) + 1e-3));
  // Turns that do not repeat the same angles carry more orders than one turn does.
  interleaved_ =
      nyquist < wanted && readings > 3.0 * (2.0 * wanted + 1.0 + drift) && prepare(wanted);
  const int even = std::min(nyquist, std::max(most_orders, wanted));
  int orders = even;
  while (!interleaved_ && orders > 0 && !prepare(orders)) orders = 3 * orders / 4;
  // A gap hides an undulation of an order that evenly spaced readings carry.
  const Gap widest = gap();
  cut_ = orders < even && even * (widest.to_rad - widest.from_rad) > two_pi;
  carried_ = interleaved_ ? wanted_ : std::clamp(orders, 0, wanted_);
}

Gap SynchronousFit::gap() const {
  std::vector<double> at;
  for (const double c : c_rad_) at.push_back(c - two_pi * std::floor(c / two_pi));
  std::ranges::sort(at);
  Gap widest{at.back(), at.front() + two_pi};
  for (std::size_t i = 1; i < at.size(); ++i)
    if (at[i] - at[i - 1] > widest.to_rad - widest.from_rad) widest = {at[i - 1], at[i]};
  return widest;
}

/// An analysis of variance at each angle: the mean, and what is about it (Eq. 432). A ratio of mean
/// squares of ν₁ and ν₂ degrees of freedom has the variance 2/ν₁ + 2/ν₂.
bool SynchronousFit::leaves_what_repeats(const SynchronousPart& part) const {
  std::vector<double> steps;
  for (std::size_t i = 1; i < c_rad_.size(); ++i)
    steps.push_back(std::abs(c_rad_[i] - c_rad_[i - 1]));
  const auto places =
      static_cast<std::size_t>(std::max(1.0, two_pi / median(std::move(steps)) + 0.5));
  const Index sensors = part.asynchronous_mm.cols();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(static_cast<Index>(places), sensors);
  Eigen::VectorXd count = Eigen::VectorXd::Zero(sum.rows());
  for (std::size_t i = 0; i < c_rad_.size(); ++i) {
    const auto at = static_cast<Index>(place_in_turn(c_rad_[i], places));
    sum.row(at) += part.asynchronous_mm.row(static_cast<Index>(i));
    count[at] += 1.0;
  }
  const double occupied = static_cast<double>((count.array() > 0.0).count());
  const double between = occupied - (2.0 * fitted_ + 1.0);
  const double within = static_cast<double>(c_rad_.size()) - occupied;
  if (!(between > 0.0 && within > 0.0)) return false;
  const double most = 1.0 + least_excess * std::sqrt(2.0 / between + 2.0 / within);
  for (Index s = 0; s < sensors; ++s) {
    const double repeats = sum.col(s).cwiseAbs2().cwiseQuotient(count.cwiseMax(1.0)).sum();
    const double rest = part.asynchronous_mm.col(s).squaredNorm() - repeats;
    if (repeats / between > most * rest / within) return true;
  }
  return false;
}

/// The normal matrix of 1, drift, cos nC, sin nC from sums of cos kC and sin kC, k ≤ 2N. False
/// where the angles do not tell the orders apart.
bool SynchronousFit::prepare(int orders) {
  fitted_ = orders;
  const auto N = static_cast<std::size_t>(orders);
  std::vector<double> ones(c_rad_.size(), 1.0);
  const auto sums = FourierSums(c_rad_, 0.0, 1.0, 2 * N + 1).of(ones);
  const FourierSums half(c_rad_, 0.0, 1.0, N + 1);
  const Index size = 2 * orders + 1 + drift;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(size, size);
  const auto cosine = [&](int k) { return sums[static_cast<std::size_t>(std::abs(k))].real(); };
  const auto sine = [&](int k) {
    return (k < 0 ? 1.0 : -1.0) * sums[static_cast<std::size_t>(std::abs(k))].imag();
  };
  const auto at_cos = [](int n) { return Index{n == 0 ? 0 : drift + 2 * n - 1}; };
  for (int n = 0; n <= orders; ++n) {
    for (int m = 0; m <= n; ++m) {
      normal(at_cos(n), at_cos(m)) = 0.5 * (cosine(n - m) + cosine(n + m));
      if (n > 0) normal(at_cos(n) + 1, at_cos(m)) = 0.5 * (sine(n + m) + sine(n - m));
      if (m > 0) normal(at_cos(n), at_cos(m) + 1) = 0.5 * (sine(n + m) - sine(n - m));
      if (m > 0) normal(at_cos(n) + 1, at_cos(m) + 1) = 0.5 * (cosine(n - m) - cosine(n + m));
    }
  }
  for (int l = 0; l < drift; ++l) {
    const auto& column = drift_[static_cast<std::size_t>(l)];
    const auto moved = half.of(column);
    normal(1 + l, 0) = moved[0].real();
    for (int n = 1; n <= orders; ++n) {
      normal(at_cos(n), 1 + l) = moved[static_cast<std::size_t>(n)].real();
      normal(at_cos(n) + 1, 1 + l) = -moved[static_cast<std::size_t>(n)].imag();
    }
    for (int m = 0; m <= l; ++m) {
      const auto& other = drift_[static_cast<std::size_t>(m)];
      double sum = 0.0;
      for (std::size_t i = 0; i < column.size(); ++i) sum += column[i] * other[i];
      normal(1 + l, 1 + m) = sum;
    }
  }
  normal_ = linear::Cholesky(normal);
  if (!normal_.positive_definite() || normal_.reciprocal_condition() < 1e-2) return false;
  const int top = std::min(wanted_, orders);
  const double even = 2.0 / static_cast<double>(c_rad_.size());
  inflation_.assign(static_cast<std::size_t>(top) + 1, 1.0);
  for (int n = 1; n <= top; ++n) {
    Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(size, 2);
    unit(at_cos(n), 0) = unit(at_cos(n) + 1, 1) = 1.0;
    const Eigen::MatrixXd inverse = normal_.solve(unit);
    inflation_[static_cast<std::size_t>(n)] =
        0.5 * (inverse(at_cos(n), 0) + inverse(at_cos(n) + 1, 1)) / even;
  }
  return true;
}

Eigen::VectorXd SynchronousFit::right_side(std::span<const double> column,
                                           const std::vector<Complex>& sums) const {
  Eigen::VectorXd right(2 * fitted_ + 1 + drift);
  right[0] = sums[0].real();
  for (int l = 0; l < drift; ++l) {
    double sum = 0.0;
    const auto& moved = drift_[static_cast<std::size_t>(l)];
    for (std::size_t i = 0; i < column.size(); ++i) sum += moved[i] * column[i];
    right[1 + l] = sum;
  }
  for (int n = 1; n <= fitted_; ++n) {
    right[drift + 2 * n - 1] = sums[static_cast<std::size_t>(n)].real();
    right[drift + 2 * n] = -sums[static_cast<std::size_t>(n)].imag();
  }
  return right;
}

std::vector<double> SynchronousFit::residuals(const std::vector<double>& column,
                                              const Eigen::VectorXd& solution) const {
  std::vector<double> left(column.size());
  for (std::size_t i = 0; i < column.size(); ++i) {
    double model = solution[0];
    for (int l = 0; l < drift; ++l)
      model += solution[1 + l] * drift_[static_cast<std::size_t>(l)][i];
    const Complex step = std::polar(1.0, c_rad_[i]);
    Complex sum = 0.0;  // Horner in exp(iC)
    for (int n = fitted_; n >= 1; --n)
      sum = (sum + Complex(solution[drift + 2 * n - 1], -solution[drift + 2 * n])) * step;
    left[i] = column[i] - model - sum.real();
  }
  return left;
}

void SynchronousFit::add_covariance(SynchronousPart& part) const {
  const auto L = static_cast<std::size_t>(std::max(2.0, std::round(turns_)));  // lines an order
  const std::size_t top = static_cast<std::size_t>(carried_);
  const std::size_t reach = (std::max<std::size_t>(1, lines_wanted / L) + 1) * L;
  const std::size_t count = top * L + reach + 1;
  const FourierSums lines(c_rad_, 0.0, 1.0 / static_cast<double>(L), count);
  const double begin_rad = std::ranges::min(c_rad_);
  const Index sensors = part.asynchronous_mm.cols();
  std::vector<std::span<const double>> columns;
  for (Index s = 0; s < sensors; ++s)
    columns.emplace_back(part.asynchronous_mm.col(s).data(), c_rad_.size());
  const auto sums = lines.of(columns);
  const double scale = 2.0 / static_cast<double>(c_rad_.size());
  part.freedom = static_cast<double>(lines_wanted);
  for (std::size_t n = 0; n <= top; ++n) {
    std::vector<NearLine> near;
    const auto take = [&](std::size_t line, double away) {
      Eigen::VectorXcd at(sensors);
      const Complex turned = std::polar(scale, away / static_cast<double>(L) * begin_rad);
      for (Index s = 0; s < sensors; ++s) at[s] = turned * sums[static_cast<std::size_t>(s)][line];
      near.push_back({std::move(at), away});
    };
    // The nearest lines on both sides that are not an order; below half an order is the drift.
    for (std::size_t j = 1; near.size() < lines_wanted && j <= reach; ++j) {
      if (j % L == 0) continue;
      const auto away = static_cast<double>(j);
      if (n * L > j + L / 2) take(n * L - j, -away);
      if (n * L + j > L / 2 && n * L + j < count) take(n * L + j, away);
    }
    part.freedom = std::min(part.freedom, static_cast<double>(near.size()));
    const NearMotion motion = n < 2 ? NearMotion{} : take_motion(near);
    part.covariance.push_back(inflation_[n] * covariance_of(near));
    if (motion.in_order.size() == 0) continue;
    part.covariance.back() += motion.covariance;
    part.harmonics.col(static_cast<Index>(n)) -= motion.in_order;
    for (std::size_t i = 0; i < c_rad_.size(); ++i)
      part.asynchronous_mm.row(static_cast<Index>(i)) +=
          (std::polar(1.0, static_cast<double>(n) * c_rad_[i]) * motion.in_order.transpose())
              .real();
  }
}

/// Orders above half the readings of a turn read like lower ones. They are taken as large as the
/// highest fitted orders are, as far as these are more than noise and than a trace of all orders.
double SynchronousFit::folded_mm2(const Eigen::VectorXd& solution, double noise_mm2) const {
  if (interleaved_) return 0.0;
  const auto [first, last] = end_orders();
  const double count = last - first + 1;
  const double mean = solution.tail(2 * (last - first + 1)).squaredNorm() / count;
  const double all = solution.tail(2 * (last - 1)).squaredNorm();
  const double most_noise =
      noise_mm2 * (1.0 + least_excess * std::sqrt(1.0 / count + 1.0 / lines_wanted));
  return mean > std::max(most_noise, trace * trace * all) ? mean - noise_mm2 : 0.0;
}

SynchronousPart SynchronousFit::operator()(std::span<const std::vector<double>> columns) const {
  const FourierSums fourier(c_rad_, 0.0, 1.0, static_cast<std::size_t>(fitted_) + 1);
  const std::vector<std::span<const double>> views(columns.begin(), columns.end());
  const auto sums = fourier.of(views);
  SynchronousPart part;
  const auto sensors = static_cast<Index>(columns.size());
  part.harmonics = Eigen::MatrixXcd::Zero(sensors, carried_ + 1);
  part.asynchronous_mm.resize(static_cast<Index>(c_rad_.size()), sensors);
  part.free_share = 1.0 - (2.0 * fitted_ + 1.0 + drift) / static_cast<double>(c_rad_.size());
  std::vector<Eigen::VectorXd> solutions;
  for (Index s = 0; s < sensors; ++s) {
    const auto& column = columns[static_cast<std::size_t>(s)];
    solutions.push_back(normal_.solve(right_side(column, sums[static_cast<std::size_t>(s)])));
    const Eigen::VectorXd& solution = solutions.back();
    part.harmonics(s, 0) = solution[0];
    for (int n = 1; n <= carried_; ++n)
      part.harmonics(s, n) = Complex(solution[drift + 2 * n - 1], -solution[drift + 2 * n]);
    const std::vector<double> left = residuals(column, solution);
    part.asynchronous_mm.col(s) =
        Eigen::Map<const Eigen::VectorXd>(left.data(), static_cast<Index>(left.size()));
  }
  add_covariance(part);
  part.white_mm2.resize(sensors);
  part.folded_mm2.resize(sensors);
  for (Index s = 0; s < sensors; ++s) {
    std::vector<double> powers;
    for (const Eigen::MatrixXcd& one : part.covariance) powers.push_back(one(s, s).real());
    part.white_mm2[s] = median(std::move(powers)) * (1.0 + least_excess / std::sqrt(lines_wanted));
  }
  for (Index s = 0; s < sensors; ++s)
    part.folded_mm2[s] =
        folded_mm2(solutions[static_cast<std::size_t>(s)], part.covariance.back()(s, s).real());
  return part;
}

}  // namespace trueaxis
