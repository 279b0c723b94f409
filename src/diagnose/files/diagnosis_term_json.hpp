// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "format/json.hpp"
#include "trueaxis/effect.hpp"

namespace trueaxis {

/// A fitted term: of an effect its formula, slot and the shape parameters that it reads; of a
/// pattern its numbers; then the linear parameters by name and their covariance.
Json term_object(const TermValue& term);

/// Back again, without the covariance. @throws InputError naming "diagnosis" for what the catalogue
/// has not, Json::exception for a malformed term.
TermValue effect_term_from(const std::string& id, const Json& json);
TermValue pattern_term_from(const Json& json);

}  // namespace trueaxis
