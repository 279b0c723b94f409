// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "trueaxis/probe_stream.hpp"
#include "trueaxis/surface.hpp"
#include "trueaxis/virtual_lathe.hpp"

/// What a fit estimates, as numbers of the virtual lathe.
namespace trueaxis::study {

/// The least standard deviation that unbiased estimates of the quantities can have on a plan.
struct Bound {
  enum class Kind {
    cramer_rao,    ///< of the noise as it is: Gaussian, autoregressive, wider where oblique,
                   ///< Student's t
    gauss_markov,  ///< of estimates linear in the readings: noise with a uniform part or rounding
  } kind = Kind::cramer_rao;
  std::vector<double> sd;          ///< in the order of quantities(); NaN: none (see bound_of)
  std::vector<double> covariance;  ///< of all quantities, row-major
  /// Why there is none of any quantity.
  enum class Missing {
    nothing,         ///< there is one
    axis_moves,      ///< the metadata tell one clamping, but the axis moved
    not_determined,  ///< the readings do not determine the parameters
    no_noise,
    not_stationary,  ///< the noise's autoregression
    at_a_limit,      ///< a step of a parameter leaves what can be probed
    no_cone          ///< a cone whose half angle is 0
  } missing = Missing::nothing;
};

/// σ²(JᵀJ)⁻¹ with J the derivatives of the virtual lathe's clean readings with respect to the
/// surface's parameters, by Richardson's central differences. The noise is whitened along the
/// stream (Kalman's innovations, so an autoregression and a white part are exact). Nothing of the
/// fitted model enters. Every clamping has an axis of its own and, with a relative gauge, a zero of
/// its own, as in the fit. Effects are taken as known, outliers as recognised and free. NaN
/// everywhere where the readings do not determine the parameters and where the metadata tell one
/// clamping but the axis moved; the radius under a relative gauge (Eq. 121). @param surface fitted:
/// that of the part, or "section"
Bound bound_of(const virtual_lathe::Scenario& scenario, SurfaceKind surface);

/// "cramer_rao" or "gauss_markov".
const char* to_string(Bound::Kind kind);

/// "the readings do not determine the parameters"; empty where there is a bound.
const char* to_string(Bound::Missing missing);

/// @throws InputError of `who` where set-ups of one clamping have axes of their own.
void refuse_moving_axis(const virtual_lathe::Scenario& scenario, const ProbeStream& probed,
                        const char* who);

/// Numbers of a scenario that one parameter of the fit moves together, and a step of it that moves
/// readings by some µm.
struct EstimatedParameter {
  std::vector<double*> numbers;
  double step;
  bool is_length = true;  ///< mm; else an angle or a direction cosine
};

/// A scenario written so that everything that is estimated is a number of its own. Every clamping
/// (the set-ups from one move of the part to the next, by the metadata) has its axis. A cone has
/// its radius in the middle of all readings.
class Estimable {
 public:
  /// Nothing if set-ups of one clamping have axes of their own: no surface of the model is that.
  static std::optional<Estimable> of(const virtual_lathe::Scenario& scenario,
                                     const ProbeStream& probed, SurfaceKind surface);

  const virtual_lathe::Scenario& scenario() const { return scenario_; }

  /// Axis (section: centre) or face of every clamping, then radius and half angle of the part,
  /// which all share. A relative gauge does not show the radius.
  std::vector<EstimatedParameter> estimated_parameters();

  /// Clamping of every reading where the gauge's zero is estimated, one a clamping; else empty.
  const std::vector<std::size_t>& gauge_zero_of() const { return gauge_zero_of_; }
  std::size_t clampings() const { return set_ups_.size(); }

 private:
  void place_radius(const ProbeStream& probed);

  virtual_lathe::Scenario scenario_;
  SurfaceKind surface_ = SurfaceKind::cone;
  std::vector<std::vector<int>> set_ups_;  ///< numbers, clamping by clamping
  std::vector<std::size_t> gauge_zero_of_;
};

}  // namespace trueaxis::study
