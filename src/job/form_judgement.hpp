// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "trueaxis/job.hpp"
#include "trueaxis/part_form.hpp"

namespace trueaxis {

/// Holds every tolerance of the task against the form of the part: met where the larger value + U
/// is no more, not met where the smaller value − U is more, else not proven (ISO 14253-1; Eq. 292).
/// The two differ where the readings leave open what is of the part.
void judge(const FormTask& task, PartForm& form);

/// The verdict is of the cut: a tolerance of form that is not proven met is a reservation of it.
Reasons form_reservations(std::span<const PartForm> forms);

}  // namespace trueaxis
