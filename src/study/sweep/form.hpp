// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "study/bound/quantities.hpp"
#include "trueaxis/form.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::study {

/// RONt of one turn about the circles of `form_criteria`, mm.
struct TurnForm {
  std::array<double, 4> value_mm, u_mm;
};

/// What a sweep with a pass band compares in addition to the surface's: `RONt_LSCI` … `RONt_MICI`.
std::vector<Quantity> form_quantities();

/// The values of the turn in the middle of a stream, with its neighbours for what the surface rises
/// in it. @param band_upr undulations per revolution @throws InputError where the readings do not
/// carry the band
TurnForm form_of_middle_turn(const ProbeStream& stream, const std::array<double, 2>& band_upr,
                             bool bore);

/// The same without noise, with so many readings per revolution that more of them change nothing.
TurnForm true_form_of_middle_turn(const virtual_lathe::Scenario& scenario,
                                  const std::array<double, 2>& band_upr);

}  // namespace trueaxis::study
