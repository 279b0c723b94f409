// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "job/check.hpp"

namespace trueaxis {

/// Asks for the stock if the target lies on the probed length of a reference of its own side (shaft
/// or bore; a face on a face). Only then is it known what the tool meets. @throws InputError that
/// says so, when the job does not state it.
void require_stock(const PlannedJob& job);

// What forbids a cut, seen from the geometry alone: the probed surface, the ball, the target and
// the stock that was stated.
extern const JobCheck cut_refused, surface_behind_ball, material_between, stock, cut_too_far;

// What the geometry does not forbid and the reader of a go must know.
extern const JobCheck cut_far, gauge_shows_no_radius;

/// Every reference has a fit.
extern const JobCheck fits_converged;

/// The actuator follows the planned correction.
extern const JobCheck actuator_follows;

/// A control of which nobody says how it reads the rows keeps the tolerance either way.
extern const JobCheck rows_read;

/// The numbers of the cut have an uncertainty.
extern const JobCheck uncertainty_known;

/// No motion that was asked into the correction must stay out of it.
extern const JobCheck motions_allowed;

/// The virtual lathe reproduces the readings with what was found (refuted()).
extern const JobCheck findings_reproduced;

/// "coaxiality at most 5.9 µm with the table, 221 µm without it" as a reason.
Reason expected_cut(const PlannedJob& job, const CutNumbers& cut);

/// The part slipped while one of the references was probed: the others may be of the part as it was
/// before.
extern const JobCheck slipped_between_references;

/// The first reference of a common datum that is off its axis by more than the tolerance.
extern const JobCheck datum_members_apart;

/// References outside the datum whose axes are farther off it than the tolerance.
extern const JobCheck references_off_datum;

/// The diagnosis moved an axis, within the cut, by more than its U against the ideal fit. One of
/// its causes has rival causes, or a pattern has no cause.
extern const JobCheck axes_open;

/// Readings that nobody diagnosed leave what correlates.
extern const JobCheck undiagnosed_correlated;

/// More is left than the noise that was stated.
extern const JobCheck noise_over_stated;

/// A bow that one manner of probing does not tell from a vibration.
extern const JobCheck bow_or_vibration;

/// A cause that is improbable by its size alone fits the readings like the named one. It would put
/// the axis so far elsewhere that the cut is far out of the tolerance, and nobody knows well how
/// improbable it is.
extern const JobCheck improbable_and_far;

/// What `axes_open` finds.
Reasons open_axes(const PlannedJob& job);

/// Of the first reference where a function of the sensor's reading was found on a part whose
/// readings change by its eccentricity alone: it is then lobes in phase with the eccentricity, and
/// a part of the eccentricity itself. Were it the part's, the axis is elsewhere by more than the
/// room that the tolerance leaves.
extern const JobCheck sensor_or_eccentricity;

}  // namespace trueaxis
