// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <random>

#include "job/agreement.hpp"
#include "job/mistakes.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

/// Two references of one part, a cone seat and a journal next to it, as the virtual lathe probes
/// them.
namespace trueaxis::testing {

/// How far the journal's axis is from the seat's, and whether it has one at all of the seat's.
struct Population {
  double eccentricity_low_mm = 0.05, eccentricity_high_mm = 0.3;
  double tilt_low_rad = 3e-4, tilt_high_rad = 15e-4;
  double apart_mm = 0.0;      ///< length of a random direction
  double apart_sd_rad = 0.0;  ///< of each slope
  bool journal_true = false;  ///< turned in this clamping: on the spindle axis
};

class AgreementBench {
 public:
  AgreementBench(const Population& population, unsigned seed) : random_(seed) {
    const auto [x, y] =
        direction(uniform(population.eccentricity_low_mm, population.eccentricity_high_mm));
    const auto [l, m] = direction(uniform(population.tilt_low_rad, population.tilt_high_rad));
    const auto [dx, dy] = direction(population.apart_mm);
    std::normal_distribution<double> slope(0.0, 1.0);
    const double dl = population.apart_sd_rad * slope(random_);
    const double dm = population.apart_sd_rad * slope(random_);
    add("A", true, x, y, l, m, 0.0, seed);
    // Apart in the middle of the journal, at Z = 140.
    if (population.journal_true) {
      add("B", false, 0.0, 0.0, 0.0, 0.0, 120.0, seed);
    } else {
      add("B", false, x + dx - 140.0 * dl, y + dy - 140.0 * dm, l + dl, m + dm, 120.0, seed);
    }
  }

  /// The journal as it is read with a mistake that `right` would mend.
  void spoil(const Mistake& right, double number = 0.0) {
    Mistake wrong = right;
    wrong.x = 1.0 / right.x, wrong.z = 1.0 / right.z, wrong.c = 1.0 / right.c;
    wrong.turn_rad = -right.turn_rad;
    result_.streams[1] = mended(result_.streams[1], wrong, -number);
    if (right.x == 2.0) result_.streams[1].x_convention = {true, SaidBy::stream};
  }

  Agreement agreement() {
    result_.fits.clear();
    for (std::size_t i = 0; i < 2; ++i)
      result_.fits.push_back(fit(result_.streams[i], result_.job.references[i].fit));
    return hold_together(result_);
  }

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

 private:
  struct Plane {
    double x, y;
  };
  Plane direction(double length) {
    const double angle = uniform(0.0, two_pi);
    return {length * std::cos(angle), length * std::sin(angle)};
  }

  void add(const char* name, bool cone, double x, double y, double l, double m, double z_mm,
           unsigned seed) {
    virtual_lathe::Scenario scenario;
    scenario.seed = 2 * seed + (cone ? 0 : 1);
    scenario.part.kind = cone ? virtual_lathe::PartKind::cone : virtual_lathe::PartKind::cylinder;
    scenario.part.radius_mm = cone ? 30.0 : 25.0;
    scenario.part.half_angle_rad = cone ? 0.124 : 0.0;
    scenario.part.x0_mm = x, scenario.part.y0_mm = y, scenario.part.l = l, scenario.part.m = m;
    scenario.noise.sigma_mm = 2e-3;
    virtual_lathe::PlannedPass pass;
    pass.start_mm = z_mm, pass.end_mm = z_mm + 40.0;
    pass.feed_mm_per_rev = 2.0, pass.readings_per_revolution = 24.3;
    scenario.plan.passes = {pass};
    result_.streams.push_back(virtual_lathe::simulate(scenario));
    JobReference reference;
    reference.name = name;
    reference.fit.surface = cone ? SurfaceKind::cone : SurfaceKind::cylinder;
    result_.job.references.push_back(reference);
  }

  std::mt19937_64 random_;
  JobResult result_;
};

}  // namespace trueaxis::testing
