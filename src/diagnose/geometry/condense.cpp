// SPDX-License-Identifier: Apache-2.0
#include "diagnose/geometry/condense.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnose/geometry/contacts.hpp"
#include "math/golden_section.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double sectors_wanted = 40.0;  // order 12 keeps 86 % of its amplitude
constexpr double turns_wanted = 500.0;
constexpr double least_readings = 8.0;  // of a mean, so that all are nearly of one weight
constexpr double tenth_lost = 0.25;     // cycles a mean: sinc(0.25) = 0.90
constexpr double one_turn = 1.1;        // a mean in ten is of two

using Column = std::vector<double>;

/// Readings of one pass, and of one section where Z steps.
struct Run {
  std::size_t begin, end, pass;
};

std::vector<Run> runs_of(const LinearisationPoint& point, const ObservationMask& mask,
                         bool sections) {
  std::vector<Run> runs;
  for (std::size_t p = 0; p < point.passes.size(); ++p) {
    runs.push_back({point.passes[p].begin, point.passes[p].end, p});
    for (const std::size_t cut : mask.fold_begin) {
      if (!sections || cut <= runs.back().begin || cut >= runs.back().end) continue;
      const std::size_t end = std::exchange(runs.back().end, cut);
      runs.push_back({cut, end, p});
    }
  }
  return runs;
}

double turns_of(const LinearisationPoint& point, std::size_t begin, std::size_t end) {
  return std::abs(point.c[end - 1] - point.c[begin]) / two_pi;
}

/// Sums over the readings of a mean.
struct Cell {
  double deviation = 0.0, off_centre = 0.0;
  double least = 1e300, most = -1e300;  ///< sensed
  std::size_t used = 0, all = 0;

  void add(double value_mm, double off, double sensed_mm, bool counts) {
    ++all;
    if (!counts) return;
    ++used, deviation += value_mm, off_centre += off;
    least = std::min(least, sensed_mm), most = std::max(most, sensed_mm);
  }
};

class Condensing {
 public:
  Condensing(const LinearisationPoint& whole, const ObservationMask& mask, const Column& left,
             Means& out)
      : whole_(whole), mask_(mask), left_(left), out_(out) {}

  std::size_t size() const { return c_.size(); }
  void give_columns() {
    out_.point.c = SharedColumn(std::move(c_)), out_.point.z = SharedColumn(std::move(z_));
    out_.point.time = SharedColumn(std::move(time_));
  }

  /// Turns of C: means over sectors of `slabs` groups of turns.
  void turning(const Run& run, std::size_t slabs, std::size_t sectors) {
    const double c0 = whole_.c[run.begin], travel = whole_.c[run.end - 1] - c0;
    const double sign = travel < 0.0 ? -1.0 : 1.0, width = travel / static_cast<double>(slabs);
    const auto count = static_cast<double>(sectors);
    std::vector<Cell> cells(slabs * sectors);
    std::vector<std::size_t> first(slabs, run.end), last(slabs, run.begin);
    whole_.for_each_part(
        [&](const PointPart& at) {
          for (std::size_t k = 0; k < at.size(); ++k) {
            const std::size_t i = at.begin + k;
            const double along = std::clamp((whole_.c[i] - c0) / width, 0.0, count_less(slabs));
            const auto slab = static_cast<std::size_t>(along);
            first[slab] = std::min(first[slab], i), last[slab] = std::max(last[slab], i);
            const double turn =
                sign * (whole_.c[i] - (c0 + middle(slab) * width)) / two_pi - shift(slab) / count;
            const double part = turn - std::floor(turn + 0.5) + 0.5;
            const auto sector = std::min(sectors - 1, static_cast<std::size_t>(part * count));
            cells[slab * sectors + sector].add(left_[i], part - middle(sector) / count,
                                               at.sensed[k], mask_.used[i]);
          }
        },
        run.begin, run.end);
    for (std::size_t slab = 0; slab < slabs; ++slab) {
      if (first[slab] > last[slab]) continue;
      const double from = whole_.c[first[slab]];
      const double turned = whole_.c[last[slab]] - from;
      for (std::size_t sector = 0; sector < sectors; ++sector) {
        const Cell& cell = cells[slab * sectors + sector];
        const double off = cell.used > 0 ? cell.off_centre / static_cast<double>(cell.used) : 0.0;
        const double part = (middle(sector) + shift(slab)) / count + off - 0.5;
        const double c = c0 + middle(slab) * width + sign * two_pi * part;
        const double share = turned != 0.0 ? (c - from) / turned : 0.0;
        push(cell, c, between(whole_.z, first[slab], last[slab], share),
             between(whole_.time, first[slab], last[slab], share), first[slab]);
      }
    }
  }

  /// C stands still: means of neighbours.
  void standing(const Run& run, std::size_t neighbours) {
    for (std::size_t begin = run.begin; begin < run.end; begin += neighbours) {
      const std::size_t end = std::min(begin + neighbours, run.end);
      Cell cell;
      double c = 0.0, z = 0.0, time = 0.0;
      whole_.for_each_part(
          [&](const PointPart& at) {
            for (std::size_t k = 0; k < at.size(); ++k) {
              cell.add(left_[at.begin + k], 0.0, at.sensed[k], mask_.used[at.begin + k]);
              c += at.c[k], z += at.z[k], time += at.time[k];
            }
          },
          begin, end);
      const auto size = static_cast<double>(end - begin);
      push(cell, c / size, z / size, time / size, begin);
    }
  }

 private:
  static double middle(std::size_t k) { return static_cast<double>(k) + 0.5; }
  /// The shifts of the sectors of a slab, in sectors: no fast line is then a slow one in all of
  /// them.
  static double shift(std::size_t slab) { return golden_share(slab); }
  static double count_less(std::size_t slabs) { return static_cast<double>(slabs) - 1e-9; }
  static double between(std::span<const double> x, std::size_t first, std::size_t last,
                        double share) {
    return x[first] + share * (x[last] - x[first]);
  }

  void push(const Cell& cell, double c, double z, double time, std::size_t reading) {
    const auto fold = static_cast<std::size_t>(std::ranges::upper_bound(mask_.fold_begin, reading) -
                                               mask_.fold_begin.begin());
    if (fold != fold_) out_.mask.fold_begin.push_back(c_.size());
    fold_ = fold;
    c_.push_back(c), z_.push_back(z), time_.push_back(time);
    const auto used = static_cast<double>(cell.used);
    out_.deviation_mm.push_back(cell.used > 0 ? cell.deviation / used : 0.0);
    out_.mask.used.push_back(2 * cell.used > cell.all);
    if (cell.used > 0) out_.sensed_mm = std::max(out_.sensed_mm, cell.most - cell.least);
  }

  const LinearisationPoint& whole_;
  const ObservationMask& mask_;
  const Column& left_;
  Means& out_;
  std::size_t fold_ = 0;
  Column c_, z_, time_;
};

/// What two sorted lists of intervals have in common.
std::vector<Extent> common(const std::vector<Extent>& a, const std::vector<Extent>& b) {
  std::vector<Extent> out;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const Extent both{std::max(a[i].low, b[j].low), std::min(a[i].high, b[j].high)};
    if (both.high > both.low) out.push_back(both);
    ++(a[i].high < b[j].high ? i : j);
  }
  return out;
}

}  // namespace

bool is_condensed(const LinearisationPoint& point) {
  return point.size() >= LinearisationPoint::few_readings;
}

Means condense(const LinearisationPoint& point, const ObservationMask& mask,
               std::span<const double> deviation_mm, std::span<const Hypothesis> known,
               std::span<const double> linear, bool sections, int threads) {
  Column left(deviation_mm.begin(), deviation_mm.end());
  if (!known.empty()) {
    const Column effect = contribution(point, known, linear, threads);
    for (std::size_t i = 0; i < left.size(); ++i) left[i] -= effect[i];
  }
  Means out;
  static_cast<LinearisationFacts&>(out.point) = point;
  out.mask.block = mask.block;
  Condensing condensing(point, mask, left, out);
  double turns = 0.0;
  for (const Pass& pass : point.passes)
    if (pass.c_sign != 0) turns += turns_of(point, pass.begin, pass.end);
  std::size_t pass = point.passes.size();
  for (const Run& run : runs_of(point, mask, sections)) {
    const Pass& of = point.passes[run.pass];
    const std::size_t begin = condensing.size();
    const double own = turns_of(point, run.begin, run.end);
    Means::Of averaged;
    if (of.c_sign == 0 || !(own > 0.0)) {
      averaged.neighbours =
          std::max<std::size_t>(1, static_cast<std::size_t>(static_cast<double>(point.size()) /
                                                            (sectors_wanted * turns_wanted)));
      condensing.standing(run, averaged.neighbours);
    } else {
      const double per_turn = of.readings_per_revolution, whole = std::round(per_turn);
      const bool same = std::abs(per_turn - whole) < 1e-4 && whole <= 2.0 * sectors_wanted;
      averaged.sectors = same ? std::max(whole, 1.0) : sectors_wanted;
      const double wanted =
          std::max({1.0, turns / turns_wanted, least_readings * averaged.sectors / per_turn});
      const double slabs = std::max(1.0, std::floor(own / wanted));
      averaged.turns = own / slabs;
      condensing.turning(run, static_cast<std::size_t>(slabs),
                         static_cast<std::size_t>(averaged.sectors));
    }
    if (run.pass != pass) {
      out.point.passes.push_back(of);
      out.point.velocity.push_back(point.velocity[run.pass]);
      out.point.passes.back().begin = begin;
      out.of_pass.push_back(averaged);
    }
    pass = run.pass;
    out.point.passes.back().end = condensing.size();
  }
  condensing.give_columns();
  fill_contacts(out.point);
  out.mask.fold_begin.push_back(out.point.size());
  out.mask.find_runs(out.point);
  if (!known.empty()) {
    const Column effect = contribution(out.point, known, linear);
    for (std::size_t i = 0; i < effect.size(); ++i) out.deviation_mm[i] += effect[i];
  }
  return out;
}

std::vector<Extent> Means::kept(const LinearisationPoint& whole, PointColumn x, double turns,
                                Extent within) const {
  if (x == &PointPart::sensed)
    return common({within}, {{within.low, tenth_lost / std::max(sensed_mm, 1e-12)}});
  std::vector<Extent> out{within};
  for (std::size_t p = 0; p < of_pass.size(); ++p) {
    const Pass& pass = whole.passes[p];
    const Of& of = of_pass[p];
    if (pass.end - pass.begin < 2) continue;
    const double travel = whole.at(x, pass.end - 1) - whole.at(x, pass.begin);
    std::vector<Extent> own;
    if (of.turns == 0.0) {
      const double step = std::abs(travel) / static_cast<double>(pass.end - pass.begin - 1) *
                          static_cast<double>(of.neighbours);
      own.push_back({within.low, step > 0.0 ? tenth_lost / step : within.high});
    } else {
      // Cycles a turn f a − turns: near a whole number, and few of them.
      const double a = travel / (whole.c[pass.end - 1] - whole.c[pass.begin]) * two_pi;
      // Within one turn nothing is lost between orders, over two a quarter of a cycle in two turns.
      const double near = of.turns < one_turn ? 0.5 : tenth_lost / std::max(of.turns, 2.0);
      const double most = std::floor(tenth_lost * of.sectors);
      if (!(std::abs(a) > 0.0)) continue;
      for (double cycles = -most; cycles <= most; ++cycles) {
        const double one = (cycles - near + turns) / a, other = (cycles + near + turns) / a;
        own.push_back({std::min(one, other), std::max(one, other)});
      }
      std::ranges::sort(own, {}, &Extent::low);
    }
    out = common(out, own);
  }
  return out;
}

}  // namespace trueaxis::diagnose_detail
