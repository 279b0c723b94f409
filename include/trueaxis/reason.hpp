// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

/// What a decision rests on, as data. The words of a code are in `format/reason_templates.cpp` and
/// nowhere else; JSON carries the code, so that a program acts on it without reading a sentence.
namespace trueaxis {

/// What a reason or a remedy says. The identifier in JSON is the name of the constant.
enum class ReasonCode {
  // The decision about a cut.
  no_target,
  coaxiality_expected,
  run_out_expected,
  with_the_table,
  with_files,
  tolerance_kept,
  tolerance_exceeded,
  tolerance_not_proven,
  file_too_coarse,
  // Streams and fits.
  streams_exchanged,
  streams_misread,
  axes_apart,
  axes_of_no_part,
  column_reversed,
  x_convention_wrong,
  probed_from_behind,
  stream_in_unit,
  column_in_unit,
  c_zero_differs,
  z_zero_differs,
  fit_implausible,
  fit_failed,
  // The part moved.
  part_slipped,
  part_may_have_slipped,
  part_moved,
  slip_unsure,
  late_or_slipped,
  statement_refuted,
  moved_across,
  moved_along_z,
  moved_tilt,
  moved_turn,
  moved_radius,
  moved_taper,
  slipped_between_references,
  left_out_at_an_end,
  far_off_at_the_end,
  moved_in_pass,
  // Geometry of the cut.
  cut_refused,
  no_surface_behind_ball,
  no_material_between,
  cuts_air,
  may_cut_air,
  stock_exceeded,
  cut_too_far,
  cut_far,
  gauge_shows_no_radius,
  // The actuator.
  actuator_cannot_follow,
  stroke_exceeded,
  slew_exceeded,
  frequency_exceeded,
  set_points_too_few,
  following_error_exceeded,
  rows_coarse,
  rows_coarse_held,
  interpolation_not_stated,
  no_uncertainty,
  // Motions asked into the correction.
  motion_refused,
  not_told_from_forbidden,
  not_repeating,
  seen_on_a_face,
  seen_along_x,
  tool_off_probe_line,
  beyond_probed_length,
  named_otherwise,
  shown_by_another,
  may_be_forbidden,
  not_found,
  // What the model leaves open.
  not_reproduced,
  left_unexplained,
  jump_left,
  pattern_with_axis,
  finding_with_axis,
  few_angles,
  sensor_at_limit,
  undiagnosed_correlated,
  noise_over_stated,
  bow_or_vibration,
  axis_open,
  finding_has_rival,
  pattern_without_cause,
  axis_open_beyond_tolerance,
  improbable_and_far,
  sensor_or_eccentricity,
  axis_of_cut_not_stated,
  // Datum and form.
  datum_members_apart,
  reference_off_datum,
  form_not_met,
  form_not_proven,
  form_not_judged,
  // Surface by evidence.
  reads_a_face,
  no_change_of_z,
  cone_at_last,
  no_taper_seen,
  taper_seen,
  not_one_surface,
  one_seat_found,
  seats_found,
  seat,
  range_by_options,
  range_by_keys,
  radius_steps,
  taper_changes,
  not_read,
  of_no_seat,
  // Remedies.
  clamp_again,
  probe_all_again,
  probe_again,
  probe_at_other_speed,
  measure,
  turn_sign,
  turn_sign_behind,
  set_x_convention,
  name_unit,
  name_units,
  clamp_all_once_c,
  clamp_all_once_z,
  probe_nearer,
  take_common_datum,
  quieter_probe_or_least_squares,
  look_for_cause,
  more_would_prove,
  more_readings,
  greater_length,
  quieter_sensor,
  hidden_cause,
  measurement_would_prove,
  nothing_proves,
  file_would_do,
  set_step,
  set_c_step,
  set_rows,
  set_interpolation,
  other_format,
  rows_that_would_do,
  rows_do_not_help,
  follows_with_rows,
  follows_with_set_points,
  follows_at_speed,
  at_speed,
  at_speed_or_less,
  at_no_speed,
  set_surface,
  // The program of a machine.
  program_expected,
  no_program,
  errors_not_found,
  errors_implausible,
  too_few_cuts,
  blocks_unreachable,
  program_worse,
  rapids_not_counted,
  ways_not_counted,
  direction_worse,
  correct_all_rotary,
  found_not_measured_there,
  axis_not_measured_there,
  beyond_measured,
  finding_not_told,
  finding_counted,
  remark,
  check_found,
  pattern_counted,
  tool_length_not_measured,
  place_of_part_unknown,
  one_tool_length,
  of_the_part_alone,
  of_found_directions,
  known_without_u,
  at_a_pole,
  cut_in_pieces,
  more_decimals,
  leaves_line,
  not_corrected,
  more_rows_measured,
  measure_plan,
  measure_between,
  plan,
  mend_and_run_again,
  name_the_program,
  probe_zero_and_run,
  count_
};

inline constexpr std::size_t reason_codes = static_cast<std::size_t>(ReasonCode::count_);

/// "part_slipped"
const char* to_string(ReasonCode code);

/// A number that a reason rests on. Inside: mm, rad, s.
struct ReasonNumber {
  const char* name;
  double value = 0.0;
  const char* unit = "1";
  double U = 0.0;  ///< expanded uncertainty; 0: none is stated
};

/// An effect, a file, a column or a key that a reason is about.
struct ReasonName {
  const char* key;
  std::string value;
};

/// Why something is decided, or what mends it.
struct Reason {
  ReasonCode code = ReasonCode::no_target;
  std::vector<std::size_t> references{};  ///< of the job, that it is of
  std::vector<ReasonNumber> numbers{};
  std::vector<ReasonName> names{};
  std::vector<Reason> parts{};     ///< reasons that it is made of
  std::vector<Reason> remedies{};  ///< what mends it; any of them does

  const ReasonNumber* number(const char* name) const;
};

using Reasons = std::vector<Reason>;

}  // namespace trueaxis
