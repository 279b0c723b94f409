// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "format/json.hpp"
#include "trueaxis/covariance.hpp"
#include "trueaxis/inference.hpp"

/// JSON of what the diagnoses of a part and of a machine state alike.
namespace trueaxis {

/// id, class, parameters and what the tests say of a cause.
Json finding_object(const std::string& effect, const NamedFinding& finding, Json parameters);
/// Its share of the readings, and its rival causes.
void add_rivals(Json& json, const NamedFinding& finding);

/// The size that would be found.
Json detectable_object(const UnseenEffect& unseen);
Json check_object(const QualityCheck& check);
Json explained_object(const Explained& gain);
/// How many tests were made, and what passes one.
void add_tests(Json& json, const Conclusion& conclusion);

/// A linear parameter of a term: mm, rad, s …
struct LinearValue {
  std::string name;
  double value = 0.0;
  std::string unit;
};
/// `linear` and, in its units, `covariance`, which may be empty.
void add_linear(Json& json, std::span<const LinearValue> values, const Covariance& covariance);

}  // namespace trueaxis
