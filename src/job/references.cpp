// SPDX-License-Identifier: Apache-2.0
#include "job/references.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "job/machine_loop.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

/// Radius at which a reference's tilt counts: that of the face to be cut, else that of a plane
/// probed; 0 for a reference whose position counts.
double face_radius(const JobReference& reference, const FitResult& fit,
                   const TargetSurface& target) {
  if (target.kind == TargetKind::face)
    return std::max(target.radius_start_mm, target.radius_end_mm);
  if (fit.surface != SurfaceKind::plane) return 0.0;
  if (reference.face_radius_mm > 0.0) return reference.face_radius_mm;
  return std::max(std::abs(fit.position_min_mm), std::abs(fit.position_max_mm));
}

/// Degrees of freedom of the σ in u, where u does not hold them yet; those of correlated readings
/// count as so many fewer.
double freedom_of(const FitResult& fit) {
  if (fit.sigma_source == SigmaSource::sensor || fit.widened > 1.0)
    return std::numeric_limits<double>::infinity();
  const auto free = static_cast<double>(fit.points) - static_cast<double>(fit.parameters.size());
  return std::max(1.0, free / (fit.u_factor * fit.u_factor));
}

/// A slip may have turned the part as well, unseen: its axis then leans elsewhere by the turn. It
/// is the root mean square of turns log-uniform over the sizes of the catalogue.
AxisEstimate axis_of(const FitResult& fit, const std::optional<Diagnosis>& diagnosis) {
  AxisEstimate out = fit.axis;
  const Finding* slip = diagnosis ? diagnosis->slip() : nullptr;
  if (!slip) return out;
  const Effect& effect = *slip->term.effect;
  const auto turn = std::ranges::find(effect.parameters, "turn", &EffectParameter::name);
  const auto found = std::ranges::find(slip->parameters, "turn", &FitParameter::name);
  if (turn == effect.parameters.end() ||
      (found != slip->parameters.end() && found->estimate.determined()))
    return out;
  const double variance =
      (turn->high * turn->high - turn->low * turn->low) / (2.0 * std::log(turn->high / turn->low));
  using enum AxisRow;
  const double along_x = out.axis.slope_x, along_y = out.axis.slope_y;
  out.covariance(slope_x, slope_x) += variance * along_y * along_y;
  out.covariance(slope_y, slope_y) += variance * along_x * along_x;
  out.covariance(slope_x, slope_y) -= variance * along_x * along_y;
  out.covariance(slope_y, slope_x) -= variance * along_x * along_y;
  return out;
}

/// By the association of the reference instead of least squares (Eq. 303).
Axis with_association(const PlannedJob& result, std::size_t i, Axis axis) {
  if (i >= result.associated.size() || !result.associated[i]) return axis;
  const Axis& more = result.associated[i]->axis;
  const auto [x, y] = more.at(axis.z_ref_mm);
  axis.x_mm += x;
  axis.y_mm += y;
  axis.slope_x += more.slope_x;
  axis.slope_y += more.slope_y;
  return axis;
}

}  // namespace

const FitResult& fit_used(const IdentifiedJob& result, std::size_t reference) {
  expects(reference < result.fits.size(), "a reference of the job");
  const bool diagnosed = reference < result.diagnoses.size() && result.diagnoses[reference];
  if (!diagnosed) return result.fits[reference];
  const Diagnosis& diagnosis = *result.diagnoses[reference];
  return diagnosis.extended.status == FitStatus::converged ? diagnosis.extended
                                                           : result.fits[reference];
}

AxisEstimate axis_of_reference(const PlannedJob& result, std::size_t i) {
  const FitResult& fit = fit_used(result, i);
  AxisEstimate out = i < result.diagnoses.size() ? axis_of(fit, result.diagnoses[i]) : fit.axis;
  const auto add = [&](const AxisCovariance& more) {
    std::ranges::transform(out.covariance.by_rows, more.by_rows, out.covariance.by_rows.begin(),
                           std::plus{});
  };
  if (i < result.associated.size() && result.associated[i]) {
    out.axis = with_association(result, i, out.axis);
    add(result.associated[i]->covariance);
  }
  if (result.job.loop.u_lag_rad > 0.0) add(covariance_of(result.job.loop, out.axis));
  return out;
}

std::vector<Reference> references_of(const PlannedJob& result) {
  std::vector<Reference> references;
  for (std::size_t i = 0; i < result.fits.size(); ++i) {
    const JobReference& named = result.job.references[i];
    const FitResult& fit = fit_used(result, i);
    references.push_back({named.name, axis_of_reference(result, i), named.weight,
                          face_radius(named, fit, *result.job.target), freedom_of(fit)});
  }
  return references;
}

std::vector<Reference> references_aimed_at(const PlannedJob& result) {
  std::vector<Reference> references = references_of(result);
  for (std::size_t i = 0; i < references.size() && i < result.diagnoses.size(); ++i) {
    if (!result.diagnoses[i] || result.job.axis_of_cut == AxisOfCut::stated) continue;
    const FitResult& asked =
        result.job.axis_of_cut == AxisOfCut::named ? result.diagnoses[i]->named : result.fits[i];
    if (asked.status == FitStatus::converged)
      references[i].axis.axis = with_association(result, i, asked.axis.axis);
  }
  return references;
}

namespace {

Reasons find_axis_of_cut(const CheckInput& in) {
  const AxisOfCut axis = in.job.job.axis_of_cut;
  const bool diagnosed =
      std::ranges::any_of(in.job.diagnoses, [](const auto& d) { return d.has_value(); });
  if (axis == AxisOfCut::stated || !diagnosed) return {};
  return {{ReasonCode::axis_of_cut_not_stated, {}, {}, {{"axis", to_string(axis)}}}};
}

}  // namespace

constinit const JobCheck axis_of_cut{
    "axis_of_cut", CheckedAt::cut, Weight::reserves, {}, find_axis_of_cut};

const char* to_string(AxisOfCut axis) {
  switch (axis) {
    case AxisOfCut::stated:
      return "stated";
    case AxisOfCut::named:
      return "named";
    case AxisOfCut::ideal:
      return "ideal";
  }
  return "";
}

}  // namespace trueaxis
