// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "live/live_state.hpp"

namespace trueaxis {

/// A picture of 20 lines: axis, U and the residuals over C.
std::string live_picture(const LiveState& state, std::optional<double> wanted_U_mm);

/// The same for a program: one line of JSON, schema trueaxis.watch/1.
std::string live_json_line(const LiveState& state, std::optional<double> wanted_U_mm);

/// The part slipped, or the probe is deaf; empty: neither.
std::string live_alarm(const LiveState& state);

/// The U that was asked for is reached.
bool is_enough(const LiveState& state, std::optional<double> wanted_U_mm);

}  // namespace trueaxis
