// SPDX-License-Identifier: Apache-2.0
#include "diagnose/refit/extended_fit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fit/describe.hpp"
#include "fit/probe_height.hpp"
#include "math/linear_algebra.hpp"
#include "surface/surface.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double rounding = 1e-12;  // of a variance: what is less remains of a difference

/// What a fit uses of the stream without excluded readings, less the contribution of the terms.
ProbeStream cleaned(const ProbeStream& stream, const ObservationMask& mask,
                    std::vector<double> effect_mm) {
  ProbeStream out = stream;
  out.time_s = {}, out.pass = {};  // no fit takes them
  for (std::size_t i = 0; i < stream.size(); ++i) out.reading_mm[i] -= effect_mm[i];
  effect_mm = {};
  const auto keep = [&](auto& column) {
    if (column.empty()) return;
    std::size_t to = 0;
    for (std::size_t i = 0; i < mask.used.size(); ++i)
      if (mask.used[i]) column[to++] = column[i];
    column.resize(to);
  };
  keep(out.reading_mm), keep(out.c_rad), keep(out.position_mm), keep(out.setup);
  return out;
}

/// ∂(derived quantity)/∂(x, y, slopes at mid length; radius; tan of the half angle).
Eigen::RowVectorXd derived_slope(const std::string& name, const Axis& axis) {
  Eigen::RowVectorXd g = Eigen::RowVectorXd::Zero(6);
  if (name == "radius_mid") g(4) = 1.0;
  const double slope = std::hypot(axis.slope_x, axis.slope_y);
  if (name == "tilt" && slope > 0.0) {
    g(2) = axis.slope_x / slope;
    g(3) = axis.slope_y / slope;
  }
  return g;
}

}  // namespace

CleanedFit fit_cleaned(const ProbeStream& stream, const FitOptions& options,
                       std::vector<double> effect_mm, const ObservationMask& mask,
                       const std::vector<Rejected>& masked, const FitResult* ideal) {
  const bool same = ideal != nullptr && masked.empty() &&
                    std::ranges::all_of(effect_mm, [](double e) { return e == 0.0; });
  const ProbeStream clean = same ? ProbeStream{} : cleaned(stream, mask, std::move(effect_mm));
  const ProbeStream& fitted = same ? stream : clean;
  CleanedFit out{same ? *ideal : fit(fitted, options), {}, {}};
  FitOptions bare = options;
  bare.influences.clear();
  std::optional<FitResult> of_noise;
  if (!options.influences.empty()) of_noise = fit(fitted, bare);
  const FitResult& noise_only = of_noise ? *of_noise : out.fit;
  out.noise_covariance = noise_only.covariance;
  out.axis_noise_covariance = noise_only.axis.covariance;
  out.fit.points = stream.size();
  out.fit.rejected = masked;
  return out;
}

FitResult extended_fit(CleanedFit cleaned, const LinearisationPoint& point,
                       const BaseUncertainty& base) {
  FitResult result = std::move(cleaned.fit);
  if (result.status != FitStatus::converged || result.set_ups.empty()) return result;

  // Base columns of the last axis with the shared shape, in this order.
  const auto per = static_cast<Eigen::Index>(point.base.per_axis());
  const auto from = static_cast<Eigen::Index>((point.base.axes - 1) * point.base.per_axis());
  const auto shared = static_cast<Eigen::Index>(point.base.axes * point.base.per_axis());
  std::vector<Eigen::Index> place(6, -1);
  const bool face = point.base.face;  // slopes and height
  for (Eigen::Index j = 0; j < per; ++j)
    place[static_cast<std::size_t>(face ? j + 2 : j)] = from + j;
  if (!face) place[4] = shared;
  if (point.base.tapers) place[5] = shared + 1;
  const auto of_last = [&](const Eigen::MatrixXd& base) {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(6, 6);
    for (Eigen::Index i = 0; i < 6; ++i) {
      for (Eigen::Index j = 0; j < 6; ++j) {
        const Eigen::Index a = place[static_cast<std::size_t>(i)],
                           b = place[static_cast<std::size_t>(j)];
        if (a >= 0 && b >= 0 && base.size() > 0) out(i, j) = base(a, b);
      }
    }
    return out;
  };
  const Eigen::MatrixXd of_noise = of_last(base.within), of_causes = of_last(base.between);
  const Eigen::MatrixXd covariance = of_noise + of_causes;
  const double z_mid = point.z_mid_mm;
  const std::size_t n = result.parameters.size();
  const std::vector<double> jacobian = reported_jacobian(result.surface, result.shape, z_mid);
  const Eigen::MatrixXd slope =
      Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>>(
          jacobian.data(), static_cast<Eigen::Index>(n), 6);
  const Eigen::MatrixXd joint_covariance = linear::propagated(slope, covariance);
  const Eigen::VectorXd from_noise = linear::propagated(slope, of_noise).diagonal();
  Eigen::VectorXd from_causes = linear::propagated(slope, of_causes).diagonal();
  const auto root = [](const Eigen::VectorXd& variance, std::size_t i) {
    return std::sqrt(std::max(0.0, variance(static_cast<Eigen::Index>(i))));
  };
  for (std::size_t p = 0; p < n; ++p) {
    for (std::size_t q = 0; q < n; ++q)
      result.covariance(p, q) +=
          joint_covariance(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(q)) -
          cleaned.noise_covariance(p, q);
    result.parameters[p].estimate.u = std::sqrt(std::max(0.0, result.covariance(p, p)));
    if (!result.budget.empty()) result.budget[0].u[p] = root(from_noise, p);
  }
  add_apex_interval(result.parameters, result.covariance, result.coverage_factor);
  std::erase_if(result.budget, [](const BudgetLine& line) {  // of the ideal fit
    return line.source == square_of_height;
  });
  const auto add_line = [&](std::string source, const Eigen::VectorXd& variance) {
    if (!(variance.maxCoeff() > 0.0)) return;
    BudgetLine line{std::move(source), 'B', {}};
    for (std::size_t p = 0; p < n; ++p) line.u.push_back(root(variance, p));
    result.budget.push_back(std::move(line));
  };
  for (const StatedPart& part : base.stated) {
    std::erase_if(result.budget,  // of the ideal fit
                  [&](const BudgetLine& line) { return line.source == part.name; });
    const Eigen::VectorXd variance = linear::propagated(slope, of_last(part.covariance)).diagonal();
    from_causes -= variance;
    add_line(part.name, variance);
  }
  if (point.height_mm != 0.0)  // with its u in the noise
    result.budget.push_back({"probe height, as found", 'A', std::vector<double>(n, 0.0)});
  if (from_causes.maxCoeff() > rounding * joint_covariance.diagonal().maxCoeff())
    add_line("causes that the readings cannot tell", from_causes);
  Eigen::MatrixXd at = Eigen::MatrixXd::Zero(4, 6);
  at.leftCols(4).setIdentity();
  at(0, 2) = at(1, 3) = face ? 0.0 : result.axis.axis.z_ref_mm - z_mid;
  const Eigen::MatrixXd axis = linear::propagated(at, covariance);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j)
      result.axis.covariance.by_rows[i * 4 + j] +=
          axis(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) -
          cleaned.axis_noise_covariance.by_rows[i * 4 + j];
  }
  for (FitParameter& d : result.derived) {
    if (d.name == "offset_at_min_z" || d.name == "offset_at_max_z") {
      const double z =
          d.name == "offset_at_min_z" ? result.position_min_mm : result.position_max_mm;
      d.estimate.u = std::max(d.estimate.u, result.axis.u_at(z));
      continue;
    }
    const Eigen::MatrixXd g = derived_slope(d.name, result.axis.axis);
    const double variance = linear::propagated(g, covariance)(0, 0);
    if (variance > 0.0) d.estimate.u = std::max(d.estimate.u, std::sqrt(variance));
  }
  if (!result.set_ups.empty()) {
    result.set_ups.back().axis = result.axis;
    result.set_ups.back().parameters = result.parameters;
  }
  result.sigma_mm = base.sigma_mm;
  result.u_factor = result.widened = 1.0;
  if (base.whitened) result.sigma_source = SigmaSource::whitened_residuals;
  return result;
}

}  // namespace trueaxis::diagnose_detail
