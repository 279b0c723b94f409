// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "calibrate/diagnose/term.hpp"

namespace trueaxis::calibrate_detail {

/// A function of the row, as few columns. It depends on one axis, on two, or on the time.
struct PatternFunction {
  std::string words;                     ///< "harmonic 5 of C"
  MatrixXd values;                       ///< a row of the problem each
  std::vector<ErrorFunction> functions;  ///< of one axis alone: as errors, one a column
  std::optional<PatternPlace> place;
  std::string letters;  ///< of the axes that it is a function of; t: of the time
};

/// Functions of one axis that no effect has: orders 5 to 12 or degrees above `highest` to 6, bumps,
/// steps; without those that the effects' own make at these positions.
/// @param highest degree of the effects
std::vector<PatternFunction> functions_of_axis(const Problem& problem, std::size_t axis,
                                               int highest);
/// Products of the two lowest orders or degrees of two axes.
std::vector<PatternFunction> functions_of_two(const Problem& problem, std::size_t a, std::size_t b);
/// What warms up, bends or steps in time.
std::vector<PatternFunction> functions_of_time(const Problem& problem);
/// What grows along an axis with the time.
std::vector<PatternFunction> growths(const Problem& problem, std::size_t axis);

/// cos and sin of an order of a whole turn, of size 1.
std::vector<ErrorFunction> harmonic(int order);

PatternFunction bump(const Problem& problem, std::size_t axis, double at, double width);
PatternFunction step(const Problem& problem, std::size_t axis, double at);

/// Bumps and steps near a place.
std::vector<PatternFunction> near(const Problem& problem, const PatternPlace& place);

}  // namespace trueaxis::calibrate_detail
