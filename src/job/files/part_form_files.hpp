// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "format/json.hpp"
#include "trueaxis/part_form.hpp"

namespace trueaxis {

/// As in result.json: filter, values as probed and of the part, a row a section, judgements.
Json part_form_object(const PartForm& form);

/// What a screen has of it: a line of the values, or a line a tolerance.
/// @param name of the reference; empty: the only one
std::string part_form_screen(const PartForm& form, const std::string& name);

/// The file of a diagnosis, with `form`.
std::string diagnosis_with_form(const Diagnosis& diagnosis, const PartForm& form);

/// All of it in words, with the sections.
std::string part_form_text(const PartForm& form);

/// "roundness NOT MET: RONt 8.1 ± 0.4 µm at Z = 12 mm, tolerance 5 µm (Gaussian 1-50 UPR, ISO
/// 14253-1)".
std::string judgement_text(const PartForm& form, const FormJudgement& judgement);

/// "Gaussian 1-50 UPR" or "no filter".
std::string filter_words(const FormOptions& options);

/// Whether the sections' radii change as a cone's: conicity then stands for cylindricity.
bool is_tapered(const FormResult& form);

}  // namespace trueaxis
