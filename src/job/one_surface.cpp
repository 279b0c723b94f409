// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "fit/plausible.hpp"
#include "job/evidence.hpp"

namespace trueaxis {
namespace {

Reason reason_of(const SeatBreak& one) {
  switch (one.kind) {
    case SeatBreak::Kind::step:
      return {ReasonCode::radius_steps, {}, {{"step", one.step_mm, "mm"}, {"z", one.z_mm, "mm"}}};
    case SeatBreak::Kind::slope:
      return {ReasonCode::taper_changes,
              {},
              {{"change", std::atan(std::abs(one.slope_change)), "rad"}, {"z", one.z_mm, "mm"}}};
    case SeatBreak::Kind::gap:
      break;
  }
  return {ReasonCode::not_read, {}, {{"z", one.z_mm, "mm"}}};
}

/// What parts the seats, and each seat as a remedy of its own code.
Reason reason_of(const Seats& seats, ReasonCode code, ReasonCode of_seat) {
  Reason reason{code, {}, {{"seats", static_cast<double>(seats.seats.size())}}};
  for (const SeatBreak& one : seats.breaks) reason.parts.push_back(reason_of(one));
  for (const Seat& one : seats.left_out)
    reason.parts.push_back({ReasonCode::of_no_seat,
                            {},
                            {{"readings", static_cast<double>(one.readings)},
                             {"from", one.z.from_mm, "mm"},
                             {"to", one.z.to_mm, "mm"}}});
  for (const Seat& seat : seats.seats)
    reason.remedies.push_back(
        {of_seat, {}, {{"from", seat.z.from_mm, "mm"}, {"to", seat.z.to_mm, "mm"}}});
  return reason;
}

}  // namespace

std::optional<Reason> not_one_surface(const ProbeStream& stream, SurfaceKind surface,
                                      ReasonCode of_seat) {
  if (surface != SurfaceKind::cone && surface != SurfaceKind::cylinder) return {};
  if (!column_objection(stream).empty()) return {};  // the fit says so
  const Seats found = find_seats(stream);
  if (!found.broken()) return {};
  Reason reason = reason_of(found, ReasonCode::not_one_surface, of_seat);
  reason.names = {{"surface", to_string(surface)}, {"stream", stream.source}};
  return reason;
}

Reason seats_reason(const Seats& seats) {
  return reason_of(seats,
                   seats.seats.size() == 1 ? ReasonCode::one_seat_found : ReasonCode::seats_found,
                   ReasonCode::seat);
}

}  // namespace trueaxis
