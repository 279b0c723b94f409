// SPDX-License-Identifier: Apache-2.0
// Law: derivatives in closed form are the differences of what they are derivatives of.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "laws/law_case.hpp"
#include "model/normal_matrix.hpp"

namespace trueaxis::laws {
namespace {

using Function = std::function<std::vector<double>(std::span<const double>)>;

/// Five-point differences of f along parameter i.
std::vector<double> difference(const Function& f, std::vector<double> at, std::size_t i,
                               double step) {
  const double middle = at[i];
  const auto moved = [&](double steps) {
    at[i] = middle + steps * step;
    return f(at);
  };
  const auto f1 = moved(1), b1 = moved(-1), f2 = moved(2), b2 = moved(-2);
  std::vector<double> slope;
  for (std::size_t k = 0; k < f1.size(); ++k)
    slope.push_back((8.0 * (f1[k] - b1[k]) - (f2[k] - b2[k])) / (12.0 * step));
  return slope;
}

/// Grazing lines bend predictions: e ≤ 0.8 R keeps the fifth derivative below 1e5 of its scale.
LawCase random_case(const std::string& id, Draw& draw) {
  LawCase c = draw_case(
      id, draw,
      {.eccentricity = 0.8, .least_half_angle_deg = 0.01, .tilt_rad = 0.1, .readings_max = 60.0});
  c.relative = id != "plane" && draw.chance(0.3);
  return c;
}

/// A step of working parameter `a` that moves the surface by 3e-4 of its smallest radius at most.
double step_of(const LawCase& c, double scale_mm) {
  const double half = 0.5 * std::abs(c.end_mm - c.start_mm);
  if (c.surface == "plane") return 1e-2;  // linear: no truncation
  const double tangent = c.surface == "cone" ? std::abs(std::tan(c.half_angle_rad())) : 0.0;
  const double smallest = c.radius_mm - tangent * half;
  return 3e-4 * smallest / (scale_mm == 1.0 ? 1.0 : (1.0 + tangent) * std::max(scale_mm, half));
}

class JacobianLaw : public ::testing::TestWithParam<std::string> {};

TEST_P(JacobianLaw, PredictionAgainstDifferencesOfResiduals) {
  constexpr std::uint64_t seed = 20251;
  Draw draw(seed);
  for (int i = 0; i < 150; ++i) {
    const LawCase c = random_case(GetParam(), draw);
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ' ' << to_literal(c));
    const ProbeStream stream = probe(c);
    const PreparedStream prepared(stream);
    const auto surface = make_surface(surface_from_id(GetParam()), frame_of(c));
    const std::vector<double> working = working_of(c);
    const std::size_t p = surface->parameter_count(), columns = surface->column_count();
    ASSERT_EQ(working.size(), p);

    const Function residual = [&](std::span<const double> at) {
      std::vector<double> out(stream.size());
      EXPECT_TRUE(residuals(*surface, at, prepared, out));
      return out;
    };
    std::vector<double> transform(p * columns);
    surface->transform(working, transform.data());
    const std::vector<double> scale = surface->working_scale_mm(working);
    for (std::size_t a = 0; a < p; ++a) {
      const double step = step_of(c, scale[a]);
      const std::vector<double> slope = difference(residual, working, a, step);
      PredictionBlock block;
      for (std::size_t b = 0; b < prepared.blocks(); ++b) {
        surface->evaluate(working, prepared.block(b), block);
        for (std::size_t k = 0; k < prepared.filled(b); ++k) {
          double closed = 0.0;
          for (std::size_t j = 0; j < columns; ++j)
            closed += transform[a * columns + j] * block.column[j][k];
          // Truncation (3e-4)⁴ · 1e5 at e = 0.8 R; rounding of two predictions over the step.
          const double tolerance =
              1e-8 * (scale[a] + std::abs(closed)) + 4e-15 * rounding_size_mm(c) / step;
          ASSERT_NEAR(slope[b * block_size + k], -closed, tolerance)
              << surface->working_names()[a] << " at reading " << b * block_size + k;
        }
      }
    }
  }
}

TEST_P(JacobianLaw, ReportedParametersAndAxisAgainstDifferences) {
  constexpr std::uint64_t seed = 20252;
  Draw draw(seed);
  for (int i = 0; i < 300; ++i) {
    const LawCase c = random_case(GetParam(), draw);
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ' ' << to_literal(c));
    const auto surface = make_surface(surface_from_id(GetParam()), frame_of(c));
    const std::vector<double> working = working_of(c);
    const std::size_t p = working.size();
    const Surface::Reported reported = surface->report(working);
    const std::vector<double> axis_jacobian = surface->axis_jacobian(working);
    const Function values = [&](std::span<const double> at) { return surface->report(at).value; };
    const Function axis = [&](std::span<const double> at) {
      const Axis a = surface->axis(at);
      return std::vector<double>{a.x_mm, a.y_mm, a.slope_x, a.slope_y};
    };
    for (std::size_t a = 0; a < p; ++a) {
      // Relative step 1e-3 of what the functions are smooth in: 1 for slopes, |tan| for k = R/tan.
      const double scale = surface->working_names()[a] == "tan_half_angle"    ? std::abs(working[a])
                           : surface->working_names()[a].starts_with("slope") ? 0.1
                                                                              : 1.0;
      const double step = 1e-3 * scale;
      const auto check = [&](const std::vector<double>& slope, const std::vector<double>& at,
                             const std::vector<double>& jacobian, const char* what) {
        for (std::size_t j = 0; j < slope.size(); ++j) {
          // Truncation 4 (1e-3)⁴ of 1/tan and less of the others; rounding of the values and of
          // the terms of k = z/n − R/tan, which cancel.
          const double tolerance = 1e-11 * (1.0 + std::abs(slope[j])) +
                                   1e-15 * (std::abs(at[j]) + std::abs(c.middle_mm())) / step;
          EXPECT_NEAR(jacobian[j * p + a], slope[j], tolerance)
              << what << ' ' << j << " by " << surface->working_names()[a];
        }
      };
      check(difference(values, working, a, step), reported.value, reported.jacobian, "parameter");
      check(difference(axis, working, a, step), axis(working), axis_jacobian, "axis");
    }
  }
}

TEST_P(JacobianLaw, InfluencesAgainstDifferences) {
  constexpr std::uint64_t seed = 20253;
  Draw draw(seed);
  for (int i = 0; i < 100; ++i) {
    LawCase c = random_case(GetParam(), draw);
    c.relative = false;
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ' ' << to_literal(c));
    const auto surface = make_surface(surface_from_id(GetParam()), frame_of(c));
    const double c_rad = draw.uniform(-4.0, 4.0);
    const double position = draw.uniform(c.start_mm, c.end_mm);
    const auto at = surface->influences(working_of(c), c_rad, position);
    // The virtual lathe, probed at one place, with one thing moved.
    const auto reading = [&](double dc, double dz, double height_mm) {
      return single_reading(c, c_rad + dc, position + dz, height_mm);
    };
    const auto slope = [&](auto f, double step) {
      return (8.0 * (f(step) - f(-step)) - (f(2.0 * step) - f(-2.0 * step))) / (12.0 * step);
    };
    const double size = rounding_size_mm(c), step = 1e-4 * std::min(1.0, c.radius_mm);
    const double tolerance = 1e-8 * size + 1e-14 * size / step;
    EXPECT_NEAR(at.c, slope([&](double d) { return reading(d, 0, 0); }, 1e-4), tolerance);
    if (GetParam() != "section") {
      EXPECT_NEAR(at.position, slope([&](double d) { return reading(0, d, 0); }, step), tolerance);
    }
    EXPECT_NEAR(at.height, slope([&](double d) { return reading(0, 0, d); }, step), tolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, JacobianLaw, ::testing::ValuesIn(catalogue_ids()), name_of);

}  // namespace
}  // namespace trueaxis::laws
