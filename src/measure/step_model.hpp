// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "measure/turn_centres.hpp"

/// What the search of a step and the delay that explains it share.
namespace trueaxis::step_model {

inline constexpr std::size_t least_run = 8;  // centres: twice the parameters of a coordinate

/// x and y of a run of turns, one row each.
Eigen::MatrixX2d places(std::span<const TurnCentre> run);

/// 1, Z and the number of the turn, Z and number from −1 to 1: a line along Z and a drift.
Eigen::MatrixXd line(std::span<const TurnCentre> run);

/// Squares of the centres about a model of `columns`, x and y together.
double squares_about(const Eigen::MatrixXd& columns, const Eigen::MatrixX2d& centres);

/// Variance of a coordinate: noise, or neighbours by second differences if that is larger.
/// What goes to and fro is not a step.
double variance(const Eigen::MatrixX2d& centres, double u_mm);

/// χ² that four parameters more explain in noise with probability `by_chance`, one place a centre.
double enough(double by_chance, std::size_t centres);

}  // namespace trueaxis::step_model
