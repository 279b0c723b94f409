// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "measure/seats.hpp"
#include "trueaxis/job.hpp"
#include "trueaxis/probe_stream.hpp"
#include "trueaxis/reason.hpp"
#include "trueaxis/surface.hpp"

namespace trueaxis {

/// The surface that a stream's readings are of, and why.
struct SurfaceEvidence {
  SurfaceKind surface = SurfaceKind::cone;
  Reason why;
};

/// A face is a plane, a stream without a change of Z a section. Else a cone if its half angle is
/// beyond 3 u and the radius changes over the probed length by more than a thousandth of the
/// length. That is more than a slide or a worn bed makes of a cylinder. Else a cylinder.
SurfaceEvidence surface_by_evidence(const ProbeStream& stream);

/// That the readings of a stream that is to be one cone or cylinder are of several (find_seats).
/// @param of_seat how the remedies say the Z range of each
std::optional<Reason> not_one_surface(const ProbeStream& stream, SurfaceKind surface,
                                      ReasonCode of_seat);

/// The seats that were found.
Reason seats_reason(const Seats& seats);

/// Of a job of one stream: a reference for every seat that is found in it, named A, B …, with its
/// readings. A stream of one surface stays as it is. @returns the seats, if there are any
std::optional<Reason> take_every_seat(Job& job, std::vector<ProbeStream>& streams);

}  // namespace trueaxis
