// SPDX-License-Identifier: Apache-2.0
#include "form/surface_model.hpp"

#include <algorithm>
#include <array>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cmath>
#include <numeric>

#include "form/exchange.hpp"
#include "form/sampling.hpp"
#include "form/swallowed.hpp"
#include "math/linear_algebra.hpp"
#include "math/statistics.hpp"

namespace trueaxis::form {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int least_draws = 100;
constexpr std::size_t least_angles = 8;     // of a section: a circle and some form
constexpr double orders_over_cutoff = 1.5;  // the filter lets 21 % of these through
constexpr std::size_t readings_an_order = 5;
constexpr int fewest_degrees = 2, most_degrees = 12;
constexpr double degrees_a_turn = 1.25, stations_a_degree = 1.5;
constexpr int between_stations = 16;  // places that are looked at
constexpr double seen = 0.05, certain = 0.999;
constexpr std::size_t angles_a_wave = 32, angles_of_doubtful = 3;  // an order more likely absent
constexpr double angles_a_width = 6.0;  // of a local form: its top is read 0.3 % low
constexpr std::size_t fewest_angles = 96, most_angles = 720;
constexpr double turns_about_a_station = 3.0;
constexpr double widest_of_steps = 2.5;  // of a turn's: a step that is not a gap
constexpr int alignments = 3;
constexpr double robust_medians = 4.4478;  // 3 σ of normal noise

}  // namespace

SurfaceModel::SurfaceModel(const SurfaceReadings& readings, const FormOptions& options)
    : options_(options),
      turns_(readings.turns),
      per_turn_(static_cast<double>(readings.size()) / readings.turns),
      radius_known_(readings.radius_known) {
  put_about_axis(readings);
  const auto most =
      static_cast<int>(std::min<std::size_t>(readings.size() / readings_an_order, 75));
  terms_.orders = std::clamp(static_cast<int>(std::ceil(orders_over_cutoff * options.high_upr)), 2,
                             std::max(2, most));
  terms_.degrees =
      std::clamp(static_cast<int>(degrees_a_turn * turns_), fewest_degrees, most_degrees);
  sample();
  if (options.filter == ProfileFilter::robust_gaussian && leave_out_far()) sample();
  for (int n = 0; n <= terms_.orders; ++n) band_.push_back(passed_by_band(options, n));
  make_grid();
  find_unfollowed();
}

/// Deviations from a cone about its axis: where the radius is known, as distances from that axis.
void SurfaceModel::put_about_axis(const SurfaceReadings& readings) {
  const auto [low, high] = range_of(readings.z_mm);
  middle_mm_ = 0.5 * (low + high);
  half_mm_ = std::max(0.5 * (high - low), 1e-9);
  z_mm_ = readings.z_mm;
  for (const double z : z_mm_) t_.push_back((z - middle_mm_) / half_mm_);
  angle_rad_ = readings.angle_rad;
  off_mm_ = readings.distance_mm;
  for (const double one : off_mm_) radius_mm_ += one / static_cast<double>(off_mm_.size());
  for (double& one : off_mm_) one -= radius_mm_;
  for (int round = 0; radius_known_ && round < alignments; ++round) {
    Exchange::Rows rows(static_cast<Index>(t_.size()), 6);
    for (std::size_t i = 0; i < t_.size(); ++i) {
      const double c = std::cos(angle_rad_[i]), s = std::sin(angle_rad_[i]);
      rows.row(static_cast<Index>(i)) << 1.0, t_[i], c, s, t_[i] * c, t_[i] * s;
    }
    const VectorXd q = Exchange(std::move(rows), Criterion::gaussian)(off_mm_).q;
    axis_.l += q[4] / half_mm_;
    axis_.m += q[5] / half_mm_;
    axis_.x0_mm += q[2] - q[4] / half_mm_ * middle_mm_;
    axis_.y0_mm += q[3] - q[5] / half_mm_ * middle_mm_;
    for (std::size_t i = 0; i < t_.size(); ++i) {
      const auto [x0, y0] = axis_.at(z_mm_[i]);
      const double x = readings.distance_mm[i] * std::cos(readings.angle_rad[i]) - x0;
      const double y = readings.distance_mm[i] * std::sin(readings.angle_rad[i]) - y0;
      angle_rad_[i] = std::atan2(y, x);
      off_mm_[i] = std::hypot(x, y) - radius_mm_;
    }
  }
}

void SurfaceModel::sample() {
  posterior_ = sample_surface(terms_, {angle_rad_, t_, off_mm_, turns_},
                              {.draws = std::max(options_.trials, least_draws),
                               .seed = options_.seed,
                               .least_noise_mm = options_.noise_mm.value_or(0.0)});
  keep_coefficients();
}

std::vector<double> SurfaceModel::left_mm() const {
  std::vector<double> left;
  for (std::size_t i = 0; i < t_.size(); ++i)
    left.push_back(off_mm_[i] - height_of(terms_, posterior_.local, mean_, angle_rad_[i], t_[i]));
  return left;
}

/// Those that Eq. 263 gives no weight.
bool SurfaceModel::leave_out_far() {
  std::vector<double> off = left_mm();
  for (double& one : off) one = std::abs(one);
  const double most = robust_medians * median(off);
  kept_.clear();
  for (std::size_t i = 0; i < off.size(); ++i)
    if (off[i] < most) kept_.push_back(i);
  if (kept_.size() == off.size()) return false;
  for (std::vector<double>* column : {&angle_rad_, &t_, &z_mm_, &off_mm_})
    *column = kept_of(*column);
  return true;
}

std::vector<double> SurfaceModel::kept_of(std::span<const double> column) const {
  std::vector<double> out;
  for (const std::size_t i : kept_) out.push_back(column[i]);
  return out;
}

void SurfaceModel::keep_coefficients() {
  mean_ = posterior_.coefficients.rowwise().mean();
  spread_ = ((posterior_.coefficients.colwise() - mean_).array().square().rowwise().sum() /
             static_cast<double>(draws() - 1))
                .sqrt();
  noise_mm_ = std::accumulate(posterior_.noise_mm.begin(), posterior_.noise_mm.end(), 0.0) /
              static_cast<double>(draws());
  const auto count = LocalForm::columns * static_cast<Index>(posterior_.local.size());
  local_.assign(static_cast<std::size_t>(terms_.orders) + 1, Eigen::MatrixXd(2, count));
  for (int n = 0; n <= terms_.orders; ++n)
    for (std::size_t k = 0; k < posterior_.local.size(); ++k)
      local_[static_cast<std::size_t>(n)].middleCols<LocalForm::columns>(
          LocalForm::columns * static_cast<Index>(k)) = posterior_.local[k].around(n);
}

SurfaceModel::Place SurfaceModel::place_of(double t) const {
  Place out{along(terms_.degrees, t), Eigen::RowVectorXd(local_.front().cols())};
  for (std::size_t k = 0; k < posterior_.local.size(); ++k)
    out.local.segment<LocalForm::columns>(LocalForm::columns * static_cast<Index>(k)) =
        posterior_.local[k].along(t);
  return out;
}

void SurfaceModel::make_grid() {
  std::size_t count = fewest_angles;
  for (int n = 2; n <= terms_.orders; ++n) {
    const double share = posterior_.order_is_there[n];
    const std::size_t a_wave = share > 0.5 ? angles_a_wave : share > seen ? angles_of_doubtful : 0;
    count = std::max(count, a_wave * static_cast<std::size_t>(n));
  }
  for (const LocalForm& one : posterior_.local)
    count = std::max(count, static_cast<std::size_t>(angles_a_width * two_pi / one.width_rad));
  count = std::min(count, most_angles);
  for (std::size_t k = 0; k < count; ++k) {
    const double angle = two_pi * static_cast<double>(k) / static_cast<double>(count);
    cosine_.push_back(std::cos(angle));
    sine_.push_back(std::sin(angle));
  }
  std::vector<std::size_t> by_z(z_mm_.size());
  std::iota(by_z.begin(), by_z.end(), std::size_t{0});
  std::ranges::stable_sort(by_z, {}, [&](std::size_t i) { return z_mm_[i]; });
  for (const double t : station_places()) add_station(middle_mm_ + half_mm_ * t, by_z);
  for (Station& station : stations_) station.orders = orders_at(station);
  for (const double z : z_mm_)
    ++std::ranges::min_element(stations_, {}, [&](const Station& station) {
        return std::abs(station.z_mm - z);
      })->readings;
}

/// Even steps over −1 … 1, and where lobes, radius and distance from the axis of the mean are
/// largest and the radius is smallest: the extremes else lie between two.
std::vector<double> SurfaceModel::station_places() const {
  const int steps = static_cast<int>(stations_a_degree * terms_.degrees) * between_stations;
  std::array<double, 4> largest{}, there{};
  std::vector<double> out;
  for (int s = 0; s <= steps; ++s) {
    const double t = 2.0 * s / steps - 1.0;
    if (s % between_stations == 0) out.push_back(t);
    const Place at = place_of(t);
    const double radius = amplitudes(at, 0, mean_)[0];
    double lobes = 0.0;
    for (int n = 2; n <= terms_.orders; ++n)
      lobes += (band_[static_cast<std::size_t>(n)] * amplitudes(at, n, mean_)).squaredNorm();
    const std::array<double, 4> sizes{lobes, radius, -radius, amplitudes(at, 1, mean_).norm()};
    for (std::size_t k = 0; k < sizes.size(); ++k)
      if (s == 0 || sizes[k] > largest[k]) largest[k] = sizes[k], there[k] = t;
  }
  out.insert(out.end(), there.begin(), there.end());
  for (const LocalForm& one : posterior_.local) out.push_back(one.t);
  std::ranges::sort(out);
  out.erase(std::ranges::unique(out).begin(), out.end());
  return out;
}

/// The angles of the grid, without those in an interruption of the readings of some turns about it.
void SurfaceModel::add_station(double z_mm, std::span<const std::size_t> by_z) {
  Station station;
  station.z_mm = z_mm;
  station.at = place_of((z_mm - middle_mm_) / half_mm_);
  const auto most = static_cast<std::size_t>(std::ceil(turns_about_a_station * per_turn_));
  const std::size_t count = std::min(std::max<std::size_t>(most, 8), by_z.size());
  const auto behind =
      std::ranges::lower_bound(by_z, z_mm, {}, [&](std::size_t i) { return z_mm_[i]; });
  const auto middle = static_cast<std::size_t>(behind - by_z.begin());
  const std::size_t first =
      std::min(middle > count / 2 ? middle - count / 2 : 0, by_z.size() - count);
  std::vector<double> angles;
  for (std::size_t k = first; k < first + count; ++k) angles.push_back(angle_rad_[by_z[k]]);
  const std::vector<double> none(angles.size(), 0.0);
  const double longest =
      std::max(longest_step(two_pi / options_.high_upr), widest_of_steps * two_pi / per_turn_);
  const Trace trace = sorted_trace(angles, none, two_pi);
  std::vector<Gap> gaps = gaps_of(trace, longest);
  for (const Gap& gap : gaps) station.gaps_rad += gap.length;
  for (std::size_t k = 0; k < cosine_.size(); ++k) {
    const double angle = two_pi * static_cast<double>(k) / static_cast<double>(cosine_.size());
    const bool in_gap = std::ranges::any_of(gaps, [&](const Gap& gap) {
      const double into = angle - gap.from - two_pi * std::floor((angle - gap.from) / two_pi);
      return into > 0.0 && into < gap.length;
    });
    if (!in_gap) station.place.push_back(k);
  }
  // A spindle that stood still there has no section.
  if (station.place.size() >= least_angles) stations_.push_back(std::move(station));
}

Eigen::Vector2d SurfaceModel::amplitudes(const Place& at, int order,
                                         const Eigen::Ref<const VectorXd>& q) const {
  Eigen::Vector2d out = Eigen::Vector2d::Zero();
  if (const Index count = at.local.size(); count > 0)
    out =
        local_[static_cast<std::size_t>(order)] * q.tail(count).cwiseProduct(at.local.transpose());
  const Index column = terms_.column(order, 0);
  for (int d = 0; d <= terms_.degrees_of(order); ++d)
    for (int w = 0; w < SurfaceTerms::width(order); ++w)
      out[w] += at.along[d] * q[column + d * SurfaceTerms::width(order) + w];
  return out;
}

/// Radius and centre of the mean are those of the section: a profile is about them.
std::vector<double> SurfaceModel::profile(const Station& station,
                                          const Eigen::Ref<const VectorXd>& q,
                                          bool filtered) const {
  std::vector<double> out(station.place.size(), 0.0);
  for (int n = 0; n <= terms_.orders; ++n) {
    Eigen::Vector2d amplitude = amplitudes(station.at, n, q);
    if (n < 2) amplitude -= amplitudes(station.at, n, mean_);
    if (filtered) amplitude *= band_[static_cast<std::size_t>(n)];
    if (amplitude.isZero(0.0)) continue;
    // n times the angle is a place of the grid: n modulo its size further from angle to angle.
    const std::size_t count = cosine_.size(), step = static_cast<std::size_t>(n) % count;
    std::size_t k = 0, place = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
      for (; place < station.place[i]; ++place) {
        k += step;
        if (k >= count) k -= count;
      }
      out[i] += amplitude[0] * cosine_[k] + amplitude[1] * sine_[k];
    }
  }
  return out;
}

std::vector<Order> SurfaceModel::orders_at(const Station& station) const {
  std::vector<Order> out;
  for (int n = 0; n <= terms_.orders; ++n) {
    const Eigen::Vector2d mean = amplitudes(station.at, n, mean_);
    double squares = 0.0;
    const bool absent = n >= 2 && posterior_.order_is_there[n] == 0.0 && posterior_.local.empty();
    for (Index draw = 0; !absent && draw < posterior_.coefficients.cols(); ++draw)
      squares +=
          (amplitudes(station.at, n, posterior_.coefficients.col(draw)) - mean).squaredNorm();
    const double u = std::sqrt(squares / static_cast<double>(draws()) / SurfaceTerms::width(n));
    // For an order that no draw has, that of least squares.
    const double flat = std::sqrt(SurfaceTerms::width(n) / static_cast<double>(off_mm_.size()));
    out.push_back({n, mean[0], mean[1], std::max(u / noise_mm_, flat)});
  }
  return out;
}

std::vector<SectionModel> SurfaceModel::sections() const {
  std::vector<SectionModel> out;
  const double cutoff = two_pi / options_.high_upr;
  const Trace all = sorted_trace(angle_rad_, off_mm_, two_pi, turns_);
  for (const Station& station : stations_) {
    StationOfSurface one;
    const auto [x0, y0] = axis_.at(station.z_mm);
    const Eigen::Vector2d centre = amplitudes(station.at, 1, mean_);
    one.z_mm = station.z_mm;
    one.x_mm = x0 + centre[0];
    one.y_mm = y0 + centre[1];
    one.mean_mm = radius_mm_ + amplitudes(station.at, 0, mean_)[0];
    one.raw.period = two_pi;
    for (const std::size_t k : station.place)
      one.raw.at.push_back(two_pi * static_cast<double>(k) / static_cast<double>(cosine_.size()));
    one.raw.value_mm = profile(station, mean_, false);
    one.profile_mm = profile(station, mean_, true);
    one.orders = station.orders;
    one.noise_mm = noise_mm_;
    one.readings = station.readings;
    one.turns = turns_;
    one.gaps_rad = station.gaps_rad;
    one.points_per_cycle = points_per_cycle(all, cutoff);
    out.emplace_back(std::move(one), radius_known_, options_);
  }
  return out;
}

std::vector<std::vector<double>> SurfaceModel::profiles(std::size_t draw) const {
  VectorXd q = posterior_.coefficients.col(static_cast<Index>(draw));
  boost::random::mt19937_64 engine(options_.seed + 0x9E3779B97F4A7C15ULL * (draw + 1));
  boost::random::normal_distribution<double> normal;
  for (const Eigen::MatrixXd& columns : taken_off_)
    for (Index k = 0; k < columns.cols(); ++k) q += normal(engine) * columns.col(k);
  std::vector<std::vector<double>> out;
  const double share = normal(engine);
  for (const Station& station : stations_) {
    std::vector<double>& at = out.emplace_back(profile(station, q, true));
    for (std::size_t i = 0; i < at.size(); ++i) {
      const std::size_t k = station.place[i];
      at[i] += share * station.unfollowed_mm.dot(Eigen::Vector3d(1.0, cosine_[k], sine_[k]));
      for (const Top& top : unfollowed_tops_)
        at[i] += share * top.height_mm *
                 top.form.at(std::atan2(sine_[k], cosine_[k]),
                             (station.z_mm - middle_mm_) / half_mm_)[0];
    }
  }
  return out;
}

/// The terms of the surface that are there, by ridge regression with their squares as prior.
void SurfaceModel::add_taken_off(std::span<const std::vector<double>> columns_mm,
                                 std::span<const double> correlation) {
  const auto count = static_cast<Index>(columns_mm.size());
  if (count == 0) return;
  std::vector<std::vector<double>> kept;
  for (std::size_t k = 0; !kept_.empty() && k < columns_mm.size(); ++k)
    kept.push_back(kept_of(columns_mm[k]));
  const SurfaceSums sums = surface_sums(
      terms_, angle_rad_, t_, kept_.empty() ? columns_mm : std::span(std::as_const(kept)));
  std::vector<Index> there;
  const VectorXd square = (mean_.array().square() + spread_.array().square()).matrix();
  for (Index j = 0; j < terms_.size(); ++j)
    if (square[j] > 0.0) there.push_back(j);
  const auto m = static_cast<Index>(there.size());
  Eigen::MatrixXd normal(m, m), some(m, count);
  for (Index i = 0; i < m; ++i) {
    const Index a = there[static_cast<std::size_t>(i)];
    for (Index j = 0; j < m; ++j) normal(i, j) = sums.normal(a, there[static_cast<std::size_t>(j)]);
    normal(i, i) += noise_mm_ * noise_mm_ / square[a];
    some.row(i) = sums.right.row(a);
  }
  const Eigen::MatrixXd solved = linear::solve_normal(normal, some);
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(mean_.size(), count);
  for (Index i = 0; i < m; ++i) columns.row(there[static_cast<std::size_t>(i)]) = solved.row(i);
  const Eigen::Map<const Eigen::MatrixXd> given(correlation.data(), count, count);
  const linear::Spectrum spectrum = linear::spectrum(given);
  taken_off_.push_back(linear::product(
      columns,
      linear::scaled_columns(spectrum.vectors, spectrum.values.cwiseMax(0.0).cwiseSqrt())));
}

std::vector<SwallowedLobes> SurfaceModel::swallowed() const {
  std::vector<SwallowedLobes> out;
  for (int n = 2; n <= terms_.orders; ++n) {
    const double through = passed_by_low_pass(options_, n, two_pi / per_turn_);
    if (!is_swallowed(options_, through) || posterior_.order_is_there[n] < certain) continue;
    SwallowedLobes lobes{n, 0.0, 0.0, through};
    for (const Station& station : stations_) {
      const Order& order = station.orders[static_cast<std::size_t>(n)];
      if (order.amplitude_mm() <= lobes.amplitude_mm) continue;
      lobes.amplitude_mm = order.amplitude_mm();
      lobes.u_mm = noise_mm_ * order.u_per_sigma;
    }
    out.push_back(lobes);
  }
  return out;
}

FormSurface SurfaceModel::form() const {
  FormSurface out{off_mm_.size(), turns_, terms_.orders, terms_.degrees, noise_mm_, {}};
  for (int n = 2; n <= terms_.orders; ++n)
    if (posterior_.order_is_there[n] > 0.5) out.orders_found.push_back(n);
  return out;
}

}  // namespace trueaxis::form
