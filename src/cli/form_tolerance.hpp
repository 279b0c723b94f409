// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "form/files/form_files.hpp"
#include "trueaxis/form.hpp"

namespace trueaxis::cli {

/// "RONt=2,CYLt=5" in µm. @throws CLI::ValidationError
std::vector<FormTolerance> parse_form_tolerances(const std::string& text);

struct FormVerdict {
  bool met = true;
  std::string text;  ///< a line a tolerance; empty: nothing was asked
};

/// "FORM: RONt below 0.79 µm (95 % confidence), CYLt …": the largest form of all sections.
std::string form_line(const FormResult& result);

/// ISO 14253-1: met where value + U is no more than the tolerance, not met where value − U is more,
/// else not proven. About the minimum zone (ISO 1101), the largest of all sections.
/// @throws InputError where a value of that name is not in the result
FormVerdict judge_form(const FormResult& result, const std::vector<FormTolerance>& tolerances);

}  // namespace trueaxis::cli
