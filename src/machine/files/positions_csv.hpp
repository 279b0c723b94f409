// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "trueaxis/machine.hpp"

namespace trueaxis {

/// Reads axis positions: a header `X[mm],A[deg] …` with every axis of the machine, a row a
/// position; `#` begins a comment. @throws InputError with every diagnostic.
std::vector<AxisPositions> read_positions_csv(const std::string& path, const Machine& machine);

/// Reads tool positions: a header `x,y,z,i,j,k` (mm; `x[mm]` too), a row a point, the direction of
/// any length but 0; a column `twist[deg]`, which `pose` writes, is ignored. @throws InputError
std::vector<ToolTarget> read_tool_targets_csv(const std::string& path);

/// `x[mm],y[mm],z[mm],i,j,k,twist[deg]`: every digit of the doubles; twist about the tool's
/// direction, actual against nominal.
std::string poses_csv(std::span<const ToolPose> poses, std::span<const double> twists_rad);

/// Solutions of a point, by point: `point,solution,X[mm]…`, both from 1.
std::string axes_csv(const Machine& machine, std::span<const std::vector<AxisPositions>> solutions);

}  // namespace trueaxis
