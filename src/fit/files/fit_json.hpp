// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "format/json.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis {

/// Schema trueaxis.fit/1: lengths in mm, angles in degrees, every number with unit and u or the
/// reason why not.
std::string fit_json(const FitResult& result);

/// The same as an object, for results that hold one.
Json fit_object(const FitResult& result);

/// What `correct` needs of a fit: surface, status, bore, axis with covariance, shape, range.
/// @throws InputError if the file is no trueaxis.fit/1, or its fit is not converged.
FitResult read_fit_json(const std::string& path);

}  // namespace trueaxis
