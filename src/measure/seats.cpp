// SPDX-License-Identifier: Apache-2.0
#include "measure/seats.hpp"

#include <algorithm>
#include <numeric>

#include "math/statistics.hpp"
#include "measure/seat_profile.hpp"

namespace trueaxis {
namespace {

/// Turns [first, last] of a profile along one straight line.
struct Stretch {
  std::size_t first = 0, last = 0;
};

/// A profile as stretches and what parts them: one break between each two of them.
struct Stretches {
  std::vector<Stretch> stretches;
  std::vector<SeatBreak> breaks;
};

// What is a seat of its own, and not form of one: form errors of a turned or ground seat stay
// below.
constexpr double least_step_mm = 0.02;
constexpr double least_slope_change = 5e-3;
constexpr double longest_slip_mm = 0.1;  // along the axis: on a taper it looks like a step
constexpr double sure = 5.0;             // u
// Of the search, in variances of a turn's noise: a line more, and a turn that is on no line.
constexpr double cost_of_line = 30.0, cost_of_odd_turn = 40.0;
constexpr double gap_turns = 5.0, gap_share = 0.1;  // of the spacing, of the length
constexpr double much_more_bent = 3.0;

/// A line through turns, weighted alike, with what a parabola would add.
class Line {
 public:
  Line(const SeatProfile& profile, std::size_t first, std::size_t last)
      : n_(static_cast<double>(last - first + 1)) {
    const auto& t = profile.turns;
    for (std::size_t i = first; i <= last; ++i) z_ += t[i].z_mm / n_, r_ += t[i].radius_mm / n_;
    double zr = 0.0;
    for (std::size_t i = first; i <= last; ++i) {
      zz_ += (t[i].z_mm - z_) * (t[i].z_mm - z_);
      zr += (t[i].z_mm - z_) * (t[i].radius_mm - r_);
    }
    slope_ = zz_ > 0.0 ? zr / zz_ : 0.0;
    double pp = 0.0, pr = 0.0, z3 = 0.0;
    for (std::size_t i = first; i <= last; ++i) z3 += std::pow(t[i].z_mm - z_, 3);
    for (std::size_t i = first; i <= last; ++i) {
      const double z = t[i].z_mm - z_;
      const double p = z * z - zz_ / n_ - (zz_ > 0.0 ? z3 / zz_ : 0.0) * z;
      pp += p * p;
      pr += p * (t[i].radius_mm - r_);
      const double off = t[i].radius_mm - at(t[i].z_mm);
      squares_ += off * off;
    }
    if (n_ > 2.5 && pp > 1e-12 * zz_ * zz_) bend_ = pr / pp;
    length_ = t[last].z_mm - t[first].z_mm;
  }

  double at(double z_mm) const { return r_ + slope_ * (z_mm - z_); }
  double slope() const { return slope_; }
  double squares() const { return squares_; }
  /// Change of slope over the stretch, mm/mm, and the sagitta that goes with it, mm.
  double bend() const { return std::abs(2.0 * bend_ * length_); }
  double sag_mm() const { return std::abs(bend_) * length_ * length_; }
  double variance_at(double z_mm) const {
    return 1.0 / n_ + (zz_ > 0.0 ? (z_mm - z_) * (z_mm - z_) / zz_ : 0.0);
  }
  double variance_of_slope() const { return zz_ > 0.0 ? 1.0 / zz_ : 0.0; }

 private:
  double n_, z_ = 0.0, r_ = 0.0, zz_ = 0.0, slope_ = 0.0, bend_ = 0.0, squares_ = 0.0;
  double length_ = 0.0;
};

/// Whether nothing was read over many turns between a turn and the next.
bool gap_after(const SeatProfile& profile, std::size_t i) {
  const auto& t = profile.turns;
  const double length_mm = t.back().z_mm - t.front().z_mm;
  const double spacing_mm = std::max(t[i].spacing_mm, t[i + 1].spacing_mm);
  return t[i + 1].z_mm - t[i].z_mm >
         std::max(gap_turns * spacing_mm, gap_share * length_mm) + spacing_mm;
}

/// The cheapest lines (dynamic programming). Sums of squares come from running sums.
std::vector<Stretch> cheapest_lines(const SeatProfile& profile) {
  const auto& t = profile.turns;
  const std::size_t n = t.size(), least = profile.sections ? 2 : 3;
  const double variance = profile.noise_mm * profile.noise_mm;
  std::vector<double> cost(n + 1, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> from(n + 1, 0);  // of a line; an odd turn: its own end
  cost[0] = 0.0;
  for (std::size_t end = 1; end <= n; ++end) {
    cost[end] = cost[end - 1] + cost_of_odd_turn;
    from[end] = end;
    double m = 0.0, z = 0.0, r = 0.0, zz = 0.0, zr = 0.0, rr = 0.0;
    for (std::size_t begin = end; begin-- > 0;) {
      if (begin + 1 < end && gap_after(profile, begin)) break;
      // Running means, so that nothing cancels.
      m += 1.0;
      const double dz = t[begin].z_mm - z, dr = t[begin].radius_mm - r;
      z += dz / m, r += dr / m;
      zz += dz * (t[begin].z_mm - z);
      zr += dz * (t[begin].radius_mm - r);
      rr += dr * (t[begin].radius_mm - r);
      if (end - begin < least) continue;
      const double squares = std::max(0.0, rr - (zz > 0.0 ? zr * zr / zz : 0.0));
      const double total = cost[begin] + squares / variance + cost_of_line;
      if (total < cost[end]) cost[end] = total, from[end] = begin;
    }
  }
  std::vector<Stretch> lines;
  for (std::size_t end = n; end > 0;) {
    if (from[end] < end) lines.push_back({from[end], end - 1});
    end = from[end] < end ? from[end] : end - 1;
  }
  std::ranges::reverse(lines);
  return lines;
}

bool gap_between(const SeatProfile& profile, const Stretch& before, const Stretch& after) {
  for (std::size_t i = before.last; i < after.first; ++i)
    if (gap_after(profile, i)) return true;
  return false;
}

/// The break between two stretches; false: none that a seat ends at.
bool find_break(const SeatProfile& profile, const Stretch& before, const Stretch& after,
                SeatBreak& out) {
  const Line a(profile, before.first, before.last), b(profile, after.first, after.last);
  const double end = profile.turns[before.last].z_mm, begin = profile.turns[after.first].z_mm;
  const double middle = 0.5 * (end + begin), reach = 0.5 * (begin - end);
  const double step = b.at(middle) - a.at(middle), change = b.slope() - a.slope();
  const double u_step = profile.noise_mm * std::sqrt(a.variance_at(middle) + b.variance_at(middle));
  const double u_change =
      profile.noise_mm * std::sqrt(a.variance_of_slope() + b.variance_of_slope());
  const double steepest = std::max(std::abs(a.slope()), std::abs(b.slope()));
  const double a_step = least_step_mm + longest_slip_mm * steepest + sure * u_step;
  const bool bends = std::abs(step) <= a.sag_mm() + b.sag_mm() &&
                     std::abs(change) <= much_more_bent * std::max(a.bend(), b.bend());
  out = {SeatBreak::Kind::gap, middle, step, change};
  // Where two lines cross between their turns the radius does not jump.
  const bool jumps = std::abs(step) > a_step + 1.2 * reach * std::abs(change);
  if (jumps && !bends) out.kind = SeatBreak::Kind::step;
  const bool turns = std::abs(change) > least_slope_change + sure * u_change;
  if (!jumps && turns && !bends) {
    out.kind = SeatBreak::Kind::slope;
    out.z_mm = std::clamp(middle - step / change, end, begin);
  }
  return out.kind != SeatBreak::Kind::gap || gap_between(profile, before, after);
}

/// The profile as the fewest straight lines that its noise allows. Two of them become one if the
/// break between them is too small for a shoulder, or bends as the lines themselves do.
Stretches straight_stretches(const SeatProfile& profile) {
  Stretches out;
  if (profile.turns.size() < 4) return out;
  const std::vector<Stretch> lines = cheapest_lines(profile);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    SeatBreak here;
    if (i > 0 && !find_break(profile, lines[i - 1], lines[i], here)) {
      out.stretches.back().last = lines[i].last;
      continue;
    }
    if (i > 0) out.breaks.push_back(here);
    out.stretches.push_back(lines[i]);
  }
  return out;
}

constexpr double least_share = 0.15;  // of the longest: shorter ones are chamfers, fillets
constexpr std::size_t fewest_turns =
    4;  // two tell lobes from a tilt, and its ends may cut one each
constexpr double groove_share = 1.0 / 3.0;  // of both neighbours
constexpr std::size_t most_seats = 12;      // more are a thread or no part
constexpr std::size_t turns_at_an_end = 5;  // that tell how a seat goes on
constexpr double follows = 6.0;             // σ of the readings about them
constexpr double rolls_off = 2.0;           // the same: next to an edge the ball is over it
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

  /// How far off a reading is, in σ of the readings about them.
  double off(std::size_t i) const {
    const double expected = circle_.at(stream_.c_rad[i]) + slope_ * (stream_.position_mm[i] - z_);
    return std::abs(stream_.reading_mm[i] - expected) / circle_.scatter_mm;
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
  const TurnRadius& last_turn = profile.turns[up ? stretch.last : stretch.first];
  const double reach = sign * last_turn.z_mm + 2.0 * last_turn.spacing_mm;
  std::vector<std::size_t> beyond;
  for (std::size_t i = 0; i < stream.size(); ++i)
    if (sign * stream.position_mm[i] >= inside && sign * stream.position_mm[i] <= reach)
      beyond.push_back(i);
  std::ranges::stable_sort(beyond, {}, [&](std::size_t i) { return sign * stream.position_mm[i]; });
  constexpr double nowhere_mm = std::numeric_limits<double>::infinity();
  double last = inside, next = nowhere_mm;     // to where readings follow
  double level = inside, leaves = nowhere_mm;  // to where the ball is clear of an edge
  std::size_t off = 0;
  for (const std::size_t i : beyond) {
    const double z = sign * stream.position_mm[i];
    if (!(seat.off(i) > follows)) {
      last = z, off = 0, next = nowhere_mm;
      if (!(seat.off(i) > rolls_off))
        level = z, leaves = nowhere_mm;
      else
        leaves = std::min(leaves, z);
      continue;
    }
    next = std::min(next, z), leaves = std::min(leaves, z);
    if (++off == off_in_a_row) break;
  }
  if (off < off_in_a_row)
    next = nowhere_mm;
  else
    last = level, next = leaves;
  next = std::min(next, last + beyond_share * last_turn.spacing_mm);
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
/// them is of neither, and no reading is of two seats. A section is of the stretch that it is in.
void part_at(const SeatBreak& here, const SeatProfile& profile, const TurnRadius& end,
             const TurnRadius& begin, Seat& before, Seat& after) {
  if (here.kind != SeatBreak::Kind::slope && before.z.to_mm < after.z.from_mm) return;
  const auto rounded = [](double z_mm) { return 1e-3 * std::round(1e3 * z_mm); };
  const double middle_mm = 0.5 * (end.z_mm + begin.z_mm);
  const double to_mm = profile.sections ? middle_mm - one_um_mm : here.z_mm - 0.5 * end.spacing_mm;
  const double from_mm =
      profile.sections ? middle_mm + one_um_mm : here.z_mm + 0.5 * begin.spacing_mm;
  before.z.to_mm = std::min(before.z.to_mm, rounded(to_mm));
  after.z.from_mm = std::max(after.z.from_mm, rounded(from_mm));
}

/// The readings of each seat, and the stretches between and next to them that are more than a
/// transition: the turn across the edge, and half a turn on both sides.
void count_readings(const ProbeStream& stream, const SeatProfile& profile, Seats& out) {
  std::vector<double> of_turns;
  for (const TurnRadius& turn : profile.turns)
    of_turns.push_back(static_cast<double>(turn.readings.size()));
  const double transition = profile.sections ? 0.0 : 2.0 * median(std::move(of_turns));
  std::vector<Seat> none(out.seats.size() + 1);  // before each seat, and after the last
  for (const double z : stream.position_mm) {
    const auto next =
        std::ranges::find_if(out.seats, [&](const Seat& s) { return z <= s.z.to_mm; });
    if (next != out.seats.end() && next->z.holds(z)) {
      ++next->readings;
      continue;
    }
    Seat& in = none[static_cast<std::size_t>(next - out.seats.begin())];
    in.z = in.readings == 0 ? ZRange{z, z}
                            : ZRange{std::min(in.z.from_mm, z), std::max(in.z.to_mm, z)};
    ++in.readings;
  }
  for (const Seat& one : none)
    if (static_cast<double>(one.readings) > transition) out.left_out.push_back(one);
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
    const bool few_turns = !profile.sections && s.last - s.first + 1 < fewest_turns;
    if (few_turns || length_mm(profile, s) < least_share * longest || is_groove(profile, found, i))
      continue;
    out.seats.push_back({{end_of(stream, profile, s, false), end_of(stream, profile, s, true)}, 0});
    of_seat.push_back(i);
  }
  if (out.seats.empty() || out.seats.size() > most_seats) return {};
  out.breaks = breaks_of(profile, found, of_seat);
  for (std::size_t i = 0; i + 1 < out.seats.size(); ++i)
    part_at(out.breaks[of_seat.front() + i], profile,
            profile.turns[found.stretches[of_seat[i]].last],
            profile.turns[found.stretches[of_seat[i + 1]].first], out.seats[i], out.seats[i + 1]);
  count_readings(stream, profile, out);
  return out;
}

}  // namespace trueaxis
