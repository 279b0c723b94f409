// SPDX-License-Identifier: Apache-2.0
#include "spindle/joint_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/linear_algebra.hpp"
#include "math/statistics.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

constexpr int most_rounds_of_second_order = 40;
constexpr double settled = 1e-3;         // of the largest u of an amplitude, from round to round
constexpr double outlying = 8.0;         // robust σ of all that does not repeat: a chip
constexpr double least_sigma_mm = 1e-6;  // below it rounding is not Gaussian
constexpr double contradiction = 1.5;    // χ²/ν from which sensors and set-ups disagree

}  // namespace

JointEstimate::JointEstimate(std::vector<RunReadings> runs, const SpindleOptions& options)
    : runs_(std::move(runs)),
      options_(options),
      axial_(runs_.front().axial),
      sensitive_rad_(axial_ ? 0.0 : sensitive_direction(runs_, options.sensitive_rad)),
      layout_(layout_of(runs_, sensitive_rad_)),
      order_min_(axial_ && runs_.front().on_axis ? 1 : 2) {
  set_influences();
  fit();
  leave_outliers_out();
  solve();
  for (const SynchronousPart& part : parts_) linear_.push_back(part.harmonics);
  correct_until_settled();
}

/// A part e off its axis turns its lobes of order n by n e/R at most. Each round corrects by what
/// the one before has found of them, which settles up to 1 rad.
void JointEstimate::correct_until_settled() {
  if (!has_radius()) return;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const double off_mm = std::abs(eccentricity(r)), radius_mm = runs_[r].radius_mm;
    const double orders = std::floor(radius_mm / off_mm);
    if (orders >= order_max_) continue;
    throw InputError(runs_[r].stream,
                     fmt::format("the part is {:.3g} mm off the axis at a radius of {:.4g} mm, "
                                 "which shows orders up to {:.0f}: centre the part, or ask for no "
                                 "higher ones (--orders)",
                                 off_mm, radius_mm, orders));
  }
  for (int round = 0; round < most_rounds_of_second_order; ++round) {
    const std::vector<OrderSolution> before = orders_;
    correct();
    solve();
    double largest = 0.0, u = least_sigma_mm;
    for (std::size_t k = 0; k < orders_.size(); ++k) {
      largest = std::max(largest, (orders_[k].guessed - before[k].guessed).cwiseAbs().maxCoeff());
      u = std::max(u, orders_[k].u_mm.maxCoeff());
    }
    if (largest <= settled * u) return;
  }
}

bool JointEstimate::has_radius() const {
  return !axial_ && std::ranges::all_of(runs_, [](const auto& r) { return r.radius_mm > 0.0; });
}

Complex JointEstimate::eccentricity(std::size_t r) const {
  Complex sum = 0.0;
  const RunReadings& run = runs_[r];
  for (std::size_t s = 0; s < run.angles_rad.size(); ++s)
    sum += parts_[r].harmonics(static_cast<Index>(s), 1) * std::polar(1.0, -run.angles_rad[s]);
  return sum / static_cast<double>(run.angles_rad.size());
}

UncertainSeries JointEstimate::series(Index unknown) const {
  UncertainSeries out;
  const auto size = static_cast<std::size_t>(order_max_) + 1;
  out.harmonics.assign(size, 0.0);
  out.u_mm.assign(size, 0.0);
  out.u_not_noise_mm.assign(size, 0.0);
  out.moved_mm =
      Eigen::MatrixXcd::Zero(static_cast<Index>(size), static_cast<Index>(influences_.size()));
  for (std::size_t k = 0; unknown >= 0 && k < orders_.size(); ++k) {
    if (!orders_[k].determined[static_cast<std::size_t>(unknown)]) continue;
    const std::size_t n = k + static_cast<std::size_t>(order_min_);
    out.harmonics[n] = orders_[k].unknowns[unknown];
    const double u = orders_[k].u_mm[unknown], other = orders_[k].u_not_noise_mm[unknown];
    out.u_mm[n] = widening_ * std::sqrt(u * u - other * other);
    out.u_not_noise_mm[n] = widening_ * other;
    out.moved_mm.row(static_cast<Index>(n)) = orders_[k].moved_mm.row(unknown);
  }
  return out;
}

std::vector<AsynchronousMotion> JointEstimate::asynchronous(bool across) const {
  std::vector<AsynchronousMotion> out;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const auto sensors = static_cast<Index>(runs_[r].angles_rad.size());
    Eigen::MatrixXd seen(sensors, 2);
    for (const Channel& one : layout_.channels())
      if (one.run == r) seen.row(static_cast<Index>(one.sensor)) << one.along, one.across;
    const Eigen::Vector2d wanted(across ? 0.0 : 1.0, across ? 1.0 : 0.0);
    const Eigen::VectorXd weights =
        linear::least_squares(seen.transpose(), Eigen::VectorXd(wanted));
    if ((seen.transpose() * weights - wanted).norm() > 1e-6) continue;
    const Eigen::VectorXd motion = parts_[r].asynchronous_mm * weights;
    out.push_back({runs_[r].c_rad, {motion.begin(), motion.end()}});
  }
  return out;
}

void JointEstimate::set_influences() {
  const auto& channels = layout_.channels();
  std::size_t brackets = 0;
  for (const Channel& one : channels) brackets = std::max(brackets, one.bracket + 1);
  const std::size_t count = options_.u_angle_rad > 0.0 && layout_.has_across() ? brackets : 0;
  for (std::size_t b = 0; b < count; ++b) {
    influences_.push_back({options_.u_angle_rad, {}, true});
    for (std::size_t i = 0; i < channels.size(); ++i)
      if (channels[i].bracket == b) influences_.back().channels.push_back(i);
  }
  for (std::size_t r = 0; r < runs_.size() && options_.u_reindex_rad > 0.0; ++r) {
    if (!runs_[r].set_up.moved()) continue;
    influences_.push_back({options_.u_reindex_rad, {}, false});
    for (std::size_t i = 0; i < channels.size(); ++i)
      if (channels[i].run == r) influences_.back().channels.push_back(i);
  }
}

void JointEstimate::fit() {
  fits_.clear();
  parts_.clear();
  order_max_ = options_.order_max;
  for (const RunReadings& run : runs_) {
    fits_.emplace_back(run.c_rad, options_.order_max);
    order_max_ = std::min(order_max_, fits_.back().order_max());
  }
  if (order_max_ < 2)
    throw InputError(runs_.front().stream,
                     "too few readings per revolution, or part of the revolution is missing (" +
                         gap_words(fits_.back().gap()) +
                         "): record at least 6 readings evenly around the revolution");
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    parts_.push_back(fits_[r](runs_[r].columns_mm));
    expect_no_gap(runs_[r], fits_[r], parts_[r]);
  }
}

void JointEstimate::leave_outliers_out() {
  bool any = false;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const Eigen::MatrixXd& left = parts_[r].asynchronous_mm;
    std::vector<bool> marks(runs_[r].c_rad.size(), false);
    const double per_turn = static_cast<double>(marks.size()) / fits_[r].turns();
    for (Index s = 0; s < left.cols(); ++s) {
      // σ counts the asynchronous motion, which moves readings of every turn.
      const std::span<const double> moving(left.col(s).data(), marks.size());
      const std::vector<double> off = outside_usual(runs_[r].c_rad, moving, per_turn);
      const double limit = outlying * std::max(mad_sigma(moving), least_sigma_mm);
      for (std::size_t i = 0; i < marks.size(); ++i) marks[i] = marks[i] || off[i] > limit;
    }
    if (std::ranges::find(marks, true) == marks.end()) continue;
    leave_out(runs_[r], marks);
    any = true;
  }
  if (any) fit();
}

void JointEstimate::solve() {
  orders_ = separate(layout_, parts_, influences_,
                     {order_min_, order_max_, options_.largest_condition, options_.coverage_factor,
                      remainder_mm_});
  double chi_squared = 0.0, freedom = 0.0, contradicted = 0.0, read = 0.0;
  for (const OrderSolution& one : orders_) {
    chi_squared += one.chi_squared;
    freedom += one.freedom;
    contradicted += one.contradicted_mm2;
    read += 0.5 * one.freedom * one.read_mm2;
  }
  contradicted_share_ = read > 0.0 ? std::sqrt(contradicted / read) : 0.0;
  disagreement_ = freedom > 0.0 ? chi_squared / freedom : std::numeric_limits<double>::quiet_NaN();
  widening_ = disagreement_ > contradiction ? std::sqrt(disagreement_) : 1.0;
}

void JointEstimate::correct() {
  const Series form = guessed(layout_.form()), along = guessed(layout_.along());
  const Series across = guessed(layout_.across());
  remainder_mm_ = remainder(form, along);
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const PartInRun part{eccentricity(r), form, along, across};
    for (std::size_t s = 0; s < runs_[r].angles_rad.size(); ++s) {
      const Series left = second_order(runs_[r], s, sensitive_rad_, part, order_max_);
      for (int n = 0; n <= order_max_; ++n) {
        const auto at = static_cast<Index>(s);
        parts_[r].harmonics(at, n) = linear_[r](at, n) - left[static_cast<std::size_t>(n)];
      }
    }
  }
}

/// An unknown over the orders, those that are not determined as the shortest solution has them.
Series JointEstimate::guessed(Index unknown) const {
  Series out(static_cast<std::size_t>(order_max_) + 1, 0.0);
  for (std::size_t k = 0; unknown >= 0 && k < orders_.size(); ++k)
    out[k + static_cast<std::size_t>(order_min_)] = orders_[k].guessed[unknown];
  return out;
}

/// What the second order may still leave in one amplitude (Eq. 149): motion across that no sensor
/// sees taken as large as that along, form of suppressed orders as unknown as it is large.
double JointEstimate::remainder(const Series& form, const Series& along) const {
  double offset = 0.0, moved = 0.0, slope = 0.0, unknown_slope = 0.0;  // squares
  for (std::size_t r = 0; r < runs_.size(); ++r)
    offset = std::max(offset, 0.5 * std::norm(eccentricity(r)));
  for (std::size_t n = 0; n < form.size(); ++n) {
    const double order = static_cast<double>(n);
    moved += 0.5 * std::norm(along[n]);
    slope += 0.5 * order * order * std::norm(form[n]);
  }
  for (std::size_t k = 0; k < orders_.size(); ++k) {
    if (!layout_.has_form() || orders_[k].determined[static_cast<std::size_t>(layout_.form())])
      continue;
    const double n = static_cast<double>(k) + order_min_;
    unknown_slope += 0.5 * n * n * std::norm(orders_[k].guessed[layout_.form()]);
  }
  const double unseen = layout_.has_across() ? 0.0 : moved;
  // Sensors may err alike: twice that of one.
  const double square = 2.0 * (unseen * slope + (offset + moved) * unknown_slope);
  return std::sqrt(square / static_cast<double>(orders_.size())) / runs_.front().radius_mm;
}

}  // namespace trueaxis
