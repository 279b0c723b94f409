// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "format/json.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis {

/// Schema trueaxis.fit/1: lengths in mm, angles in degrees, every number with unit and u or the
/// reason why not.
std::string fit_json(const FitResult& result);

/// The same as an object, for results that hold one.
Json fit_object(const FitResult& result);

/// {"row", "why"} of each reading that does not count, and read back.
Json rejected_json(const std::vector<Rejected>& rows);
std::vector<Rejected> rejected_from(const Json& json);

/// The fit that `fit_object` wrote, but for what only its readings can tell: no residuals, budget
/// or covariance of the parameters; of each set-up the axis. One that did not
/// converge has no numbers. @throws Json::exception and InputError for what is not a fit.
FitResult fit_from_object(const Json& json);

/// The same of a file's text, converged and with the covariance of its axis.
/// @param path of the text, for messages
/// @throws InputError if its schema is not trueaxis.fit/1.
FitResult fit_from_json(std::string_view text, const std::string& path);

/// The fit for a person at a terminal: status, parameters with U, residuals, what to do.
std::string fit_text(const FitResult& result);

/// A fit in some eight lines for a person: how good it is, the axis, the sizes, what to know of
/// it. Lines are not broken (the command does). fit_text() has every parameter.
std::string fit_screen(const FitResult& result);

/// "axis   x 48.19 µm, y -31.01 µm, U 0.35 µm at Z 0 mm" at both ends of the readings; of a plane
/// its tilt; empty if nothing was fitted.
std::string axis_screen(const FitResult& result);

/// For those without a servo: at which C the part is out towards the probe, at the end that is
/// farther off, and how far to tap it there. The run-out is twice the distance of the axis, of a
/// face twice what its tilt makes at X; a probe at the rear meets the high spot half a turn later.
/// Empty where the offset is within twice its U, and where nothing was fitted.
std::string tap_text(const FitResult& result);

/// "tap    The cone runs out 129 µm at Z 0 mm: tap at C = 16° by 64.7 µm", the line of a screen
/// that a machinist acts on; empty as tap_text().
std::string tap_screen(const FitResult& result, const std::string& name);

/// "axis known to ± 0.88 µm (k = 2)", at the end that is known less; "axis not known"; for a plane
/// its tilt; empty for a surface without an axis.
std::string axis_accuracy(const FitResult& result);

}  // namespace trueaxis
