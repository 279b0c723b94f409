// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "studies/axis_bias/axis_bias.hpp"

namespace trueaxis {

/// For the terminal; the same as a table of Markdown for the documentation.
std::string axis_bias_text(const std::vector<study::AxisBiasRow>& rows);
std::string axis_bias_markdown(const std::vector<study::AxisBiasRow>& rows);

/// One row an effect and form; mm per edge unit.
std::string axis_bias_csv(const std::vector<study::AxisBiasRow>& rows);

/// Of a shift in mm per unit of the effect: "mm/deg".
std::string axis_bias_unit(const study::AxisBiasRow& row);

}  // namespace trueaxis
