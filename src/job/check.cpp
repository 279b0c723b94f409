// SPDX-License-Identifier: Apache-2.0
#include "job/check.hpp"

#include <array>
#include <utility>

#include "job/agreement.hpp"
#include "job/checks.hpp"
#include "job/doubts.hpp"
#include "job/references.hpp"
#include "job/slip.hpp"

namespace trueaxis {

std::span<const JobCheck* const> checks() {
  static constexpr std::array all{
      // No go.
      &references_agree, &fits_converged, &part_slipped, &cut_refused, &surface_behind_ball,
      &material_between, &stock, &cut_too_far, &actuator_follows, &uncertainty_known,
      &motions_allowed, &findings_reproduced,
      // Not proven.
      &slipped_between_references, &datum_members_apart, &axis_known, &improbable_and_far,
      &sensor_or_eccentricity, &rows_read,
      // With reservations.
      &axes_open, &undiagnosed_correlated, &noise_over_stated, &bow_or_vibration,
      &references_off_datum, &cut_far, &gauge_shows_no_radius, &axis_of_cut};
  return all;
}

Reasons first_found(Weight weight, CheckedAt last, const CheckInput& input) {
  for (const JobCheck* check : checks())
    if (check->weight == weight && check->at <= last)
      if (Reasons found = check->find(input); !found.empty()) return found;
  return {};
}

Reasons all_found(Weight weight, const CheckInput& input) {
  Reasons all;
  for (const JobCheck* check : checks())
    if (check->weight == weight)
      for (Reason& one : check->find(input)) all.push_back(std::move(one));
  return all;
}

}  // namespace trueaxis
