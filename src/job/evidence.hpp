// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/probe_stream.hpp"
#include "trueaxis/reason.hpp"
#include "trueaxis/surface.hpp"

namespace trueaxis {

/// The surface that a stream's readings are of, and why.
struct SurfaceEvidence {
  SurfaceKind surface = SurfaceKind::cone;
  Reason why;
};

/// A face is a plane, a stream without a change of Z a section. Else a cone where its half angle
/// is beyond 3 u and the radius changes over the probed length by more than a thousandth of the
/// length, which is more than a slide or a worn bed makes of a cylinder; else a cylinder.
SurfaceEvidence surface_by_evidence(const ProbeStream& stream);

}  // namespace trueaxis
