// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "studies/published/published.hpp"

namespace trueaxis {

/// Reads a sweep (see parse_sweep_toml) whose file may have a table of published single runs:
///
///     [paper]      source = "…"   parameters = ["x0", "k"]
///     [[paper.row]]  at = ["10"]   values = ["0.0507", "402.036"]     ("?": a noise level lost)
///     [[paper.reading]]  name = "…"   set = { "pass.z_end_mm" = -10 }
///                  printed_per_error = { half_angle = 2 }   noise_factor = 1   fit_noise = false
///                  least_decimals = { y0 = 4 }
///
/// @throws InputError with every diagnostic: file, line, column, what to do.
study::PublishedSweep read_published_sweep(const std::string& path);

/// The same from text; `path` names it in diagnostics and places the scenario's file.
study::PublishedSweep parse_published_sweep(std::string_view content, const std::string& path);

}  // namespace trueaxis
