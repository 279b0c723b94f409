// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>

#include "simulate/clean_stream.hpp"

namespace trueaxis::study {

/// Whether anything of the noise, or the sensor's rounding, moves a reading.
bool has_noise(const virtual_lathe::CleanStream& clean, const virtual_lathe::Noise& noise);

/// Divides rows (one a reading) by the standard deviation of the reading given all before it, after
/// taking off what those predict: Kalman's innovations of y = s x + v, x the autoregression of
/// standard deviation 1, s that of the reading, v white (uniform part and rounding). Information
/// then is JᵀJ (Eq. 123).
/// @return false if the autoregression is not stationary, or where nothing is noisy.
bool whiten(const virtual_lathe::CleanStream& clean, const virtual_lathe::Noise& noise,
            Eigen::MatrixXd& rows);

}  // namespace trueaxis::study
