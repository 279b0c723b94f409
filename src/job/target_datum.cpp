// SPDX-License-Identifier: Apache-2.0
#include "job/target_datum.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "job/references.hpp"
#include "math/linear_algebra.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
using NamesOfDatum = std::vector<std::string>;

std::size_t reference_named(const PlannedJob& result, const std::string& name) {
  const auto found = std::ranges::find(result.job.references, name, &JobReference::name);
  expects(found != result.job.references.end(), "a reference of the job");
  return static_cast<std::size_t>(found - result.job.references.begin());
}

bool is_face_datum(const PlannedJob& result, const NamesOfDatum& datum) {
  return result.fits[reference_named(result, datum.front())].surface == SurfaceKind::plane;
}

/// What the readings of a reference say of x, y at z_ref and the slopes, per reading: the normal
/// matrix of (cos C, sin C, w cos C, w sin C), w = Z − z_ref + R tan α, less what the radius and a
/// taper take of it.
Matrix4 metric_of(const PlannedJob& result, std::size_t i, double z_ref_mm) {
  const ProbeStream& stream = result.streams[i];
  const Revolved& shape = fit_used(result, i).shape;
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  for (std::size_t k = 0; k < stream.size(); ++k) {
    const double u = stream.position_mm[k] - z_ref_mm;
    const double radius =
        shape.radius_mm + shape.tan_half_angle * (stream.position_mm[k] - shape.axis.z_ref_mm);
    const double w = u + radius * shape.tan_half_angle;
    const double c = std::cos(stream.c_rad[k]), s = std::sin(stream.c_rad[k]);
    const Eigen::Matrix<double, 6, 1> row{c, s, w * c, w * s, 1.0, u};
    normal += row * row.transpose();
  }
  normal /= static_cast<double>(stream.size());
  const Eigen::Index own = fit_used(result, i).surface == SurfaceKind::cone ? 2 : 1;
  const Eigen::MatrixXd of_own = normal.block(4, 4, own, own), mixed = normal.block(0, 4, 4, own);
  return normal.topLeftCorner<4, 4>() -
         linear::product(mixed, linear::solve_normal(of_own, Eigen::MatrixXd(mixed.transpose())));
}

/// (x, y, slopes) at another height.
Matrix4 moved_by(double dz_mm) {
  Matrix4 out = Matrix4::Identity();
  out(0, 2) = out(1, 3) = dz_mm;
  return out;
}

/// The axis that several references share, and its normal matrix.
struct Common {
  std::vector<Matrix4> share;  ///< of each reference of the job
  Matrix4 metric = Matrix4::Zero();
};

Common common_axis(const PlannedJob& result, const NamesOfDatum& names, double z_ref_mm) {
  Common out;
  out.share.assign(result.fits.size(), Matrix4::Zero());
  for (const std::string& name : names) {
    const std::size_t i = reference_named(result, name);
    const Matrix4 metric = result.job.references[i].weight * metric_of(result, i, z_ref_mm);
    out.metric += metric;
    out.share[i] = metric * moved_by(z_ref_mm - axis_of_reference(result, i).axis.z_ref_mm);
  }
  const linear::Cholesky solver(out.metric);
  if (!solver.positive_definite() || !(solver.reciprocal_condition() > 1e-14))
    throw Refusal(
        "the readings of the datum do not determine its axis: probe it at two heights at least");
  for (Matrix4& share : out.share) share = solver.solve(Eigen::MatrixXd(share));
  return out;
}

/// The same held to the direction of a face: what least squares leaves of x and y where the slopes
/// are given.
void hold_to_face(std::size_t face, Common& common) {
  const Eigen::MatrixXd metric = common.metric;
  const Eigen::Matrix2d lever =
      linear::solve_normal(Eigen::MatrixXd(metric.topLeftCorner<2, 2>()),
                           Eigen::MatrixXd(metric.topRightCorner<2, 2>()));
  for (Matrix4& share : common.share) {
    share.topRows<2>() += lever * share.bottomRows<2>();
    share.bottomRows<2>().setZero();
  }
  common.share[face].setZero();
  common.share[face].topRightCorner<2, 2>() = -lever;
  common.share[face].bottomRightCorner<2, 2>().setIdentity();
}

void keep(const std::vector<Matrix4>& shares, TargetDatum& out) {
  for (const Matrix4& share : shares) Eigen::Map<Matrix4>(out.shares.emplace_back().data()) = share;
}

/// The axis of the references by their shares.
Reference combined(const TargetDatum& datum, const std::vector<Reference>& references) {
  Reference one{datum.name, {}, 1.0, 0.0};
  Eigen::Vector4d axis = Eigen::Vector4d::Zero();
  Matrix4 covariance = Matrix4::Zero();
  for (std::size_t i = 0; i < references.size(); ++i) {
    const Eigen::Map<const Matrix4> share(datum.shares[i].data());
    if (share.isZero(0.0)) continue;
    const Axis& of = references[i].axis.axis;
    axis += share * Eigen::Vector4d(of.x_mm, of.y_mm, of.slope_x, of.slope_y);
    covariance +=
        share * Eigen::Map<const Matrix4>(references[i].axis.covariance.data()) * share.transpose();
    one.freedom = std::min(one.freedom, references[i].freedom);
  }
  one.axis.axis = {axis[0], axis[1], axis[2], axis[3], datum.z_ref_mm};
  Eigen::Map<Matrix4>(one.axis.covariance.data()) = covariance;
  return one;
}

}  // namespace

std::optional<TargetDatum> target_datum(const PlannedJob& result) {
  const DatumSystem& datums = result.job.datums;
  if (datums.empty()) return {};
  TargetDatum out;
  for (const NamesOfDatum& names : datums)
    out.name += (out.name.empty() ? "" : " | ") + fmt::format("{}", fmt::join(names, "-"));
  const TargetSurface& target = *result.job.target;
  out.z_ref_mm = 0.5 * (target.z_start_mm + target.z_end_mm);
  std::vector<Matrix4> shares(result.fits.size(), Matrix4::Zero());
  if (!is_face_datum(result, datums.front())) {
    shares = common_axis(result, datums.front(), out.z_ref_mm).share;
  } else {
    const std::size_t face = reference_named(result, datums.front().front());
    if (datums.size() > 1) {
      Common common = common_axis(result, datums[1], out.z_ref_mm);
      hold_to_face(face, common);
      shares = common.share;
    } else {
      shares[face].bottomRightCorner<2, 2>().setIdentity();
    }
  }
  keep(shares, out);
  return out;
}

std::vector<Reference> judged(const PlannedJob& result, const std::vector<Reference>& references) {
  if (!result.datum) return references;
  Reference one = combined(*result.datum, references);
  const TargetSurface& target = *result.job.target;
  if (target.kind == TargetKind::face)
    one.face_radius_mm = std::max(target.radius_start_mm, target.radius_end_mm);
  return {one};
}

Axis shared_axis(const PlannedJob& result, const std::vector<std::string>& names) {
  TargetDatum datum;
  datum.z_ref_mm = result.datum->z_ref_mm;
  keep(common_axis(result, names, datum.z_ref_mm).share, datum);
  return combined(datum, references_of(result)).axis.axis;
}

}  // namespace trueaxis
