// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <Eigen/Dense>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cmath>

#include "base/threads.hpp"
#include "job/datum_axes.hpp"
#include "job/references.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t trials = 40;  // u to 11 %
constexpr std::uint64_t seed = 5459;

class AxisDifference {
 public:
  AxisDifference(const PlannedJob& result, std::size_t reference)
      : name_(result.job.references[reference].name),
        fit_(fit_used(result, reference)),
        criterion_(*result.job.references[reference].association),
        points_(datum_points(result, reference)) {
    const auto& diagnosis = result.diagnoses[reference];
    sigma_mm_ =
        diagnosis && diagnosis->noise.sigma_mm > 0.0 ? diagnosis->noise.sigma_mm : fit_.rms_mm;
  }

  AxisEstimate estimate() const {
    const Eigen::Vector4d found = off_least_squares(points_);
    Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
    std::vector<Eigen::Vector4d> drawn(trials);
    for_each_index(trials, 0, [&](std::size_t k) { drawn[k] = off_least_squares(noisy(k)); });
    for (const Eigen::Vector4d& one : drawn)
      covariance += (one - found) * (one - found).transpose() / static_cast<double>(trials);
    AxisEstimate out{{found[0], found[1], found[2], found[3], fit_.axis.axis.z_ref_mm}, {}};
    Eigen::Map<Eigen::Matrix4d>(out.covariance.data()) = covariance;  // symmetric
    return out;
  }

 private:
  /// Noise along the probe line.
  std::vector<Point3> noisy(std::size_t trial) const {
    boost::random::mt19937_64 engine(seed + 0x9E3779B97F4A7C15ULL * (trial + 1));
    boost::random::normal_distribution<double> normal(0.0, sigma_mm_);
    std::vector<Point3> out = points_;
    for (Point3& point : out) {
      const double factor = 1.0 + normal(engine) / std::hypot(point[0], point[1]);
      point[0] *= factor;
      point[1] *= factor;
    }
    return out;
  }
  Axis by(Criterion criterion, const std::vector<Point3>& points) const {
    const Element element = fit_.surface == SurfaceKind::cone ? Element::cone : Element::cylinder;
    const DatumAxis found = datum_axis(points, element, criterion, fit_.bore);
    if (!found.why.empty())
      throw Refusal(fmt::format("the readings of {} do not give an axis of {}: {}", name_,
                                name_of(criterion_), found.why));
    return found.axis;
  }
  Eigen::Vector4d off_least_squares(const std::vector<Point3>& points) const {
    const Axis other = by(criterion_, points), least = by(Criterion::gaussian, points);
    const double z = fit_.axis.axis.z_ref_mm;
    const auto [x, y] = other.at(z);
    const auto [x_least, y_least] = least.at(z);
    return {x - x_least, y - y_least, other.slope_x - least.slope_x, other.slope_y - least.slope_y};
  }

  const std::string& name_;
  const FitResult& fit_;
  Criterion criterion_;
  std::vector<Point3> points_;
  double sigma_mm_ = 0.0;
};

}  // namespace

void expect_associable(const JobReference& reference, const ProbeStream& stream) {
  if (reference.association.value_or(Criterion::gaussian) == Criterion::gaussian) return;
  const bool gauge = stream.indication == Indication::relative;
  if (gauge || list_set_ups(stream).size() > 1)
    throw Refusal(
        fmt::format("the association of {} needs positions of one set-up, and {}: remove "
                    "`association`, or give it a stream of X_M",
                    reference.name, gauge ? "its stream is a gauge's" : "there are several"));
}

std::optional<AxisEstimate> associated_difference(const PlannedJob& result, std::size_t reference) {
  const auto& association = result.job.references[reference].association;
  if (!association || *association == Criterion::gaussian) return {};
  if (fit_used(result, reference).status != FitStatus::converged) return {};
  expect_associable(result.job.references[reference], result.streams[reference]);
  return AxisDifference(result, reference).estimate();
}

}  // namespace trueaxis
