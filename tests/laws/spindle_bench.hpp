// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <complex>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "trueaxis/spindle.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::laws {

/// a_n exp(−iφ_n) of a_n cos(n α − φ_n), by order.
using TrueSeries = std::vector<std::complex<double>>;

/// The bench has its sensors where it states them.
inline SpindleOptions exact_angles() {
  SpindleOptions options;
  options.u_angle_rad = options.u_reindex_rad = 0.0;
  return options;
}

/// A cylinder of radius 20 mm, off-centre, with a form and a spindle with radial motion along X and
/// Y. Every order from 2 to `top` is there, sizes falling with the order, phases drawn.
struct SpindleBench {
  explicit SpindleBench(std::uint64_t seed, int top = 100) {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (auto [series, size_um] : {std::pair{&form, 2.0}, {&along_x, 1.0}, {&along_y, 1.0}}) {
      series->assign(static_cast<std::size_t>(top) + 1, 0.0);
      for (int n = 2; n <= top; ++n) {
        const double amplitude_mm = size_um * mm_per_um * (0.3 + unit(engine)) / n;
        (*series)[static_cast<std::size_t>(n)] = std::polar(amplitude_mm, -two_pi * unit(engine));
      }
    }
    virtual_lathe::Part& part = scenario.part;
    part.radius_mm = 20.0;
    part.x0_mm = 0.006;
    part.y0_mm = -0.004;
    scenario.probe.relative_zero_mm.reset();
    add("part.roundness", form);
    add("spindle.radial_synchronous", along_x);
    add("extra.radial_motion_y", along_y);
    scenario.seed = seed;
    pass(1);
  }

  void add(const char* id, const TrueSeries& series) {
    for (std::size_t n = 2; n < series.size(); ++n) {
      scenario.effects.push_back({id,
                                  {{"order", static_cast<double>(n)},
                                   {"amplitude_mm", std::abs(series[n])},
                                   {"phase_rad", -std::arg(series[n])}}});
    }
  }

  /// A dwell of `turns` in a set-up; the first call replaces the only pass.
  void pass(int setup, double turns = 6.0, double per_turn = 250.0) {
    virtual_lathe::PlannedPass one;
    one.start_mm = one.end_mm = 10.0;
    one.speed_rpm = 600.0;
    one.readings_per_revolution = per_turn;
    one.revolutions = turns;
    one.setup = setup;
    one.c_start_rad = 0.1 * setup;
    scenario.plan.passes.push_back(one);
  }
  void passes(const std::vector<int>& setups, double turns = 6.0, double per_turn = 250.0) {
    scenario.plan.passes.clear();
    for (const int number : setups) pass(number, turns, per_turn);
  }
  void sensors_deg(const std::vector<double>& angles_deg) {
    scenario.probe.sensor_angles_rad.clear();
    for (const double angle : angles_deg)
      scenario.probe.sensor_angles_rad.push_back(angle * rad_per_deg);
  }
  /// A set-up with the part turned, and clamped a little off where it was.
  void setup(int number, double reindex_deg, bool rear = false) {
    virtual_lathe::Chucking one;
    one.number = number;
    one.reindex_rad = reindex_deg * rad_per_deg;
    one.rear = rear;
    one.x0_mm = 0.006 - 0.002 * number;
    one.y0_mm = -0.004 + 0.001 * number;
    scenario.plan.setups.push_back(one);
  }

  ProbeStream stream() const { return virtual_lathe::simulate(scenario); }
  SpindleResult separate(const SpindleOptions& options = exact_angles()) const {
    const ProbeStream one = stream();
    return separate_spindle({&one, 1}, options);
  }

  virtual_lathe::Scenario scenario;
  TrueSeries form, along_x, along_y;
};

/// Whether value ± 2 u, or the bound in its place, holds the truth.
inline bool holds(const Estimate& one, double truth_mm) {
  if (one.interval) return truth_mm <= one.interval->back();
  return std::abs(one.value - truth_mm) <= 2.0 * one.u;
}

/// The harmonic as a_n exp(−iφ_n).
inline std::complex<double> complex_of(const SpindleHarmonic& one) {
  return {one.cos_mm, -one.sin_mm};
}

/// Distance of an estimate from the truth, of the whole harmonic: amplitude and phase.
inline double error_mm(const SpindleHarmonic& one, const TrueSeries& truth, int order) {
  return std::abs(complex_of(one) - truth[static_cast<std::size_t>(order)]);
}

}  // namespace trueaxis::laws
