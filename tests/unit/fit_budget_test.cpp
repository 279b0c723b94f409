// SPDX-License-Identifier: Apache-2.0
// Lines of an uncertainty budget, against fits of readings that have what each is about.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "fit/associate.hpp"
#include "fit/describe.hpp"
#include "fit/joint_model.hpp"
#include "fit/place_set_ups.hpp"
#include "fit/probe_height.hpp"
#include "fit/uncertainty.hpp"
#include "math/statistics.hpp"
#include "trueaxis/fit.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::fit_budget_test {
namespace {

using Kind = Influence::Kind;

/// What a lathe does to the readings of a cone.
struct Lathe {
  double gain = 0.0, c_rad = 0.0, z_mm = 0.0, height_mm = 0.0;
};

/// Readings of a cone that leans and runs out, over 50 mm; half of them after it was clamped anew.
ProbeStream cone(const Lathe& lathe, bool twice = false) {
  ProbeStream stream;
  constexpr int count = 720;
  for (int i = 0; i < count; ++i) {
    const bool second = twice && 2 * i >= count;
    const Revolved surface{
        second ? Axis{-0.3, 0.7, -1e-3, 2e-3, 20.0} : Axis{0.8, -0.5, 2e-3, 3e-3, 20.0}, 25.0,
        0.12};
    const double c = 0.4 + two_pi * i / 37.3, z = 50.0 * i / count;
    stream.c_rad.push_back(c + lathe.c_rad);
    stream.position_mm.push_back(z + lathe.z_mm);
    stream.reading_mm.push_back(intersect(surface, c, z, lathe.height_mm).x_mm);
    if (twice) stream.setup.push_back(second ? 2 : 1);
  }
  if (twice) stream.setups = {{.number = 1}, {.number = 2, .clamp_force_ratio = 1.5}};
  double mean = 0.0;
  for (const double x : stream.reading_mm) mean += x / count;
  for (double& x : stream.reading_mm) x += lathe.gain * (x - mean);
  return stream;
}

std::vector<double> values(const FitResult& fit) {
  std::vector<double> out;
  for (const FitParameter& one : fit.parameters) out.push_back(one.estimate.value);
  return out;
}

/// What a fit says that an influence of this u contributes to each parameter.
std::vector<double> contributions(const ProbeStream& stream, const Influence& influence) {
  FitOptions options;
  options.influences = {influence, {Kind::probe_delay, 1.0}};  // the other is not of a fit
  const FitResult found = fit(stream, options);
  EXPECT_EQ(found.status, FitStatus::converged) << found.message;
  // A height has a line of its square next.
  EXPECT_EQ(found.budget.size(), influence.kind == Kind::probe_height ? 3U : 2U);
  EXPECT_EQ(found.budget[1].source, info_of(influence.kind).name);
  EXPECT_EQ(found.budget[1].type, 'B');
  return found.budget[1].u;
}

// A probe that is h off reads √(R² − h²) of a circle about the spindle. The u of a height of 0 is
// h here, so the radius is off by 1/√3 of its u, to the next order h²/4R².
TEST(FitBudget, AHeightMakesTheRadiusSmaller) {
  constexpr double radius_mm = 8.0, height_mm = 0.2;
  ProbeStream stream;
  for (int i = 0; i < 400; ++i) {
    stream.c_rad.push_back(two_pi * i / 37.3);
    stream.position_mm.push_back(0.05 * i);
    stream.reading_mm.push_back(std::sqrt(radius_mm * radius_mm - height_mm * height_mm));
  }
  FitOptions options;
  options.surface = SurfaceKind::cylinder;
  EXPECT_TRUE(holds_on_centre_height(fit(stream, options)));
  options.influences = {{Kind::probe_height, height_mm}};
  const FitResult found = fit(stream, options);
  EXPECT_FALSE(holds_on_centre_height(found));
  const Estimate& radius = found.parameter("radius");
  const double off = (radius_mm - radius.value) / radius.u;
  EXPECT_NEAR(off, 1.0 / std::sqrt(3.0), 2.0 * std::pow(height_mm / radius_mm, 2));
}

// Two clampings that lean otherwise and share radius and taper: there and back, to rounding.
TEST(FitStart, PartsOfAModelJoinToThatModel) {
  const ProbeStream stream = cone({}, true);
  const JointModel model(stream, place_set_ups(stream), catalogue_entry(SurfaceKind::cone), {});
  const std::vector<double> joint{0.8, -0.5, 0.2, 0.3, -0.3, 0.7, -0.1, 0.25, 25.0, 0.12};
  ASSERT_EQ(model.parameter_count(), joint.size());
  std::vector<std::vector<double>> of_parts;
  for (const JointPart& part : model.parts()) of_parts.push_back(model.working(joint, part));
  const std::vector<double> back = model.joined(of_parts);
  for (std::size_t j = 0; j < joint.size(); ++j) EXPECT_NEAR(back[j], joint[j], 1e-13) << j;
}

// The influence is small enough for second orders to be below 1e-3 of the first. At its height the
// probe sees the derivative there.
TEST(FitBudget, AnInfluenceContributesWhatItDoesToAFit) {
  constexpr double u = 1e-4, height_mm = 1.5;
  for (const bool twice : {false, true}) {
    const ProbeStream stream = cone({}, twice);
    const std::vector<double> as_it_is = values(fit(stream, {}));
    const auto expect_moved = [&](const Influence& influence, const ProbeStream& other,
                                  const FitOptions& options = {}) {
      const std::vector<double> found = contributions(stream, influence);
      const std::vector<double> moved = values(fit(other, options));
      for (std::size_t i = 0; i < moved.size(); ++i) {
        const double expected = std::abs(moved[i] - as_it_is[i]);
        EXPECT_NEAR(found[i], expected, 2e-3 * expected + 1e-9)
            << info_of(influence.kind).name << ", parameter " << i << (twice ? ", twice" : "");
      }
    };
    if (!twice) expect_moved({Kind::probe_gain, u}, cone({.gain = u}));
    expect_moved({Kind::c_offset, u}, cone({.c_rad = u}, twice));
    expect_moved({Kind::z_offset, u}, cone({.z_mm = u}, twice));
    ProbeStream higher = stream;
    const ProbeStream at = cone({.height_mm = height_mm}, twice);
    const ProbeStream above = cone({.height_mm = height_mm + u}, twice);
    for (std::size_t i = 0; i < higher.size(); ++i)
      higher.reading_mm[i] += above.reading_mm[i] - at.reading_mm[i];
    expect_moved({Kind::probe_height, u, height_mm}, higher);
    FitOptions ball;
    ball.ball_radius_mm = u;
    expect_moved({Kind::ball_radius, u}, stream, ball);
  }
}

// Eq. 33 (Huber 1981, section 7.6): k² Σψ²/(N − p) over the square of the mean of ψ′, k = 1 + p/N
// var ψ′/(mean ψ′)², times (JᵀJ)⁻¹, which the plain fit shows next to its own σ². At both minima it
// is the same to a few u of the slopes.
TEST(FitBudget, ARobustLossHasTheUOfEquation33) {
  ProbeStream stream = cone({});
  std::mt19937_64 random(51);
  std::normal_distribution<double> normal(0.0, 2e-3);
  for (std::size_t i = 0; i < stream.size(); ++i)
    stream.reading_mm[i] += normal(random) * (i % 9 == 0 ? 6.0 : 1.0);
  const FitResult plain = fit(stream, {});
  const double n = static_cast<double>(stream.size()), p = 6.0;
  for (const Loss loss : {Loss::huber, Loss::tukey}) {
    FitOptions options;
    options.loss = loss;
    const FitResult robust = fit(stream, options);
    ASSERT_EQ(robust.status, FitStatus::converged);
    EXPECT_EQ(robust.sigma_source, SigmaSource::robust_residuals);
    const double c = (loss == Loss::huber ? 1.345 : 4.685) * robust.sigma_mm;
    double squares = 0.0, mean = 0.0, mean2 = 0.0;
    for (const double r : robust.residual_mm) {
      const double v = r / c, w = std::abs(v) < 1.0 ? 1.0 - v * v : 0.0;
      const double psi = loss == Loss::tukey ? r * w * w : std::clamp(r, -c, c);
      const double slope =
          loss == Loss::tukey ? w * (1.0 - 5.0 * v * v) : (std::abs(v) <= 1.0 ? 1.0 : 0.0);
      squares += psi * psi, mean += slope / n, mean2 += slope * slope / n;
    }
    const double k = 1.0 + p / n * (mean2 - mean * mean) / (mean * mean);
    const double sigma = k * std::sqrt(squares / (n - p)) / mean;
    for (std::size_t i = 0; i < robust.parameters.size(); ++i) {
      const double per_sigma = plain.parameters[i].estimate.u / plain.sigma_mm;
      EXPECT_NEAR(robust.parameters[i].estimate.u, sigma * per_sigma, 2e-3 * sigma * per_sigma);
    }
  }
}

// By more than 3, either way, if five degrees of freedom show it.
TEST(FitBudget, AStatedNoiseIsDoubtedBeyondAFactorOfThree) {
  EXPECT_TRUE(noise_disagrees(0.5, 1.51, 5.0));
  EXPECT_FALSE(noise_disagrees(0.5, 1.49, 500.0));
  EXPECT_TRUE(noise_disagrees(0.5, 0.166, 7.0));
  EXPECT_FALSE(noise_disagrees(0.5, 0.168, 500.0));
  EXPECT_FALSE(noise_disagrees(0.5, 9.0, 4.9));
  EXPECT_FALSE(noise_disagrees(0.0, 9.0, 500.0)) << "none is stated";
}

// In mm on the surface, its largest part positive; it does not name parts below a twentieth.
TEST(FitBudget, ADirectionHasItsNames) {
  const std::vector<std::string> names{"x", "slope", "radius", "y"};
  const std::vector<double> scale_mm{1.0, 10.0, 1.0, 1.0};
  const auto named = [&](const Eigen::Vector4d& sizes_mm) {
    return name_direction(sizes_mm.cwiseProduct(Eigen::Vector4d(1.0, 0.1, 1.0, 1.0)), names,
                          scale_mm);
  };
  EXPECT_EQ(named({3.0, -4.0, 0.0, 0.0}), "-0.60 x + 0.80 slope");
  EXPECT_EQ(named({0.0, 4.0, -3.0, 0.0}), "0.80 slope - 0.60 radius");
  EXPECT_EQ(named({0.04, 1.0, 0.0, 0.06}), "1.00 slope + 0.06 y");
  EXPECT_EQ(named({-0.06, 1.0, 0.0, 0.04}), "-0.06 x + 1.00 slope");
}

/// u of the length of a plane vector: along it, or in the worse direction within that u.
double u_of_length(const Eigen::Vector2d& v, const Eigen::Matrix2d& covariance) {
  const double worst = std::sqrt(covariance.eigenvalues().real().maxCoeff());
  return v.norm() > worst ? std::sqrt(v.dot(covariance * v)) / v.norm() : worst;
}

// Off the spindle axis, and on it, where no direction is better known than another.
TEST(FitDerived, OffsetsAndTiltAreThoseOfTheAxis) {
  ProbeStream centred = cone({});
  for (std::size_t i = 0; i < centred.size(); ++i)
    centred.reading_mm[i] = 25.0 + 0.12 * (centred.position_mm[i] - 20.0);
  FitOptions options;
  options.noise_mm = 2e-3;
  ProbeStream round = centred;  // a cylinder
  for (double& x : round.reading_mm) x = 25.0;
  for (const ProbeStream& stream : {cone({}), centred, round}) {
    if (stream.reading_mm == round.reading_mm) options.surface = SurfaceKind::cylinder;
    const FitResult found = fit(stream, options);
    ASSERT_EQ(found.status, FitStatus::converged) << found.message;
    const Axis& axis = found.axis.axis;
    const Eigen::Matrix4d covariance =
        Eigen::Map<const Eigen::Matrix4d>(found.axis.covariance.data());
    for (const auto& [name, z] : {std::pair{"offset_at_min_z", found.position_min_mm},
                                  {"offset_at_max_z", found.position_max_mm}}) {
      Eigen::Matrix<double, 2, 4> at;
      at << Eigen::Matrix2d::Identity(), (z - axis.z_ref_mm) * Eigen::Matrix2d::Identity();
      const auto [x, y] = axis.at(z);
      const Estimate& offset = found.parameter(name);
      EXPECT_NEAR(offset.value, std::hypot(x, y), 1e-15);
      EXPECT_NEAR(offset.u, u_of_length({x, y}, at * covariance * at.transpose()), 1e-9 * offset.u);
    }
    const Eigen::Vector2d slope(axis.slope_x, axis.slope_y);
    EXPECT_NEAR(found.parameter("tilt").value, std::atan(slope.norm()), 1e-15);
    EXPECT_NEAR(found.parameter("tilt").u, u_of_length(slope, covariance.bottomRightCorner<2, 2>()),
                1e-12);
    const bool is_cone = options.surface == SurfaceKind::cone;
    EXPECT_EQ(found.derived.size(), is_cone ? 4U : 3U);
    const std::string first = found.derived.front().name;
    EXPECT_EQ(first, is_cone ? "radius_mid" : "offset_at_min_z");
    if (is_cone) {
      EXPECT_EQ(found.parameter("radius_mid").value, found.shape.radius_mm);
    }
  }
  options.surface = SurfaceKind::section;
  const FitResult section = fit(round, options);
  ASSERT_EQ(section.derived.size(), 1U) << "no direction";
  EXPECT_EQ(section.derived.front().name, "eccentricity");
}

TEST(FitDerived, TheRmsOfATukeyLossIsOfWhatItKeeps) {
  ProbeStream stream = cone({});
  std::mt19937_64 random(52);
  std::normal_distribution<double> normal(0.0, 2e-3);
  for (std::size_t i = 0; i < stream.size(); ++i)
    stream.reading_mm[i] += i % 90 == 7 ? 0.3 : normal(random);
  for (const Loss loss : {Loss::plain, Loss::huber, Loss::tukey}) {
    FitOptions options;
    options.loss = loss;
    const FitResult found = fit(stream, options);
    std::vector<double> kept = found.residual_mm;
    if (loss == Loss::tukey) {
      ASSERT_GE(found.rejected.size(), 8U);
      for (const Rejected& one : found.rejected) kept[one.row - 1] = 0.0;
    }
    double squares = 0.0;
    for (const double r : kept) squares += r * r;
    const double count = static_cast<double>(
        kept.size() - (loss == Loss::tukey ? found.rejected.size() : std::size_t{0}));
    EXPECT_NEAR(found.rms_mm, std::sqrt(squares / count), 1e-12);
    const bool listed =
        std::ranges::find(found.rejected, 8U, &Rejected::row) != found.rejected.end();
    EXPECT_EQ(listed, loss != Loss::plain);
  }
}

// The ball's centre runs on 22 to 28 mm: a ball of 24 mm leaves a radius below 0 at one end, here
// the first; of a cylinder at both.
TEST(FitDerived, ABallThatIsTooLargeIsRefusedWhereItIs) {
  FitOptions options;
  options.ball_radius_mm = 24.0;
  const FitResult found = fit(cone({}), options);
  EXPECT_EQ(found.status, FitStatus::implausible);
  EXPECT_NE(found.message.find("at Z = 0 mm, which is impossible"), std::string::npos)
      << found.message;
  ProbeStream other = cone({});
  for (double& z : other.position_mm) z = 50.0 - z;
  const FitResult turned = fit(other, options);
  EXPECT_EQ(turned.status, FitStatus::implausible);
  EXPECT_NE(turned.message.find("at Z = 50 mm, which is impossible"), std::string::npos)
      << turned.message;
  options.ball_radius_mm = 20.0;
  EXPECT_EQ(fit(cone({}), options).status, FitStatus::converged);
  EXPECT_TRUE(fit(cone({}), options).notes.empty());
}

/// Two parameters, the second a slope at 25 mm, of which JᵀJ by mm is 1 and `value`.
Determination determined(double value, const ReadingNoise& noise) {
  const NormalMatrix normal{.parameters = 2, .jtj = {1.0, 0.0, 0.0, 625.0 * value}, .jtr = {0, 0}};
  return determine(normal, {1.0, 25.0}, 25.0, noise, 2.0);
}

// Two u of 1 µm are a tenth of 25 mm at a value of (2e-3 / 2.5)². What widens u widens it there.
TEST(FitUncertainty, ADirectionIsFreeFromATenthOfTheSize) {
  const auto begins_at = [](double limit, const ReadingNoise& noise) {
    const Determination more = determined(1.04 * limit, noise);
    EXPECT_EQ(more.free_directions.cols(), 0);
    EXPECT_NEAR(more.inverse(0, 0), 1.0, 1e-12);
    EXPECT_NEAR(more.inverse(1, 1) * 625.0 * 1.04 * limit, 1.0, 1e-9);
    const Determination less = determined(0.96 * limit, noise);
    EXPECT_EQ(less.inverse(1, 1), 0.0);
    return less.free_directions.cols() == 1 && less.free_directions(0, 0) == 0.0;
  };
  ReadingNoise noise;
  noise.sigma_mm = 1e-3;
  const double limit = 6.4e-7;
  EXPECT_TRUE(begins_at(limit, noise));
  noise.u_factor = 3.0;
  EXPECT_TRUE(begins_at(9.0 * limit, noise));
  for (const double sigma_mm : {0.0, std::nan("")}) {  // JᵀJ is singular to rounding
    noise.sigma_mm = sigma_mm;
    EXPECT_TRUE(begins_at(1e-14, noise));
  }
  for (const double value : {3.0, 5.0}) {  // JᵀCJ is 4 limits
    noise.sigma_mm = 1e-3, noise.correlated.emplace();
    noise.correlated->jtcj = Eigen::Vector2d(1.0, 625.0 * 4.0 * limit).asDiagonal();
    EXPECT_EQ(determined(std::sqrt(value) * limit, noise).free_directions.cols(),
              value < 4.0 ? 1 : 0);
  }
}

// Correlation takes the trace of (JᵀJ)⁻¹ JᵀCJ of the freedom in the place of the parameters, but
// leaves a tenth of it; the u of the first parameter is twice that of white noise.
TEST(FitUncertainty, OfCorrelatedNoiseTakesFreedom) {
  Determination two;
  two.inverse = Eigen::Vector2d(0.5, 0.25).asDiagonal();
  for (const auto& [redundancy, left] : {std::pair{10.0, 10.0 + 2.0 - 4.5}, {2.6, 0.26}}) {
    ReadingNoise noise;
    noise.sigma_mm = noise.shown_mm = 1e-3, noise.redundancy = redundancy;
    noise.source = SigmaSource::residuals;
    noise.correlated.emplace();
    noise.correlated->jtcj = Eigen::Vector2d(8.0, 2.0).asDiagonal();
    ReadingNoise stated = noise;
    stated.source = SigmaSource::sensor;
    stated.stated_mm = 1e-3;
    take_in(two, 2.0, noise), take_in(two, 2.0, stated);
    EXPECT_NEAR(noise.sigma_mm, 1e-3 * std::sqrt(redundancy / left), 1e-15);
    EXPECT_EQ(noise.shown_mm, noise.sigma_mm);
    EXPECT_EQ(stated.sigma_mm, 1e-3);
    EXPECT_NEAR(noise.u_factor, 2.0, 1e-12);
    EXPECT_NEAR(stated.u_factor, 2.0, 1e-12);
    EXPECT_EQ(noise.widened, student_widening(std::max(1.0, redundancy / 4.0), 2.0));
    EXPECT_EQ(stated.widened, 1.0);
  }
}

// In mm on the surface, the largest first in sign, without what is below 0.05.
TEST(FitUncertainty, AFreeDirectionIsNamedByItsParts) {
  const auto named = [](double x, double y, double slope) {
    return name_direction(Eigen::Vector3d(x, y, slope), {"x", "y", "slope_x"}, {1.0, 1.0, 25.0});
  };
  EXPECT_EQ(named(0.6, -0.04, 0.8 / 25.0), "0.60 x + 0.80 slope_x");
  EXPECT_EQ(named(0.6, -0.06, 0.8 / 25.0), "0.60 x - 0.06 y + 0.80 slope_x");
  EXPECT_EQ(named(0.6, 0.0, -0.8 / 25.0), "-0.60 x + 0.80 slope_x");
  EXPECT_EQ(named(1.2, 0.0, -1.6 / 25.0), "-0.60 x + 0.80 slope_x");
}

// Each end is k times the u away that the apex would have if it were there (Fieller): a move d of
// it adds d times the u of ln tan α, which correlates with it. Nothing bounds it if that is 1/k.
TEST(FitUncertainty, TheApexHasAnIntervalOfItsOwn) {
  const double alpha = 0.2, relative = 1.0 / (std::tan(alpha) * std::pow(std::cos(alpha), 2));
  for (const double u_ln : {0.1, 0.4, 0.49, 0.51}) {
    const double u_angle = u_ln / relative, u_mm = 0.5, shared = -0.6 * u_mm * u_angle;
    std::vector<FitParameter> parameters{{"half_angle", {alpha, u_angle, "rad", ""}},
                                         {"k", {-120.0, u_mm, "mm", ""}}};
    Covariance covariance({"half_angle", "k"});
    const double of[] = {u_angle * u_angle, shared, shared, u_mm * u_mm};
    std::copy_n(of, 4, covariance.data());
    add_apex_interval(parameters, covariance, 2.0);
    const auto& interval = parameters[1].estimate.interval;
    ASSERT_EQ(interval.has_value(), u_ln < 0.5);
    if (!interval) continue;
    for (const double end : {(*interval)[0], (*interval)[1]}) {
      const double d = end + 120.0;
      const double variance = u_mm * u_mm - 2.0 * d * relative * shared + d * d * u_ln * u_ln;
      EXPECT_NEAR(std::abs(d), 2.0 * std::sqrt(variance), 1e-9);
    }
    EXPECT_LT((*interval)[0], -120.0);
    EXPECT_GT((*interval)[1], -120.0);
  }
}

}  // namespace
}  // namespace trueaxis::fit_budget_test
