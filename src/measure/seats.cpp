// SPDX-License-Identifier: Apache-2.0
#include "measure/seats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/hundredths.hpp"
#include "measure/kept_readings.hpp"
#include "measure/seat_profile.hpp"
#include "measure/seat_stretches.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double least_share = 0.15;        // of the longest: shorter ones are chamfers, fillets
constexpr double groove_share = 1.0 / 3.0;  // of both neighbours
constexpr std::size_t most_seats = 12;      // more are a thread or no part
constexpr std::size_t turns_at_an_end = 5;  // that tell how a seat goes on
constexpr double follows = 6.0;             // σ of the readings about them
constexpr double beyond_share = 0.25;       // of the spacing: a range ends there at the latest
constexpr double one_um_mm = 1e-3;
constexpr std::size_t off_in_a_row = 3;  // readings that end a seat

/// A line in Z and a circle in C through the turns at one end of a stretch, robustly.
class Continued {
 public:
  Continued(const ProbeStream& stream, const SeatProfile& profile, std::size_t first,
            std::size_t last)
      : stream_(stream) {
    double n = 0.0, r = 0.0, zz = 0.0, zr = 0.0;
    for (std::size_t i = first; i <= last; ++i, n += 1.0)
      z_ += profile.turns[i].z_mm, r += profile.turns[i].radius_mm;
    z_ /= n, r /= n;
    for (std::size_t i = first; i <= last; ++i) {
      const double dz = profile.turns[i].z_mm - z_;
      zz += dz * dz;
      zr += dz * (profile.turns[i].radius_mm - r);
    }
    slope_ = zz > 0.0 ? zr / zz : 0.0;
    ProbeStream level = stream;
    std::vector<std::size_t> readings;
    for (std::size_t i = first; i <= last; ++i)
      for (const std::size_t at : profile.turns[i].readings) {
        level.reading_mm[at] -= slope_ * (stream.position_mm[at] - z_);
        readings.push_back(at);
      }
    circle_ = robust_circle(level, readings);
  }

  bool holds(std::size_t i) const {
    const double expected = circle_.at(stream_.c_rad[i]) + slope_ * (stream_.position_mm[i] - z_);
    return std::abs(stream_.reading_mm[i] - expected) <= follows * circle_.scatter_mm;
  }

 private:
  const ProbeStream& stream_;
  double z_ = 0.0, slope_ = 0.0;
  RobustCircle circle_;
};

/// The number of fewest decimals in [inner, outer), outwards of a seat's last reading.
double shortest_number(double inner, double outer) {
  const double sign = outer > inner ? 1.0 : -1.0;
  for (const double step : {1.0, 0.1, 0.01, 1e-3, 1e-4}) {
    const double one = step * (sign > 0.0 ? std::ceil(inner / step) : std::floor(inner / step));
    const double rounded = std::round(one * 1e4) / 1e4;
    if (sign * (rounded - inner) >= 0.0 && sign * (outer - rounded) > 0.0) return rounded;
  }
  return inner;
}

/// How far a stretch goes on at one end; `up`: towards +Z.
double end_of(const ProbeStream& stream, const SeatProfile& profile, const Stretch& stretch,
              bool up) {
  const std::size_t count = stretch.last - stretch.first + 1;
  // The last turn may hold readings of the other side.
  const std::size_t skip = count > 3 ? 1 : 0, used = std::min(turns_at_an_end, count - skip);
  const std::size_t first = up ? stretch.last + 1 - skip - used : stretch.first + skip;
  const Continued seat(stream, profile, first, first + used - 1);
  const double sign = up ? 1.0 : -1.0;
  const double inside = sign * profile.turns[first + used / 2].z_mm;
  const double reach =
      sign * profile.turns[up ? stretch.last : stretch.first].z_mm + 2.0 * profile.spacing_mm;
  std::vector<std::size_t> beyond;
  for (std::size_t i = 0; i < stream.size(); ++i)
    if (sign * stream.position_mm[i] >= inside && sign * stream.position_mm[i] <= reach)
      beyond.push_back(i);
  std::ranges::stable_sort(beyond, {}, [&](std::size_t i) { return sign * stream.position_mm[i]; });
  double last = inside, next = std::numeric_limits<double>::infinity();
  std::size_t off = 0;
  for (const std::size_t i : beyond) {
    const double z = sign * stream.position_mm[i];
    if (seat.holds(i)) {
      last = z, off = 0;
      continue;
    }
    if (off == 0) next = z;
    if (++off == off_in_a_row) break;
  }
  if (off < off_in_a_row) next = std::numeric_limits<double>::infinity();
  next = std::min(next, last + beyond_share * profile.spacing_mm);
  return sign * shortest_number(last, next);
}

double length_mm(const SeatProfile& profile, const Stretch& s) {
  return profile.turns[s.last].z_mm - profile.turns[s.first].z_mm;
}

/// Between two shoulders that face each other, and short: of a groove or a collar.
bool is_groove(const SeatProfile& profile, const Stretches& found, std::size_t i) {
  if (i == 0 || i + 1 >= found.stretches.size()) return false;
  const double before = found.breaks[i - 1].step_mm, after = found.breaks[i].step_mm;
  return found.breaks[i - 1].kind == SeatBreak::Kind::step &&
         found.breaks[i].kind == SeatBreak::Kind::step && before * after < 0.0 &&
         length_mm(profile, found.stretches[i]) <
             groove_share * std::min(length_mm(profile, found.stretches[i - 1]),
                                     length_mm(profile, found.stretches[i + 1]));
}

/// What parts each two neighbouring seats, in one, and what is beyond the outer ones.
std::vector<SeatBreak> breaks_of(const SeatProfile& profile, const Stretches& found,
                                 const std::vector<std::size_t>& seats) {
  std::vector<SeatBreak> out(found.breaks.begin(),
                             found.breaks.begin() + static_cast<std::ptrdiff_t>(seats.front()));
  for (std::size_t k = 1; k < seats.size(); ++k) {
    SeatBreak here;
    const std::size_t before = seats[k - 1], after = seats[k];
    const bool apart = find_break(profile, found.stretches[before], found.stretches[after], here);
    out.push_back(apart ? here : found.breaks[before]);  // a groove: its first edge
  }
  out.insert(out.end(), found.breaks.begin() + static_cast<std::ptrdiff_t>(seats.back()),
             found.breaks.end());
  return out;
}

/// If two seats meet without a jump, the readings about the corner follow both: half a turn of
/// them is of neither, and no reading is of two seats.
void part_at(const SeatBreak& here, double margin_mm, Seat& before, Seat& after) {
  if (here.kind != SeatBreak::Kind::slope && before.z.to_mm < after.z.from_mm) return;
  const auto rounded = [](double z_mm) { return 1e-3 * std::round(1e3 * z_mm); };
  before.z.to_mm = std::min(before.z.to_mm, rounded(here.z_mm - margin_mm));
  after.z.from_mm = std::max(after.z.from_mm, rounded(here.z_mm + margin_mm));
}

bool may_hold_seats(const ProbeStream& stream) {
  return stream.kind == StreamKind::lateral && stream.has_position() && stream.size() >= 16 &&
         list_set_ups(stream).size() == 1 && stream.more_reading_mm.empty();
}

}  // namespace

bool Seats::broken() const {
  return std::ranges::any_of(breaks,
                             [](const SeatBreak& one) { return one.kind != SeatBreak::Kind::gap; });
}

Seats find_seats(const ProbeStream& stream) {
  Seats out;
  if (!may_hold_seats(stream)) return out;
  const SeatProfile profile = seat_profile(stream);
  const Stretches found = straight_stretches(profile);
  if (found.breaks.empty()) return out;
  double longest = 0.0;
  for (const Stretch& s : found.stretches) longest = std::max(longest, length_mm(profile, s));
  std::vector<std::size_t> of_seat;
  for (std::size_t i = 0; i < found.stretches.size(); ++i) {
    const Stretch& s = found.stretches[i];
    if (length_mm(profile, s) < least_share * longest || is_groove(profile, found, i)) continue;
    out.seats.push_back({{end_of(stream, profile, s, false), end_of(stream, profile, s, true)}, 0});
    of_seat.push_back(i);
  }
  if (out.seats.empty() || out.seats.size() > most_seats) return {};
  out.breaks = breaks_of(profile, found, of_seat);
  const double margin_mm = profile.sections ? one_um_mm : 0.5 * profile.spacing_mm;
  for (std::size_t i = 0; i + 1 < out.seats.size(); ++i)
    part_at(out.breaks[of_seat.front() + i], margin_mm, out.seats[i], out.seats[i + 1]);
  for (Seat& seat : out.seats)
    for (const double z : stream.position_mm) seat.readings += seat.z.holds(z) ? 1 : 0;
  return out;
}

ProbeStream within(const ProbeStream& stream, const ZRange& range) {
  if (stream.kind == StreamKind::face)
    throw InputError(stream.source, "is of a face, which has no range of Z: leave it out");
  std::vector<bool> kept(stream.size());
  std::size_t inside = 0, first = 0;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    kept[i] = stream.has_position() && range.holds(stream.position_mm[i]);
    if (kept[i] && inside++ == 0) first = i;
  }
  const auto end = [](double z_mm) { return fmt::format("{:.10g}", z_mm); };
  const std::string text = !std::isfinite(range.from_mm) ? "up to " + end(range.to_mm) + " mm"
                           : !std::isfinite(range.to_mm)
                               ? "from " + end(range.from_mm) + " mm"
                               : end(range.from_mm) + " to " + end(range.to_mm) + " mm";
  if (inside == 0) {
    std::string has = "the stream has no Z";
    if (stream.has_position() && stream.size() > 0) {
      const auto [low, high] = std::ranges::minmax(stream.position_mm);
      has = fmt::format("they reach from Z {:.6g} to {:.6g} mm", low, high);
    }
    throw InputError(stream.source, "has no reading at Z " + text + ": " + has);
  }
  ProbeStream out = stream;
  if (inside == stream.size()) return out;
  keep_readings(out, kept);
  out.read_as.push_back(
      fmt::format("Z {}: the other {} of {} readings are excluded; row 1 of the results is row {} "
                  "of the stream",
                  text, stream.size() - inside, stream.size(), first + 1));
  return out;
}

}  // namespace trueaxis
