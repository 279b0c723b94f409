// SPDX-License-Identifier: Apache-2.0
#include "fit/describe.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/counted.hpp"
#include "base/number.hpp"
#include "fit/plausible.hpp"
#include "fit/probe_height.hpp"
#include "math/linear_algebra.hpp"
#include "math/statistics.hpp"
#include "measure/centre_of_ball.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr const char* no_redundancy =
    "no uncertainty: as many readings as parameters, and no sensor noise given";
constexpr double cylinder_sds =
    3.0;  // a half angle within 3 u of zero cannot be told from a cylinder
constexpr double cylinder_tan = 1e-10;  // below, noise-free: 0.01 nm over 100 mm

RowMajorMatrix as_rows(const std::vector<double>& values, Eigen::Index columns) {
  return Eigen::Map<const RowMajorMatrix>(
      values.data(), static_cast<Eigen::Index>(values.size()) / columns, columns);
}

Eigen::Index index_of(const std::vector<std::string>& names, std::string_view name) {
  const auto at = std::ranges::find(names, name);
  return at == names.end() ? -1 : at - names.begin();
}

/// Parameters with value and u; those that move along an undetermined direction say so instead.
std::vector<FitParameter> report_parameters(const SurfaceInfo& info,
                                            const std::vector<double>& value,
                                            const RowMajorMatrix& jacobian,
                                            const RowMajorMatrix& edge,
                                            const Determination& determination) {
  std::vector<FitParameter> parameters;
  for (std::size_t i = 0; i < info.parameters.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    FitParameter parameter{std::string(info.parameters[i]),
                           {value[i], std::sqrt(edge(row, row)), std::string(info.units[i]), ""}};
    const double whole = jacobian.row(row).norm();
    for (Eigen::Index j = 0; j < determination.free_directions.cols(); ++j) {
      const Eigen::VectorXd direction = determination.free_directions.col(j);
      const double along = std::abs(jacobian.row(row).dot(direction));
      if (along > 1e-6 * whole * direction.norm())
        parameter.estimate.why_not = "not determined by these readings";
    }
    if (!std::isfinite(parameter.estimate.value)) {
      parameter.estimate.why_not = "not determined by these readings";
    }
    if (parameter.estimate.why_not.empty() && !std::isfinite(parameter.estimate.u)) {
      parameter.estimate.why_not = no_redundancy;
    } else if (!parameter.estimate.why_not.empty()) {
      parameter.estimate.value = parameter.estimate.u = std::numeric_limits<double>::quiet_NaN();
    }
    parameters.push_back(std::move(parameter));
  }
  return parameters;
}

void withdraw(FitParameter& parameter, const std::string& why) {
  parameter.estimate = {.unit = parameter.estimate.unit, .why_not = why};
}

void withdraw(FitResult& result, std::string_view name, const std::string& why) {
  for (SetUpFit& one : result.set_ups) {
    for (FitParameter& parameter : one.parameters) {
      if (parameter.name == name) withdraw(parameter, why);
    }
  }
}

constexpr const char* as_cylinder = "the cone cannot be told from a cylinder";

/// A cone whose half angle is zero within its uncertainty, at the level of U too, has no apex.
void check_cone(const JointModel& model, const std::vector<double>& joint,
                const Eigen::MatrixXd& covariance, double coverage, FitResult& result) {
  const Eigen::Index tan = index_of(model.names(), "tan_half_angle");
  if (tan < 0 || !result.not_determined.empty()) return;
  const double value = joint[static_cast<std::size_t>(tan)], u = std::sqrt(covariance(tan, tan));
  // As many readings as parameters have no u: nothing then says that it is a cylinder.
  const double sds = std::max(cylinder_sds, coverage);
  const double limit = std::isfinite(u) ? std::max(sds * u, cylinder_tan) : cylinder_tan;
  if (std::abs(value) > limit) return;
  result.not_determined.push_back(fmt::format("k and half_angle: {}, half angle {:.2g}° ± {:.2g}°",
                                              as_cylinder, std::atan(value) / rad_per_deg,
                                              u / rad_per_deg));
  withdraw(result, "k", as_cylinder);
  withdraw(result, "half_angle", as_cylinder);
}

constexpr double rival_sds = 3.0;  // likelihood ratio e^-4.5: 1 in 90

/// A second minimum as low as the first, outside its uncertainty: the readings do not choose.
/// Eq. 25.
void check_rival(const JointModel& model, const std::vector<PlacedSetUp>& set_ups,
                 const Association& association, const ReadingNoise& noise, FitResult& result) {
  if (!association.rival || !result.not_determined.empty()) return;
  const Minimum& best = association.minimum;
  const Minimum& rival = *association.rival;
  const auto p = static_cast<Eigen::Index>(best.working.size());
  const double rounding_mm = 1e-11 * std::abs(result.set_ups.back().shape.radius_mm);
  const double limit = std::pow(rival_sds * std::max(noise.sigma_mm, rounding_mm), 2);
  if (rival.normal.sum_rho - best.normal.sum_rho > limit) return;
  const Eigen::VectorXd apart = Eigen::Map<const Eigen::VectorXd>(rival.working.data(), p) -
                                Eigen::Map<const Eigen::VectorXd>(best.working.data(), p);
  if (apart.dot(as_rows(best.normal.jtj, p) * apart) <= limit) return;
  std::string text;
  for (std::size_t s = 0; s < set_ups.size(); ++s) {
    const JointPart& part = model.part_of(set_ups[s]);
    const Surface::Reported other = part.surface->report(model.working(rival.working, part));
    const bool said = s > 0 && set_ups[s].clamping == set_ups[s - 1].clamping;
    const std::string where =
        model.clampings() > 1 ? " (" + set_up_name(set_ups[s].set_up) + ")" : "";
    for (std::size_t i = 0; i < other.value.size(); ++i) {
      FitParameter& parameter = result.set_ups[s].parameters[i];
      if (std::abs(other.value[i] - parameter.estimate.value) <= rival_sds * parameter.estimate.u)
        continue;
      if (!said) {
        text += fmt::format("{}{}{} {:.6g} or {:.6g}", text.empty() ? "" : ", ", parameter.name,
                            where, parameter.estimate.value, other.value[i]);
      }
      withdraw(parameter, "two surfaces fit these readings equally well");
    }
  }
  if (!text.empty()) result.not_determined.push_back("two surfaces fit equally well: " + text);
}

/// The surface as it was in one set-up.
struct Standing {
  const Surface& surface;
  std::vector<double> working;
  Eigen::MatrixXd covariance;      ///< of `working`
  RowMajorMatrix report_jacobian;  ///< of the reported parameters with respect to the joint ones
};

SetUpFit report_set_up(const PlacedSetUp& placed, const Standing& standing,
                       const std::vector<FitParameter>& parameters) {
  const Surface& surface = standing.surface;
  SetUpFit out{placed.set_up, placed.root, parameters, {}, surface.shape(standing.working)};
  out.axis.axis = surface.axis(standing.working);
  const RowMajorMatrix jacobian = as_rows(surface.axis_jacobian(standing.working),
                                          static_cast<Eigen::Index>(standing.working.size()));
  const RowMajorMatrix axis = linear::propagated(jacobian, standing.covariance);
  std::copy_n(axis.data(), 16, out.axis.covariance.data());
  return out;
}

std::vector<std::string> names_of(const std::vector<FitParameter>& parameters) {
  std::vector<std::string> names;
  for (const FitParameter& one : parameters) names.push_back(one.name);
  return names;
}

FitParameter length(std::string name, double value, double u) {
  return {std::move(name), {value, u, "mm", ""}};
}

/// (The order in std::max matters below: NaN, no uncertainty, must stay NaN.)
/// u of |v| for a plane vector v with covariance c: along v, or in the worse direction where v is
/// within its u.
double u_of_norm(const Eigen::Vector2d& v, const Eigen::Matrix2d& c) {
  const double worst = std::sqrt(std::max(linear::eigenvalues(c)(1), 0.0));
  if (v.norm() <= worst) return worst;
  return std::sqrt(std::max(v.dot(c * v), 0.0)) / v.norm();
}

void report_derived(const Standing& last, FitResult& result) {
  const std::span<const std::string_view> names = last.surface.working_names();
  const auto radius = std::ranges::find(names, "radius") - names.begin();
  const Eigen::MatrixXd& covariance = last.covariance;
  if (result.surface == SurfaceKind::cone && radius < last.covariance.rows()) {
    result.derived.push_back(
        length("radius_mid", result.shape.radius_mm, std::sqrt(covariance(radius, radius))));
  }
  const RowMajorMatrix axis = Eigen::Map<const RowMajorMatrix>(result.axis.covariance.data(), 4, 4);
  const Axis& line = result.axis.axis;
  const auto offset = [&](const char* name, double z) {
    Eigen::Matrix<double, 2, 4> at;
    at << 1, 0, z - line.z_ref_mm, 0, 0, 1, 0, z - line.z_ref_mm;
    const auto [x, y] = line.at(z);
    result.derived.push_back(
        length(name, std::hypot(x, y), u_of_norm({x, y}, at * axis * at.transpose())));
  };
  const bool no_direction =
      result.surface == SurfaceKind::section || result.surface == SurfaceKind::sphere;
  if (no_direction) offset("eccentricity", line.z_ref_mm);
  if (result.surface == SurfaceKind::cone || result.surface == SurfaceKind::cylinder) {
    offset("offset_at_min_z", result.position_min_mm);
    offset("offset_at_max_z", result.position_max_mm);
  }
  if (no_direction) return;
  const double slope = std::hypot(line.slope_x, line.slope_y);
  result.derived.push_back({"tilt", {std::atan(slope), result.axis.u_tilt(), "rad", ""}});
}

void report_rms(FitResult& result) {
  const Eigen::Map<const Eigen::VectorXd> residual(
      result.residual_mm.data(), static_cast<Eigen::Index>(result.residual_mm.size()));
  double sum = residual.squaredNorm();
  std::size_t left = result.residual_mm.size();
  if (result.loss == Loss::tukey) {
    for (const Rejected& r : result.rejected) sum -= std::pow(result.residual_mm[r.row - 1], 2);
    left -= result.rejected.size();
  }
  result.rms_mm = std::sqrt(std::max(0.0, sum) / std::max<double>(1.0, static_cast<double>(left)));
}

void add_notes(const ReadingNoise& noise, FitResult& result) {
  if (noise.correlated) {
    result.notes.push_back(fmt::format(
        "neighbouring residuals correlate ({:.2f}): slow noise, or form; TrueAxis computes every u "
        "for noise with the autoregression {:.2f}, up to {:.1f} times that of white noise",
        noise.autocorrelation, fmt::join(noise.correlated->phi, " and "), noise.u_factor));
  } else if (noise.u_factor > 1.0) {
    result.notes.push_back(
        fmt::format("neighbouring residuals correlate ({:.2f}): form or slow noise; TrueAxis "
                    "widens every u {:.1f}-fold",
                    noise.autocorrelation, noise.u_factor));
  }
  const double stated = noise.stated_mm.value_or(0.0), shown = noise.shown_mm;
  if (noise_disagrees(stated, shown, noise.redundancy)) {
    result.notes.push_back(
        fmt::format("stated noise {:.3g} µm, the residuals show {:.3g} µm: ", stated / mm_per_um,
                    shown / mm_per_um) +
        (shown > stated
             ? fmt::format("TrueAxis computes u from the residuals, {} times the stated noise; "
                           "the readings contain more than the sensor's noise (form, motion, "
                           "another surface or unit), or the stated noise is too small",
                           significant(shown / stated, 2))
             : fmt::format("TrueAxis computes u from the stated noise; if that is too large (a "
                           "unit?), every u is up to {} times too large",
                           significant(stated / shown, 2))));
  }
  if (result.loss != Loss::plain) return;
  std::vector<double> sample;  // spread evenly: enough for a scale
  const std::size_t stride = result.residual_mm.size() / 1024 + 1;
  for (std::size_t i = 0; i < result.residual_mm.size(); i += stride)
    sample.push_back(result.residual_mm[i]);
  const double limit = suspect_sds * mad_sigma(sample);
  const auto far =
      (Eigen::Map<const Eigen::ArrayXd>(result.residual_mm.data(),
                                        static_cast<Eigen::Index>(result.residual_mm.size()))
           .abs() > limit)
          .count();
  if (far > 0 && limit > 0.0 && result.sigma_mm > 1e-9) {
    result.notes.push_back(fmt::format(
        "{} beyond {} robust σ: outliers? fit with a robust loss (tukey)",
        counted(static_cast<std::size_t>(far), "reading lies", "readings lie"), suspect_sds));
  }
}

}  // namespace

double radius_U_mm(const FitResult& fit) {
  double U_mm = 0.0;
  for (const auto* list : {&fit.parameters, &fit.derived})
    for (const FitParameter& p : *list)
      if ((p.name == "radius" || p.name == "radius_mid") && std::isfinite(p.estimate.u))
        U_mm = fit.coverage_factor * p.estimate.u;
  return U_mm;
}

std::string impossible_radius(const FitResult& fit, bool for_sure) {
  const double side = for_sure ? -1.0 : 1.0;
  if (fit.surface == SurfaceKind::plane || fit.surface == SurfaceKind::own) return "";
  if (!is_diagnosed(fit.surface)) {
    for (const char* name : {"radius", "minor_radius"})
      for (const FitParameter& p : fit.parameters)
        if (p.name == name && !(p.estimate.value > side * p.estimate.expanded(fit.coverage_factor)))
          return fmt::format("no part has a {} of {:.6g} mm: {}",
                             p.name == std::string("radius") ? "radius" : "tube radius",
                             p.estimate.value, mend_ball_radius);
    return "";
  }
  for (const double z_mm : {fit.position_min_mm, fit.position_max_mm}) {
    const double radius_mm =
        fit.shape.radius_mm + fit.shape.tan_half_angle * (z_mm - fit.shape.axis.z_ref_mm);
    if (!(radius_mm <= side * radius_U_mm(fit))) continue;
    return fmt::format(
        "the part would have a radius of {:.6g} mm at Z = {:.6g} mm, which is impossible: {}",
        radius_mm, z_mm, mend_ball_radius);
  }
  return "";
}

void describe(const JointModel& model, const std::vector<PlacedSetUp>& set_ups,
              Association& association, ReadingNoise noise, const FitOptions& options,
              FitResult& result) {
  const std::vector<double>& joint = association.minimum.working;
  const std::vector<double> scale = model.scale_mm(joint);
  // The weights of a robust loss are in its factor (see estimate_noise), so the plain matrix is
  // inverted.
  const NormalMatrix normal =
      association.scale_mm > 0.0 ? model.accumulate(joint, {}) : association.minimum.normal;
  const JointPart& last_part = model.part_of(set_ups.back());
  const double size = std::max(last_part.surface->shape(model.working(joint, last_part)).radius_mm,
                               *std::ranges::max_element(scale));
  const Determination determination =
      determine(normal, scale, size, noise, options.coverage_factor);
  take_in(determination, options.coverage_factor, noise);
  for (Eigen::Index j = 0; j < determination.free_directions.cols(); ++j) {
    result.not_determined.push_back(
        name_direction(determination.free_directions.col(j), model.names(), scale));
  }
  const auto sources = budget_sources(model, association, determination, noise, options);
  Eigen::MatrixXd covariance = sources.front().covariance;
  for (std::size_t i = 1; i < sources.size(); ++i) covariance += sources[i].covariance;

  const auto stand = [&](const PlacedSetUp& placed) {
    const JointPart& part = model.part_of(placed);
    const Eigen::MatrixXd a = model.working_jacobian(joint, part);
    std::vector<double> working = model.working(joint, part);
    const RowMajorMatrix report =
        as_rows(part.surface->report(working).jacobian, static_cast<Eigen::Index>(working.size()));
    return Standing{*part.surface, std::move(working), linear::propagated(a, covariance),
                    report * a};
  };
  for (const PlacedSetUp& placed : set_ups) {
    const Standing standing = stand(placed);
    const RowMajorMatrix& jacobian = standing.report_jacobian;
    const RowMajorMatrix edge = linear::propagated(jacobian, covariance);
    std::vector<FitParameter> parameters =
        report_parameters(model.info(), standing.surface.report(standing.working).value, jacobian,
                          edge, determination);
    result.covariance = Covariance(names_of(parameters));
    std::copy_n(edge.data(), edge.size(), result.covariance.data());
    add_apex_interval(parameters, result.covariance, options.coverage_factor);
    result.set_ups.push_back(report_set_up(placed, standing, parameters));
  }
  const Standing last = stand(set_ups.back());
  for (const Source& source : sources) {
    BudgetLine line{source.name, source.type, {}};
    const Eigen::VectorXd variance =
        linear::propagated(last.report_jacobian, source.covariance).diagonal();
    for (const double v : variance) line.u.push_back(std::sqrt(std::max(v, 0.0)));
    result.budget.push_back(std::move(line));
  }
  check_cone(model, joint, covariance, options.coverage_factor, result);
  check_rival(model, set_ups, association, noise, result);
  if (model.indication() == Indication::relative) {
    withdraw(result, "radius", "a relative gauge does not show it; the nominal radius was used");
    withdraw(result, "k", "a relative gauge does not show it: the nominal radius places the apex");
  }
  if (!result.not_determined.empty()) {
    result.status = FitStatus::rank_deficient;
    result.message =
        "not determined by these readings: " + result.not_determined.front() +
        (result.not_determined.size() > 1 ? ", and more" : "") +
        (result.not_determined.front().find(as_cylinder) != std::string::npos
             ? "; associate a cylinder (--surface cylinder), or probe more of the length"
             : "; probe more of the length, or more of the circumference");
  }
  result.sigma_mm = noise.sigma_mm;
  result.sigma_source = noise.source;
  result.autocorrelation = noise.autocorrelation;
  result.u_factor = noise.u_factor;
  result.widened = noise.widened;
  result.parameters = result.set_ups.back().parameters;
  result.axis = result.set_ups.back().axis;
  result.shape = result.set_ups.back().shape;
  if (determination.free_directions.cols() == 0) report_derived(last, result);
  add_square_of_height(options.influences, result);
  for (FitParameter& derived : result.derived) {
    if (!std::isfinite(derived.estimate.u)) derived.estimate.why_not = no_redundancy;
  }
  result.rejected = list_rejected(association);
  result.residual_mm = std::move(association.residual_mm);
  report_rms(result);
  if (model.clampings() > 1) {
    result.notes.push_back("the part was clamped " + std::to_string(model.clampings()) +
                           " times; parameters and axis are those of " +
                           set_up_name(set_ups.back().set_up) + ", the last");
  }
  if (std::string note = impossible_radius(result, false); !note.empty())
    result.notes.push_back(std::move(note));
  add_notes(noise, result);
}

}  // namespace trueaxis
