// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "format/json.hpp"
#include "trueaxis/form.hpp"

namespace trueaxis {

/// `trueaxis.form/1`.
std::string form_json(const FormResult& result);

/// Lobes that the cut-off takes part of, with what it lets through.
Json swallowed_json(const FormResult& result);

/// The profiles of all sections, before and behind the filter: `trueaxis.form_profile/1`.
std::string form_profile_csv(const FormResult& result);

}  // namespace trueaxis
