// SPDX-License-Identifier: Apache-2.0
#include "measure/seat_stretches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trueaxis {
namespace {

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
  return t[i + 1].z_mm - t[i].z_mm >
         std::max(gap_turns * profile.spacing_mm, gap_share * length_mm) + profile.spacing_mm;
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

}  // namespace

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

}  // namespace trueaxis
