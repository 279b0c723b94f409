// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "format/json.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis {

inline constexpr const char* diagnosis_schema = "trueaxis.diagnosis/2";

/// The diagnosis as an object.
Json diagnosis_object(const Diagnosis& diagnosis);

/// Verdict and findings of a diagnosis, for a result that names the file of the whole one.
Json diagnosis_summary(const Diagnosis& diagnosis);

/// A finding without its term and rivals, for results that hold a summary.
Json finding_summary(const Finding& finding);

/// A pattern in words and its amplitude.
Json unexplained_summary(const Unexplained& unexplained);

/// Like to_json, and never without a reason where a number is missing.
Json estimate_object(const Estimate& estimate);

/// {"value", "unit"}, and `why` where the value is not finite.
Json quantity_object(double value, const char* unit, const char* why);

}  // namespace trueaxis
