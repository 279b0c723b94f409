// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "trueaxis/diagnosis.hpp"

namespace trueaxis {

/// What the virtual lathe needs of a diagnosis: of both fits source, hash, status, surface, bore,
/// axes and shape, RMS and rejected rows; u's frame; the terms; σ, autoregression and masked rows.
/// @param path of the text, for messages
/// @throws InputError when the text is no trueaxis.diagnosis/2.
Diagnosis diagnosis_from_json(std::string_view text, const std::string& path);

}  // namespace trueaxis
