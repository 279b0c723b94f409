// SPDX-License-Identifier: Apache-2.0
#include "study/bound/bound.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "math/linear_algebra.hpp"
#include "simulate/clean_stream.hpp"
#include "study/bound/quantities.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::study {
namespace {

using namespace virtual_lathe;
using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// d of(scenario) / d parameters, one column each: (4 D(h/2) − D(h)) / 3 of central differences D.
template <class Of>
/// Eq. 122.
Eigen::MatrixXd derivatives(Estimable model, const Of& of) {
  const std::vector<EstimatedParameter> all = model.estimated_parameters();
  Eigen::MatrixXd out;
  for (std::size_t j = 0; j < all.size(); ++j) {
    std::vector<double> at;
    for (const double* number : all[j].numbers) at.push_back(*number);
    const auto moved = [&](double step) -> Eigen::VectorXd {
      for (std::size_t i = 0; i < at.size(); ++i) *all[j].numbers[i] = at[i] + step;
      return of(model.scenario());
    };
    const auto central = [&](double step) -> Eigen::VectorXd {
      return (moved(step) - moved(-step)) / (2.0 * step);
    };
    const Eigen::VectorXd whole = central(all[j].step), half = central(0.5 * all[j].step);
    (void)moved(0.0);
    if (j == 0) out.resize(whole.size(), static_cast<Eigen::Index>(all.size()));
    out.col(static_cast<Eigen::Index>(j)) = (4.0 * half - whole) / 3.0;
  }
  return out;
}

/// Whether every parameter moves some reading by more than rounding does.
bool all_move_readings(Estimable model, const Eigen::MatrixXd& jacobian) {
  constexpr double picometre = 1e-9;
  Eigen::Index column = 0;
  return std::ranges::all_of(
      model.estimated_parameters(), [&](const EstimatedParameter& parameter) {
        return jacobian.col(column++).cwiseAbs().maxCoeff() * parameter.step > picometre;
      });
}

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// One column more for every gauge zero: what is subtracted from all readings of a clamping.
void append_gauge_zeros(const Estimable& model, Eigen::MatrixXd& jacobian) {
  const std::vector<std::size_t>& zero_of = model.gauge_zero_of();
  if (zero_of.empty()) return;
  const Eigen::Index before = jacobian.cols();
  const auto zeros = static_cast<Eigen::Index>(model.clampings());
  jacobian.conservativeResize(Eigen::NoChange, before + zeros);
  jacobian.rightCols(zeros).setZero();
  for (std::size_t i = 0; i < zero_of.size(); ++i)
    jacobian(static_cast<Eigen::Index>(i), before + static_cast<Eigen::Index>(zero_of[i])) = -1.0;
}

/// Whether the parameters are known well enough for derivatives to say anything: to a tenth of the
/// radius, as a fit demands of itself.
bool is_determined(Estimable model, const Eigen::MatrixXd& covariance) {
  constexpr double coverage_factor = 2.0, size_share = 0.1;
  const Part& part = model.scenario().part;
  if (part.kind == PartKind::face) return true;
  Eigen::Index j = 0;
  return std::ranges::all_of(model.estimated_parameters(),
                             [&](const EstimatedParameter& parameter) {
                               const double scale_mm = parameter.is_length ? 1.0 : part.radius_mm;
                               const double u_mm = std::sqrt(covariance(j, j)) * scale_mm;
                               return ++j, coverage_factor * u_mm < size_share * part.radius_mm;
                             });
}

/// x_i = F x_{i−1} + q e₁, its first component of standard deviation 1.
struct StateSpace {
  Eigen::MatrixXd transition, covariance;
  double fresh_variance = 1.0;
};

std::optional<StateSpace> state_space(const Noise& noise) {
  std::vector<double> phi = noise.autoregression;
  if (phi.empty()) phi = {noise.rho};
  const auto order = static_cast<Eigen::Index>(phi.size());
  StateSpace out;
  out.transition = Eigen::MatrixXd::Zero(order, order);
  for (Eigen::Index j = 0; j < order; ++j) {
    out.transition(0, j) = phi[static_cast<std::size_t>(j)];
    if (j > 0) out.transition(j, j - 1) = 1.0;
  }
  // P = Σ Fⁱ e₁e₁ᵀ (Fⁱ)ᵀ, twice as many terms a step (Smith 1968).
  Eigen::MatrixXd power = out.transition, sum = Eigen::MatrixXd::Zero(order, order);
  sum(0, 0) = 1.0;
  constexpr int most_doublings = 40;
  for (int i = 0; i < most_doublings; ++i) {
    sum += linear::propagated(power, sum);
    power = linear::product(power, power);
    if (!sum.allFinite() || !power.allFinite()) return std::nullopt;
    if (power.norm() < 1e-30) {
      out.covariance = sum / sum(0, 0);
      out.fresh_variance = 1.0 / sum(0, 0);
      return out;
    }
  }
  return std::nullopt;
}

/// The variance of the uniform part and of rounding, mm².
double white_variance(const CleanStream& clean, const Noise& noise) {
  return (noise.uniform_mm * noise.uniform_mm +
          0.25 * clean.sensor.quantisation_mm * clean.sensor.quantisation_mm) /
         3.0;
}

/// Whether anything of the noise, or the sensor's rounding, moves a reading.
bool has_noise(const CleanStream& clean, const Noise& noise) {
  return noise.sigma_mm > 0.0 || white_variance(clean, noise) > 0.0;
}

/// Divides rows (one a reading) by the standard deviation of the reading given all before it, after
/// taking off what those predict: Kalman's innovations of y = s x + v, x the autoregression of
/// standard deviation 1, s that of the reading, v white (uniform part and rounding). Information
/// then is JᵀJ (Eq. 123).
/// @return false if the autoregression is not stationary, or where nothing is noisy.
bool whiten(const CleanStream& clean, const Noise& noise, Eigen::MatrixXd& rows) {
  const double white = white_variance(clean, noise);
  if (!has_noise(clean, noise)) return false;
  std::optional<StateSpace> space = state_space(noise);
  if (!space) return false;
  const Eigen::MatrixXd& transition = space->transition;
  Eigen::MatrixXd& covariance = space->covariance;
  Eigen::MatrixXd state = Eigen::MatrixXd::Zero(transition.rows(), rows.cols());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const double tangent =
        noise.incidence > 0.0 ? clean.tan_incidence[static_cast<std::size_t>(i)] : 0.0;
    const double s = noise.sigma_mm * std::sqrt(1.0 + noise.incidence * tangent * tangent);
    const double spread = s * s * covariance(0, 0) + white;
    const Eigen::RowVectorXd innovation = rows.row(i) - s * state.row(0);
    rows.row(i) = innovation / std::sqrt(spread);
    const Eigen::VectorXd gain = s / spread * covariance.col(0);
    state = (transition * (state + gain * innovation)).eval();
    covariance -= s * gain * covariance.row(0).eval();
    covariance = linear::propagated(transition, covariance);
    covariance(0, 0) += space->fresh_variance;
  }
  return true;
}

/// Fisher information of one reading of Student's t over that of a Gaussian of its variance.
/// Eq. 124.
double information_of(const Noise& noise) {
  const double v = noise.student_dof;
  return v > 2.0 && noise.uniform_mm == 0.0 ? v * (v + 1.0) / ((v - 2.0) * (v + 3.0)) : 1.0;
}

/// (JᵀJ)⁻¹ of whitened rows; empty where a direction is not determined to rounding.
Eigen::MatrixXd inverse_information(const Eigen::MatrixXd& jacobian) {
  if (jacobian.rows() < jacobian.cols()) return {};
  const Eigen::VectorXd scale = jacobian.colwise().norm().cwiseInverse();
  if (!scale.allFinite()) return {};
  const Eigen::MatrixXd scaled = jacobian * scale.asDiagonal();
  const auto [values, right, none_asked, rank] =
      linear::singular_system(scaled, Eigen::VectorXd::Zero(scaled.rows()));
  constexpr double singular = 1e-8;  // derivatives carry about 1e-10 of their size
  if (!(values.minCoeff() > singular * values.maxCoeff())) return {};
  const Eigen::MatrixXd root = scale.asDiagonal() * right * values.cwiseInverse().asDiagonal();
  return root * root.transpose();
}

}  // namespace

Bound bound_of(const Scenario& scenario, SurfaceKind surface) {
  const std::vector<Quantity> all = quantities(surface);
  const std::size_t count = all.size();
  Bound bound;
  bound.sd.assign(count, not_a_number);
  bound.covariance.assign(count * count, not_a_number);
  const auto without = [&](Bound::Missing why) {
    bound.missing = why;
    return bound;
  };
  if (scenario.part.kind == PartKind::cone && scenario.part.half_angle_rad == 0.0)
    return without(Bound::Missing::no_cone);
  const CleanStream clean = simulate_clean(scenario);
  if (!has_noise(clean, scenario.noise)) return without(Bound::Missing::no_noise);
  if (scenario.noise.uniform_mm > 0.0 || clean.sensor.quantisation_mm > 0.0)
    bound.kind = Bound::Kind::gauss_markov;
  const std::optional<Estimable> model = Estimable::of(scenario, clean.stream, surface);
  if (!model) return without(Bound::Missing::axis_moves);
  Eigen::MatrixXd jacobian;
  try {
    jacobian = derivatives(
        *model, [](const Scenario& moved) { return vector_of(simulate_clean(moved).value_mm); });
  } catch (const InputError&) {
    return without(Bound::Missing::at_a_limit);
  }
  if (!all_move_readings(*model, jacobian)) return without(Bound::Missing::not_determined);
  const Eigen::Index parameters = jacobian.cols();
  append_gauge_zeros(*model, jacobian);
  if (!whiten(clean, scenario.noise, jacobian)) return without(Bound::Missing::not_stationary);
  const Eigen::MatrixXd inverse = inverse_information(jacobian);
  if (inverse.size() == 0 || !is_determined(*model, inverse))
    return without(Bound::Missing::not_determined);
  const Probed probed = probed_length(clean.stream);
  const Eigen::MatrixXd of_quantities = derivatives(*model, [&](const Scenario& moved) {
    return vector_of(true_values(moved, probed, surface));
  });
  RowMajorMatrix covariance = of_quantities * inverse.topLeftCorner(parameters, parameters) *
                              of_quantities.transpose() / information_of(scenario.noise);
  for (std::size_t i = 0; i < count; ++i) {
    const bool by_nominal = all[i].name.starts_with("radius") || all[i].name == "k";
    if (!scenario.probe.relative_zero_mm || !by_nominal) continue;
    covariance.row(static_cast<Eigen::Index>(i)).setConstant(not_a_number);
    covariance.col(static_cast<Eigen::Index>(i)).setConstant(not_a_number);
  }
  std::copy_n(covariance.data(), count * count, bound.covariance.begin());
  for (std::size_t i = 0; i < count; ++i) bound.sd[i] = std::sqrt(bound.covariance[i * count + i]);
  return bound;
}

const char* to_string(Bound::Kind kind) {
  return kind == Bound::Kind::cramer_rao ? "cramer_rao" : "gauss_markov";
}

const char* to_string(Bound::Missing missing) {
  static constexpr const char* words[] = {"",
                                          "the axis moves between set-ups of one clamping",
                                          "the readings do not determine the parameters",
                                          "no noise",
                                          "the noise is not stationary",
                                          "a little more of a parameter could not be probed",
                                          "a cone without an angle"};
  return words[static_cast<std::size_t>(missing)];
}

}  // namespace trueaxis::study
