// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "study/axis_bias/axis_bias.hpp"

namespace trueaxis {

/// One row an effect and form; mm per edge unit.
std::string axis_bias_csv(const std::vector<study::AxisBiasRow>& rows);

/// Schema trueaxis.axis_bias/1.
std::string axis_bias_json(const virtual_lathe::Scenario& scenario,
                           const std::vector<study::AxisBiasRow>& rows,
                           const std::string& input_hash);

/// For the terminal; the same as a table of Markdown for the documentation.
std::string axis_bias_text(const std::vector<study::AxisBiasRow>& rows);
std::string axis_bias_markdown(const std::vector<study::AxisBiasRow>& rows);

}  // namespace trueaxis
