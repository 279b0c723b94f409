// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::study {

/// A number of a scenario, by the path of its key in the scenario's file with the unit inside:
/// "noise.sigma_mm", "pass.z_end_mm" (of every pass), "pass.0.z_end_mm" (of the first),
/// "effect.1.amplitude_mm", "setup.0.reindex_rad", "noise.autoregression.0" (φ₁). "pass.length_mm"
/// is the travel: the start stays, the end moves the way it lies.
struct ScenarioParameter {
  std::string path;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool open = false;  ///< low and high themselves are not allowed
};

/// What a number is set to, in the unit inside.
struct Setting {
  std::string path;
  double value = 0.0;
};

/// Every number that this scenario has, in the order of its file.
std::vector<ScenarioParameter> scenario_parameters(const virtual_lathe::Scenario& scenario);

/// @throws ContractViolation for a path that the scenario does not have; so does set_parameter.
double parameter(const virtual_lathe::Scenario& scenario, std::string_view path);
void set_parameter(virtual_lathe::Scenario& scenario, std::string_view path, double value);

/// Whether a path is that of a pass' length.
bool is_travel(std::string_view path);

/// Sets numbers that differ from each other, in any order: travels come last, from the start that
/// was set and the way that the pass had before.
void set_parameters(virtual_lathe::Scenario& scenario, std::span<const Setting> settings);

/// Whether two paths write one number: "pass.feed_mm_per_rev" and "pass.0.feed_mm_per_rev",
/// "pass.length_mm" and "pass.z_end_mm". No path that the scenario lacks does.
bool write_same_number(const virtual_lathe::Scenario& scenario, std::string_view a,
                       std::string_view b);

}  // namespace trueaxis::study
