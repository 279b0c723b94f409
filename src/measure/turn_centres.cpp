// SPDX-License-Identifier: Apache-2.0
#include "measure/turn_centres.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "math/linear_algebra.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t least_readings = 12;  // of a centre: three times its parameters
constexpr double straight = 0.9;            // of the way of C that leads on
constexpr std::size_t most_centres = 400;
constexpr double beyond_noise = 1e-3;  // of streams
constexpr double mostly = 0.25;        // of the scatter about a line, left by a step
constexpr std::size_t least_run = 8;   // centres: twice the parameters of a coordinate
constexpr std::size_t least_side = 2;

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

/// Squares of the centres [first, last) about a model of `columns`, x and y together.
double squares_about(const Eigen::MatrixXd& columns, const Eigen::MatrixX2d& centres) {
  const Eigen::MatrixXd model = linear::pivoted_least_squares(columns, Eigen::MatrixXd(centres));
  return (centres - linear::product(columns, model)).squaredNorm();
}

/// Variance of a coordinate by second differences: what goes to and fro is not a step.
double variance_of_neighbours(const Eigen::MatrixX2d& centres) {
  const Eigen::Index n = centres.rows() - 2;
  const Eigen::MatrixX2d second =
      centres.topRows(n) - 2.0 * centres.middleRows(1, n) + centres.bottomRows(n);
  std::vector<double> squares;
  for (Eigen::Index i = 0; i < n; ++i) squares.push_back(second.row(i).squaredNorm());
  return median(std::move(squares)) / (2.0 * std::log(2.0) * 6.0);  // median of χ²(2)
}

/// −1 to 1 over a column; 0 if it is constant.
Eigen::VectorXd scaled(Eigen::VectorXd column) {
  const double low = column.minCoeff(), half = 0.5 * (column.maxCoeff() - low);
  return half > 0.0 ? Eigen::VectorXd((column.array() - low) / half - 1.0)
                    : Eigen::VectorXd::Zero(column.size());
}

/// The step in one run of turns: a line along Z and a drift in time are not steps, nor is a bend.
std::optional<CentreStep> step_in(std::span<const TurnCentre> run, double u_mm, double by_chance) {
  const auto n = static_cast<Eigen::Index>(run.size());
  Eigen::MatrixX2d centres(n, 2);
  Eigen::VectorXd z(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const TurnCentre& one = run[static_cast<std::size_t>(i)];
    centres.row(i) << one.x_mm, one.y_mm;
    z(i) = one.position_mm;
  }
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(n, -1.0, 1.0);
  Eigen::MatrixXd model(n, 5);
  model << Eigen::VectorXd::Ones(n), scaled(z), t, t.array().square(), t.array().cube();
  const double about_line = squares_about(model.leftCols(3), centres);
  const double about_bend = squares_about(model, centres);
  double least = about_bend;
  Eigen::Index at = 0;
  const auto side = static_cast<Eigen::Index>(least_side);
  for (Eigen::Index k = side; k + side <= n; ++k) {
    for (Eigen::Index i = 0; i < n; ++i) {
      model(i, 3) = i < k ? 0.0 : 1.0;
      model(i, 4) = i < k ? 0.0 : t(i) - t(k);
    }
    const double squares = squares_about(model, centres);
    if (squares >= least) continue;
    least = squares;
    at = k;
  }
  const double noise = 2.0 * static_cast<double>(n) * u_mm * u_mm;
  if (at == 0 || least - noise > mostly * (about_line - noise)) return {};
  // A step and a change of slope of x and of y are four parameters, each centre a place for them.
  const double variance = std::max(u_mm * u_mm, variance_of_neighbours(centres));
  const double enough =
      quantile(complement(boost::math::chi_squared(4.0), by_chance / static_cast<double>(n)));
  if (about_bend - least < enough * variance) return {};
  const auto mean_of = [&](Eigen::Index from, Eigen::Index count) -> Eigen::Vector2d {
    return centres.middleRows(from, count).colwise().mean().transpose();
  };
  const Eigen::Index few = std::min<Eigen::Index>({3, at, n - at});
  return CentreStep{run[static_cast<std::size_t>(at)].begin,
                    (mean_of(at, few) - mean_of(at - few, few)).norm()};
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

std::optional<CentreStep> find_centre_step(const TurnCentres& centres, double by_chance) {
  std::optional<CentreStep> found;
  for (std::size_t begin = 0; begin < centres.list.size();) {
    std::size_t end = begin;
    while (end < centres.list.size() && centres.list[end].run == centres.list[begin].run) ++end;
    if (end - begin >= least_run) {
      const auto step =
          step_in(std::span(centres.list).subspan(begin, end - begin), centres.u_mm, by_chance);
      if (step && (!found || step->size_mm > found->size_mm)) found = step;
    }
    begin = end;
  }
  return found;
}

std::string moved_text(const CentreStep& step) {
  return fmt::format(
      "the centre of the turns moves by {:.3g} µm about data row {}: the part slipped there, C "
      "lost "
      "its place, or two recordings were joined. Give each part of the stream a file of its own, "
      "or "
      "clamp the part again and probe again",
      step.size_mm / mm_per_um, step.reading + 1);
}

}  // namespace trueaxis
