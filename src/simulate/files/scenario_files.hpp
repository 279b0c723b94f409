// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "format/toml_reader.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {

/// Reads a scenario of the virtual lathe. Keys carry their unit (`_mm` may be `_um`, `_in`, `_m`;
/// `_deg` may be `_rad`, `_mrad`, `_urad`, `_arcsec`; `_s` may be `_ms`, `_us`, `_min`):
///
///     name = "…"   seed = 1
///     [part]       surface = "cone" | "cylinder" | "face"   feature = "shaft" | "bore"
///                  x0_mm y0_mm l m   k_mm + half_angle_deg | radius_mm (+ radius_at_mm,
///                  half_angle_deg with its sign)   d_mm   u_start_mm u_end_mm
///     [probe]      ball_radius_mm relative_zero_mm nominal_radius_mm states_noise
///                  sensor_angles_deg = [0, 99, 202] (several sensors, from +X towards +Y)
///     [noise]      sigma_mm uniform_mm rho student_dof incidence outlier_fraction outlier_size_mm
///                  outliers_one_sided quantisation_mm   autoregression = [φ₁, φ₂ …] (not rho)
///     [[pass]]     z_start_mm z_end_mm | z_mm (face: x_…)   feed_mm_per_rev speed_rpm
///                  readings_per_revolution revolutions (dwell) duration_s rate_hz (stationary)
///                  jitter pause_s c_start_deg setup
///     [[setup]]    number reindex_deg z_shift_mm side = "front" | "rear" x_jog_mm
///                  clamp_force_ratio x0_mm y0_mm l m
///     [[effect]]   id = "part.roundness" and the parameters of that effect
///     [cut]        table = "path.csv"  use = "command" | "wanted" | "none"
///     [cut.target] surface = "cylinder" | "cone" | "face"   feature   z_start_mm z_end_mm (where
///                  the contact starts and ends) radius_mm (at z_start) half_angle_deg opens | z_mm
///                  radius_start_mm radius_end_mm
///     [cut.tool]   nose_radius_mm tool_height_mm angle_from_probe_deg speed_rpm sense = "+c" |
///                  "-c"  feed_mm_per_rev c_start_deg
///     [cut.actuator] perfect natural_frequency_hz damping delay_s sampling_hz
///
/// These are a job's words. Still read are those that a scenario had before: kind, bore = true,
/// z_face_mm, x_start_mm, x_end_mm, height_mm, sense = 1 | -1, a half angle with its sign.
///
/// @throws InputError with every diagnostic: file, line, column, what to do.
virtual_lathe::Scenario read_scenario_toml(const std::string& path);

/// The same from text; `path` names it in diagnostics and places relative file names.
virtual_lathe::Scenario parse_scenario_toml(std::string_view content, const std::string& path);

/// [part], [probe], [noise], [[pass]], [[setup]], [[effect]] and [cut] of a table.
void read_scenario_tables(TomlTable root, virtual_lathe::Scenario& scenario);

/// The lists [[pass]], [[setup]] and [[effect]] of a table; a face's passes run along X.
std::vector<virtual_lathe::PlannedPass> read_passes(TomlTable table, bool face);
std::vector<virtual_lathe::Chucking> read_setups(TomlTable table);
std::vector<virtual_lathe::Effect> read_effects(TomlTable table);

/// What the virtual lathe knows, schema "trueaxis.truth/1": part, effects, noise, seed, rows of
/// outliers and clipped readings (0-based). Lengths in mm, angles in degrees, times in s, each
/// value with its unit. `half_angle` is in (0, 90°); the place of k says which way the cone opens.
std::string truth_json(const virtual_lathe::Truth& truth);

/// Reads a correction table for the virtual cut: `#` lines, then a header
/// `rev,Z[mm],C[deg],X_fts[mm],X_command[mm]` (face: `rev,X[mm],C[deg],Z_fts[mm],Z_command[mm]`)
/// and rows. C may be wrapped to [0, 360) or running; it is unwrapped in the `sense` (±1) of the
/// cut.
/// @throws InputError with every diagnostic.
virtual_lathe::CutTable read_cut_table(const std::string& path, int sense);
virtual_lathe::CutTable parse_cut_table(std::string_view content, const std::string& path,
                                        int sense);

}  // namespace trueaxis
