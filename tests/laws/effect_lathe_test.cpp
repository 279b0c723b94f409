// SPDX-License-Identifier: Apache-2.0
// The linearised columns of every effect against the virtual lathe, which has the effects in its
// own formulas and no derivative anywhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "laws/lathe_bench.hpp"
#include "laws/lathe_cases.hpp"
#include "trueaxis/effect.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::testing {
namespace {

// The lathe finds a contact to a few units of the last place of 40 mm: 7e-15 each.
constexpr double reading_mm = 1e-12;

class EffectLathe : public ::testing::TestWithParam<LatheBench> {
 protected:
  std::vector<double> read(const std::string& id,
                           const std::map<std::string, double>& parameters) const {
    virtual_lathe::Scenario scenario = GetParam().scenario();
    if (!id.empty()) scenario.effects = {{id, parameters}};
    return virtual_lathe::simulate(scenario).reading_mm;
  }

  std::vector<double> predicted(const LatheCase& one, const TermContext& at) const {
    const EffectTerm& term = find_effect(one.id)->term;
    const std::size_t count = linear_parameters(term, one.shape).size();
    EXPECT_EQ(count, one.linear.size()) << one.id;
    std::vector<std::vector<double>> columns(count, std::vector<double>(at.size()));
    std::vector<double*> rows;
    for (auto& column : columns) rows.push_back(column.data());
    fill_columns(term, at, one.shape, rows);
    std::vector<double> sum(at.size(), 0.0);
    for (std::size_t j = 0; j < count; ++j) {
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += one.linear[j] * columns[j][i];
    }
    return sum;
  }
};

double largest(const std::vector<double>& values) {
  double size = 0.0;
  for (const double value : values) size = std::max(size, std::abs(value));
  return size;
}

TEST_P(EffectLathe, StartsFromTheSameReadings) {
  const ProbeStream stream = virtual_lathe::simulate(GetParam().scenario());
  const LatheColumns columns(GetParam(), stream);
  for (std::size_t i = 0; i < stream.size(); ++i) {
    ASSERT_NEAR(stream.reading_mm[i], columns.x[i], reading_mm);
  }
}

// change(a)/a = column + O(a): half the size leaves half the error, and none but rounding where the
// effect is linear. A wrong column leaves an error that does not shrink.
TEST_P(EffectLathe, ColumnsAreTheLimitOfTheLathe) {
  const ProbeStream stream = virtual_lathe::simulate(GetParam().scenario());
  const LatheColumns columns(GetParam(), stream);
  std::vector<LatheCase> cases = lathe_cases();
  std::erase_if(cases, [](const LatheCase& one) { return !one.has_limit; });
  for (const LatheCase& one : cases) {
    SCOPED_TRACE(one.id + " with parameters of size " + std::to_string(one.size));
    const std::vector<double> expected = predicted(one, columns.context());
    const auto error = [&](double size) {
      const std::vector<double> after = read(one.id, one.lathe(size));
      std::vector<double> off(after.size());
      for (std::size_t i = 0; i < off.size(); ++i) {
        off[i] = (after[i] - stream.reading_mm[i]) / size - expected[i];
      }
      return largest(off);
    };
    const double rounding = 2.0 * reading_mm / one.size;
    const double whole = error(one.size), half = error(0.5 * one.size);
    EXPECT_LT(whole, 0.05 * largest(expected) + rounding);
    EXPECT_LT(half, 0.55 * whole + 2.0 * rounding);
    // No amplitude, no effect.
    const std::vector<double> none = read(one.id, one.lathe(0.0));
    for (std::size_t i = 0; i < none.size(); ++i) {
      ASSERT_NEAR(none[i], stream.reading_mm[i], 2.0 * reading_mm);
    }
  }
}

// A lag of 5 ms is not small (ωT = 0.08 at 151 rpm). Linearised there, the column is exact for the
// first harmonic at constant Z; it leaves out the feed along the tilted axis, 4 T ω v θ, and what
// the second harmonic e²/4R does beyond its second order, 18 ω³T² e²/4R.
TEST_P(EffectLathe, LagIsLinearisedWhereItIs) {
  const ProbeStream stream = virtual_lathe::simulate(GetParam().scenario());
  const LatheColumns columns(GetParam(), stream);
  const double at_s = 5e-3, step_s = 1e-4;
  LatheCase lag{"probe.lag", 0.0, {}, {.time_constant_s = at_s}, {1.0}};
  const std::vector<double> expected = predicted(lag, columns.context());
  const auto after = read("probe.lag", {{"time_constant_s", at_s + step_s}});
  const auto before = read("probe.lag", {{"time_constant_s", at_s - step_s}});
  std::vector<double> off(after.size()), naive(after.size());
  lag.shape.time_constant_s = 0.0;
  const std::vector<double> at_zero = predicted(lag, columns.context());
  for (std::size_t i = 0; i < off.size(); ++i) {
    const double slope = (after[i] - before[i]) / (2.0 * step_s);
    off[i] = slope - expected[i];
    naive[i] = slope - at_zero[i];
  }
  const double w = 151.0 / 60.0 * two_pi, v = 5.3 * 151.0 / 60.0;
  const double tilt = std::hypot(LatheBench::l, LatheBench::m);
  const double e = std::hypot(LatheBench::x0_mm, LatheBench::y0_mm) + tilt * LatheBench::end_mm;
  const double left_out = 4.0 * at_s * w * v * tilt + 18.0 * std::pow(w, 3) * at_s * at_s * e * e /
                                                          (4.0 * LatheBench::radius_mm);
  EXPECT_LT(largest(off), 1.2 * left_out);  // next orders of ωT = 0.08
  EXPECT_GT(largest(naive), 0.05 * largest(expected));
}

// A play of 20 µm holds the reading for some 25° after each extreme. At that play the column is
// exact for one harmonic of C and a feed along a straight generatrix. The harmonic grows along Z by
// what the tilt makes of the feed in half a revolution, and there is a second one of e²/4R: an
// extreme moves by twice both.
TEST_P(EffectLathe, HysteresisIsLinearisedWhereItIs) {
  const ProbeStream stream = virtual_lathe::simulate(GetParam().scenario());
  const LatheColumns columns(GetParam(), stream);
  const double play_mm = 0.02;
  LatheCase play{"probe.hysteresis", 0.0, {}, {.play_mm = play_mm}, {1.0}};
  const std::vector<double> expected = predicted(play, columns.context());
  const std::vector<double> after = read("probe.hysteresis", {{"play_mm", play_mm}});
  play.shape.play_mm = 0.0;
  const std::vector<double> at_zero = predicted(play, columns.context());
  std::vector<double> off(after.size()), naive(after.size());
  for (std::size_t i = 0; i < off.size(); ++i) {
    const double change = (after[i] - stream.reading_mm[i]) / play_mm;
    off[i] = change - expected[i];
    naive[i] = change - at_zero[i];
  }
  const double tilt = std::hypot(LatheBench::l, LatheBench::m);
  const double e = std::hypot(LatheBench::x0_mm, LatheBench::y0_mm) + tilt * LatheBench::end_mm;
  const double growth = 5.3 * tilt * 0.5, second = e * e / (4.0 * LatheBench::radius_mm);
  EXPECT_LT(largest(off) * play_mm, 2.0 * (growth + second));
  EXPECT_GT(largest(naive), 0.9);  // a flat top as a step is off by all of it
}

INSTANTIATE_TEST_SUITE_P(Parts, EffectLathe,
                         ::testing::Values(LatheBench{"Cone", 0.1}, LatheBench{"Cylinder"},
                                           LatheBench{"ConeFromTheRear", -0.2, false, true},
                                           LatheBench{"ConicalBore", 0.1, true},
                                           LatheBench{"BoreFromTheRear", 0.0, true, true}),
                         [](const auto& bench) { return bench.param.name; });

// The slope along Y follows from that along C, at any height of the line: against central
// differences over the height, which err by h² X/R³ (1e-8 of the slope) and rounding (1e-15/h ·
// 40).
TEST(EffectLatheCases, SlopesAlongYHoldAtAnyHeight) {
  const Revolved cone = LatheBench{"Cone", 0.1}.surface();
  const std::vector<double> one{1.0};
  for (const double height : {-8.0, 0.0, 3.0}) {
    for (const double c : {0.3, 2.0, 4.4}) {
      const double step = 1e-3;
      const Intersection contact = intersect(cone, c, 10.0, height);
      const double slope = (intersect(cone, c, 10.0, height + step).x_mm -
                            intersect(cone, c, 10.0, height - step).x_mm) /
                           (2.0 * step);
      const std::vector<double> c_rad{c}, x{contact.x_mm}, dx_dc{contact.dx_dc};
      TermContext at;
      at.c_rad = c_rad, at.x_mm = x, at.dx_dc = dx_dc, at.height_mm = height;
      at.z_mm = at.time_s = at.speed_rad_per_s = at.velocity_mm_per_s = at.sensed_mm = one;
      at.dx_dz = at.theta_rad = at.theta_chuck_rad = at.s_mm = at.clamp_force_ratio = one;
      double column = 0.0;
      double* const out[] = {&column};
      fill_columns(find_effect("probe.height")->term, at, {}, out);
      EXPECT_NEAR(column, slope, 1e-9) << "height " << height << ", C " << c;
    }
  }
}

TEST(EffectLatheCases, HasACaseForEveryEffect) {
  std::set<std::string_view> covered;
  const std::vector<LatheCase> cases = all_lathe_cases();
  for (const LatheCase& one : cases) covered.insert(one.id);
  for (const Effect& effect : effect_catalogue()) {
    EXPECT_EQ(covered.contains(effect.id), !effect.check) << effect.id;
  }
}

}  // namespace
}  // namespace trueaxis::testing
