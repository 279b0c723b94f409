// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "diagnose/explain/averaged_axis.hpp"
#include "math/linear_algebra.hpp"
#include "math/normal_mixture.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double level = 0.9545;      // of ±2 σ of a normal law
constexpr double least_share = 1e-3;  // of u²: smaller sources count as normal
constexpr double least_noise = 1e-3;  // of u, where the readings have none
constexpr double small_share = 0.05;  // of u²: a source that its variance tells as well

/// A direction of the axis at an end, as a row: its product with the base is the axis there.
struct Direction {
  Eigen::VectorXd row;
  double variance(const Eigen::MatrixXd& covariance) const {
    return std::max(0.0, row.dot(covariance * row));
  }
};

/// The worse direction at −1 or 1 of the probed length.
Direction worse_at(const LinearisationPoint& point, double end, const Eigen::MatrixXd& covariance) {
  const auto per = static_cast<Eigen::Index>(point.base.per_axis());
  const auto from = static_cast<Eigen::Index>(point.base.axes - 1) * per;
  Eigen::MatrixXd at = Eigen::MatrixXd::Zero(2, covariance.rows());
  at(0, from) = at(1, from + 1) = 1.0;
  if (point.base.tilts) at(0, from + 2) = at(1, from + 3) = end * point.z_half_mm;
  const auto [values, vectors] = linear::spectrum(linear::propagated(at, covariance));
  return {at.transpose() * vectors.col(1)};
}

/// What the causes may add at most for 2 u to be the interval, over what they add.
double scale_at(const Direction& along, const AveragedAxis& average) {
  const double of_noise = along.variance(average.within),
               of_causes = along.variance(average.between), whole = of_noise + of_causes;
  if (!(of_causes > least_share * whole)) return 1.0;
  double normal = whole;
  std::vector<NormalMixture> mixtures;
  for (const AveragedAxis::Source& source : average.sources) {
    const double own = along.variance(source.covariance);
    if (own < least_share * whole) continue;
    normal -= own;
    NormalMixture& mixture = mixtures.emplace_back();
    for (const Alternative& one : source.law)
      mixture.push_back(
          {one.probability, along.row.dot(one.off), std::sqrt(along.variance(one.covariance))});
  }
  const double sd = std::sqrt(std::max(normal, least_noise * least_noise * whole));
  const double u = 0.5 * central_quantile(sd, mixtures, level);
  return std::max(0.0, u * u - of_noise) / of_causes;
}

double scale_of(const LinearisationPoint& point, const AveragedAxis& average) {
  const Eigen::MatrixXd whole = average.within + average.between;
  return std::max(scale_at(worse_at(point, -1.0, whole), average),
                  scale_at(worse_at(point, 1.0, whole), average));
}

/// The covariance of the axis that has the interval of a mixture without a source.
Eigen::MatrixXd without(const LinearisationPoint& point, const AveragedAxis& average,
                        std::size_t source) {
  AveragedAxis less = average;
  less.sources.erase(less.sources.begin() + static_cast<std::ptrdiff_t>(source));
  less.between -= average.sources[source].covariance;
  return less.within + scale_of(point, less) * less.between;
}

}  // namespace

void set_interval(const LinearisationPoint& point, AveragedAxis& average) {
  if (average.sources.empty()) return;
  const double scale = scale_of(point, average);
  const double u_mm = axis_uncertainty(point, average.within + scale * average.between).u_mm;
  const auto share_without = [&](const Eigen::MatrixXd& rest) {
    return u_mm > 0.0 ? 1.0 - std::pow(axis_uncertainty(point, rest).u_mm / u_mm, 2) : 0.0;
  };
  for (std::size_t i = 0; i < average.sources.size(); ++i) {
    AveragedAxis::Source& source = average.sources[i];
    source.share = share_without(average.within + scale * (average.between - source.covariance));
    if (source.share > small_share) source.share = share_without(without(point, average, i));
  }
  average.between *= scale;
  for (AveragedAxis::Source& source : average.sources) source.covariance *= scale;
}

std::vector<AxisLimit> limits_of(const LinearisationPoint& point, const AveragedAxis& average) {
  std::vector<AxisLimit> out;
  const Eigen::MatrixXd whole = average.within + average.between;
  const double u_mm = axis_uncertainty(point, whole).u_mm;
  const double causes_mm = axis_uncertainty(point, average.between).u_mm;
  out.push_back({"", "", u_mm > 0.0 ? 1.0 - std::pow(causes_mm / u_mm, 2) : 0.0});
  for (const AveragedAxis::Source& source : average.sources)
    out.push_back(
        {source.effect ? std::string(source.effect->id) : "", source.instead_of, source.share});
  std::erase_if(out, [](const AxisLimit& one) { return !(one.share > least_share); });
  std::ranges::stable_sort(out, std::greater{}, &AxisLimit::share);
  return out;
}

}  // namespace trueaxis::diagnose_detail
