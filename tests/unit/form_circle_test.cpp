// SPDX-License-Identifier: Apache-2.0
// Reference circles: profiles whose circles are known in closed form, and the proof of each
// optimum.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "form/circle.hpp"
#include "form/exchange.hpp"
#include "form/harmonics.hpp"
#include "support/form_profiles.hpp"

namespace trueaxis::testing {
namespace {

constexpr const char* circles[] = {"LSCI", "MZCI", "MCCI", "MICI"};
constexpr double rounding_mm = 1e-9;  // the goal: 1e-6 µm

// All four circles of an ellipse are concentric with it: RONt is the difference of its half axes.
TEST(FormCircle, EllipseExactly) {
  const double a = 25.01, b = 24.99;
  const FormResult result = assess_form(
      section_stream([&](double t) { return a * b / std::hypot(b * std::cos(t), a * std::sin(t)); },
                     720),
      quick());
  for (const char* circle : {"LSCI", "MZCI", "MCCI"})
    EXPECT_NEAR(value_of(result.sections[0].values, "RONt", circle).estimate.value, a - b,
                rounding_mm)
        << circle;
  // Inside, where two points alone hold it, the circle may move along the long axis until the next
  // ones touch: they are (a − b)h² further off, at a lever of h, the step of the angles.
  const double step = two_pi / 720.0;
  EXPECT_NEAR(value_of(result.sections[0].values, "RONt", "MICI").estimate.value, a - b,
              1.01 * (a - b) * step);
  EXPECT_NEAR(result.sections[0].circles[2].radius_mm, a, rounding_mm);
  EXPECT_NEAR(result.sections[0].circles[3].radius_mm, b, (a - b) * step * step);
}

// Least squares are along the circumference (ISO 12181-1): half a turn that is read three times as
// densely, or a turn and a half, moves no centre. One of readings was 1.3 and 0.9 µm off.
TEST(FormCircle, DensityOfReadingsMovesNoCentre) {
  const auto lobes = [](double t) {
    return 20.0 + 10e-3 * std::cos(2.0 * t - 0.4) + 10e-3 * std::cos(3.0 * t - 1.1);
  };
  ProbeStream dense, more;
  for (int i = 0; i < 2400; ++i) {
    dense.c_rad.push_back(i < 1800 ? 0.5 * two_pi * i / 1800.0
                                   : 0.5 * two_pi * (1.0 + (i - 1800) / 600.0));
    more.c_rad.push_back(1.5 * two_pi * i / 2400.0 + (i < 1600 ? 0.0 : two_pi / 3200.0));
  }
  for (ProbeStream* stream : {&dense, &more}) {
    for (const double c : stream->c_rad) stream->reading_mm.push_back(lobes(c));
    const FormResult result = assess_form(*stream, quick());
    EXPECT_NEAR(result.sections[0].circles[0].x_mm, 0.0, 2e-5);
    EXPECT_NEAR(result.sections[0].circles[0].y_mm, 0.0, 2e-5);
    EXPECT_NEAR(result.sections[0].circles[0].radius_mm, 20.0, 2e-5);
  }
}

// Turns at the same angles are one turn. Rounding sets the readings at 0 just before the end of
// some turns: taken as two places they would draw the least-squares circle by 2/91 of a lobe.
TEST(FormCircle, TheReadingsWhereATurnClosesAreOnePlace) {
  const double a = 2e-3;
  const auto lobes = [&](double t) { return 25.0 + a * std::cos(3.0 * t); };
  ProbeStream stream;
  for (const double off : {0.0, -1e-15, 1e-15})
    for (int i = 0; i < 90; ++i) {
      const double angle = two_pi * i / 90.0;
      stream.c_rad.push_back(angle + off + (i == 0 && off < 0.0 ? two_pi : 0.0));
      stream.reading_mm.push_back(lobes(angle));
    }
  const FormResult result = assess_form(stream, quick());
  EXPECT_EQ(result.sections[0].profile.angle_rad.size(), 90U);
  EXPECT_NEAR(result.sections[0].circles[0].x_mm, 0.0, rounding_mm);
  for (const char* circle : circles)
    EXPECT_NEAR(value_of(result.sections[0].values, "RONt", circle).estimate.value, 2.0 * a,
                rounding_mm)
        << circle;
}

// n lobes of amplitude a: every circle has RONt = 2a, RONp = RONv = a, RONq = a/√2 about LSCI.
TEST(FormCircle, LobesExactly) {
  for (const int n : {2, 3, 5, 8}) {
    const double a = 2e-3;
    const FormResult result = assess_form(
        section_stream([&](double t) { return 25.0 + a * std::cos(n * t); }, 720), quick());
    const auto& values = result.sections[0].values;
    for (const char* circle : circles)
      EXPECT_NEAR(value_of(values, "RONt", circle).estimate.value, 2.0 * a,
                  n == 2 && std::string(circle) == "MICI" ? 1.01 * 2.0 * a * two_pi / 720.0
                                                          : rounding_mm)  // as of an ellipse
          << n << circle;
    EXPECT_NEAR(value_of(values, "RONp", "LSCI").estimate.value, a, rounding_mm);
    EXPECT_NEAR(value_of(values, "RONv", "LSCI").estimate.value, a, rounding_mm);
    EXPECT_NEAR(value_of(values, "RONq", "LSCI").estimate.value, a / std::sqrt(2.0), rounding_mm);
    EXPECT_EQ(result.sections[0].lobes, n);
    EXPECT_NEAR(result.sections[0].lobes_share, 1.0, 1e-9);
    // dr/dθ = n a at most, half a step away n a (nh/2)²/2 less; the rule itself (nh)⁴/30.
    const double step = two_pi / 720.0;
    EXPECT_NEAR(value_of(values, "slope").estimate.value, n * a,
                0.13 * a * std::pow(n, 3) * step * step);
    const FormHarmonic& order = result.sections[0].harmonics.at(static_cast<std::size_t>(n) - 1);
    EXPECT_NEAR(order.amplitude_mm, a, rounding_mm);
    EXPECT_NEAR(std::remainder(order.phase_rad, two_pi), 0.0, 1e-6);
  }
}

// One reading of N sticks out by h. LSCI: h(1 − 3/N) up and (1 + 2 cos(2π/N)) h/N down next to it;
// MZCI, MCCI, MICI: h, as its neighbours are as near to it as one likes (a gauge: Eq. 265).
TEST(FormCircle, OneReadingStandsOut) {
  const double h = 1e-2, n = 360.0;
  ProbeStream stream = section_stream([&](double t) { return t == 0.0 ? h : 0.0; }, 360);
  stream.indication = Indication::relative;
  const auto values = assess_form(stream, quick()).sections[0].values;
  EXPECT_NEAR(value_of(values, "RONt", "LSCI").estimate.value,
              h * (1.0 - 3.0 / n) + h / n * (1.0 + 2.0 * std::cos(two_pi / n)), rounding_mm);
  const double beside = 0.5 * (1.0 - std::cos(two_pi / n));  // what the next reading leaves of it
  for (const char* circle : {"MZCI", "MCCI", "MICI"})
    EXPECT_NEAR(value_of(values, "RONt", circle).estimate.value, h, 1.1 * beside * h) << circle;
}

// A circle that is 1 mm off the axis is round, and its run-out twice its eccentricity.
TEST(FormCircle, AnEccentricCircleIsRound) {
  const FormResult result =
      assess_form(section_stream([](double t) { return eccentric(20.0, 1.0, t); }, 1000), quick());
  for (const char* circle : circles)
    EXPECT_NEAR(value_of(result.sections[0].values, "RONt", circle).estimate.value, 0.0,
                rounding_mm);
  EXPECT_NEAR(value_of(result.sections[0].values, "eccentricity").estimate.value, 1.0, rounding_mm);
  EXPECT_NEAR(value_of(result.sections[0].values, "radius").estimate.value, 20.0, rounding_mm);
  EXPECT_NEAR(value_of(group_of(result, "datum"), "runout_circular").estimate.value, 2.0,
              rounding_mm);
  EXPECT_NEAR(value_of(group_of(result, "datum"), "concentricity").estimate.value, 2.0,
              rounding_mm);
}

// So is one that a ball reads, from outside and from inside, in front and on the rear side: the
// ball's centre runs on a circle of radius 10 ± 2 mm. Distances less 2 mm would be two undulations
// of e²/4 (1/10 − 1/12) = 0.4 µm off. A gauge is at 0 where the surface is at its nominal radius;
// taken from the wrong side it would be e²/2R off.
TEST(FormCircle, AnEccentricCircleIsRoundToABall) {
  const double radius_mm = 10.0, ball_mm = 2.0, e_mm = 0.3;
  for (const bool bore : {false, true})
    for (const bool gauge : {false, true})
      for (const bool rear : {false, true}) {
        const double of_centre_mm = bore ? radius_mm - ball_mm : radius_mm + ball_mm;
        ProbeStream stream = section_stream(
            [&](double c) {
              const double from_zero = gauge ? of_centre_mm : 0.0;
              return rear ? from_zero - eccentric(of_centre_mm, e_mm, c + 0.5 * two_pi)
                          : eccentric(of_centre_mm, e_mm, c) - from_zero;
            },
            1000);
        if (gauge) stream.indication = Indication::relative, stream.nominal_radius_mm = radius_mm;
        stream.setups.front().rear = rear;
        FormOptions options = quick();
        options.bore = bore, options.ball_radius_mm = ball_mm;
        const auto values = assess_form(stream, options).sections[0].values;
        for (const char* circle : circles)
          EXPECT_NEAR(value_of(values, "RONt", circle).estimate.value, 0.0, rounding_mm)
              << circle << (bore ? " bore" : " shaft") << gauge << rear;
        EXPECT_NEAR(value_of(values, "eccentricity").estimate.value, e_mm, rounding_mm);
        EXPECT_NEAR(value_of(values, "radius").estimate.value, radius_mm, rounding_mm);
      }
}

// Pure orders through the Gaussian filter: RONt = 2a · 2^−(n/50)², band-pass T₂(1 − T₁).
TEST(FormCircle, PureOrdersThroughTheFilter) {
  const double a = 1e-3;
  const auto round_by = [&](int n, double low, double high) {
    FormOptions options = quick(ProfileFilter::gaussian, high);
    options.low_upr = low;
    const auto result = assess_form(
        section_stream([&](double t) { return 25.0 + a * std::cos(n * t); }, 3600), options);
    return value_of(result.sections[0].values, "RONt", "MZCI").estimate.value;
  };
  const auto passes = [](double n, double cutoff) {
    return std::exp2(-(n / cutoff) * (n / cutoff));
  };
  for (const int n : {2, 3, 15, 50}) {
    EXPECT_NEAR(round_by(n, 1.0, 50.0), 2.0 * a * passes(n, 50.0), rounding_mm) << n;
    EXPECT_NEAR(round_by(n, 15.0, 150.0), 2.0 * a * passes(n, 150.0) * (1.0 - passes(n, 15.0)),
                rounding_mm)
        << n;
  }
}

// Eq. 266 on random profiles: the multipliers prove that nothing is better.
TEST(FormCircle, EveryOptimumIsProven) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  for (int repeat = 0; repeat < 50; ++repeat) {
    std::vector<double> angle, y;
    for (int i = 0; i < 300; ++i) {
      angle.push_back(std::uniform_real_distribution<double>(0.0, two_pi)(random));
      y.push_back(1e-3 * normal(random));
    }
    const form::Exchange::Rows rows = form::limacon_rows(angle);
    for (const Criterion criterion : {Criterion::minimum_zone, Criterion::minimum_circumscribed,
                                      Criterion::maximum_inscribed}) {
      form::Exchange exchange(rows, criterion);
      const form::Nearest nearest = exchange(y);
      const std::vector<double> off = exchange.off(y, nearest);
      ASSERT_TRUE(nearest.determined);
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      double weight = 0.0;
      const double extreme =
          criterion == Criterion::minimum_zone ? std::abs(off[nearest.touches[0].reading]) : 0.0;
      for (const auto& touch : nearest.touches) {
        EXPECT_GE(touch.multiplier, -1e-12);
        const auto row = static_cast<Eigen::Index>(touch.reading);
        sum += touch.multiplier * touch.side * rows.row(row).transpose();
        weight += touch.multiplier;
        EXPECT_NEAR(off[touch.reading], touch.side * extreme, 1e-15);
      }
      const double size = criterion == Criterion::minimum_zone            ? 0.0
                          : criterion == Criterion::minimum_circumscribed ? 1.0
                                                                          : -1.0;
      EXPECT_LT((sum - Eigen::Vector3d(size, 0.0, 0.0)).norm(), 1e-12);
      EXPECT_NEAR(weight, 1.0, 1e-12);
      for (const double one : off) {
        EXPECT_TRUE(criterion == Criterion::maximum_inscribed || one <= extreme + 1e-15);
        EXPECT_TRUE(criterion == Criterion::minimum_circumscribed || one >= -extreme - 1e-15);
      }
    }
  }
}

// Orders at uneven angles are found together: none leaks into another.
TEST(FormCircle, HarmonicsAtUnevenAngles) {
  std::mt19937_64 random(5);
  form::Trace trace;
  trace.period = two_pi;
  for (int i = 0; i < 900; ++i)
    trace.at.push_back((i + std::uniform_real_distribution<double>(0.1, 0.9)(random)) * two_pi /
                       900.0);
  for (const double at : trace.at)
    trace.value_mm.push_back(1e-3 * std::cos(2.0 * at - 1.0) + 2e-4 * std::cos(77.0 * at - 2.0));
  const auto orders = form::harmonics_of(trace, 120);
  for (const form::Order& one : orders) {
    const double amplitude = one.order == 2 ? 1e-3 : one.order == 77 ? 2e-4 : 0.0;
    EXPECT_NEAR(one.amplitude_mm(), amplitude, 1e-14) << one.order;
  }
  EXPECT_NEAR(orders[77].phase_rad(), 2.0, 1e-9);
}

// A groove of 8 µm in a bore goes into the material: a valley, and a peak of a shaft's profile of
// the same radii (ISO 12181-1).
TEST(FormCircle, AGrooveInABoreIsAValley) {
  const auto deeper = [](double t) {
    return 20.0 + 8e-3 * std::exp(-std::pow((t - 3.0) / 0.1, 2));
  };
  const ProbeStream stream = section_stream(deeper, 720);
  FormOptions options = quick();
  const auto value = [&](const char* name) {
    return value_of(assess_form(stream, options).sections[0].values, name, "LSCI").estimate.value;
  };
  const double high = value("RONp"), low = value("RONv");
  EXPECT_GT(high, 6e-3);
  EXPECT_LT(low, 2e-3);
  options.bore = true;
  EXPECT_DOUBLE_EQ(value("RONv"), high);
  EXPECT_DOUBLE_EQ(value("RONp"), low);
}

}  // namespace
}  // namespace trueaxis::testing
