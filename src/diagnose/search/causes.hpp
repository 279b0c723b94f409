// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/regression/normal_equations.hpp"

namespace trueaxis::diagnose_detail {

/// Every variant of the effects that a search tries one by one in every step, by their SearchRange.
/// `tests` of each is how many of its kind there are. Harmonics in the part's frame stand for all
/// of their order until causes_of_order tells them apart, unless re-chucking does.
std::vector<Hypothesis> preset_causes(const Problem& problem);

/// Whether it is the error that readings rounded to a step make: it has the step's period over what
/// is sensed, or a harmonic of it, as far as the swing tells periods apart. It is subtracted, but
/// is not an error of the scale. 0: nothing was rounded.
bool is_rounding(const Hypothesis& hypothesis, const LinearisationPoint& point, double step_mm);

/// Causes in addition to the presets that show as the harmonic of an order.
std::vector<Hypothesis> causes_of_order(const Problem& problem, int order);

/// The shape of an effect that stands for it: its typical one, with the sensor's place and range.
TermShape typical_shape(const Effect& effect, const LinearisationPoint& point);

/// A value of a parameter of the shape in its own unit.
double value_in(ShapeValues::In in, double value, const LinearisationPoint& point);

/// Readings on either side of a step: with fewer, its size would explain two outliers.
constexpr std::size_t least_beside_step = 8;

/// Times between which a step may lie, or their middle if there are too few readings.
Extent dates_of_steps(const LinearisationPoint& point);

constexpr double least_swing_mm = 0.02;  ///< sensed: below it no period of the scale is seen
constexpr double least_tangent = 1e-3;   ///< of the half angle: below it a cone is a cylinder

/// Neighbours of a hypothesis in its continuous shape (by the effect's Refinement, of a slip that
/// lasts then by its duration; for a bump, its window), in pairs `step` to either side on a scale
/// where 1 is the range; lines are refined elsewhere.
std::vector<Hypothesis> neighbours(const Hypothesis& hypothesis, const LinearisationPoint& point,
                                   double step);

}  // namespace trueaxis::diagnose_detail
