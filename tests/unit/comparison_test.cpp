// SPDX-License-Identifier: Apache-2.0
// Measured against simulated: discrepancies whose RMS, share and spectrum follow from a formula.
#include "resimulate/files/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "trueaxis/error.hpp"
#include "trueaxis/job.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double lobes_mm = 0.006, residual_mm = 0.001, offset_mm = 0.002, sigma_mm = 0.0005;
constexpr std::size_t turns = 20, per_turn = 40;

struct Example {
  ProbeStream measured;
  SimulatedReadings simulated;
  std::vector<bool> masked;
};

/// Whole turns: before, three lobes and an offset are missed; after, seven lobes.
Example example() {
  Example out;
  for (std::size_t i = 0; i < turns * per_turn; ++i) {
    const double c = two_pi * static_cast<double>(i) / per_turn, x = 40.0 + 0.3 * std::cos(c);
    out.measured.c_rad.push_back(c);
    out.measured.reading_mm.push_back(x);
    out.simulated.before_mm.push_back(x - offset_mm - lobes_mm * std::cos(3.0 * c - 0.4));
    out.simulated.after_mm.push_back(x - residual_mm * std::cos(7.0 * c));
  }
  out.masked.assign(out.measured.size(), false);
  return out;
}

constexpr double rounding_mm = 1e-12;  // of sums of 40 mm

TEST(Comparison, RmsAndShareOfHarmonics) {
  const Example e = example();
  const Comparison c = compare(e.measured, e.simulated, e.masked, sigma_mm);
  EXPECT_EQ(c.readings, turns * per_turn);
  EXPECT_EQ(c.masked, 0u);
  // A harmonic has the variance A²/2; the RMS has the offset in it, the variance does not.
  EXPECT_NEAR(c.before.rms_mm, std::hypot(offset_mm, lobes_mm / std::sqrt(2.0)), rounding_mm);
  EXPECT_NEAR(c.after.rms_mm, residual_mm / std::sqrt(2.0), rounding_mm);
  EXPECT_NEAR(c.before.share, 1.0, 1e-12);
  EXPECT_NEAR(c.after.share, 1.0 / 36.0, 1e-9);
  EXPECT_NEAR(c.noise.share, 2.0 * sigma_mm * sigma_mm / (lobes_mm * lobes_mm), 1e-9);
  EXPECT_EQ(c.noise.rms_mm, sigma_mm);
}

TEST(Comparison, LinesOfTheSpectrum) {
  const Example e = example();
  const Comparison c = compare(e.measured, e.simulated, e.masked, sigma_mm);
  ASSERT_GE(c.lines.size(), 3u);
  // FourierSums is good to 1e-9 of the sum of the values.
  constexpr double sums_mm = 2e-9 * lobes_mm;
  EXPECT_EQ(c.lines[0].order, 3.0);
  EXPECT_NEAR(c.lines[0].before_mm, lobes_mm, sums_mm);
  EXPECT_NEAR(c.lines[0].after_mm, 0.0, sums_mm);
  const auto at = [&](double order) {
    for (const SpectrumBin& bin : c.spectrum) {
      if (bin.order == order) return bin;
    }
    return SpectrumBin{};
  };
  EXPECT_NEAR(at(0.0).before_mm, offset_mm, sums_mm);
  EXPECT_NEAR(at(7.0).after_mm, residual_mm, sums_mm);
  EXPECT_NEAR(at(7.0).before_mm, 0.0, sums_mm);
  EXPECT_NEAR(c.spectrum.back().order, 15.0, 1e-12);
  // Half a cell is 1/(2 · 20 turns).
  EXPECT_NEAR(c.spectrum[1].order, 1.0 / 40.0, 1e-12);
}

TEST(Comparison, MaskedReadingsDoNotCount) {
  Example e = example();
  const Comparison whole = compare(e.measured, e.simulated, e.masked, sigma_mm);
  // A whole turn masked and spoilt leaves whole turns: the same numbers.
  for (std::size_t i = 0; i < per_turn; ++i) {
    e.masked[i] = true;
    e.measured.reading_mm[i] += i == 3 ? std::nan("") : 5.0;
  }
  const Comparison c = compare(e.measured, e.simulated, e.masked, sigma_mm);
  EXPECT_EQ(c.masked, per_turn);
  EXPECT_NEAR(c.before.rms_mm, whole.before.rms_mm, rounding_mm);
  EXPECT_NEAR(c.after.share, whole.after.share, 1e-9);
}

TEST(Comparison, NothingMissedHasNoShare) {
  Example e = example();
  e.simulated.before_mm = e.simulated.after_mm = e.measured.reading_mm;
  const Comparison c = compare(e.measured, e.simulated, e.masked, sigma_mm);
  EXPECT_EQ(c.before.rms_mm, 0.0);
  EXPECT_TRUE(std::isnan(c.after.share));
}

/// λ = 0.3 of the way back from lobes, and a harmonic that they do not hold.
TEST(Comparison, WayBackIsWhereTheReadingsLie) {
  for (const double share : {0.0, 0.3, 0.49, 0.51, 1.2}) {
    Example e = example();
    for (std::size_t i = 0; i < e.measured.size(); ++i) {
      const double c = e.measured.c_rad[i], after = e.simulated.after_mm[i];
      e.simulated.before_mm[i] = after - lobes_mm * std::cos(3.0 * c - 0.4);
      e.measured.reading_mm[i] = after + share * (e.simulated.before_mm[i] - after) + offset_mm +
                                 residual_mm * std::sin(11.0 * c);
    }
    const Comparison c = compare(e.measured, e.simulated, e.masked, sigma_mm);
    EXPECT_NEAR(c.j_test_lambda.value, share, 1e-9);
    EXPECT_EQ(c.after.share > 1.0, share > 0.5);
    // Least squares of one factor of a harmonic: σ/√(n A²/2).
    EXPECT_NEAR(c.j_test_lambda.u, sigma_mm / (lobes_mm * std::sqrt(turns * per_turn / 2.0)), 1e-9);
  }
}

/// AR(1) correlates readings i and j by φ^|i − j|: the sum over all pairs that count.
TEST(Comparison, WayBackKnowsCorrelatedNoise) {
  Example e = example();
  for (const std::size_t i : {0, 5, 6, 7, 333, 799}) e.masked[i] = true;
  std::vector<double> way;
  double mean = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < e.masked.size(); ++i) {
    way.push_back(e.simulated.before_mm[i] - e.simulated.after_mm[i]);
    if (!e.masked[i]) mean += way[i] / (turns * per_turn - 6.0);
  }
  for (std::size_t i = 0; i < way.size(); ++i) {
    way[i] = e.masked[i] ? 0.0 : way[i] - mean;
    squares += way[i] * way[i];
  }
  for (const double phi : {-0.5, 0.9}) {
    double pairs = 0.0;
    for (std::size_t i = 0; i < way.size(); ++i) {
      for (std::size_t j = 0; j < way.size(); ++j)
        pairs += way[i] * way[j] * std::pow(phi, i > j ? i - j : j - i);
    }
    const double u = sigma_mm * std::sqrt(pairs) / squares;
    EXPECT_NEAR(compare(e.measured, e.simulated, e.masked, sigma_mm, {phi}).j_test_lambda.u, u,
                1e-9 * u)
        << phi;
  }
}

TEST(Comparison, TwoSimulationsAlikeHaveNoWayBack) {
  Example e = example();
  e.simulated.before_mm = e.simulated.after_mm;
  const Comparison c = compare(e.measured, e.simulated, e.masked, sigma_mm);
  EXPECT_FALSE(c.j_test_lambda.determined());
  EXPECT_FALSE(c.j_test_lambda.why_not.empty());
}

TEST(Comparison, LessThanHalfATurnHasNoSpectrum) {
  Example e = example();
  for (std::size_t i = per_turn / 3; i < e.masked.size(); ++i) e.masked[i] = true;
  const Comparison c = compare(e.measured, e.simulated, e.masked, sigma_mm);
  EXPECT_TRUE(c.spectrum.empty());
  EXPECT_TRUE(c.lines.empty());
  EXPECT_GT(c.before.rms_mm, 0.0);
}

TEST(Comparison, NeedsAValueForEveryReading) {
  Example e = example();
  e.simulated.after_mm.pop_back();
  EXPECT_THROW(compare(e.measured, e.simulated, e.masked, sigma_mm), ContractViolation);
  e = example();
  e.masked.pop_back();
  EXPECT_THROW(compare(e.measured, e.simulated, e.masked, sigma_mm), ContractViolation);
}

/// A text on one line: it is wrapped at blanks.
std::string unwrapped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool blank = c == ' ' || c == '\n';
    if (!blank)
      out += c;
    else if (!out.empty() && out.back() != ' ')
      out += ' ';
  }
  return out;
}

TEST(ComparisonText, OneLineSaysWhatIsLeft) {
  Resimulation again;
  again.comparison.before = {0.004, 1.0};
  again.comparison.after = {0.002, 0.25};
  again.comparison.noise = {0.0019, 0.225};
  EXPECT_EQ(
      unwrapped(resimulation_line(again)),
      "simulated measured − simulated 4 → 2 µm RMS; 25 % of the variance remains, noise alone "
      "leaves 22.5 % ");
  again.comparison.noise = {0.03, 56.25};
  EXPECT_NE(unwrapped(resimulation_line(again)).find("noise alone could make all of it"),
            std::string::npos);
  again.why_not = "it has no place";
  EXPECT_EQ(unwrapped(resimulation_line(again)), "simulated not again: it has no place ");
}

}  // namespace
}  // namespace trueaxis
