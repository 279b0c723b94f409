// SPDX-License-Identifier: Apache-2.0
// Every reason and every remedy in words, once.
#include <iterator>

#include "format/reason_words.hpp"

namespace trueaxis {
namespace {

struct Template {
  ReasonCode code;
  const char* text;
};

}  // namespace

std::string_view template_of(ReasonCode code) {
  using enum ReasonCode;
  static constexpr Template in_order_of_codes[] = {
      {no_target, "identified, no target to correct"},
      {coaxiality_expected,
       "coaxiality at most {at_most:um:two} µm with {parts}, {without:um:two} µm without it"},
      {run_out_expected,
       "axial run-out at most {at_most:um:two} µm with {parts}, {without:um:two} µm without it"},
      {with_the_table, "the table (in 95 of 100)"},
      {with_files, "{files} (worst: {worst}, in 95 of 100)"},
      {tolerance_kept, "{parts}, tolerance {tolerance:um:.9g} µm"},
      {tolerance_exceeded,
       "{@tolerance_kept}, and at least {at_least:um:two} µm<; {file_that_adds}, as its control "
       "reads it, adds {by_file:um:two} µm of it><; {remedies}>"},
      {tolerance_not_proven,
       "{@tolerance_kept}<; {file_that_adds}, as its control reads it, adds {by_file:um:two} µm "
       "of it><; {remedies}>"},
      {file_too_coarse,
       "{@tolerance_kept}<; {file_that_adds}, as its control reads it, adds {by_file:um:two} µm "
       "of it>: {remedies}"},
      {streams_exchanged,
       "{file} and {file2} have each other's stream: as given their fits leave {left:um:.3g} µm "
       "and {left_of_other:um:.3g} µm, exchanged {exchanged:um:.3g} µm and "
       "{exchanged_of_other:um:.3g} µm: exchange their `stream`"},
      {streams_misread,
       "{@axes_apart}, <{offset_left:um:one} µm and >{tilt_left:mrad:.2g} mrad if {parts:, or "
       "}: {remedies:, or }"},
      {axes_apart,
       "the axes of {file} and {file2} are <{offset:um:one} µm and >{tilt:mrad:.2g} mrad apart "
       "(U = <{U_offset:um:.2g} µm and >{tilt.U:mrad:.2g} mrad)"},
      {axes_of_no_part,
       "{@axes_apart}, farther than surfaces of one part are, and no sign, unit, diameter or "
       "zero of one stream explains it: probe all references in one clamping"},
      {column_reversed, "{column} of {file} runs the other way"},
      {x_convention_wrong, "the X of {file} is a {convention}"},
      {probed_from_behind, "{file} was probed from behind"},
      {stream_in_unit, "{file} is in {unit}"},
      {column_in_unit, "the {column} of {file} is in {unit}"},
      {c_zero_differs, "C of {file} counts from another zero< ({to_add:deg:+.1f}° to be added)>"},
      {z_zero_differs, "Z of {file} counts from another zero< ({to_add::+.3g} mm to be added)>"},
      {fit_implausible, "{file}: {message}"},
      {fit_failed, "{name}: {message}; {turns}"},
      {part_slipped,
       "{ref}the part slipped in the chuck< at {onset_time::.1f} s>< at reading "
       "{onset_reading::.0f}>< by {parts: and }><: {remedies}>"},
      {part_may_have_slipped,
       "{ref}the part may have slipped in the chuck, which the data cannot tell from {effect} "
       "(probability of the slip {probability::.2g}): {remedies}"},
      {part_moved, "{@part_slipped}: the axis is that of the part as it now stands"},
      {slip_unsure, "the part slipped, and where it is now is not known"},
      {statement_refuted,
       "{ref}{key} is stated as {stated:usual}, and the readings show {seen:usual} (U, k = 2): "
       "correct the statement, or leave it out"},
      {moved_across, "{by:um:pm} µm"},
      {moved_along_z, "{by:um:pm} µm along Z"},
      {moved_tilt, "{by:deg:pm}° of tilt"},
      {moved_turn, "{by:deg:pm}°"},
      {moved_radius, "{by:um:pm} µm of radius"},
      {moved_taper, "{by:deg:pm}° of taper"},
      {slipped_between_references,
       "the part slipped while {name} was probed, and the other references may have been probed "
       "before: probe all of them again as the part now stands"},
      {left_out_at_an_end,
       "{ref}most of the {end} {count::.0f} readings of a pass were left out, because they do not "
       "lie where the others do: the part may have slipped there, and stands elsewhere now. Clamp "
       "it again and probe again, or take that end out of the stream if the surface ends there"},
      {far_off_at_the_end,
       "{ref}{count::.0f} of the last {last::.0f} readings lie more than {limit::.0f} σ off, as "
       "no other {last::.0f} do: the part may have slipped there, and stands elsewhere now. Clamp "
       "it again and probe again, or take that end out of the stream if the surface ends there"},
      {moved_in_pass, "{ref}{text}"},
      {cut_refused, "{why}"},
      {no_surface_behind_ball,
       "{name}: with a ball of radius {ball::.6g} mm the surface has a radius of {radius::.6g} "
       "mm at Z = {z::.6g} mm: give the radius of the probe's ball, or none where the readings "
       "are of the contact"},
      {no_material_between,
       "the target is a {target} and the probed surface of {name} a {probed}: at {along} = "
       "{at::.6g} mm, C = {c:deg:.4g}° there is no material between them ({material:length}): "
       "see which feature is a shaft and which a bore"},
      {cuts_air,
       "the target cuts air: at {along} = {at::.6g} mm, C = {c:deg:.4g}° the probed surface of "
       "{name} has {material:length} over it (U = {material.U:length})"},
      {may_cut_air,
       "the target may cut air: at {along} = {at::.6g} mm, C = {c:deg:.4g}° the probed surface "
       "of {name} has {material:length} over it (U = {material.U:length})"},
      {stock_exceeded,
       "the target needs more than the stated stock of {stock:length}: at {along} = {at::.6g} "
       "mm, C = {c:deg:.4g}° the probed surface of {name} has {material:length} over it (U = "
       "{material.U:length})"},
      {cut_too_far,
       "the cut from Z = {z_start::.6g} to {z_end::.6g} mm lies so far from the probed length "
       "of <the datum {datum}><{name}>, Z = {z_low::.6g} to {z_high::.6g} mm, that U is "
       "extrapolated: {times::.3g} times that within it: {remedies}"},
      {cut_far,
       "the cut from Z = {z_start::.6g} to {z_end::.6g} mm lies so far from the probed length "
       "of <the datum {datum}><{name}>, Z = {z_low::.6g} to {z_high::.6g} mm, that U is "
       "extrapolated: {times::.3g} times that within it<; {remedies}>"},
      {gauge_shows_no_radius,
       "{name} was read with a relative gauge, which shows no radius: whether the target cuts "
       "air there is not known"},
      {actuator_cannot_follow, "the actuator cannot follow: {parts:; }; {remedies}"},
      {stroke_exceeded, "stroke {used:um:.4g} µm of {available:um:.4g} µm"},
      {slew_exceeded, "slew {used::.4g} mm/s of {available::.4g} mm/s"},
      {frequency_exceeded, "frequency {used::.4g} Hz of a bandwidth of {available::.4g} Hz"},
      {set_points_too_few,
       "set-points {per_revolution::.4g} a revolution, more than {needed::.0f} are needed for "
       "order {order::.0f}"},
      {following_error_exceeded, "following error {used:um:.4g} µm of {available:um:.4g} µm"},
      {rows_coarse,
       "{rows::.0f} rows per revolution: straight lines between them are off by up to "
       "{off:um:.3g} µm; {remedies}"},
      {no_uncertainty,
       "the readings give no uncertainty: probe more of them, or give the sensor's noise"},
      {motion_refused, "{effect} of {reference} must not enter the correction: {parts}"},
      {not_told_from_forbidden,
       "the data cannot tell it from {cause} (class {class}), which must not be copied into the "
       "cut; the probability of such a cause is {probability::.2g}, allowed are {allowed::.2g}"},
      {not_repeating, "it does not repeat every revolution"},
      {seen_on_a_face, "a face is cut without the motions that were seen on it"},
      {seen_along_x, "it was seen along X, and a face is cut along Z"},
      {tool_off_probe_line,
       "the probe saw it along its own direction; the tool's angle from the probe must be 0 or "
       "180 deg"},
      {beyond_probed_length, "the length to be cut reaches beyond the one that was probed"},
      {named_otherwise, "it is named {effect} there"},
      {shown_by_another, "another reference shows it already"},
      {may_be_forbidden,
       "the probability that it is {cause}, which should not be, is {probability::.2g}"},
      {not_found, "it was not found"},
      {not_reproduced,
       "{ref}what was found does not reproduce the readings: simulated with them, "
       "{after:um:.3g} µm RMS are left ({share:%:.0f} % of the variance), with the ideal "
       "surface {before:um:.3g} µm: {remedies}"},
      {left_unexplained,
       "{ref}what was found leaves {left:um:.2g} µm where the {source} show a noise of "
       "{noise:um:.2g} µm: the readings hold something that no cause and no pattern explains, and "
       "the axis may go with it. See whether the part slipped, clamp it again and probe again"},
      {pattern_with_axis,
       "{ref}a pattern of {amplitude:um:.2g} µm near one undulation per revolution has no known "
       "cause, and the axis goes with it: {remedies}"},
      {finding_with_axis,
       "{ref}{effect} is so slow or so near to once a revolution that over the stream it gains at "
       "most {turns::.2g} turns on the part or its eccentricity, and cannot be told from a shift "
       "of the axis: {remedies}"},
      {few_angles,
       "{ref}{angles::.0f} angles, the same in every revolution or nearly so, cannot tell "
       "{lobes::.0f} lobes from an eccentricity: probe at {enough::.0f} angles or more"},
      {sensor_at_limit,
       "{ref}{count::.0f} readings are at {limit::.6f} mm, the end of the sensor's range, and "
       "falsify the axis: exclude them (--drop-invalid, drop_invalid of a job), or bring the part "
       "within the range and probe again"},
      {undiagnosed_correlated,
       "{ref}its readings are not diagnosed, and what they leave correlates"},
      {noise_over_stated,
       "{ref}after all that was found a reading scatters by {left:um:.2g} µm, {times::.2g} "
       "times the stated noise: the readings hold something that was not found, or the noise "
       "was stated too small"},
      {bow_or_vibration,
       "{ref}a bow that was seen in one pass, or in passes alike, may as well be a vibration near "
       "the spindle's frequency, which would move the axis: a pass back at another speed tells"},
      {axis_open,
       "{ref}the diagnosis moved the axis by {moved:um:.2g} µm (U = {moved.U:um:.2g} µm), and "
       "{parts:, }"},
      {finding_has_rival, "{effect} may be {rival}"},
      {pattern_without_cause, "a pattern has no known cause"},
      {axis_open_beyond_tolerance,
       "{parts}; were the axis where the ideal fit has it, the coaxiality would be up to "
       "{if_ideal:um:two} µm, tolerance {tolerance:um:.9g} µm"},
      {improbable_and_far,
       "{ref}{effect} may be {rival} too, improbable as its size is, and the axis were then "
       "{shift:um:.0f} µm elsewhere: measure it, or {remedies}"},
      {sensor_or_eccentricity,
       "{ref}{effect} moves the axis by {shift:um:.2g} µm, and on a part that turns off-centre "
       "it looks as lobes in phase with the eccentricity do, which move no axis: probe once "
       "more with the slide moved by some tenths of a millimetre, as a set-up of its own, or "
       "calibrate the sensor"},
      {axis_of_cut_not_stated,
       "the job has the part cut about the {axis} axis, not about the stated one"},
      {datum_members_apart,
       "{name} is at least {off:um:.3g} µm (a diameter, over the cut) off the datum {datum}, "
       "more than the tolerance, so that the references of the datum share no axis: see whether "
       "all were probed in one clamping and whether Z and C are counted alike"},
      {reference_off_datum,
       "{name} is at least {off:um:.3g} µm (a diameter, over the cut) off the datum {datum}, "
       "and no tolerance is held against it: see whether it was probed in the same clamping"},
      {form_not_met, "the {form} of {name} is NOT MET, and the verdict is of the cut alone"},
      {form_not_proven, "the {form} of {name} is NOT PROVEN, and the verdict is of the cut alone"},
      {form_not_judged, "the {form} of {name} is NOT JUDGED, and the verdict is of the cut alone"},
      {reads_a_face, "taken for a plane: Z_M is read at C and X"},
      {no_change_of_z, "taken for one section: there is no change of Z"},
      {cone_at_last, "taken for a cone"},
      {no_taper_seen, "taken for a cylinder: no taper is seen; {remedies}"},
      {taper_seen,
       "taken for a {surface}: <half angle {half_angle:deg:of U}° ± {half_angle.U:deg:two}°><the "
       "radius "
       "changes by {change:um:.4g} µm over {length::.4g} mm of Z><; {remedies}>"},
      {not_one_surface,
       "is not one {surface}: {parts:; }. A jump at the same C and another Z is the shape of "
       "the part, not a slip and not an error of X, Z or C. Give the Z range of one surface: "
       "{remedies:, or }; or `trueaxis run {stream} -o FOLDER` without --surface takes every "
       "seat"},
      {one_seat_found, "one seat is in the stream, {remedies}, and more beside it: {parts:; }"},
      {seats_found, "{seats::.0f} seats are in the stream ({remedies:, }): {parts:; }"},
      {seat, "Z {from::.10g} to {to::.10g} mm"},
      {range_by_options, "--z-from-mm {from::.10g} --z-to-mm {to::.10g}"},
      {range_by_keys, "z_from_mm = {from::.10g}, z_to_mm = {to::.10g}"},
      {radius_steps, "the radius steps by {step::+.4g} mm at Z {z::.4g} mm, a shoulder"},
      {taper_changes, "the taper changes by {change:deg:.2g}° at Z {z::.4g} mm"},
      {not_read, "nothing was read about Z {z::.4g} mm"},
      {clamp_again, "clamp it again and probe again"},
      {probe_again, "probe again"},
      {probe_at_other_speed, "probe again at another speed and another feed"},
      {measure, "{what}"},
      {turn_sign, "turn the sign of its column {column}"},
      {turn_sign_behind, "probed there, X is negative: turn the sign of its column X_M"},
      {set_x_convention, "x_convention = \"{convention}\""},
      {name_unit, "[{unit}] behind the name of {column}"},
      {name_units, "[{unit}] behind the names of X and Z"},
      {clamp_all_once_c,
       "another set-up: probe all references in one clamping, or add the angle to its C"},
      {clamp_all_once_z,
       "another set-up: probe all references with one datum, or add the length to its Z"},
      {probe_nearer, "probe nearer to it, or a greater length"},
      {take_common_datum,
       "it lies between them, so take the axis of both: datum = [{references}] in [target]"},
      {quieter_probe_or_least_squares,
       "{ref}the axis by {association} rests on few readings and takes their noise in whole: a "
       "quieter probe or least squares (without `association`) would prove it"},
      {look_for_cause,
       "{ref}what the readings leave is no noise, neighbours are alike ({autocorrelation::.2f}): "
       "more of them prove nothing. Look for its cause, or clamp the part again and probe again"},
      {more_would_prove, "{parts:, or } would prove it"},
      {more_readings, "about {needed::.0f} readings instead of {now::.0f}"},
      {greater_length, "the same number over {needed::.4g} mm instead of {now::.4g} mm"},
      {quieter_sensor,
       "more than {times::.0f} times the readings would be needed: take a quieter sensor"},
      {hidden_cause,
       "no number of readings proves it: {effect}, which these passes do not show, leaves "
       "{open:um:.2g} µm of the axis open<. {what}><. Or state {stated_as} in the job>"},
      {measurement_would_prove, "readings alone do not prove it: {what}"},
      {nothing_proves,
       "no number of readings proves it: what the compromise, the stated influences and rival "
       "models leave is more than the tolerance"},
      {file_would_do, "{output} would do with {parts: and }"},
      {set_step, "{key} = {step::.6g}"},
      {set_c_step, "c_step_deg = {step:deg:.6g}"},
      {set_rows, "rows_per_revolution = {rows::.0f} in [cut]"},
      {other_format,
       "{output} does not keep the tolerance with any step that the format allows: take another "
       "format"},
      {rows_that_would_do,
       "with rows_per_revolution = {rows::.0f} it is at most {allowed:um:.3g} µm"},
      {rows_do_not_help, "more rows do not help"},
      {follows_with_rows,
       "it would with {rows::.0f} rows a revolution (rows_per_revolution): between {now::.0f} "
       "the interpolation errs too much"},
      {follows_with_set_points,
       "it would with set-points at {rate::.12g} Hz (sampling_hz)<, or {parts}>"},
      {follows_at_speed, "it would {parts}"},
      {at_speed, "at {speed::.12g} rpm"},
      {at_speed_or_less, "at {speed::.12g} rpm or less"},
      {at_no_speed, "not at any speed"},
      {set_surface, "say --surface {surface} if it is one"},
      {program_expected,
       "tip off by at most {at_most:um:two} µm with the new program (in 95 of 100), "
       "{without:um:two} µm on its path without it"},
      {no_program, "errors of the machine identified, no program to compensate"},
      {errors_not_found, "the errors were not found: {message}"},
      {errors_implausible, "{why}"},
      {too_few_cuts,
       "the program has {cuts::.0f} cutting moves, of which nothing is left beside where the "
       "part stands; {fewest::.0f} are the fewest"},
      {blocks_unreachable,
       "{blocks::.0f} of the program's blocks cannot be reached, the first in line "
       "{line::.0f}: {why}"},
      {program_worse,
       "the new program is off by {after:um:two} µm on its path, the old one by "
       "{before:um:two} µm; {remedies}"},
      {found_not_measured_there,
       "{effect} was found, {@beyond_measured}: what it is beyond is not known; measure "
       "where the part is cut"},
      {axis_not_measured_there, "{@beyond_measured}: errors of the axis beyond are not known"},
      {beyond_measured,
       "the program has {axis} from {program_low::.4g} to {program_high::.4g} {unit} and it "
       "was measured from {measured_low::.4g} to {measured_high::.4g} {unit}"},
      {finding_not_told,
       "{effect} is not told from {rivals}< and {more::.0f} more>< (plan {plan} tells them "
       "apart: {what})>"},
      {finding_counted, "{effect} was found: {consequence}"},
      {remark, "{text}"},
      {check_found, "{check}: {text}"},
      {pattern_counted,
       "{pattern} of {amplitude:um:.3g} µm that no effect explains, counted with U"},
      {tool_length_not_measured,
       "line {line::.0f} cuts with a tool of {length::.6g} mm, {beyond::.3g} mm from the "
       "lengths that were measured: a tilt of the spindle of 0.2 mrad, which they do not "
       "show, would move its tip by {moved:um:.3g} µm"},
      {place_of_part_unknown,
       "Where the part stands as a whole is not known, as no ball's place is<: {parts}>"},
      {one_tool_length, "One length of tool does not show the direction of the spindle<: {parts}>"},
      {of_the_part_alone,
       "the numbers are of the part without that, and hold once its zero point is probed on "
       "this machine."},
      {of_found_directions,
       "it shows where the tip is, and directions are those of the errors that were found."},
      {known_without_u, "Errors known beforehand that state no u are taken as exact."},
      {at_a_pole,
       "At a pole of the machine {blocks::.0f} blocks keep the tip and leave up to "
       "{left:deg:.3g} deg of direction."},
      {cut_in_pieces, "cut its blocks in pieces with [program] tolerance_um"},
      {more_decimals, "ask for more [program] decimals"},
      {leaves_line,
       "between its blocks the tip leaves the line by {between:um:two} µm<: cut them in "
       "pieces with [program] tolerance_um = {pieces:um:.0f}>"},
      {not_corrected, "{not_corrected:um:two} µm of it is what was found and no program corrects"},
      {more_rows_measured,
       "U is {left:um:two} µm, and some {times::.2g} times the {rows::.0f} rows, as the "
       "square of U, would do"},
      {measure_plan, "measure {@plan}"},
      {plan, "plan {plan}: {what} ({minutes::.0f} min)"},
      {mend_and_run_again, "Mend what the verdict names, and run the job again."},
      {name_the_program, "Name the part's program in a [program] table, and run the job again."},
      {probe_zero_and_run,
       "Probe the part's zero point on this machine, and run the new program in place of the "
       "old one.< To lift the reservations: {remedies}.>"}};
  static_assert(std::size(in_order_of_codes) == reason_codes);
  static_assert([] {
    for (std::size_t i = 0; i < reason_codes; ++i)
      if (static_cast<std::size_t>(in_order_of_codes[i].code) != i) return false;
    return true;
  }());
  return in_order_of_codes[static_cast<std::size_t>(code)].text;
}

}  // namespace trueaxis
