// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "format/json.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

/// As in result.json: association, its axis at both ends of the probed length, how far it is from
/// that of the job there, and why there is no u.
Json datum_axes_array(const std::vector<DatumAxis>& axes, const FitResult& used);

/// A line an association.
std::string datum_axes_text(const std::vector<DatumAxis>& axes, const FitResult& used);

}  // namespace trueaxis
