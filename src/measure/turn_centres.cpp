// SPDX-License-Identifier: Apache-2.0
#include "measure/turn_centres.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

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

}  // namespace

TurnCentres turn_centres(const ProbeStream& stream, std::span<const double> value_mm) {
  TurnCentres out;
  const std::size_t count = stream.size();
  if (count < least_readings) return out;
  double way = 0.0;
  for (std::size_t i = 1; i < count; ++i) way += std::abs(stream.c_rad[i] - stream.c_rad[i - 1]);
  if (!(way > 0.0)) return out;
  const double per_turn = static_cast<double>(count) * two_pi / way;
  const double turns = std::max({1.0, std::ceil(least_readings / per_turn),
                                 std::ceil(way / two_pi / static_cast<double>(most_centres))});
  double squares = 0.0, freedom = 0.0;
  TurnCentre next;
  double gone = 0.0;
  int sense = 0;
  for (std::size_t i = 1; i < count; ++i) {
    gone += std::abs(stream.c_rad[i] - stream.c_rad[i - 1]);
    const bool other = !stream.setup.empty() && stream.setup[i] != stream.setup[next.begin];
    if (gone < turns * two_pi * (1.0 - 1e-9) && !other) continue;
    const double led = stream.c_rad[i] - stream.c_rad[next.begin];
    const int now = led > 0.0 ? 1 : -1;
    next.end = i;
    const bool leads = !other && std::abs(led) >= straight * gone;
    if (!leads || (sense != 0 && now != sense)) ++next.run;
    sense = leads ? now : 0;
    TurnCentre one = next;
    if (leads && take_centre(stream, value_mm, one, squares, freedom)) out.list.push_back(one);
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
