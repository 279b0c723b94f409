// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "trueaxis/correction.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

// The actuator of the facts of theory.md: second order alone, the hold made negligible.
Actuator without_hold() {
  Actuator actuator;
  actuator.sampling_hz = 1e12;
  return actuator;
}

TEST(Actuator, FollowingErrorsOfTheCatalogueHoldWithoutTheHold) {
  // docs/explanation/theory.md: 300 µm at 1 UPR, 600 Hz, damping 0.7; printed to one decimal.
  const double printed[][2] = {{60, 0.7}, {300, 3.5}, {600, 7.0}, {1000, 11.7}, {2000, 23.4}};
  for (const auto& [rpm, um] : printed) {
    EXPECT_NEAR(300.0 * std::abs(without_hold().response(rpm / 60.0) - 1.0), um, 0.05) << rpm;
  }
}

TEST(Actuator, TheHoldOfTheSamplingAddsHalfItsPeriodToTheLag) {
  // Lag at low frequency: 2ζ/ω_n + T/2 = 371.4 µs + 25 µs; at 1000 rpm 12.45 µm in place of 11.67.
  const double omega = 2.0 * pi * 1000.0 / 60.0;
  const double lag_s = 2.0 * 0.7 / (2.0 * pi * 600.0) + 0.5 / 20000.0;
  // The amplitude differs from A ω lag by a relative (f/f_n)² = 8e-4.
  EXPECT_NEAR(300.0 * std::abs(Actuator{}.response(1000.0 / 60.0) - 1.0), 300.0 * omega * lag_s,
              300.0 * omega * lag_s * 1e-3);
}

TEST(Actuator, AdvancingTheCommandLeavesSixNanometres) {
  // docs/explanation/theory.md: advancing by 2ζ/ω_n = 0.37 ms leaves 0.006 µm at 1000 rpm.
  const double lead_s = 2.0 * 0.7 / (2.0 * pi * 600.0);
  EXPECT_NEAR(lead_s, 0.37e-3, 0.005e-3);
  const double f = 1000.0 / 60.0;
  const Complex advanced = without_hold().response(f) * std::polar(1.0, 2.0 * pi * f * lead_s);
  EXPECT_NEAR(300.0 * std::abs(advanced - 1.0), 0.006, 0.0005);
  // docs/explanation/theory.md: timing costs 31 nm per µs there.
  EXPECT_NEAR(300e3 * 2.0 * pi * f * 1e-6, 31.0, 0.5);
}

TEST(Actuator, ResponseHasTheDocumentedFactors) {
  Actuator actuator;
  actuator.delay_s = 1e-4;
  for (const double f : {0.0, 10.0, 600.0, 2500.0}) {
    const double w = 2.0 * pi * f, wn = 2.0 * pi * 600.0, half = w / (2.0 * 20000.0);
    const Complex second = wn * wn / Complex(wn * wn - w * w, 2.0 * 0.7 * wn * w);
    const Complex hold = (f == 0.0 ? 1.0 : std::sin(half) / half) * std::polar(1.0, -half);
    const Complex expected = second * std::polar(1.0, -w * 1e-4) * hold;
    EXPECT_NEAR(std::abs(actuator.response(f) - expected), 0.0, 1e-14) << f;
  }
}

TEST(Actuator, BandwidthIsWhereTheGainFallsToMinusThreeDecibels) {
  for (const double damping : {0.05, 0.5, std::numbers::sqrt2 / 2.0, 1.0, 30.0}) {
    Actuator actuator = without_hold();
    actuator.damping = damping;
    const double f = actuator.bandwidth_hz();
    EXPECT_NEAR(std::abs(actuator.response(f)), std::numbers::sqrt2 / 2.0, 1e-9) << damping;
    // Lowest such frequency: the gain is above it on the way there.
    for (int i = 1; i < 50; ++i) {
      EXPECT_GT(std::abs(actuator.response(f * i / 50.0)), std::numbers::sqrt2 / 2.0) << damping;
    }
  }
  Actuator butterworth;
  butterworth.damping = std::numbers::sqrt2 / 2.0;
  EXPECT_NEAR(butterworth.bandwidth_hz(), 600.0, 1e-9);
}

TEST(Actuator, MeasuredResponseGoesThroughItsPointsWithUnwrappedPhase) {
  Actuator actuator = without_hold();
  actuator.measured = {{100.0, 1.0, -1.0}, {200.0, 0.25, -3.0}, {300.0, 0.25, 1.28318530717958648}};
  // The hold of 1e12 Hz turns the phase by πf/f_s = 1e-9. 1.283… is −5 a turn on.
  EXPECT_NEAR(std::abs(actuator.response(100.0)), 1.0, 1e-12);
  EXPECT_NEAR(std::abs(actuator.response(200.0)), 0.25, 1e-12);
  EXPECT_NEAR(std::arg(actuator.response(200.0)), -3.0, 2e-9);
  EXPECT_NEAR(std::remainder(std::arg(actuator.response(300.0)) + 5.0, 2.0 * pi), 0.0, 2e-9);
  EXPECT_NEAR(std::remainder(std::arg(actuator.response(350.0)) + 6.0, 2.0 * pi), 0.0, 2e-9);
  // By straight lines the gain of 1 at 100 Hz falls by a factor 4 in 100 Hz: 1/sqrt(2) after a
  // quarter of that.
  EXPECT_NEAR(actuator.bandwidth_hz(), 125.0, 1e-9);
  actuator.measured.front().gain = 0.5;  // has fallen before the first point
  EXPECT_EQ(actuator.bandwidth_hz(), 0.0);
}

// A pure delay: its phase is a straight line through 0, and nothing is unknown between points.
TEST(Actuator, MeasuredDelayIsThatDelayFromFewPoints) {
  Actuator actuator = without_hold();
  actuator.measured = {{20.0, 1.0, -0.2}, {50.0, 1.0, -0.5}, {300.0, 1.0, -3.0}};
  for (const double f : {0.0, 3.0, 35.0, 200.0, 290.0}) {
    EXPECT_NEAR(std::abs(actuator.response(f) - std::polar(1.0, -0.01 * f)), 0.0, 2e-9) << f;
    EXPECT_NEAR(actuator.between_points(f), 0.0, 1e-12) << f;
  }
}

// One that turns by more than half a revolution before its first point, and one from below 1 Hz.
TEST(Actuator, AMeasuredDelayMayBeLongOrSlow) {
  for (const double scale : {1.0, 0.01}) {
    Actuator actuator = without_hold();
    for (const double f : {0.0, 20.0, 30.0, 50.0})
      if (f > 0.0 || scale < 1.0)
        actuator.measured.push_back({scale * f, 0.8, std::remainder(-0.125 * f, 2.0 * pi)});
    EXPECT_NO_THROW(actuator.validate());
    for (const double f : {0.0, 10.0, 20.0, 27.0, 49.0, 70.0}) {
      const Complex delayed = std::polar(0.8, -0.125 * f);
      EXPECT_LT(std::abs(actuator.response(scale * f) - delayed), 2e-9) << scale << ' ' << f;
      EXPECT_LT(actuator.between_points(scale * f), 1e-12) << scale << ' ' << f;
    }
  }
}

TEST(Actuator, OnePointOfAResponseIsItsGainAndDelay) {
  Actuator actuator = without_hold();
  actuator.measured = {{100.0, 0.9, -0.5}};
  for (const double f : {0.0, 40.0, 100.0, 150.0})
    EXPECT_LT(std::abs(actuator.response(f) - std::polar(0.9, -0.005 * f)), 2e-9) << f;
  EXPECT_EQ(actuator.bandwidth_hz(), 100.0) << "it is not known to fall";
}

// Sparse points of a second order, within them: the cubic is off by less than a third of what it
// says is unknown, and that falls as the square of the spacing, as straight lines do.
TEST(Actuator, MeasuredResponseSaysWhatItsPointsDoNotShow) {
  Actuator model = without_hold();
  model.natural_frequency_hz = 150.0, model.damping = 0.5;
  double coarse = 0.0, fine = 0.0;
  for (const double step : {10.0, 5.0}) {
    Actuator measured = without_hold();
    for (double f = step; f < 120.0; f += step) {
      const Complex h = model.response(f);
      measured.measured.push_back({f, std::abs(h), std::arg(h)});
    }
    for (double f = 0.3 * step; f < 60.0; f += 0.77 * step) {
      const double unknown = measured.between_points(f);
      const double off = std::abs(measured.response(f) / model.response(f) - 1.0);
      EXPECT_LT(off, unknown / 3.0 + 1e-9) << step << ' ' << f;
      (step > 7.0 ? coarse : fine) = std::max(step > 7.0 ? coarse : fine, unknown);
    }
  }
  EXPECT_NEAR(coarse / fine, 4.0, 1.0);
}

TEST(Actuator, MeasuredResponseOfASecondOrderIsThatSecondOrder) {
  const Actuator model;
  Actuator measured;
  for (double f = 1.0; f < 3000.0; f += 1.0) {
    const Complex h = without_hold().response(f);
    measured.measured.push_back({f, std::abs(h), std::arg(h)});
  }
  for (const double f : {0.3, 16.67, 123.4, 599.9}) {
    // Straight lines over 1 Hz would err by (1/f_n)²/8 times a curvature of order 1.
    EXPECT_NEAR(std::abs(measured.response(f) - model.response(f)), 0.0, 1e-8) << f;
  }
  EXPECT_NEAR(measured.bandwidth_hz(), model.bandwidth_hz(), 1e-3);
}

TEST(Actuator, ValidationNamesQuantityValueAndLimit) {
  EXPECT_NO_THROW(Actuator{}.validate());
  const auto message = [](const Actuator& actuator) -> std::string {
    try {
      actuator.validate();
    } catch (const ContractViolation& violation) {
      return violation.what();
    }
    return "";
  };
  Actuator actuator;
  actuator.stroke_mm = -0.6;
  EXPECT_EQ(message(actuator), "actuator: stroke [mm] is -0.6, must be > 0");
  actuator = {};
  actuator.stroke_reserve = 1.0;
  EXPECT_EQ(message(actuator), "actuator: stroke reserve is 1, must be >= 0 and < 1");
  actuator = {};
  actuator.delay_s = std::nan("");
  EXPECT_EQ(message(actuator), "actuator: delay [s] is nan, must be >= 0");
  actuator = {};
  actuator.measured = {{10.0, 1.0, 0.0}, {10.0, 0.9, -0.1}};
  EXPECT_EQ(message(actuator),
            "actuator: measured frequency [Hz] is 10, must be >= 0 and above the one before");
}

// A phase with the wrong sign leads, which no servo does; one that is written a turn on does not.
TEST(Actuator, AMeasuredLeadIsRefused) {
  Actuator actuator;
  actuator.measured = {{10.0, 1.0, 0.063}, {100.0, 1.0, 0.63}};
  EXPECT_TRUE(actuator.leads());
  actuator.measured.back().phase_rad = 0.11;
  EXPECT_TRUE(actuator.leads());
  EXPECT_THROW(actuator.validate(), ContractViolation);
  actuator.measured.back().phase_rad = 0.09;  // as a measurement may be off
  EXPECT_FALSE(actuator.leads());
  actuator.measured = {{10.0, 1.0, -0.063}, {100.0, 1.0, -2.0}, {200.0, 1.0, 2.0 * pi - 4.0}};
  EXPECT_FALSE(actuator.leads());
  EXPECT_NO_THROW(actuator.validate());
}

}  // namespace
}  // namespace trueaxis
