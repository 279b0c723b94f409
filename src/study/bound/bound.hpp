// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "trueaxis/surface.hpp"
#include "trueaxis/virtual_lathe.hpp"

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
/// surface's parameters, by Richardson's central differences, the noise whitened along the stream
/// (Kalman's innovations, so an autoregression and a white part are exact): nothing of the model
/// that is fitted enters. Every clamping has an axis of its own and, with a relative gauge, a zero
/// of its own, as in the fit. Effects are taken as known, outliers as recognised and free. NaN
/// everywhere where the readings do not determine the parameters and where the metadata tell one
/// clamping but the axis moved; the radius under a relative gauge (Eq. 121).
/// @param surface fitted: that of the part, or "section"
Bound bound_of(const virtual_lathe::Scenario& scenario, SurfaceKind surface);

/// "cramer_rao" or "gauss_markov".
const char* to_string(Bound::Kind kind);

/// "the readings do not determine the parameters"; empty where there is a bound.
const char* to_string(Bound::Missing missing);

}  // namespace trueaxis::study
