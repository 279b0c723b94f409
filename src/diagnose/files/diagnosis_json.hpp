// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "format/json.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/effect.hpp"

namespace trueaxis {

/// Schema trueaxis.diagnosis/3: lengths in mm, angles in degrees, times in s, each with its unit; a
/// number that is not there is null next to the reason. `findings[].term` and `unexplained[].term`
/// hold what was found as numbers, over u = (z − z_mid)/z_half of `u_frame`.
std::string diagnosis_json(const Diagnosis& diagnosis);

inline constexpr const char* diagnosis_schema = "trueaxis.diagnosis/3";

/// The diagnosis as an object.
Json diagnosis_object(const Diagnosis& diagnosis);

/// Verdict and causes of a diagnosis, for a result that names the file of the whole one.
Json diagnosis_summary(const Diagnosis& diagnosis);

/// A cause without its term and rival causes, for results that hold a summary.
Json finding_summary(const Finding& finding);

/// A model that the axis is averaged over.
Json share_object(const AxisShare& share);

/// A pattern in words and its amplitude.
Json unexplained_summary(const Unexplained& unexplained);

/// Like to_json, and never without a reason where a number is missing.
Json estimate_object(const Estimate& estimate);

/// σ of one reading, where it comes from, and what was excluded. `autocorrelation` is that of
/// neighbouring readings, which follows from the autoregression.
Json noise_object(const NoiseReport& noise);

/// Lag-1 autocorrelation of ε_i = Σ φ_j ε_{i−j} + e_i; 0 for white noise, NaN where it is not
/// stationary.
double neighbour_correlation(const std::vector<double>& autoregression);

/// A fitted term: the formula, slot and shape parameters of an effect, or the numbers of a pattern;
/// then the linear parameters by name and their covariance.
Json term_object(const TermValue& term);

/// Back again, without the covariance. @throws InputError naming "diagnosis" for what the catalogue
/// does not have, Json::exception for a malformed term.
TermValue effect_term_from(const std::string& id, const Json& json,
                           std::span<const Effect> own_effects = {});
TermValue pattern_term_from(const Json& json);

/// What the virtual lathe and a verdict need of a diagnosis: its verdict, both fits as
/// `fit_from_object` has them, u's frame, causes and patterns with their classes. Also shares of
/// the axis, what cannot be seen, the measurements, noise and excluded rows. @param path of the
/// text, for messages @param own_effects that it was made with; they outlive the result @throws
/// InputError if the schema of the text is not trueaxis.diagnosis/3, or it names an effect that
/// neither the catalogue nor `own_effects` has.
Diagnosis diagnosis_from_json(std::string_view text, const std::string& path,
                              std::span<const Effect> own_effects = {});

}  // namespace trueaxis
