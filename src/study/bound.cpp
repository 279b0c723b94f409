// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/study/bound.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "trueaxis/base/error.hpp"
#include "trueaxis/base/units.hpp"
#include "trueaxis/simulate/clean_stream.hpp"
#include "trueaxis/study/quantities.hpp"

namespace trueaxis::study {
namespace {

using namespace virtual_lathe;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A parameter of the surface in the scenario, and a step of it that moves readings by some µm.
struct Lever {
  double* number;
  double step;
};

std::vector<Lever> levers(Part& part) {
  constexpr double length_step = 0.01, cosine_step = 1e-4, angle_step = 1e-4;
  if (part.kind == PartKind::face)
    return {{&part.l, cosine_step}, {&part.m, cosine_step}, {&part.d_mm, length_step}};
  std::vector<Lever> out{{&part.x0_mm, length_step},
                         {&part.y0_mm, length_step},
                         {&part.l, cosine_step},
                         {&part.m, cosine_step}};
  if (part.kind == PartKind::cone) {
    const double room = std::min(part.half_angle_rad, 90.0 * rad_per_deg - part.half_angle_rad);
    out.push_back({&*part.apex_mm, length_step});
    out.push_back({&part.half_angle_rad, std::min(angle_step, 0.25 * room)});
  } else {
    out.push_back({&part.radius_mm, length_step});
  }
  return out;
}

/// A cone by its apex, as its parameters are reported.
void give_apex(Part& part) {
  if (part.kind != PartKind::cone || part.apex_mm) return;
  part.apex_mm = part.radius_at_mm - part.radius_mm / std::tan(part.half_angle_rad);
  part.half_angle_rad = std::abs(part.half_angle_rad);
}

/// d of(scenario) / d levers, one column each: (4 D(h/2) − D(h)) / 3 of central differences D.
template <class Of>
Eigen::MatrixXd derivatives(Scenario scenario, const Of& of) {
  const std::vector<Lever> all = levers(scenario.part);
  Eigen::MatrixXd out;
  for (std::size_t j = 0; j < all.size(); ++j) {
    const double at = *all[j].number;
    const auto central = [&](double step) -> Eigen::VectorXd {
      *all[j].number = at + step;
      const Eigen::VectorXd up = of(scenario);
      *all[j].number = at - step;
      const Eigen::VectorXd down = of(scenario);
      *all[j].number = at;
      return (up - down) / (2.0 * step);
    };
    const Eigen::VectorXd whole = central(all[j].step), half = central(0.5 * all[j].step);
    if (j == 0) out.resize(whole.size(), static_cast<Eigen::Index>(all.size()));
    out.col(static_cast<Eigen::Index>(j)) = (4.0 * half - whole) / 3.0;
  }
  return out;
}

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Fisher information of one reading of Student's t over that of a Gaussian of its variance.
double information_of(const Noise& noise) {
  const double v = noise.student_dof;
  return v > 2.0 && noise.uniform_mm == 0.0 ? v * (v + 1.0) / ((v - 2.0) * (v + 3.0)) : 1.0;
}

/// Rows divided by their standard deviation given all rows before: y = s x + v, x AR(1) of standard
/// deviation 1, v white.
void whiten(const CleanStream& clean, const Noise& noise, Eigen::MatrixXd& rows) {
  const double white = (noise.uniform_mm * noise.uniform_mm +
                        0.25 * clean.sensor.quantisation_mm * clean.sensor.quantisation_mm) /
                       3.0;
  Eigen::RowVectorXd state = Eigen::RowVectorXd::Zero(rows.cols());
  double variance = 1.0;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const double tangent =
        noise.incidence > 0.0 ? clean.tan_incidence[static_cast<std::size_t>(i)] : 0.0;
    const double s = noise.sigma_mm * std::sqrt(1.0 + noise.incidence * tangent * tangent);
    const double spread = s * s * variance + white;
    const Eigen::RowVectorXd innovation = rows.row(i) - s * state;
    rows.row(i) = innovation / std::sqrt(spread);
    const double gain = s * variance / spread;
    state = noise.rho * (state + gain * innovation);
    variance = noise.rho * noise.rho * (1.0 - gain * s) * variance + 1.0 - noise.rho * noise.rho;
  }
}

bool is_simple(const Scenario& scenario, const CleanStream& clean) {
  const std::vector<SetUp> set_ups = list_set_ups(clean.stream);
  const bool clamped_once =
      std::ranges::all_of(set_ups, [&](const SetUp& s) { return s.clamped_as(set_ups.front()); });
  const bool own_axis = std::ranges::any_of(
      scenario.plan.setups, [](const Chucking& s) { return s.x0_mm || s.y0_mm || s.l || s.m; });
  return clamped_once && !own_axis && !scenario.probe.relative_zero_mm &&
         scenario.noise.autoregression.empty();
}

/// (JᵀJ)⁻¹ of whitened rows; empty where a direction is not determined to rounding.
Eigen::MatrixXd inverse_information(const Eigen::MatrixXd& jacobian) {
  if (jacobian.rows() < jacobian.cols()) return {};
  const Eigen::VectorXd scale = jacobian.colwise().norm().cwiseInverse();
  if (!scale.allFinite()) return {};
  const Eigen::MatrixXd scaled = jacobian * scale.asDiagonal();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinV);
  const Eigen::VectorXd values = svd.singularValues();
  constexpr double singular = 1e-8;  // derivatives carry about 1e-10 of their size
  if (!(values.minCoeff() > singular * values.maxCoeff())) return {};
  const Eigen::MatrixXd root =
      scale.asDiagonal() * svd.matrixV() * values.cwiseInverse().asDiagonal();
  return root * root.transpose();
}

}  // namespace

Bound bound_of(const Scenario& asked) {
  Scenario scenario = asked;
  const std::size_t count = quantities(scenario.part.kind).size();
  Bound bound;
  bound.sd.assign(count, std::numeric_limits<double>::quiet_NaN());
  bound.covariance.assign(count * count, std::numeric_limits<double>::quiet_NaN());
  if (scenario.part.kind == PartKind::cone && scenario.part.half_angle_rad == 0.0) return bound;
  give_apex(scenario.part);
  const Noise noise = scenario.noise;
  const CleanStream clean = simulate_clean(scenario);
  if (noise.uniform_mm > 0.0 || clean.sensor.quantisation_mm > 0.0)
    bound.kind = Bound::Kind::gauss_markov;
  if (!is_simple(scenario, clean) || !(noise.sigma_mm > 0.0 || noise.uniform_mm > 0.0))
    return bound;
  Eigen::MatrixXd jacobian;
  try {
    jacobian = derivatives(
        scenario, [](const Scenario& moved) { return vector_of(simulate_clean(moved).value_mm); });
  } catch (const InputError&) {  // a step leaves what can be probed
    return bound;
  }
  whiten(clean, noise, jacobian);
  const Eigen::MatrixXd inverse = inverse_information(jacobian);
  if (inverse.size() == 0) return bound;
  const Probed probed = probed_length(clean.stream);
  const Eigen::MatrixXd of_quantities = derivatives(
      scenario, [&](const Scenario& moved) { return vector_of(true_values(moved, probed)); });
  const Rows covariance =
      of_quantities * inverse * of_quantities.transpose() / information_of(noise);
  std::copy_n(covariance.data(), count * count, bound.covariance.begin());
  for (std::size_t i = 0; i < count; ++i) bound.sd[i] = std::sqrt(bound.covariance[i * count + i]);
  return bound;
}

const char* to_string(Bound::Kind kind) {
  return kind == Bound::Kind::cramer_rao ? "cramer_rao" : "gauss_markov";
}

}  // namespace trueaxis::study
