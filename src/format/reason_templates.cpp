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
      {no_target, "axis identified; no target to correct"},
      {coaxiality_expected,
       "coaxiality at most {at_most:um:up} µm with {parts}, {without:um:two} µm without it"},
      {run_out_expected,
       "axial run-out at most {at_most:um:up} µm with {parts}, {without:um:two} µm without it"},
      {with_the_table, "the table (95 % confidence)"},
      {with_files, "{files} (worst: {worst}, 95 % confidence)"},
      {tolerance_kept, "{parts}, tolerance {tolerance:um:.9g} µm"},
      {tolerance_exceeded,
       "{@tolerance_kept}, and at least {at_least:um:down} µm<; {file_that_adds}, as its control "
       "reads it, adds {by_file:um:two} µm of this><; {remedies}>"},
      {tolerance_not_proven,
       "{@tolerance_kept}<; {file_that_adds}, as its control reads it, adds {by_file:um:two} µm of "
       "this><; {remedies}>"},
      {file_too_coarse,
       "{@tolerance_kept}<; {file_that_adds}, as its control reads it, adds {by_file:um:two} µm of "
       "this>: {remedies}"},
      {streams_exchanged,
       "the streams of {file} and {file2} are exchanged: the fits leave residuals of {left:um:.3g} "
       "µm and {left_of_other:um:.3g} µm as given, {exchanged:um:.3g} µm and "
       "{exchanged_of_other:um:.3g} µm if exchanged: exchange their `stream`"},
      {streams_misread,
       "{@axes_apart}, <{offset_left:um:one} µm and >{tilt_left:mrad:.2g} mrad if {parts:, or "
       "}: {remedies:, or }"},
      {axes_apart,
       "the axes of {name} and {name2} are <{offset:um:one} µm and >{tilt:mrad:.2g} mrad apart "
       "(U = <{U_offset:um:.2g} µm and >{tilt.U:mrad:.2g} mrad)"},
      {axes_of_no_part,
       "{@axes_apart}, farther than surfaces of one part can be, and no sign, unit, diameter or "
       "zero of one stream explains it: probe all references in one clamping"},
      {column_reversed, "{column}< of {file}> runs in the opposite direction<: {remedies}>"},
      {x_convention_wrong, "the X of {file} is a {convention}"},
      {probed_from_behind, "{file} was probed from behind"},
      {stream_in_unit, "{file} is in {unit}"},
      {column_in_unit, "the {column} of {file} is in {unit}"},
      {c_zero_differs, "C of {file} counts from another zero< (add {to_add:deg:+.1f}°)>"},
      {z_zero_differs, "Z of {file} counts from another zero< (add {to_add::+.3g} mm)>"},
      {fit_implausible, "{file}: {message}"},
      {fit_failed, "{name}: {message}; {turns}"},
      {part_slipped,
       "{ref}the part slipped in the chuck< at {onset_time::.1f} s>< at reading "
       "{onset_reading::.0f}>< from {begin_time::.1f} s to {end_time::.1f} s>< from reading "
       "{begin_reading::.0f} to {end_reading::.0f}>< by {parts: and }><: {remedies}>"},
      {part_may_have_slipped,
       "{ref}the part may have slipped in the chuck, which the data cannot tell from {effect} "
       "(probability of the slip {probability::.2g}): {remedies}"},
      {part_moved, "{@part_slipped}: the axis given is that of the part after the slip"},
      {slip_unsure, "the part slipped, and its present position is not known"},
      {late_or_slipped,
       "{ref}the spindle changes its speed, and X is late< by about {delay:ms:.3g} ms> or the part "
       "slipped there: give each speed a file of its own"},
      {statement_refuted,
       "{ref}{key} is stated as {stated:usual}, but the readings show {seen:usual} (U, k = 2): "
       "correct the statement, or remove it"},
      {moved_across, "{by:um:pm} µm"},
      {moved_along_z, "{by:um:pm} µm along Z"},
      {moved_tilt, "{by:deg:pm}° of tilt"},
      {moved_turn, "{by:deg:pm}°"},
      {moved_radius, "{by:um:pm} µm of radius"},
      {moved_taper, "{by:deg:pm}° of taper"},
      {slipped_between_references,
       "the part slipped while {name} was probed, and the other references may have been probed "
       "before the slip"},
      {left_out_at_an_end,
       "{ref}most of the {end} {count::.0f} readings of a pass are excluded because they do not "
       "lie where the others do: the part may have slipped there and have moved. Probe again with "
       "a "
       "return pass, which tells a form of the part from a slip, or remove that end from the "
       "stream if the surface ends there"},
      {far_off_at_the_end,
       "{ref}{count::.0f} of the last {last::.0f} readings lie more than {limit::.0f} σ off, as no "
       "other {last::.0f} do: the part may have slipped there and have moved. Clamp it again and "
       "probe again, or remove that end from the stream if the surface ends there"},
      {moved_in_pass, "{ref}{text}"},
      {cut_refused, "{why}"},
      {no_surface_behind_ball,
       "{name}: with a ball of radius {ball::.6g} mm the surface has a radius of {radius::.6g} mm "
       "at Z = {z::.6g} mm: give the radius of the probe's ball, or remove it if the readings are "
       "contact points"},
      {no_material_between,
       "the target is a {target} and the probed surface of {name} is a {probed}: at {along} = "
       "{at::.6g} mm, C = {c:deg:.4g}° there is no material between them ({material:length}): "
       "check which feature is a shaft and which is a bore"},
      {cuts_air,
       "the target cuts air: at {along} = {at::.6g} mm, C = {c:deg:.4g}° the probed surface of "
       "{name} is {material:missing} short of it (U = {material.U:length})"},
      {may_cut_air,
       "the target may cut air: at {along} = {at::.6g} mm, C = {c:deg:.4g}° the probed surface "
       "of {name} has {material:length} over it (U = {material.U:length})"},
      {stock_exceeded,
       "the target needs more than the stated stock of {stock:length}: at {along} = {at::.6g} mm, "
       "C = {c:deg:.4g}° the probed surface of {name} has {material:length} over it (U = "
       "{material.U:length})"},
      {cut_too_far,
       "the cut from Z = {z_start::.6g} to {z_end::.6g} mm lies so far from the probed length of "
       "<the datum {datum}><{name}>, Z = {z_low::.6g} to {z_high::.6g} mm, that U is extrapolated "
       "to {times::.3g} times its value within that length: {remedies}"},
      {cut_far,
       "the cut from Z = {z_start::.6g} to {z_end::.6g} mm lies so far from the probed length of "
       "<the datum {datum}><{name}>, Z = {z_low::.6g} to {z_high::.6g} mm, that U is extrapolated "
       "to {times::.3g} times its value within that length<; {remedies}>"},
      {gauge_shows_no_radius,
       "{name} was read with a relative gauge, which does not show the radius: TrueAxis cannot "
       "check whether the target cuts air there"},
      {actuator_cannot_follow, "the actuator cannot follow: {parts:; }; {remedies}"},
      {stroke_exceeded, "stroke {used:um:.4g} µm of {available:um:.4g} µm"},
      {slew_exceeded, "slew {used::.4g} mm/s of {available::.4g} mm/s"},
      {frequency_exceeded, "frequency {used::.4g} Hz of a bandwidth of {available::.4g} Hz"},
      {set_points_too_few,
       "set-points {per_revolution::.4g} per revolution; order {order::.0f} needs more than "
       "{needed::.0f}"},
      {following_error_exceeded,
       "following error {used:um:.4g} µm of {available:um:.4g} µm<, {unknown:um:.2g} µm of it "
       "because the points of the measured response are too far apart here: measure more of them>"},
      {rows_coarse,
       "{rows::.0f} rows per revolution: straight lines between them are off by up to {off:um:.3g} "
       "µm; {remedies}"},
      {rows_coarse_held,
       "{rows::.0f} rows per revolution: a control that holds each row until the next is off by up "
       "to {off:um:.3g} µm; {remedies}"},
      {interpolation_not_stated,
       "{parts}, tolerance {tolerance:um:.9g} µm; {held:um:two} µm if the control does not join "
       "the "
       "rows of table.csv by straight lines but holds each until the next: {remedies:, or }"},
      {no_uncertainty,
       "the readings do not give an uncertainty: probe more readings, or state the sensor's noise"},
      {motion_refused, "{effect} of {reference} must not enter the correction: {parts}"},
      {not_told_from_forbidden,
       "the data cannot tell it from {cause} (class {class}), which must not be copied into the "
       "cut; the probability of such a cause is {probability::.2g}, the limit is {allowed::.2g}"},
      {not_repeating, "it does not repeat every revolution"},
      {seen_on_a_face, "for a face the cut ignores the motions found on it"},
      {seen_along_x, "it was found along X, and a face is cut along Z"},
      {tool_off_probe_line,
       "the probe measured it along its own direction; the tool's angle from the probe must be 0 "
       "or 180 deg"},
      {beyond_probed_length, "the length to be cut extends beyond the probed length"},
      {named_otherwise, "it is named {effect} there"},
      {shown_by_another, "another reference shows it already"},
      {may_be_forbidden,
       "the probability that it is {cause}, which must not be copied, is {probability::.2g}"},
      {not_found, "it was not found"},
      {not_reproduced,
       "{ref}the causes found do not reproduce the readings: simulated with them, the residual is "
       "{after:um:.3g} µm RMS ({share:%:.0f} % of the variance); with the ideal fit alone it is "
       "{before:um:.3g} µm: {remedies}"},
      {left_unexplained,
       "{ref}the causes found leave a residual of {left:um:.2g} µm, while the {source} show a "
       "noise of {noise:um:.2g} µm: no cause or pattern explains the rest, which may shift the "
       "axis. Check whether the part slipped, clamp it again and probe again"},
      {jump_left,
       "{ref}at data row {row} the residual jumps by {size:um:.3g} µm, {times::.0f} times as far "
       "as "
       "neighbours usually differ: no noise does. A groove, a slot or an edge may draw the axis: "
       "remove its readings from the stream and diagnose again"},
      {pattern_with_axis,
       "{ref}a pattern of {amplitude:um:.2g} µm near one undulation per revolution has no known "
       "cause and may be a shift of the axis: {remedies}"},
      {finding_with_axis,
       "{ref}{effect} is slow or close to once per revolution: over the stream it gains at most "
       "{turns::.2g} turns on the part or its eccentricity and cannot be told from a shift of the "
       "axis: {remedies}"},
      {few_angles,
       "{ref}the {angles::.0f} angles repeat in every revolution or nearly so and cannot tell "
       "{lobes::.0f} lobes from an eccentricity: probe at {enough::.0f} angles or more"},
      {sensor_at_limit,
       "{ref}{count::.0f} readings are at {limit::.6f} mm, the end of the sensor's range, and "
       "falsify the axis: exclude them (--drop-invalid, in a job drop_invalid), or bring the part "
       "within the range and probe again"},
      {undiagnosed_correlated,
       "{ref}its readings are not diagnosed, and their residuals are correlated"},
      {noise_over_stated,
       "{ref}after all causes found, a reading scatters by {left:um:.2g} µm, {times::.2g} times "
       "the stated noise: a cause was not found, or the stated noise is too small"},
      {bow_or_vibration,
       "{ref}a bow found in one pass, or in equal passes, could also be a vibration near the "
       "spindle's frequency, which would move the axis: a return pass at another speed decides"},
      {axis_open,
       "{ref}the diagnosis moved the axis by {moved:um:.2g} µm (U = {moved.U:um:.2g} µm), and "
       "{parts:, }"},
      {finding_has_rival, "{effect} may be {rival}"},
      {pattern_without_cause, "a pattern has no known cause"},
      {axis_open_beyond_tolerance,
       "{parts}; if the axis is where the ideal fit has it, the coaxiality is up to "
       "{if_ideal:um:two} µm, tolerance {tolerance:um:.9g} µm"},
      {improbable_and_far,
       "{ref}{effect} could also be {rival}. That is unlikely at this size, but it would move the "
       "axis by {shift:um:.0f} µm: measure it, or {remedies}"},
      {sensor_or_eccentricity,
       "{ref}{effect} moves the axis by {shift:um:.2g} µm. On a part that turns off-centre it "
       "cannot be told from lobes in phase with the eccentricity, which would not move the axis: "
       "probe once more with the slide moved by some tenths of a millimetre, as a set-up of its "
       "own, or calibrate the sensor"},
      {axis_of_cut_not_stated,
       "the job cuts the part about the {axis} axis, not about the final axis"},
      {datum_members_apart,
       "{name} is at least {off:um:.3g} µm (a diameter, over the cut) off the datum {datum}. This "
       "is more than the tolerance, so the references of the datum do not share one axis: check "
       "whether all were probed in one clamping and whether Z and C are counted alike"},
      {reference_off_datum,
       "{name} is at least {off:um:.3g} µm (a diameter, over the cut) off the datum {datum}, and "
       "the job does not compare this with a tolerance: check whether it was probed in the same "
       "clamping"},
      {form_not_met, "the {form} of {name} is NOT MET; the verdict covers the cut only"},
      {form_not_proven, "the {form} of {name} is NOT PROVEN; the verdict covers the cut only"},
      {form_not_judged, "the {form} of {name} is NOT JUDGED; the verdict covers the cut only"},
      {reads_a_face, "surface assumed: plane, because Z_M is read at C and X"},
      {no_change_of_z, "surface assumed: one section, because Z does not change"},
      {cone_at_last, "surface assumed: cone"},
      {no_taper_seen, "surface assumed: cylinder, because the readings show no taper; {remedies}"},
      {taper_seen,
       "surface assumed: {surface}, because <the half angle is {half_angle:deg:of U}° ± "
       "{half_angle.U:deg:two}°><the radius changes by {change:um:.4g} µm over {length::.4g} mm of "
       "Z><; {remedies}>"},
      {not_one_surface,
       "is not one {surface}: {parts:; }. A jump at the same C and another Z is the shape of the "
       "part, not a slip or an error of X, Z or C. Give the Z range of one surface: {remedies:, or "
       "}; or use `trueaxis run {stream} -o FOLDER` without --surface for all seats"},
      {one_seat_found, "the stream has one seat, {remedies}, and more next to it: {parts:; }"},
      {seats_found, "the stream has {seats::.0f} seats ({remedies:, }): {parts:; }"},
      {seat, "Z {from::.10g} to {to::.10g} mm"},
      {range_by_options, "--z-from-mm {from::.10g} --z-to-mm {to::.10g}"},
      {range_by_keys, "z_from_mm = {from::.10g}, z_to_mm = {to::.10g}"},
      {radius_steps, "the radius steps by {step::+.4g} mm at Z {z::.4g} mm, a shoulder"},
      {taper_changes, "the taper changes by {change:deg:.2g}° at Z {z::.4g} mm"},
      {not_read, "there are no readings about Z {z::.4g} mm"},
      {of_no_seat, "{readings::.0f} readings at Z {from::.4g} to {to::.4g} mm are of no seat"},
      {clamp_again, "clamp it again and probe again"},
      {probe_all_again, "clamp the part again and probe all references again"},
      {probe_again, "probe again"},
      {probe_at_other_speed, "probe again at another speed and another feed"},
      {measure, "{what}"},
      {turn_sign, "reverse the sign of its column {column}"},
      {turn_sign_behind, "X is negative when probed there: reverse the sign of its column X_M"},
      {set_x_convention, "x_convention = \"{convention}\""},
      {name_unit, "write [{unit}] after the name of {column}"},
      {name_units, "write [{unit}] after the names of X and Z"},
      {clamp_all_once_c,
       "another clamping: probe all references in one clamping, or add the angle to its C"},
      {clamp_all_once_z,
       "another clamping: probe all references with one datum, or add the length to its Z"},
      {probe_nearer, "probe nearer to it, or over a greater length"},
      {take_common_datum,
       "it lies between them, so use the common axis of both: datum = [{references}] in [target]"},
      {quieter_probe_or_least_squares,
       "{ref}the axis by {association} rests on few readings and includes all of their noise: a "
       "quieter probe or least squares (without `association`) would prove it"},
      {look_for_cause,
       "{ref}the residuals are not noise, because neighbours are alike ({autocorrelation::.2f}): "
       "more readings prove nothing. Look for the cause, or clamp the part again and probe again"},
      {more_would_prove, "{parts:, or } would prove it"},
      {more_readings, "about {needed::.0f} readings instead of {now::.0f}"},
      {greater_length, "the same number over {needed::.4g} mm instead of {now::.4g} mm"},
      {quieter_sensor,
       "more than {times::.0f} times the readings would be needed: use a quieter sensor"},
      {hidden_cause,
       "no number of readings proves it: {effect}, which these passes do not show, leaves "
       "{open:um:.2g} µm of the axis unknown<. To show it, {what}><. Or state {stated_as} in the "
       "job>"},
      {measurement_would_prove, "readings alone do not prove it: {what}"},
      {nothing_proves,
       "no number of readings proves it: the compromise, the stated influences and the rival "
       "causes together exceed the tolerance"},
      {file_would_do, "{output} keeps the tolerance with {parts: and }"},
      {set_step, "{key} = {step::.6g}"},
      {set_c_step, "c_step_deg = {step:deg:.6g}"},
      {set_rows, "rows_per_revolution = {rows::.0f} in [cut]"},
      {set_interpolation,
       "state interpolation = \"linear\" or \"none\" in [cut], as the control does"},
      {other_format,
       "{output} does not keep the tolerance with any step of the format: use another format"},
      {rows_that_would_do,
       "with rows_per_revolution = {rows::.0f} it is at most {allowed:um:.3g} µm"},
      {rows_do_not_help, "more rows do not help"},
      {follows_with_rows,
       "it can follow with {rows::.0f} rows per revolution (rows_per_revolution): with {now::.0f} "
       "the interpolation error is too large"},
      {follows_with_set_points,
       "it can follow with set-points at {rate::.12g} Hz (sampling_hz)<, or {parts}>"},
      {follows_at_speed, "it can follow {parts}"},
      {at_speed, "at {speed::.12g} rpm"},
      {at_speed_or_less, "at {speed::.12g} rpm or less"},
      {at_no_speed, "at no speed"},
      {set_surface, "use --surface {surface} if it is one"},
      {program_expected,
       "tip off by at most {at_most:um:up} µm with the new program (95 % confidence), "
       "{without:um:two} µm on its path without it"},
      {no_program, "errors of the machine identified; no program to compensate"},
      {errors_not_found, "the errors were not found: {message}"},
      {errors_implausible, "{why}"},
      {too_few_cuts,
       "the program has {cuts::.0f} cutting moves, too few to separate its errors from the place "
       "of the part; at least {fewest::.0f} are needed"},
      {blocks_unreachable,
       "the machine cannot reach {blocks::.0f} of the program's blocks, the first in line "
       "{line::.0f}: {why}"},
      {program_worse,
       "the new program is off by {after:um:two} µm on its path, the old one by "
       "{before:um:two} µm; {remedies}"},
      {rapids_not_counted,
       "not counted: rapid moves with an unknown axis, which stay as they are ({moves::.0f}, from "
       "line {line::.0f})"},
      {ways_not_counted,
       "counted at their end only: cutting moves from an unknown position ({moves::.0f}, from line "
       "{line::.0f})"},
      {direction_worse,
       "the tool's direction comes out worse: {after:deg:.2g}° for {before:deg:.2g}° (line "
       "{line::.0f})<; {remedies}>"},
      {correct_all_rotary, "--rotary all (in a job [program] rotary) corrects it"},
      {found_not_measured_there,
       "{effect} was found, {@beyond_measured}: its size beyond that is not known; measure where "
       "the part is cut"},
      {axis_not_measured_there, "{@beyond_measured}: errors of the axis beyond that are not known"},
      {beyond_measured,
       "the program moves {axis} from {program_low::.4g} to {program_high::.4g} {unit}, and the "
       "measurement covers {measured_low::.4g} to {measured_high::.4g} {unit}"},
      {finding_not_told,
       "the data cannot tell {effect} from {rivals}< and {more::.0f} more>< (plan {plan} tells "
       "them apart: {what})>"},
      {finding_counted, "{effect} was found: {consequence}"},
      {remark, "{text}"},
      {check_found, "{check}: {text}"},
      {pattern_counted,
       "{pattern} of <{amplitude:um:.3g} µm><{angle:deg:.3g}°> has no known cause; what the tip is "
       "off by at most includes <{amplitude_left:um:.3g} µm><{angle_left:deg:.3g}°> of it, which "
       "the calibration does not explain either"},
      {tool_length_not_measured,
       "line {line::.0f} cuts with a tool of {length::.6g} mm, {beyond::.3g} mm from the measured "
       "lengths: a tilt of the spindle of 0.2 mrad, which they do not show, would move its tip by "
       "{moved:um:.3g} µm"},
      {place_of_part_unknown, "The place of the part as a whole is not known<: {parts}>"},
      {one_tool_length, "One tool length does not show the direction of the spindle<: {parts}>"},
      {of_the_part_alone,
       "the numbers apply to the part without this place, and hold once its zero point is probed "
       "on this machine."},
      {of_found_directions,
       "the measurement shows the position of the tip; directions are computed from the errors "
       "found."},
      {known_without_u, "Errors known beforehand without u are treated as exact."},
      {at_a_pole,
       "At a pole of the machine {blocks::.0f} blocks keep the tip but leave up to {left:deg:.3g} "
       "deg of direction."},
      {cut_in_pieces, "split its blocks with [program] tolerance_um"},
      {more_decimals, "raise [program] decimals"},
      {leaves_line,
       "between its blocks the tip leaves the line by {between:um:two} µm<: split them with "
       "[program] tolerance_um = {pieces:um:.0f}>"},
      {not_corrected,
       "mend on the machine the errors found that no program can correct: {not_corrected:um:two} "
       "µm "
       "of this"},
      {more_rows_measured,
       "U is {left:um:two} µm; about {times::.2g} times the {rows::.0f} rows would be enough, as U "
       "falls with the square root of their number"},
      {measure_plan, "measure {@plan}"},
      {measure_between, "measure also at positions of {axis} between those measured"},
      {plan, "plan {plan}: {what} ({minutes::.0f} min)"},
      {mend_and_run_again, "Correct what the verdict names, and run the job again."},
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
