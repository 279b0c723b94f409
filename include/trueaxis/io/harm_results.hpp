// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/study/harm.hpp"

namespace trueaxis {

/// One row an effect and form; mm per edge unit.
std::string harm_csv(const std::vector<study::HarmRow>& rows);

/// Schema trueaxis.harm/1.
std::string harm_json(const virtual_lathe::Scenario& scenario,
                      const std::vector<study::HarmRow>& rows, const std::string& input_hash);

/// For the terminal; the same as a table of Markdown for the documentation.
std::string harm_text(const std::vector<study::HarmRow>& rows);
std::string harm_markdown(const std::vector<study::HarmRow>& rows);

}  // namespace trueaxis
