// SPDX-License-Identifier: Apache-2.0
#include "job/one_surface.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <vector>

#include "fit/plausible.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

std::string break_text(const SeatBreak& one) {
  switch (one.kind) {
    case SeatBreak::Kind::step:
      return fmt::format("the radius steps by {:+.4g} mm at Z {:.4g} mm, a shoulder", one.step_mm,
                         one.z_mm);
    case SeatBreak::Kind::slope:
      return fmt::format("the taper changes by {:.2g}° at Z {:.4g} mm",
                         std::atan(std::abs(one.slope_change)) / rad_per_deg, one.z_mm);
    case SeatBreak::Kind::gap:
      break;
  }
  return fmt::format("nothing was read about Z {:.4g} mm", one.z_mm);
}

std::string breaks_text(const Seats& seats) {
  std::vector<std::string> texts;
  for (const SeatBreak& one : seats.breaks) texts.push_back(break_text(one));
  return fmt::format("{}", fmt::join(texts, "; "));
}

std::string range_text(const ZRange& z, RangesAs as) {
  return fmt::format(
      fmt::runtime(as == RangesAs::options ? "--z-from-mm {:.10g} --z-to-mm {:.10g}"
                                           : "z_from_mm = {:.10g}, z_to_mm = {:.10g}"),
      z.from_mm, z.to_mm);
}

}  // namespace

void expect_one_surface(const ProbeStream& stream, SurfaceKind surface, RangesAs ranges) {
  if (surface != SurfaceKind::cone && surface != SurfaceKind::cylinder) return;
  if (!column_objection(stream).empty()) return;  // the fit says so
  const Seats found = find_seats(stream);
  if (!found.broken()) return;
  std::vector<std::string> of;
  for (const Seat& seat : found.seats) of.push_back(range_text(seat.z, ranges));
  throw InputError(
      stream.source,
      fmt::format("is not one {}: {}. A jump at the same C and another Z is the shape of the part, "
                  "not a slip and not an error of X, Z or C. Give the Z range of one surface: {}; "
                  "or `trueaxis run {} -o FOLDER` without --surface takes every seat",
                  to_string(surface), breaks_text(found), fmt::join(of, ", or "), stream.source));
}

std::string seats_text(const Seats& seats) {
  std::vector<std::string> ranges;
  for (const Seat& seat : seats.seats)
    ranges.push_back(fmt::format("Z {:.10g} to {:.10g} mm", seat.z.from_mm, seat.z.to_mm));
  if (ranges.size() == 1)
    return fmt::format("one seat is in the stream, {}, and more beside it: {}", ranges.front(),
                       breaks_text(seats));
  return fmt::format("{} seats are in the stream ({}): {}", ranges.size(), fmt::join(ranges, ", "),
                     breaks_text(seats));
}

}  // namespace trueaxis
