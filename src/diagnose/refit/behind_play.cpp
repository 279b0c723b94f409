// SPDX-License-Identifier: Apache-2.0
#include "diagnose/refit/behind_play.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/geometry/contacts.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double step_rad =
    two_pi / 200.0;  // a wave of order 8 is known to a hundredth where it turns back
constexpr std::size_t at_a_time = 512;  // readings

/// The way of the probe over the surface, in steps finer than the readings.
struct Way {
  std::vector<double> c, z, time;
  std::vector<std::size_t> reading;  ///< place of each of the readings

  void go(double to_c, double to_z, double to_time) {
    const double from_c = c.back(), from_z = z.back(), from_time = time.back();
    const double steps = std::max(1.0, std::ceil(std::abs(to_c - from_c) / step_rad));
    for (double k = 1.0; k <= steps; ++k) {
      const double share = k / steps;
      c.push_back(from_c + share * (to_c - from_c));
      z.push_back(from_z + share * (to_z - from_z));
      time.push_back(from_time + share * (to_time - from_time));
    }
  }
};

/// Where X took the play up last, and when.
struct Play {
  double play_mm, reading_mm = 0.0, side = 0.0;
  double c = 0.0, z = 0.0, time = 0.0;

  void start(double x_mm, const Way& way) {
    reading_mm = x_mm, side = 0.0;
    be_at(way, 0);
  }
  void take_up(double x_mm, const Way& way, std::size_t k) {
    const double ahead = x_mm - reading_mm;
    if (std::abs(ahead) < 0.5 * play_mm || ahead == 0.0) return;
    side = ahead > 0.0 ? 1.0 : -1.0;
    reading_mm = x_mm - 0.5 * side * play_mm;
    be_at(way, k);
  }

 private:
  void be_at(const Way& way, std::size_t k) { c = way.c[k], z = way.z[k], time = way.time[k]; }
};

class Follower {
 public:
  Follower(const LinearisationPoint& point, std::span<const Hypothesis> terms,
           std::span<const double> linear, double play_mm)
      : point_(point), terms_(terms), linear_(linear), play_{play_mm} {
    for (auto* column : {&out.c_rad, &out.z_mm, &out.time_s, &out.side})
      column->reserve(point.size());
    for (std::size_t p = 0; p < point.passes.size(); ++p)
      for (std::size_t i = point.passes[p].begin; i < point.passes[p].end;) i = follow(p, i);
  }

  BehindPlay out;

 private:
  /// @param reading the first of those that are followed @returns the one after the last
  std::size_t follow(std::size_t number, std::size_t reading) {
    const Pass& pass = point_.passes[number];
    const Clamping& now = clamping_at(point_.clampings, point_.before, pass.setup, reading);
    const std::size_t end = std::min({reading + at_a_time, pass.end, now.until});
    Way way = way_to(pass, reading);
    for (std::size_t i = reading; i < end; ++i) {
      if (i > pass.begin) way.go(point_.c[i], point_.z[i], point_.time[i]);
      way.reading.push_back(way.c.size() - 1);
    }
    const std::vector<double> x_mm = x_along(way, number, now);
    std::size_t next = 0;
    if (reading == pass.begin) play_.start(x_mm[0], way);
    for (std::size_t k = 0; k < x_mm.size(); ++k) {
      play_.take_up(x_mm[k], way, k);
      if (k != way.reading[next]) continue;
      out.c_rad.push_back(play_.c), out.z_mm.push_back(play_.z);
      out.time_s.push_back(play_.time), out.side.push_back(play_.side);
      ++next;
    }
    return end;
  }

  /// Begins at the reading before; a pass begins with a revolution in place.
  Way way_to(const Pass& pass, std::size_t reading) const {
    const std::size_t from = reading > pass.begin ? reading - 1 : reading;
    const double back = reading > pass.begin ? 0.0 : two_pi * pass.c_sign;
    Way way{{point_.c[from] - back}, {point_.z[from]}, {point_.time[from]}, {}};
    if (reading == pass.begin) way.go(point_.c[from], point_.z[from], point_.time[from]);
    return way;
  }

  std::vector<double> x_along(const Way& way, std::size_t number, const Clamping& now) const {
    LinearisationPoint at;
    static_cast<LinearisationFacts&>(at) = point_;
    at.before.clear();
    at.clampings = {now};
    at.clampings[0].until = Clamping{}.until;
    Pass pass = point_.passes[number];
    pass.begin = 0, pass.end = way.c.size();
    at.passes = {pass};
    at.velocity = {point_.velocity[number]};
    at.c = SharedColumn::of(way.c), at.z = SharedColumn::of(way.z);
    at.time = SharedColumn::of(way.time);
    fill_contacts(at);
    std::vector<double> x_mm = at.column(&PointPart::x);
    const std::vector<double> more = contribution(at, terms_, linear_);
    for (std::size_t k = 0; k < x_mm.size(); ++k) x_mm[k] += more[k];
    return x_mm;
  }

  const LinearisationPoint& point_;
  std::span<const Hypothesis> terms_;
  std::span<const double> linear_;
  Play play_;
};

}  // namespace

BehindPlay behind_play(const LinearisationPoint& point, std::span<const Hypothesis> terms,
                       std::span<const double> linear, double play_mm) {
  return Follower(point, terms, linear, play_mm).out;
}

}  // namespace trueaxis::diagnose_detail
