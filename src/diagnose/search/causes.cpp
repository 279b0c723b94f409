// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/causes.hpp"

#include <algorithm>
#include <cmath>

#include "math/statistics.hpp"

namespace trueaxis::diagnose_detail {
namespace {

using FreeParameters = std::vector<std::size_t>;

constexpr double decay_lengths[] = {10.0, 20.0, 40.0, 80.0, 160.0};
constexpr double bearings[] = {-500.0, -250.0, -100.0,
                               -50.0,  -20.0,  0.0};  // effects.md: far to near
constexpr double not_a_cylinder = 1e-3;               // tan of the half angle
constexpr double no_motion = 1e-9;
constexpr double few_cycles[] = {0.5, 0.7, 0.9, 1.15, 1.5, 1.9, 2.4, 3.0};

TermShape with_order(double order) {
  TermShape shape;
  shape.order = order;
  return shape;
}

void add_harmonics(const LinearisationPoint& point, const Resolution& resolution,
                   std::vector<Hypothesis>& list) {
  const double tests = resolution.harmonics;
  for (int n = 2; n <= resolution.harmonics; ++n) {
    list.push_back(of_effect("part.roundness", with_order(n), {0, 1}, tests));
    if (resolution.degrees > 0)
      list.push_back(of_effect("part.roundness", with_order(n), {}, tests));
    if (!point.reindexed && !point.two_sided) continue;
    list.push_back(of_effect("spindle.radial_synchronous", with_order(n), {}, tests));
    if (std::abs(point.tan_half_angle) > not_a_cylinder)
      list.push_back(of_effect("spindle.axial_synchronous", with_order(n), {}, tests));
    TermShape tilt = with_order(n);
    tilt.lever_from_mm = bearings[2];
    if (resolution.degrees > 0)
      list.push_back(of_effect("spindle.tilt_synchronous", tilt, {}, tests));
  }
}

void add_along_z(const LinearisationPoint& point, const Resolution& resolution,
                 std::vector<Hypothesis>& list) {
  if (resolution.degrees == 0) return;
  list.push_back(of_effect("part.barrel", {}, {0}, 2));
  if (resolution.degrees > 2) list.push_back(of_effect("part.barrel", {}, {}, 2));
  if (!point.base.tapers) list.push_back(of_effect("part.taper", {}));
  list.push_back(of_effect("part.bow", {}));
  const int highest = std::min(5, resolution.degrees + 1);
  for (int degree = 2; degree <= highest; ++degree) {
    TermShape shape;
    shape.degree = degree;
    list.push_back(of_effect("slide.z_straightness", shape, {}, 6));
    const auto last = static_cast<std::size_t>(degree - 2);
    if (degree > 2) list.push_back(of_effect("slide.z_straightness", shape, {last}, 6));
  }
  list.push_back(of_effect("slide.xz_parallelism", {}));
}

bool both_ways(const LinearisationPoint& point) {
  const Extent v = range_of(point.velocity);
  return v.low < -no_motion && v.high > no_motion;
}

void add_probe(const LinearisationPoint& point, const Resolution& resolution,
               std::vector<Hypothesis>& list) {
  list.push_back(of_effect("probe.height", {}));
  list.push_back(of_effect("encoder.offset", {}));
  list.push_back(of_effect("encoder.eccentricity", {}));
  if (resolution.degrees > 0) {
    list.push_back(of_effect("probe.tilt", {}));
    if (both_ways(point)) {
      for (const FreeParameters& free : {FreeParameters{0}, FreeParameters{1}, FreeParameters{}})
        list.push_back(of_effect("slide.backlash", {}, free, 3));
    }
  }
  TermShape response;
  response.reference_x_mm = point.reference_x_mm;
  response.range_mm = point.range_x_mm;
  response.order = 3.0;
  list.push_back(of_effect("probe.gain", response));
  for (const FreeParameters& free : {FreeParameters{0}, FreeParameters{1}, FreeParameters{}})
    list.push_back(of_effect("probe.nonlinearity", response, free, 3));
  // Of few cycles over the swing, a periodogram that forgets the surface's columns misses it.
  const double swing = sensed_swing(point);
  for (const double cycles : few_cycles) {
    TermShape shape;
    shape.period_mm = swing / cycles;
    if (swing > least_swing_mm && !resolution.sections)
      list.push_back(of_effect("probe.cyclic", shape, {}, 4.0 * std::size(few_cycles)));
  }
  list.push_back(of_effect("probe.ball_radius", {}));
  list.push_back(of_effect("probe.pretravel", response, {0}));
  if (!point.has_time) return;
  list.push_back(of_effect("probe.latency", {}));
  for (const double T : {0.0, 5e-3}) {
    TermShape lag;
    lag.time_constant_s = T;
    list.push_back(of_effect("probe.lag", lag, {}, 2));
  }
}

void add_time(const LinearisationPoint& point, std::vector<Hypothesis>& list) {
  if (!point.has_time) return;
  const double lasted = range_of(point.time).length();
  list.push_back(of_effect("thermal.drift", {}, {0}, 4));
  for (const double share : {0.1, 0.3, 1.0}) {
    TermShape shape;
    shape.time_constant_s = share * lasted;
    list.push_back(of_effect("thermal.drift", shape, {1}, 4));
  }
}

}  // namespace

double sensed_swing(const LinearisationPoint& point) {
  double swing = 0.0;
  for (const char side : {0, 1}) {
    double low = 1e300, high = -1e300;
    for (std::size_t i = 0; i < point.size(); ++i) {
      if (point.rear[i] != side) continue;
      low = std::min(low, point.sensed[i]), high = std::max(high, point.sensed[i]);
    }
    swing = std::max(swing, high - low);
  }
  return swing;
}

std::vector<Hypothesis> slips(const LinearisationPoint& point, std::size_t instants) {
  std::vector<Hypothesis> list;
  if (!point.has_time || point.size() < 8 * instants) return list;
  for (std::size_t k = 1; k < instants; ++k) {
    TermShape shape;
    shape.onset_s = point.time[k * point.size() / instants];
    list.push_back(of_effect("part.slip", shape, {0, 1}, 4.0 * static_cast<double>(instants)));
    list.push_back(of_effect("part.slip", shape, {2}, 4.0 * static_cast<double>(instants)));
  }
  return list;
}

std::vector<Hypothesis> preset_causes(const LinearisationPoint& point,
                                      const Resolution& resolution) {
  std::vector<Hypothesis> list;
  add_harmonics(point, resolution, list);
  add_along_z(point, resolution, list);
  add_probe(point, resolution, list);
  add_time(point, list);
  return list;
}

std::vector<Hypothesis> causes_of_order(const LinearisationPoint& point,
                                        const Resolution& resolution, int order) {
  std::vector<Hypothesis> list;
  const double tests = resolution.harmonics;
  const double n = order;
  list.push_back(of_effect("part.roundness", with_order(n), {0, 1}, tests));
  if (resolution.degrees > 0) list.push_back(of_effect("part.roundness", with_order(n), {}, tests));
  list.push_back(of_effect("spindle.radial_synchronous", with_order(n), {}, tests));
  if (resolution.degrees > 0) {
    for (const double bearing : bearings) {
      TermShape shape = with_order(n);
      shape.lever_from_mm = bearing;
      list.push_back(of_effect("spindle.tilt_synchronous", shape, {}, tests * std::size(bearings)));
    }
    if (std::abs(point.tan_half_angle) > not_a_cylinder)
      list.push_back(of_effect("spindle.axial_synchronous", with_order(n), {}, tests));
    const double jaws = point.z_mid_mm - point.z_half_mm;
    for (const int j : {order, order / 2}) {
      if (j < 2 || j > 6 || (j != order && 2 * j != order)) continue;
      for (const double decay : decay_lengths) {
        TermShape shape = with_order(j);
        shape.lever_from_mm = jaws;
        shape.decay_length_mm = decay;
        const double all = 5.0 * std::size(decay_lengths);
        if (j == order) list.push_back(of_effect("part.chuck_lobing", shape, {0, 1}, all));
        if (2 * j <= resolution.harmonics)
          list.push_back(of_effect("part.chuck_lobing", shape, {}, all));
      }
    }
  }
  return list;
}

std::vector<Hypothesis> neighbours(const Hypothesis& h, const LinearisationPoint& point,
                                   double step) {
  std::vector<Hypothesis> list;
  const auto vary = [&](auto change) {
    for (const double d : {-step, step}) {
      Hypothesis other = h;
      change(other, d);
      list.push_back(std::move(other));
    }
  };
  if (!h.effect) {
    if (h.pattern.kind != Pattern::Kind::bump) return list;
    vary([](Hypothesis& o, double d) { o.pattern.angle_rad += d * o.pattern.width_rad * 8.0; });
    vary([](Hypothesis& o, double d) { o.pattern.width_rad *= std::exp(4.0 * d); });
    if (h.pattern.length_mm > 0.0) {
      vary([](Hypothesis& o, double d) { o.pattern.position_mm += d * o.pattern.length_mm * 8.0; });
      vary([](Hypothesis& o, double d) { o.pattern.length_mm *= std::exp(4.0 * d); });
    }
    return list;
  }
  const auto id = h.effect->id;
  if (id == "spindle.tilt_synchronous" && !h.with_radial) {
    // The envelope 1 + u κ, κ = half length / (middle − bearing): κ is what the data show.
    vary([&](Hypothesis& o, double d) {
      const double kappa = point.z_half_mm / (point.z_mid_mm - o.shape.lever_from_mm) + d;
      if (kappa > 0.01 && kappa < 1.2)
        o.shape.lever_from_mm = point.z_mid_mm - point.z_half_mm / kappa;
    });
  } else if (id == "part.chuck_lobing") {
    vary([](Hypothesis& o, double d) {
      o.shape.decay_length_mm =
          std::clamp(o.shape.decay_length_mm * std::exp(3.0 * d), 10.0, 200.0);
    });
  } else if (id == "part.slip") {
    const auto [first, last] = range_of(point.time);
    vary([&](Hypothesis& o, double d) {
      o.shape.onset_s = std::clamp(o.shape.onset_s + d * (last - first), first, last);
    });
  } else if (id == "thermal.drift" && !h.free.empty() && h.free[0] == 1) {
    vary([](Hypothesis& o, double d) { o.shape.time_constant_s *= std::exp(3.0 * d); });
  } else if (id == "probe.lag") {
    vary([](Hypothesis& o, double d) {
      o.shape.time_constant_s = std::clamp(o.shape.time_constant_s + 0.02 * d, 0.0, 0.05);
    });
  }
  return list;
}

}  // namespace trueaxis::diagnose_detail
