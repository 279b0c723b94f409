// SPDX-License-Identifier: Apache-2.0
#include "fit/describe.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "trueaxis/base/units.hpp"
#include "trueaxis/math/statistics.hpp"

namespace trueaxis {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr const char* no_redundancy =
    "no uncertainty: as many readings as parameters, and no sensor noise given";
constexpr double cylinder_sds =
    3.0;  // a half angle within 3 u of zero cannot be told from a cylinder
constexpr double cylinder_tan = 1e-10;  // below, noise-free: 0.01 nm over 100 mm

Rows as_rows(const std::vector<double>& values, Eigen::Index columns) {
  return Eigen::Map<const Rows>(values.data(), static_cast<Eigen::Index>(values.size()) / columns,
                                columns);
}

Eigen::Index index_of(std::span<const std::string_view> names, std::string_view name) {
  const auto at = std::ranges::find(names, name);
  return at == names.end() ? -1 : at - names.begin();
}

/// Parameters with value and u; those that move along an undetermined direction say so instead.
void report_parameters(const Surface::Reported& reported, const Rows& jacobian,
                       const Eigen::MatrixXd& covariance, const Determination& determination,
                       FitResult& result) {
  const SurfaceInfo& info = surface_info(result.surface);
  const Rows edge = jacobian * covariance * jacobian.transpose();
  result.covariance.assign(edge.data(), edge.data() + edge.size());
  for (std::size_t i = 0; i < info.parameters.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    FitParameter parameter{
        std::string(info.parameters[i]),
        {reported.value[i], std::sqrt(edge(row, row)), std::string(info.units[i]), ""}};
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
    result.parameters.push_back(std::move(parameter));
  }
}

void withdraw(FitResult& result, std::string_view name, const std::string& why) {
  for (FitParameter& parameter : result.parameters) {
    if (parameter.name != name) continue;
    parameter.estimate.value = parameter.estimate.u = std::numeric_limits<double>::quiet_NaN();
    parameter.estimate.why_not = why;
  }
}

/// A cone whose half angle is zero within its uncertainty has no apex.
void check_cone(const Surface& surface, std::span<const double> working,
                const Eigen::MatrixXd& covariance, FitResult& result) {
  const Eigen::Index tan = index_of(surface.working_names(), "tan_half_angle");
  if (tan < 0 || !result.not_determined.empty()) return;
  const double value = working[static_cast<std::size_t>(tan)], u = std::sqrt(covariance(tan, tan));
  // As many readings as parameters have no u: nothing then says that it is a cylinder.
  const double limit = std::isfinite(u) ? std::max(cylinder_sds * u, cylinder_tan) : cylinder_tan;
  if (std::abs(value) > limit) return;
  char text[160];
  std::snprintf(
      text, sizeof text,
      "k and half_angle: the cone cannot be told from a cylinder, half angle %.2g° ± %.2g°",
      std::atan(value) / rad_per_deg, u / rad_per_deg);
  result.not_determined.push_back(text);
  withdraw(result, "k", "the cone cannot be told from a cylinder");
  withdraw(result, "half_angle", "the cone cannot be told from a cylinder");
}

constexpr double rival_sds = 3.0;  // likelihood ratio e^-4.5: 1 in 90

/// A second minimum as low as the first, outside its uncertainty: the readings do not choose.
void check_rival(const Surface& surface, const Association& association, const Noise& noise,
                 FitResult& result) {
  if (!association.rival || !result.not_determined.empty()) return;
  const Minimum& best = association.minimum;
  const Minimum& rival = *association.rival;
  const auto p = static_cast<Eigen::Index>(best.working.size());
  const double rounding_mm = 1e-11 * std::abs(surface.shape(best.working).radius_mm);
  const double limit = std::pow(rival_sds * std::max(noise.sigma_mm, rounding_mm), 2);
  if (rival.normal.sum_rho - best.normal.sum_rho > limit) return;
  const Eigen::VectorXd apart = Eigen::Map<const Eigen::VectorXd>(rival.working.data(), p) -
                                Eigen::Map<const Eigen::VectorXd>(best.working.data(), p);
  if (apart.dot(as_rows(best.normal.jtj, p) * apart) <= limit) return;
  const Surface::Reported other = surface.report(rival.working);
  std::string text;
  for (std::size_t i = 0; i < result.parameters.size(); ++i) {
    FitParameter& parameter = result.parameters[i];
    if (std::abs(other.value[i] - parameter.estimate.value) <= rival_sds * parameter.estimate.u)
      continue;
    char term[120];
    std::snprintf(term, sizeof term, "%s%s %.6g or %.6g", text.empty() ? "" : ", ",
                  parameter.name.c_str(), parameter.estimate.value, other.value[i]);
    text += term;
    withdraw(result, parameter.name, "two surfaces fit these readings equally well");
  }
  if (!text.empty()) result.not_determined.push_back("two surfaces fit equally well: " + text);
}

void report_axis(const Surface& surface, std::span<const double> working,
                 const Eigen::MatrixXd& covariance, FitResult& result) {
  result.axis.axis = surface.axis(working);
  result.shape = surface.shape(working);
  const Rows jacobian =
      as_rows(surface.axis_jacobian(working), static_cast<Eigen::Index>(working.size()));
  const Rows axis = jacobian * covariance * jacobian.transpose();
  std::copy_n(axis.data(), 16, result.axis.covariance.begin());
}

FitParameter length(std::string name, double value, double u) {
  return {std::move(name), {value, u, "mm", ""}};
}

/// (The order in std::max matters below: NaN, no uncertainty, must stay NaN.)
/// u of |v| for a plane vector v with covariance c: along v, or in the worse direction where v is
/// within its u.
double u_of_norm(const Eigen::Vector2d& v, const Eigen::Matrix2d& c) {
  const double worst =
      std::sqrt(std::max(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(c).eigenvalues()(1), 0.0));
  if (v.norm() <= worst) return worst;
  return std::sqrt(std::max(v.dot(c * v), 0.0)) / v.norm();
}

void report_derived(const Surface& surface, const Eigen::MatrixXd& covariance, FitResult& result) {
  const Eigen::Index radius = index_of(surface.working_names(), "radius");
  if (result.surface == "cone" && radius >= 0) {
    result.derived.push_back(
        length("radius_mid", result.shape.radius_mm, std::sqrt(covariance(radius, radius))));
  }
  const Rows axis = Eigen::Map<const Rows>(result.axis.covariance.data(), 4, 4);
  const Axis& line = result.axis.axis;
  const auto offset = [&](const char* name, double z) {
    Eigen::Matrix<double, 2, 4> at;
    at << 1, 0, z - line.z_ref_mm, 0, 0, 1, 0, z - line.z_ref_mm;
    const auto [x, y] = line.at(z);
    result.derived.push_back(
        length(name, std::hypot(x, y), u_of_norm({x, y}, at * axis * at.transpose())));
  };
  if (result.surface == "section") offset("eccentricity", line.z_ref_mm);
  if (result.surface == "cone" || result.surface == "cylinder") {
    offset("offset_at_min_z", result.position_min_mm);
    offset("offset_at_max_z", result.position_max_mm);
  }
  if (result.surface == "section") return;
  const Eigen::Vector2d slope(line.slope_x, line.slope_y);
  const double u = u_of_norm(slope, axis.bottomRightCorner<2, 2>());
  result.derived.push_back(
      {"tilt", {std::atan(slope.norm()) / rad_per_deg, u / rad_per_deg, "deg", ""}});
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

constexpr double suspect_sds = 6.0;  // a Gaussian reading lies beyond with probability 2e-9

void add_notes(const Noise& noise, FitResult& result) {
  char text[200];
  if (noise.u_factor > 1.0) {
    std::snprintf(
        text, sizeof text,
        "neighbouring residuals correlate (%.2f): form or slow noise; every u is widened %.1f-fold",
        noise.autocorrelation, noise.u_factor);
    result.notes.emplace_back(text);
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
    std::snprintf(text, sizeof text,
                  "%td readings lie beyond 6 robust σ: outliers? fit with a robust loss (tukey)",
                  far);
    result.notes.emplace_back(text);
  }
}

}  // namespace

void describe(const Surface& surface, Association& association, const PreparedStream& stream,
              const Noise& noise, const FitOptions& options, FitResult& result) {
  const std::vector<double>& working = association.minimum.working;
  const std::vector<double> scale = surface.working_scale_mm(working);
  // The weights of a robust loss are in its factor (see estimate_noise), so the plain matrix is
  // inverted.
  const NormalMatrix normal = association.scale_mm > 0.0 ? accumulate(surface, working, stream, {})
                                                         : association.minimum.normal;
  const double size = std::max(surface.shape(working).radius_mm, *std::ranges::max_element(scale));
  const Determination determination =
      determine(normal, scale, size, noise.sigma_mm * noise.u_factor, options.coverage_factor);
  for (Eigen::Index j = 0; j < determination.free_directions.cols(); ++j) {
    result.not_determined.push_back(
        name_direction(determination.free_directions.col(j), surface.working_names(), scale));
  }
  const auto sources = budget_sources(surface, association, stream, determination, noise, options);
  Eigen::MatrixXd covariance = sources.front().covariance;
  for (std::size_t i = 1; i < sources.size(); ++i) covariance += sources[i].covariance;

  const Surface::Reported reported = surface.report(working);
  const Rows jacobian = as_rows(reported.jacobian, static_cast<Eigen::Index>(working.size()));
  report_parameters(reported, jacobian, covariance, determination, result);
  for (const Source& source : sources) {
    BudgetLine line{source.name, source.type, {}};
    const Eigen::VectorXd variance =
        (jacobian * source.covariance * jacobian.transpose()).diagonal();
    for (const double v : variance) line.u.push_back(std::sqrt(std::max(v, 0.0)));
    result.budget.push_back(std::move(line));
  }
  check_cone(surface, working, covariance, result);
  check_rival(surface, association, noise, result);
  if (stream.source().indication == Indication::relative) {
    withdraw(result, "radius", "a relative gauge does not show it; the nominal radius was used");
  }
  if (!result.not_determined.empty()) {
    result.status = FitStatus::rank_deficient;
    result.message = "not determined by these readings: " + result.not_determined.front() +
                     (result.not_determined.size() > 1 ? ", and more" : "") +
                     "; probe more of the length, or more of the circumference";
  }
  result.sigma_mm = noise.sigma_mm;
  result.sigma_source = noise.source;
  result.autocorrelation = noise.autocorrelation;
  result.u_factor = noise.u_factor;
  report_axis(surface, working, covariance, result);
  if (determination.free_directions.cols() == 0) report_derived(surface, covariance, result);
  for (FitParameter& derived : result.derived) {
    if (!std::isfinite(derived.estimate.u)) derived.estimate.why_not = no_redundancy;
  }
  result.rejected = list_rejected(association);
  result.residual_mm = std::move(association.residual_mm);
  report_rms(result);
  add_notes(noise, result);
}

}  // namespace trueaxis
