// SPDX-License-Identifier: Apache-2.0
#include "measure/turn_centres.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>

#include "math/linear_algebra.hpp"
#include "math/statistics.hpp"
#include "measure/passes.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t least_readings = 12;  // of a centre: three times its parameters
constexpr double straight = 0.9;            // of the way of C that leads on
constexpr std::size_t most_centres = 400;
constexpr double beyond_noise = 1e-3;  // of streams

/// Mean, cosine, sine and slope in time of the values of a stretch; adds to the squares left.
bool take_centre(const ProbeStream& stream, std::span<const double> value_mm, TurnCentre& centre,
                 double& squares, double& freedom) {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  double sum2 = 0.0, position = 0.0;
  std::size_t count = 0;
  const double middle = 0.5 * static_cast<double>(centre.begin + centre.end);
  const double half = 0.5 * static_cast<double>(centre.end - centre.begin);
  const double origin_mm = value_mm[centre.begin];
  for (std::size_t i = centre.begin; i < centre.end; ++i) {
    const double value = value_mm[i] - (std::isfinite(origin_mm) ? origin_mm : 0.0);
    if (!std::isfinite(value)) continue;
    const Eigen::Vector4d row(1.0, std::cos(stream.c_rad[i]), std::sin(stream.c_rad[i]),
                              (static_cast<double>(i) - middle) / half);
    normal.noalias() += row * row.transpose();
    right += value * row;
    sum2 += value * value;
    position += stream.has_position() ? stream.position_mm[i] : 0.0;
    ++count;
  }
  if (count < least_readings) return false;
  const Eigen::LDLT<Eigen::Matrix4d> solver(normal);
  // Angles all in one half of a turn tell no centre.
  constexpr double weak = 0.1;
  if (solver.vectorD().minCoeff() < weak * static_cast<double>(count) / 4.0) return false;
  const Eigen::Vector4d solution = solver.solve(right);
  centre.position_mm = position / static_cast<double>(count);
  centre.x_mm = solution(1);
  centre.y_mm = solution(2);
  const Eigen::Matrix4d cofactors = solver.solve(Eigen::Matrix4d::Identity());
  centre.cofactor = {cofactors(1, 1), cofactors(2, 2), cofactors(1, 2)};
  squares += std::max(sum2 - right.dot(solution), 0.0);
  freedom += static_cast<double>(count) - 4.0;
  return true;
}

/// A cone about a line: what runs along Z within a turn moves its centre, out otherwise than back.
class StraightAxis {
 public:
  StraightAxis(const ProbeStream& stream, std::span<const double> value_mm) {
    if (stream.has_position()) {
      const auto [low, high] = range_of(stream.position_mm);
      middle_mm_ = 0.5 * (low + high);
      half_mm_ = std::max(0.5 * (high - low), 1e-9);
    }
    Matrix6 normal = Matrix6::Identity() * 1e-9;
    Vector6 right = Vector6::Zero();
    for (std::size_t i = 0; i < value_mm.size(); ++i) {
      if (!std::isfinite(value_mm[i])) continue;
      const Vector6 row = row_of(stream, i);
      normal.noalias() += row * row.transpose();
      right += value_mm[i] * row;
    }
    q_ = linear::solve_normal(Eigen::MatrixXd(normal), Eigen::VectorXd(right));
  }
  std::vector<double> left(const ProbeStream& stream, std::span<const double> value_mm) const {
    std::vector<double> out(value_mm.begin(), value_mm.end());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] -= q_.dot(row_of(stream, i));
    return out;
  }
  void add_to(TurnCentre& centre) const {
    const double t = (centre.position_mm - middle_mm_) / half_mm_;
    centre.x_mm += q_[2] + q_[4] * t;
    centre.y_mm += q_[3] + q_[5] * t;
  }

 private:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  Vector6 row_of(const ProbeStream& stream, std::size_t i) const {
    const double c = std::cos(stream.c_rad[i]), s = std::sin(stream.c_rad[i]);
    const double t = stream.has_position() ? (stream.position_mm[i] - middle_mm_) / half_mm_ : 0.0;
    Vector6 out;
    out << 1.0, t, c, s, t * c, t * s;
    return out;
  }
  double middle_mm_ = 0.0, half_mm_ = 1.0;
  Vector6 q_;
};

}  // namespace

TurnCentres turn_centres(const ProbeStream& stream, std::span<const double> value_mm,
                         CentresOf of) {
  TurnCentres out;
  const std::size_t count = stream.size();
  if (count < least_readings) return out;
  double way = 0.0;
  for (std::size_t i = 1; i < count; ++i) way += std::abs(stream.c_rad[i] - stream.c_rad[i - 1]);
  if (!(way > 0.0)) return out;
  const double per_turn = static_cast<double>(count) * two_pi / way;
  const double turns = std::max({1.0, std::ceil(least_readings / per_turn),
                                 std::ceil(way / two_pi / static_cast<double>(most_centres))});
  const StraightAxis axis(stream, of == CentresOf::readings ? value_mm : std::span<const double>{});
  std::vector<double> left_mm = axis.left(stream, value_mm);
  const std::vector<bool> chips = lone_outliers(left_mm);
  for (std::size_t i = 0; i < count; ++i)
    if (chips[i]) left_mm[i] = std::numeric_limits<double>::quiet_NaN();
  double squares = 0.0, freedom = 0.0;
  std::vector<bool> ends(count, false);  // a turn before a reading: another pass begins
  for (const Pass& pass : find_passes(stream)) ends[pass.begin] = true;
  TurnCentre next;
  double gone = 0.0;
  int sense = 0;
  for (std::size_t i = 1; i < count; ++i) {
    // The way to the next pass does not count: the step before it stands for it.
    const std::size_t to = ends[i] ? i - 1 : i;
    const bool alone = ends[i] && to == next.begin;
    const double step = alone ? 0.0 : stream.c_rad[to] - stream.c_rad[to - 1];
    gone += std::abs(step);
    const bool whole = gone >= turns * two_pi * (1.0 - 1e-9);
    const bool other = !stream.setup.empty() && stream.setup[i] != stream.setup[next.begin];
    if (!whole && !ends[i]) continue;
    const double led = stream.c_rad[i - 1] + step - stream.c_rad[next.begin];
    const int now = led > 0.0 ? 1 : -1;
    next.end = i;
    const bool leads = whole && !other && std::abs(led) >= straight * gone;
    if (whole || other) {
      if (!leads || (sense != 0 && now != sense)) ++next.run;
      sense = leads ? now : 0;
    }
    TurnCentre one = next;
    if (leads && take_centre(stream, left_mm, one, squares, freedom)) {
      axis.add_to(one);
      out.list.push_back(one);
    }
    next.begin = i;
    gone = 0.0;
  }
  if (freedom > 0.0) out.sigma_mm = std::sqrt(squares / freedom);
  double cofactors = 0.0;
  for (const TurnCentre& one : out.list) cofactors += 0.5 * (one.cofactor[0] + one.cofactor[1]);
  if (!out.list.empty())
    out.u_mm = out.sigma_mm * std::sqrt(cofactors / static_cast<double>(out.list.size()));
  return out;
}

double centres_spread(const TurnCentres& centres, std::size_t parameters) {
  const double freedom =
      2.0 * static_cast<double>(centres.list.size()) - static_cast<double>(parameters);
  if (!(freedom >= 4.0) || !(centres.u_mm > 0.0)) return 1.0;
  double chi2 = 0.0;
  for (const TurnCentre& one : centres.list) {
    const auto [xx, yy, xy] = one.cofactor;
    const double x = one.x_mm / centres.sigma_mm, y = one.y_mm / centres.sigma_mm;
    chi2 += (yy * x * x - 2.0 * xy * x * y + xx * y * y) / (xx * yy - xy * xy);
  }
  const boost::math::chi_squared law(freedom);
  return cdf(complement(law, chi2)) < beyond_noise ? std::sqrt(chi2 / freedom) : 1.0;
}

}  // namespace trueaxis
