// SPDX-License-Identifier: Apache-2.0
#include "spindle/near_motion.hpp"

#include <algorithm>
#include <cmath>

#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using Eigen::Index;

constexpr double lines_of_motion = 8.0;  // on each side, that tell a motion close to an order
constexpr double step_of_motion = 0.02;  // lines
constexpr double least_off = 0.05;       // lines: what is nearer is the order
constexpr double most_rest = 4.0;        // of the median power, in a line without that motion
constexpr double least_share = 2e-3;     // of the lines' power: what the steps of x leave
constexpr double nearly_zero = 1e-3;     // lines

/// sinc(x − j) (−1)ʲ: what a motion at x lines leaves in line j.
double in_line(double x, double j) {
  const double off = 0.5 * two_pi * (x - j);
  const double size = std::abs(off) < 1e-9 ? 1.0 : std::sin(off) / off;
  return std::fmod(std::abs(j), 2.0) > 0.5 ? -size : size;
}

/// Several motions close to an order, or one whose frequency wanders: the order has taken about as
/// much of them as the lines next to it have.
NearMotion several_motions(const std::vector<NearLine*>& lines) {
  const Index sensors = lines.front()->at.size();
  NearMotion out{Eigen::VectorXcd::Zero(sensors), Eigen::MatrixXcd::Zero(sensors, sensors)};
  for (const NearLine* line : lines)
    if (std::abs(line->away) < least_away) out.covariance += line->at * line->at.adjoint();
  return out;
}

}  // namespace

NearMotion take_motion(std::vector<NearLine>& near) {
  std::vector<NearLine*> lines;
  std::vector<double> powers;
  double all = 0.0;
  for (NearLine& line : near) {
    powers.push_back(line.at.squaredNorm());
    if (std::abs(line.away) > lines_of_motion) continue;
    lines.push_back(&line);
    all += powers.back();
  }
  struct Place {
    double x, explained, squares;
    Eigen::VectorXcd amplitude;
  };
  const auto at = [&](double x) {
    Place place{x, 0.0, 0.0, Eigen::VectorXcd::Zero(near.front().at.size())};
    for (const NearLine* line : lines) {
      const double pattern = in_line(x, line->away);
      place.amplitude += pattern * line->at;
      place.squares += pattern * pattern;
    }
    place.amplitude /= place.squares;
    place.explained = place.squares * place.amplitude.squaredNorm();
    return place;
  };
  std::vector<Place> places;
  for (double x = -least_away + step_of_motion; x < least_away; x += step_of_motion)
    if (std::abs(x) >= least_off) places.push_back(at(x));
  const Place* best = &*std::ranges::max_element(places, {}, &Place::explained);
  const double usual = median(powers);
  const double rest =
      (all - best->explained) / std::max(static_cast<double>(lines.size()) - 1.5, 1.0);
  if (!(best->explained > standing_out * usual)) return {};
  // The order itself, which grows or shrinks evenly: the limit of x = 0.
  if (best->explained < at(nearly_zero).explained + most_rest * std::max(usual, rest)) return {};
  if (rest > most_rest * usual && all - best->explained > least_share * all)
    return several_motions(lines);
  const auto sensors = static_cast<double>(near.front().at.size());
  const double noise = std::max(usual, rest) / sensors;
  NearMotion out{Eigen::VectorXcd::Zero(best->amplitude.size()),
                 Eigen::MatrixXcd::Zero(best->amplitude.size(), best->amplitude.size())};
  double sum = 0.0;
  for (const Place& place : places) {
    const double weight = std::exp((place.explained - best->explained) / noise);
    const double share = in_line(place.x, 0.0);
    sum += weight;
    out.in_order += weight * share * place.amplitude;
    out.covariance += weight * share * share * (place.amplitude * place.amplitude.adjoint());
    out.covariance.diagonal().array() += weight * share * share * noise / place.squares;
  }
  out.in_order /= sum;
  out.covariance = out.covariance / sum - out.in_order * out.in_order.adjoint();
  for (NearLine* line : lines) line->at -= in_line(best->x, line->away) * best->amplitude;
  return out;
}

}  // namespace trueaxis
