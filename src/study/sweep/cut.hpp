// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/bound/quantities.hpp"
#include "trueaxis/fit.hpp"
#include "trueaxis/surface.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::study {

/// The residual on a part that was cut about an axis as it was found.
struct CutOutcome {
  double coaxiality_mm = 0.0;  ///< of the cut with the true axis of the reference, a diameter
  double at_most_mm = 0.0;     ///< what a run says it is at most (95 % confidence)
  double residual_mm = 0.0;    ///< RMS of the cut about its own surface
};

/// What a sweep that cuts compares in addition to the surface's: `coaxiality`, `cut_residual`.
std::vector<Quantity> cut_quantities();

/// Corrects for the axis found, cuts in the virtual lathe as the program says, and probes the
/// result without noise. It probes a feed within both ends, at a lead that is not a multiple of the
/// feed.
CutOutcome cut_about(const virtual_lathe::CutProgram& program, const AxisEstimate& found,
                     const Axis& truth);

}  // namespace trueaxis::study
