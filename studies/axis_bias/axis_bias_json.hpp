// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "studies/axis_bias/axis_bias.hpp"

namespace trueaxis {

/// Schema trueaxis.axis_bias/2.
std::string axis_bias_json(const virtual_lathe::Scenario& scenario,
                           const std::vector<study::AxisBiasRow>& rows,
                           const std::string& input_hash);

}  // namespace trueaxis
