// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "trueaxis/diagnosis.hpp"

namespace trueaxis {

/// What the virtual lathe and a verdict need of a diagnosis: its verdict, both fits as
/// `fit_from_object` has them, u's frame, findings and patterns with their classes, the next
/// measurement; σ, autoregression and masked rows.
/// @param path of the text, for messages
/// @throws InputError when the text is no trueaxis.diagnosis/2.
Diagnosis diagnosis_from_json(std::string_view text, const std::string& path);

}  // namespace trueaxis
