// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/form.hpp"

namespace trueaxis {

/// `trueaxis.form/1`.
std::string form_json(const FormResult& result);

/// The profiles of all sections, before and behind the filter: `trueaxis.form_profile/1`.
std::string form_profile_csv(const FormResult& result);

}  // namespace trueaxis
