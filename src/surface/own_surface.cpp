// SPDX-License-Identifier: Apache-2.0
#include "surface/own_surface.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "surface/revolved_surface.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

double secant(std::span<const double> w) { return std::sqrt(1.0 + w[2] * w[2] + w[3] * w[3]); }

}  // namespace

ProfileSurface::ProfileSurface(std::shared_ptr<const RevolvedProfile> profile,
                               std::shared_ptr<const Parameters> parameters,
                               const SurfaceFrame& frame)
    : profile_(std::move(profile)),
      parameters_(std::move(parameters)),
      frame_(frame),
      cone_(make_surface(SurfaceKind::cone, frame)) {
  for (const auto& parameter : *parameters_) names_.emplace_back(parameter.name);
}

std::vector<double> ProfileSurface::working_scale_mm(std::span<const double> working) const {
  const double radius = std::max(shape(working).radius_mm, 1e-6);
  std::vector<double> scale{1.0, 1.0, radius, radius};
  for (const auto& parameter : *parameters_) scale.push_back(parameter.length_mm);
  return scale;
}

std::vector<double> ProfileSurface::start(const ReadingBlock& readings, std::size_t count) const {
  return with_profile(cone_->start(readings, count), readings, count);
}

std::vector<double> ProfileSurface::level_start(const ReadingBlock& readings,
                                                std::size_t count) const {
  return with_profile(cone_->level_start(readings, count), readings, count);
}

std::vector<double> ProfileSurface::with_profile(std::vector<double> cone,
                                                 const ReadingBlock& readings,
                                                 std::size_t count) const {
  cone.resize(line_parameters);
  for (const double one : profile_start(axis(cone), readings, count)) cone.push_back(one);
  return cone;
}

std::vector<double> ProfileSurface::profile_start(const Axis& /*axis*/,
                                                  const ReadingBlock& /*readings*/,
                                                  std::size_t /*count*/) const {
  std::vector<double> out;
  for (const auto& parameter : *parameters_) out.push_back(parameter.start);
  return out;
}

void ProfileSurface::evaluate(std::span<const double> working, const ReadingBlock& readings,
                              PredictionBlock& out) const {
  out.valid = true;
  for (std::size_t i = 0; i < block_size; ++i) {
    const Contact at = meet(working, readings.cos_c[i], readings.sin_c[i], readings.position_mm[i],
                            readings.reading_mm[i]);
    out.valid = out.valid && at.hit;
    out.residual[i] = readings.reading_mm[i] - at.x_mm;
    for (std::size_t j = 0; j < working.size(); ++j) out.column[j][i] = at.per_working[j];
  }
}

void ProfileSurface::transform(std::span<const double> working, double* out) const {
  const std::size_t p = working.size();
  std::fill_n(out, p * p, 0.0);
  for (std::size_t i = 0; i < p; ++i) out[i * p + i] = 1.0;
}

Surface::Reported ProfileSurface::report(std::span<const double> working) const {
  const std::size_t p = working.size();
  const Reported line = differentiate<line_parameters>(
      working.first(line_parameters), line_parameters, [this](const auto* w, auto* out) {
        using std::sqrt;
        const auto n = 1.0 / sqrt(1.0 + w[2] * w[2] + w[3] * w[3]);
        for (std::size_t i = 0; i < 2; ++i) {
          out[i] = w[i] - w[2 + i] * frame_.position_ref_mm;
          out[2 + i] = w[2 + i] * n;
        }
      });
  Reported all{line.value, std::vector<double>(p * p, 0.0)};
  all.value.insert(all.value.end(), working.begin() + line_parameters, working.end());
  for (std::size_t i = 0; i < p; ++i) {
    if (i >= line_parameters) all.jacobian[i * p + i] = 1.0;
    for (std::size_t j = 0; i < line_parameters && j < line_parameters; ++j)
      all.jacobian[i * p + j] = line.jacobian[i * line_parameters + j];
  }
  return all;
}

Axis ProfileSurface::axis(std::span<const double> w) const {
  return {w[0], w[1], w[2], w[3], frame_.position_ref_mm};
}

std::vector<double> ProfileSurface::axis_jacobian(std::span<const double> working) const {
  std::vector<double> jacobian(line_parameters * working.size(), 0.0);
  for (std::size_t i = 0; i < line_parameters; ++i) jacobian[i * working.size() + i] = 1.0;
  return jacobian;
}

Revolved ProfileSurface::shape(std::span<const double> working) const {
  return tangent_cone(working, frame_.position_ref_mm * secant(working));
}

Surface::Influences ProfileSurface::influences(std::span<const double> working, double c_rad,
                                               double position_mm, double) const {
  const double guess = (frame_.root == Root::front ? 1.0 : -1.0) * shape(working).radius_mm;
  const Contact at = meet(working, std::cos(c_rad), std::sin(c_rad), position_mm, guess);
  if (!at.hit) return {};
  const Intersection touch =
      intersect(tangent_cone(working, at.height_mm), c_rad, position_mm, 0.0, frame_.root);
  return {touch.dx_dc / touch.x_mm, touch.dx_dc, touch.dx_dz};
}

Revolved ProfileSurface::tangent_cone(std::span<const double> working, double height_mm) const {
  const auto r = profile_->radius(height_mm, working.subspan(line_parameters));
  const double s_mm = height_mm - frame_.position_ref_mm * secant(working);
  return {axis(working), r.mm - r.per_height * s_mm, r.per_height};
}

/// f(X) = ρ − r(h): the distance of the contact from the axis less the radius at its height. With q
/// from the axis point at z_ref, d the axis' direction and w = q − (q·d) d, ρ = |w|. The
/// derivatives of the root are dX/dp = −f_p / f_X.
ProfileSurface::Contact ProfileSurface::meet(std::span<const double> w, double cos_c, double sin_c,
                                             double z_mm, double guess_mm) const {
  constexpr int most_steps = 30;
  constexpr double rounding = 1e-14;  // of the radius
  using Vector = Eigen::Vector3d;
  const double sec = secant(w);
  const Vector d(w[2] / sec, w[3] / sec, 1.0 / sec), e(cos_c, sin_c, 0.0);
  const Vector origin(-w[0], -w[1], z_mm - frame_.position_ref_mm);
  Contact at;
  at.x_mm = guess_mm;
  for (int step = 0; step < most_steps; ++step) {
    const Vector q = origin + at.x_mm * e;
    const double s = q.dot(d);
    const Vector across = q - s * d;
    const double distance = across.norm();
    at.height_mm = s + frame_.position_ref_mm * sec;
    at.radius = profile_->radius(at.height_mm, w.subspan(line_parameters));
    const double slope = at.radius.per_height;
    const double f = distance - at.radius.mm;
    const double f_x = e.dot(across) / distance - slope * e.dot(d);
    if (!std::isfinite(f) || !(std::abs(f_x) > 1e-6)) return at;
    if (std::abs(f) > rounding * std::abs(at.x_mm) && step + 1 < most_steps) {
      const double next = at.x_mm - f / f_x;
      if (next != at.x_mm) {
        at.x_mm = next;
        continue;
      }
    }
    at.hit = std::abs(f) <= 1e-9 * std::max(1.0, std::abs(at.x_mm));
    for (std::size_t i = 0; i < 2; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      at.per_working[i] = (across(k) / distance - slope * d(k)) / f_x;
      // ∂d/∂slope = (unit vector − d · d_k) / sec, so ∂s = (q_k − s d_k) / sec.
      const double s_slope = (q(k) - s * d(k)) / sec;
      at.per_working[2 + i] =
          (s * s_slope / distance + slope * (s_slope + frame_.position_ref_mm * d(k))) / f_x;
    }
    for (std::size_t i = line_parameters; i < w.size(); ++i)
      at.per_working[i] = at.radius.per_parameter[i - line_parameters] / f_x;
    return at;
  }
  return at;
}

CatalogueEntry own_entry(std::shared_ptr<const RevolvedProfile> profile) {
  const auto parameters = std::make_shared<const ProfileSurface::Parameters>(profile->parameters());
  expects(parameters->size() <= RevolvedProfile::most, "at most four parameters of a profile");
  SurfaceInfo info{SurfaceKind::own,      "own", "a profile of the user's",
                   StreamKind::lateral,   true,  {"x0", "y0", "l", "m"},
                   {"mm", "mm", "1", "1"}};
  for (const auto& parameter : *parameters) {
    info.parameters.push_back(parameter.name);
    info.units.push_back(parameter.unit);
  }
  return {std::move(info),
          [profile, parameters](const SurfaceFrame& frame) -> std::unique_ptr<Surface> {
            return std::make_unique<ProfileSurface>(profile, parameters, frame);
          }};
}

}  // namespace trueaxis
