// SPDX-License-Identifier: Apache-2.0
// Law: moving, turning, scaling or reordering the readings moves, turns, scales the result or
// leaves it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <map>

#include "laws/law_case.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::laws {
namespace {

using Parameters = std::map<std::string, Estimate>;

Parameters by_name(const FitResult& result) {
  Parameters out;
  for (const FitParameter& p : result.parameters) out[p.name] = p.estimate;
  return out;
}

class FrameLaw : public ::testing::TestWithParam<std::string> {
 protected:
  struct Example {
    LawCase c;
    ProbeStream stream;
    FitResult result;
    Parameters base;
  };

  /// Runs `body` on noisy streams of well-determined parts: a minimum to move, not an exact root.
  void for_examples(const std::function<void(Example&)>& body) {
    constexpr std::uint64_t seed = 20281;
    Draw draw(seed);
    int used = 0;
    for (int i = 0; i < 40; ++i) {
      Example example;
      example.c = draw_case(GetParam(), draw,
                            {.eccentricity = 0.8,
                             .least_half_angle_deg = 3.0,
                             .largest_half_angle_deg = 60.0,
                             .tilt_rad = 0.02,
                             .length_min_mm = 20.0,
                             .readings_min = 200.0});
      example.c.noise_mm = 0.005, example.c.seed = static_cast<std::uint64_t>(i) + 1;
      SCOPED_TRACE(::testing::Message() << "seed " << seed << ' ' << to_literal(example.c));
      example.stream = probe(example.c);
      example.result = fit(example.stream, options_of(example.c));
      ASSERT_NE(example.result.status, FitStatus::max_iterations);
      if (example.result.status != FitStatus::converged)
        continue;  // its reason is tested elsewhere
      example.base = by_name(example.result);
      body(example);
      ++used;
    }
    EXPECT_GE(used, 30);
  }

  /// Same minimum: the rest of the last step is below 1e-5 of u (the minimiser's tolerance);
  /// `reading_mm` is what rounding of the transformed readings is worth.
  void expect(const Example& example, const FitResult& result,
              const std::map<std::string, double>& wanted, double reading_mm = 0.0) {
    ASSERT_EQ(result.status, FitStatus::converged) << result.message;
    const Parameters got = by_name(result);
    const double norm = std::sqrt(static_cast<double>(result.points)) *
                        (reading_mm + 1e-15 * rounding_size_mm(example.c));
    for (const auto& [name, value] : wanted) {
      const double u = got.at(name).u;
      EXPECT_NEAR(got.at(name).value, value, 1e-5 * u + norm * u / result.sigma_mm) << name;
    }
  }

  std::map<std::string, double> values(const Parameters& base) {
    std::map<std::string, double> out;
    for (const auto& [name, estimate] : base) out[name] = estimate.value;
    return out;
  }
};

TEST_P(FrameLaw, PeriodicInC) {
  for_examples([&](Example& e) {
    for (const int k : {1, -3, 1000}) {
      ProbeStream turned = e.stream;
      for (double& c : turned.c_rad) c += two_pi * k;
      const double reach = std::abs(turned.c_rad.back()) + std::abs(turned.c_rad.front());
      expect(e, fit(turned, options_of(e.c)), values(e.base),
             1e-16 * reach * rounding_size_mm(e.c));
    }
  });
}

TEST_P(FrameLaw, PartTurnedAgainstTheSpindle) {
  for_examples([&](Example& e) {
    const double angle = 1.234;
    ProbeStream turned = e.stream;
    for (double& c : turned.c_rad) c += angle;
    auto wanted = values(e.base);
    for (const auto& [x, y] : {std::pair{"x0", "y0"}, std::pair{"l", "m"}}) {
      if (!wanted.contains(x)) continue;
      const auto v = std::polar(1.0, angle) * std::complex(wanted[x], wanted[y]);
      wanted[x] = v.real(), wanted[y] = v.imag();
    }
    expect(e, fit(turned, options_of(e.c)), wanted, 1e-14 * rounding_size_mm(e.c));
  });
}

TEST_P(FrameLaw, DatumAlongTheSpindleShifted) {
  for_examples([&](Example& e) {
    const double shift = 77.25;
    ProbeStream moved = e.stream;
    auto wanted = values(e.base);
    if (GetParam() == "plane") {
      for (double& z : moved.reading_mm) z += shift;
      wanted["d"] += shift * std::sqrt(1.0 - std::pow(wanted["l"], 2) - std::pow(wanted["m"], 2));
    } else {
      for (double& z : moved.position_mm) z += shift;
      if (wanted.contains("l")) {
        const double n = std::sqrt(1.0 - std::pow(wanted["l"], 2) - std::pow(wanted["m"], 2));
        wanted["x0"] -= wanted["l"] / n * shift, wanted["y0"] -= wanted["m"] / n * shift;
        if (wanted.contains("k")) wanted["k"] += shift / n;
      }
    }
    expect(e, fit(moved, options_of(e.c)), wanted, 1e-15 * 5.0 * (500.0 + shift));
  });
}

TEST_P(FrameLaw, Scaled) {
  for_examples([&](Example& e) {
    const double factor = 25.4;
    ProbeStream scaled = e.stream;
    for (double& x : scaled.reading_mm) x *= factor;
    for (double& z : scaled.position_mm) z *= factor;
    FitOptions options = options_of(e.c);
    options.ball_radius_mm *= factor;
    scaled.ball_radius_mm.reset();
    auto wanted = values(e.base);
    for (const char* length : {"x0", "y0", "k", "radius", "d"}) {
      if (wanted.contains(length)) wanted[length] *= factor;
    }
    const FitResult result = fit(scaled, options);
    expect(e, result, wanted, 1e-15 * factor * rounding_size_mm(e.c));
    EXPECT_NEAR(result.rms_mm, factor * e.result.rms_mm, 1e-9 * result.rms_mm);
  });
}

TEST_P(FrameLaw, OrderOfReadingsDoesNotMatter) {
  for_examples([&](Example& e) {
    ProbeStream reversed = e.stream;
    for (auto* column : {&reversed.reading_mm, &reversed.c_rad, &reversed.position_mm})
      std::ranges::reverse(*column);
    const FitResult result = fit(reversed, options_of(e.c));
    expect(e, result, values(e.base));
    for (const auto& [name, estimate] : e.base)
      EXPECT_NEAR(by_name(result).at(name).u, estimate.u, 1e-6 * estimate.u) << name;
  });
}

TEST_P(FrameLaw, EveryReadingTwice) {
  for_examples([&](Example& e) {
    ProbeStream twice = e.stream;
    for (auto* column : {&twice.reading_mm, &twice.c_rad, &twice.position_mm}) {
      const std::vector<double> once = *column;
      column->insert(column->end(), once.begin(), once.end());
    }
    twice.time_s.clear();
    for (auto* column : {&twice.pass, &twice.setup}) {
      const auto once = *column;
      column->insert(column->end(), once.begin(), once.end());
    }
    const FitResult result = fit(twice, options_of(e.c));
    expect(e, result, values(e.base));
    // σ² = S/(N − p) and (JᵀJ)⁻¹ halves.
    const auto n = static_cast<double>(e.stream.size());
    const auto p = static_cast<double>(e.base.size());
    const double shrink = std::sqrt((n - p) / (2.0 * n - p));
    for (const auto& [name, estimate] : e.base) {
      EXPECT_NEAR(by_name(result).at(name).u / (result.u_factor * result.widened),
                  shrink * estimate.u / (e.result.u_factor * e.result.widened), 1e-6 * estimate.u)
          << name;
    }
  });
}

TEST_P(FrameLaw, SameBitsTwice) {
  for_examples([&](Example& e) {
    const FitResult again = fit(e.stream, options_of(e.c));
    for (const auto& [name, estimate] : e.base) {
      EXPECT_EQ(by_name(again).at(name).value, estimate.value) << name;
      EXPECT_EQ(by_name(again).at(name).u, estimate.u) << name;
    }
    EXPECT_EQ(again.residual_mm, e.result.residual_mm);
    EXPECT_EQ(again.covariance, e.result.covariance);
  });
}

INSTANTIATE_TEST_SUITE_P(Catalogue, FrameLaw, ::testing::ValuesIn(catalogue_ids()), name_of);

}  // namespace
}  // namespace trueaxis::laws
