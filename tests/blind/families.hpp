// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "blind/bench.hpp"
#include "blind/plans.hpp"

namespace trueaxis::blind {

using virtual_lathe::Effect;

/// A parameter that an effect is proportional to, and the upper end of its typical range
/// (docs/reference/effects.md), in the unit of its name.
struct Size {
  std::string_view name;
  double typical_most;
};

/// An effect of the lathe as the judge knows it: a form or cause that competes as a name.
struct Family {
  std::string_view id;
  std::vector<Size> sizes;
};

/// The catalogued causes: the lathe's effects without the checks of the data's quality and without
/// what no catalogue has (extra.*).
const std::vector<Family>& families();

/// Also of extra.*. @throws std::invalid_argument for an unknown id.
const Family& family(std::string_view id);

/// All sizes times `factor`.
Effect scaled(Effect effect, double factor);

/// The effect whose sizes are at the upper end of their range, of a size between the ends that is
/// as likely in every octave; `unit` draws from [0, 1), where the catalogue gives both ends.
Effect of_typical_size(Effect largest, const std::function<double()>& unit);

/// Largest size over the upper end of its typical range.
double over_typical(const Effect& effect);

/// Orders, frequencies, pitches, bearings, instants and phases drawn from the typical ranges; the
/// sizes at the upper end. Lines stay below half the sampling rate of the slow pass.
Effect draw_effect(std::string_view id, const Bench& bench, std::mt19937_64& random);

/// Effects whose changes of the readings span what the cause can do when amplitudes, phases and
/// signs are free and the shape (order, pitch, instant …) is that of `shaped`.
std::vector<Effect> directions(const Effect& shaped);

/// The changes of the readings by directions(shaped), a column each.
Eigen::MatrixXd columns(const Bench& bench, const Effect& shaped);

}  // namespace trueaxis::blind
