// SPDX-License-Identifier: Apache-2.0
// Rules of a fit that only unusual streams show: correlated noise of a few readings, an angle that
// scatters, readings far off, a profile that cannot have a ball.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "fit/associate.hpp"
#include "fit/describe.hpp"
#include "fit/joint_model.hpp"
#include "fit/moved.hpp"
#include "fit/place_set_ups.hpp"
#include "fit/plausible.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/fit.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double radius_mm = 20.0;

/// An eccentric cylinder of so many readings in so many revolutions over 40 mm; the eccentricity
/// turned by `turned_rad` from X.
ProbeStream cylinder(std::size_t readings, double revolutions, double eccentricity_mm,
                     double turned_rad = 0.0) {
  ProbeStream stream;
  for (std::size_t i = 0; i < readings; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(readings);
    const double c = two_pi * revolutions * share;
    stream.c_rad.push_back(c + turned_rad);
    stream.position_mm.push_back(40.0 * share);
    stream.reading_mm.push_back(
        intersect({{eccentricity_mm, 0.0, 0.0, 0.0, 0.0}, radius_mm, 0.0}, c, 0.0).x_mm);
  }
  return stream;
}

FitOptions of_cylinder() {
  FitOptions options;
  options.surface = SurfaceKind::cylinder;
  return options;
}

// Eq. 34: of fewer readings than a model of the noise needs (ten a parameter) u is that of white
// noise times √((1 + ρ)/(1 − ρ)), ρ as it is reported.
TEST(FitUncertainty, OfAFewCorrelatedReadingsIsWiderByTheirCorrelation) {
  std::mt19937_64 random(41);
  std::normal_distribution<double> normal(0.0, 1e-3);
  ProbeStream stream = cylinder(48, 2.3, 0.1);
  double noise = 0.0;
  for (double& x : stream.reading_mm) x += noise = 0.95 * noise + normal(random);
  const FitResult found = fit(stream, of_cylinder());
  ASSERT_EQ(found.status, FitStatus::converged) << found.message;
  const double rho = found.autocorrelation;
  ASSERT_GT(rho * std::sqrt(48.0), 4.0);
  EXPECT_NEAR(found.u_factor, std::sqrt((1.0 + rho) / (1.0 - rho)), 1e-12);
  const auto widened = [](const FitResult& of) {
    return std::ranges::any_of(of.notes, [](const std::string& note) {
      return note.find("TrueAxis widens every u") != std::string::npos;
    });
  };
  EXPECT_TRUE(widened(found));
  EXPECT_FALSE(widened(fit(cylinder(48, 2.3, 0.1), of_cylinder())));
}

// Two chips next to each other count as three σ each.
TEST(FitUncertainty, ChipsHardlyCorrelate) {
  std::mt19937_64 random(46);
  std::normal_distribution<double> normal(0.0, 1e-3);
  ProbeStream stream = cylinder(400, 8.3, 0.1);
  for (double& x : stream.reading_mm) x += normal(random);
  for (const std::size_t i : {50U, 51U, 200U, 201U, 300U, 301U}) stream.reading_mm[i] += 0.1;
  const FitResult found = fit(stream, of_cylinder());
  const double sigma_mm = found.rms_mm * std::sqrt(400.0 / 395.0);
  double products = 0.0, squares = 0.0, before = 0.0;
  for (const double left : found.residual_mm) {
    const double r = std::clamp(left, -3.0 * sigma_mm, 3.0 * sigma_mm);
    products += r * before, squares += r * r, before = r;
  }
  EXPECT_NEAR(found.autocorrelation, products / squares, 0.02);
}

// U of the radius, or of the one in the middle of a cone; 0 if there is none.
TEST(FitNotes, URadiusIsThatOfTheRadius) {
  FitResult found;
  found.coverage_factor = 3.0;
  EXPECT_EQ(radius_U_mm(found), 0.0);
  found.parameters = {{"x0", {1.0, 7.0, "mm", ""}}, {"radius", {1.0, std::nan(""), "mm", ""}}};
  EXPECT_EQ(radius_U_mm(found), 0.0);
  found.parameters.back().estimate.u = 0.5;
  EXPECT_EQ(radius_U_mm(found), 1.5);
  found.derived = {{"radius_mid", {1.0, 0.25, "mm", ""}}};
  EXPECT_EQ(radius_U_mm(found), 0.75);
}

/// What "noise of C" adds to u of the axis' place.
double u_by_angle_mm(const FitResult& fit) {
  for (const BudgetLine& line : fit.budget)
    if (line.source == "noise of C") return std::hypot(line.u[0], line.u[1]);
  return 0.0;
}

// An eccentricity e at angles that scatter by σ_C is read smaller by e σ_C²/2, whatever its
// direction. Of 4000 readings σ_C² is known to a few √(2/4000); 15 % are six of these.
TEST(FitUncertainty, OfAScatteringAngleDoesNotDependOnWhereTheAxisIs) {
  constexpr double e_mm = 1.0, sigma_rad = 0.02;
  double first = 0.0;
  for (const double turned : {0.0, 0.8, 0.5 * std::numbers::pi, 4.0}) {
    std::mt19937_64 random(42);
    std::normal_distribution<double> normal(0.0, sigma_rad);
    ProbeStream stream = cylinder(4000, 40.3, e_mm, turned);
    for (double& c : stream.c_rad) c += normal(random);
    const double u = u_by_angle_mm(fit(stream, of_cylinder()));
    EXPECT_NEAR(u, 0.5 * sigma_rad * sigma_rad * e_mm, 0.15 * 0.5 * sigma_rad * sigma_rad * e_mm);
    if (first == 0.0) first = u;
    EXPECT_NEAR(u, first, 1e-6 * first) << turned;
  }
}

// u in units of 1e-3: 1 of x and y at the middle, 0.1 of each slope; in quadrature 5 at 49 mm off
// it. A plane has no place, and its slopes count together.
TEST(FitMovedPart, UOfAnAxisIsThatAtItsWorseEnd) {
  FitResult fit;
  fit.coverage_factor = 3.0;
  fit.axis.axis.z_ref_mm = 10.0;
  fit.axis.covariance.by_rows = {1e-6, 0, 0, 0, 0, 1e-6, 0, 0, 0, 0, 1e-8, 0, 0, 0, 0, 1e-8};
  fit.position_min_mm = 10.0 - std::sqrt(2400.0), fit.position_max_mm = 30.0;
  fit.surface = SurfaceKind::cylinder;
  EXPECT_NEAR(U_of_axis_mm(fit), 3.0 * 5e-3, 1e-12);
  fit.surface = SurfaceKind::plane;
  EXPECT_NEAR(U_of_axis_mm(fit), 3.0 * (std::sqrt(2400.0) - 10.0) * std::sqrt(2e-8), 1e-12);
  fit.position_max_mm = 60.0;
  EXPECT_NEAR(U_of_axis_mm(fit), 3.0 * 60.0 * std::sqrt(2e-8), 1e-12);
}

// A lone reading far off does not count, whatever it is; of two neighbours both do. The size of a
// step is that between the lines through the three turns before and the five after it, at the
// second of these: u is σ √(2/144) √(1/3 + 3²/2 + 1/5 + 1²/10) = 2.7e-4 mm.
TEST(FitMovedPart, OnlyALoneReadingFarOffDoesNotCount) {
  constexpr std::size_t per_turn = 144, count = 8 * per_turn + 1;
  const ProbeStream stream = cylinder(count, static_cast<double>(count) / per_turn, 0.1);
  const FitResult found = fit(stream, of_cylinder());
  std::mt19937_64 random(43);
  std::normal_distribution<double> normal(0.0, 1e-3);
  std::vector<double> left_mm;
  for (std::size_t i = 0; i < count; ++i)
    left_mm.push_back(normal(random) + (i < 3 * per_turn ? 0.0 : 4e-3 * std::cos(stream.c_rad[i])));
  const auto step_mm = [&](std::size_t at, const std::vector<double>& off_mm) {
    std::vector<double> there = left_mm;
    std::ranges::copy(off_mm, there.begin() + static_cast<std::ptrdiff_t>(at));
    const auto step = moved_in_pass(stream, there, found);
    return step ? step->size_mm : 0.0;
  };
  ASSERT_NEAR(step_mm(0, {}), 4e-3, 1.1e-3);  // four u
  for (const std::size_t at : {std::size_t{0}, std::size_t{300}, std::size_t{700}}) {
    ASSERT_GT(step_mm(at, {0.015, 0.015}), 0.0);
    EXPECT_NE(step_mm(at, {0.015, 0.015}), step_mm(at, {0.016, 0.015})) << at;
    EXPECT_NE(step_mm(at, {0.015, 0.015}), step_mm(at, {0.015, 0.016})) << at;
    EXPECT_EQ(step_mm(at, {0.015}), step_mm(at, {0.016})) << at;
  }
}

// Lobes leave residuals too, of up to 10 µm: C in gon is looked for beyond.
TEST(FitMisreading, SmallResidualsAreLobes) {
  ProbeStream stream = cylinder(2880, 20.0, 0.1);
  for (std::size_t i = 0; i < stream.size(); ++i)
    stream.reading_mm[i] += 0.011 * std::sqrt(2.0) * std::cos(3.0 * stream.c_rad[i]);
  const Refit better = [](const ProbeStream& right, SurfaceKind) {
    FitResult again;
    again.status = FitStatus::converged, again.points = right.size(), again.rms_mm = 1e-4;
    return again;
  };
  FitResult found;
  found.surface = SurfaceKind::cylinder;
  found.residual_mm.assign(stream.size(), 0.0);
  found.rms_mm = 0.009;
  EXPECT_EQ(likely_misreading(stream, found, better), "");
  found.rms_mm = 0.011;
  EXPECT_TRUE(likely_misreading(stream, found, better).starts_with("C has 400 gon"));
}

// A fit that went astray leaves more than the surface to first order does, and tells of no unit: 1°
// of C is an arc and not a turn, where as little as noise is left of it.
TEST(FitMisreading, AFitThatWentAstrayTellsNothing) {
  ProbeStream stream = cylinder(400, 1.0 / 360.0, 0.1);
  std::mt19937_64 random(45);
  std::normal_distribution<double> normal(0.0, 0.01);
  for (double& reading : stream.reading_mm) reading += normal(random);
  const Refit better = [](const ProbeStream& right, SurfaceKind) {
    FitResult again;
    again.status = FitStatus::converged, again.points = right.size(), again.rms_mm = 0.01;
    return again;
  };
  FitResult astray;
  astray.surface = SurfaceKind::cylinder;
  astray.residual_mm.assign(stream.size(), 0.0);
  astray.rms_mm = 2e7;
  EXPECT_EQ(likely_misreading(stream, astray, better), "");
  for (std::size_t i = 0; i < stream.size(); ++i)  // what no arc of 1° has
    stream.reading_mm[i] += std::cos(0.1 * static_cast<double>(i));
  EXPECT_TRUE(likely_misreading(stream, astray, better).starts_with("C is in "));
}

// The largest of 2880 readings of noise is below 5 σ but once in 600 streams.
TEST(FitNotes, AReadingBeyondSixSigmaIsSuspected) {
  const auto notes = [](double off_mm) {
    std::mt19937_64 random(44);
    std::normal_distribution<double> normal(0.0, 1e-3);
    ProbeStream stream = cylinder(2880, 20.0, 0.1);
    for (std::size_t i = 0; i < stream.size(); ++i)
      stream.reading_mm[i] += i == 700 ? off_mm : normal(random);
    std::string all;
    for (const std::string& note : fit(stream, of_cylinder()).notes) all += note + '\n';
    return all;
  };
  // Robust σ of some 1000 residuals is known to 4 %, twice that here: 6 ± 0.5 σ.
  EXPECT_EQ(notes(5.5e-3).find("robust σ"), std::string::npos);
  EXPECT_NE(notes(6.5e-3).find("1 reading lies beyond 6 robust σ"), std::string::npos);
}

// The axis of one clamping, and of that one alone.
TEST(FitStart, ATiltIsOfOneClamping) {
  ProbeStream stream = cylinder(400, 8.0, 0.1);
  stream.setups.resize(2);
  for (std::size_t i = 0; i < stream.size(); ++i) stream.setup.push_back(i < 200 ? 1 : 2);
  stream.setups[1].number = 2, stream.setups[1].clamp_force_ratio = 1.5;  // clamped anew
  const JointModel model(stream, place_set_ups(stream), catalogue_entry(SurfaceKind::cylinder), {});
  ASSERT_EQ(model.clampings(), 2U);
  const std::vector<double> none(model.parameter_count(), 0.0);
  const std::vector<double> tilted = model.tilted(none, 1, {0.3, -0.2});
  const std::vector<double> back = model.mirrored(tilted, 1);
  for (const JointPart& part : model.parts()) {
    const auto slopes = [&](const std::vector<double>& joint) {
      const Axis axis = part.surface->axis(model.working(joint, part));
      return std::pair(axis.slope_x, axis.slope_y);
    };
    const bool here = part.clamping == 1;
    EXPECT_EQ(slopes(tilted), here ? std::pair(0.3, -0.2) : std::pair(0.0, 0.0));
    EXPECT_EQ(slopes(back), here ? std::pair(-0.3, 0.2) : std::pair(0.0, 0.0));
  }
}

// Chips of 1 mm in a tenth of the readings: without them the start of a level cylinder is exact, up
// to the rounding of squares of 20 mm over 0.1 mm.
TEST(FitStart, OfARobustLossIsWithoutChips) {
  ProbeStream stream = cylinder(400, 8.0, 0.1);
  const auto is_chip = [](std::size_t i) { return i % 10 == 3; };
  for (std::size_t i = 0; i < stream.size(); ++i) stream.reading_mm[i] += is_chip(i) ? 1.0 : 0.0;
  const JointModel model(stream, place_set_ups(stream), catalogue_entry(SurfaceKind::cylinder), {});
  std::vector<double> left_mm(model.size());
  for (const Loss loss : {Loss::huber, Loss::tukey}) {
    model.residuals(find_start(model, samples_of(model), loss), left_mm);
    for (std::size_t i = 0; i < left_mm.size(); ++i)
      ASSERT_NEAR(left_mm[i], is_chip(i) ? 1.0 : 0.0, 1e-9) << i;
  }
}

// A robust loss passes over the readings for its scale, its minimum and the last digits, each at
// least as often as a fit that starts at the plain minimum.
TEST(FitMinimum, PassesOfAllStagesCount) {
  std::mt19937_64 random(45);
  std::normal_distribution<double> normal(0.0, 1e-3);
  ProbeStream stream = cylinder(400, 8.3, 0.1);
  for (double& x : stream.reading_mm) x += normal(random);
  FitOptions options = of_cylinder();
  const int plain = fit(stream, options).iterations;
  ASSERT_GT(plain, 0);
  options.loss = Loss::huber;
  const int huber = fit(stream, options).iterations;
  EXPECT_GT(huber, plain);
  options.loss = Loss::tukey;
  EXPECT_GT(fit(stream, options).iterations, huber) << "it begins with Huber's";
}

// Where the slopes of Tukey's loss by its own formula are zero, here to a ten-millionth of the
// noise. Its fourth differences err by (h/c)⁴ of a step h.
TEST(FitMinimum, IsPolishedFarBelowTheNoise) {
  constexpr double c_mm = 5e-3;
  std::mt19937_64 random(44);
  std::normal_distribution<double> normal(0.0, 1e-3);
  ProbeStream stream = cylinder(400, 8.3, 0.1);
  for (std::size_t i = 0; i < stream.size(); ++i)
    stream.reading_mm[i] += normal(random) + (i % 10 == 3 ? 0.02 : 0.0);
  const JointModel model(stream, place_set_ups(stream), catalogue_entry(SurfaceKind::cylinder), {});
  Minimum found;
  found.working = find_start(model, samples_of(model), Loss::tukey);
  polish(model, {LossScale::Kind::tukey, c_mm}, found);
  const std::vector<double> scale = model.scale_mm(found.working);
  for (std::size_t j = 0; j < scale.size(); ++j) {
    const double h = 1e-5 / scale[j];
    const auto cost = [&](double steps) {
      std::vector<double> there = found.working, left_mm(model.size());
      there[j] += steps * h;
      model.residuals(there, left_mm);
      double sum = 0.0;
      for (const double r : left_mm)
        sum += 1.0 - std::pow(1.0 - std::min(1.0, r * r / (c_mm * c_mm)), 3);
      return sum;
    };
    const double slope = (8.0 * (cost(1.0) - cost(-1.0)) - cost(2.0) + cost(-2.0)) / 12.0;
    const double bend = cost(1.0) - 2.0 * cost(0.0) + cost(-1.0);
    EXPECT_NEAR(slope / bend * 1e-5, 0.0, 1e-10) << j;
  }
}

// One section tells nothing of a tilt, and of the rest what the fit of a circle tells. Lobes keep
// the minimum off its start. The iteration ends at 1e-12 of the sum of squares.
TEST(FitMinimum, OfOneSectionIsThatOfItsCircle) {
  ProbeStream stream = cylinder(400, 8.3, 5.0);
  std::ranges::fill(stream.position_mm, 7.0);
  for (std::size_t i = 0; i < stream.size(); ++i)
    stream.reading_mm[i] += 0.3 * std::cos(3.0 * stream.c_rad[i] + 1.0);
  FitOptions options = of_cylinder();
  const FitResult found = fit(stream, options);
  EXPECT_EQ(found.status, FitStatus::rank_deficient);
  options.surface = SurfaceKind::section;
  EXPECT_NEAR(found.rms_mm, fit(stream, options).rms_mm, 1e-12);
}

/// Three set-ups of two readings each: front, rear, and clamped anew; Z of each 10 mm on.
ProbeStream three_set_ups(double x_mm) {
  ProbeStream stream;
  stream.source = "part.csv";
  for (const int number : {1, 2, 3})
    for (const double more : {0.0, 2.0}) {
      stream.setup.push_back(number);
      stream.reading_mm.push_back(number == 2 ? -x_mm : x_mm);
      stream.c_rad.push_back(more);
      stream.position_mm.push_back(10.0 * number + more);
    }
  stream.setups = {{.number = 1}, {.number = 2}, {.number = 3, .z_shift_mm = 4.0}};
  return stream;
}

// Parts of 0.4 mm and of 25 mm: X_M tells the side by its sign, whatever its size.
TEST(FitSetUps, SidesAndClampingsAreThoseOfTheReadings) {
  for (const double x_mm : {0.4, 25.0}) {
    ProbeStream stream = three_set_ups(x_mm);
    const std::vector<PlacedSetUp> placed = place_set_ups(stream);
    ASSERT_EQ(placed.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(placed[i].clamping, i < 2 ? 0U : 1U);
      EXPECT_EQ(placed[i].root, i == 1 ? Root::rear : Root::front);
      EXPECT_EQ(placed[i].z_shift_mm, i < 2 ? 0.0 : 4.0);
      EXPECT_EQ(set_up_name(placed[i].set_up), "set-up " + std::to_string(i + 1));
    }
    using Ranges = std::vector<std::array<double, 2>>;
    EXPECT_EQ(probed_ranges(stream, placed), (Ranges{{10.0, 22.0}, {26.0, 28.0}}));
    stream.setups[1].rear = true;
    EXPECT_EQ(place_set_ups(stream)[1].root, Root::rear);
    stream.indication = Indication::relative;  // its sign tells nothing
    stream.setups[0].rear = true, stream.setups[1].rear = false;
    EXPECT_EQ(place_set_ups(stream)[0].root, Root::rear);
    EXPECT_EQ(place_set_ups(stream)[1].root, Root::front);
  }
  ProbeStream one = cylinder(100, 3.0, 0.1);
  one.setups[0].z_shift_mm = 4.0;
  ASSERT_EQ(place_set_ups(one).size(), 1U);
  EXPECT_EQ(place_set_ups(one)[0].z_shift_mm, 0.0) << "there is nothing that it is shifted against";
}

TEST(FitSetUps, ASideThatTheReadingsContradictIsNamedWithItsRow) {
  const auto why = [](const ProbeStream& stream) -> std::string {
    try {
      place_set_ups(stream);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  for (const double x_mm : {0.4, 25.0}) {
    ProbeStream stream = three_set_ups(x_mm);
    stream.setups[2].rear = true;
    EXPECT_NE(why(stream).find("X_M of set-up 3 is positive, but the stated side is rear"),
              std::string::npos);
    stream = three_set_ups(x_mm);
    stream.reading_mm[5] = -x_mm;
    EXPECT_NE(why(stream).find("X_M of set-up 3 changes sign or is zero at data row 6"),
              std::string::npos);
    stream = three_set_ups(x_mm);
    stream.reading_mm[3] = x_mm;
    EXPECT_NE(why(stream).find("X_M of set-up 2 changes sign or is zero at data row 4"),
              std::string::npos);
    stream.setup.clear();
    stream.setups.resize(1);
    EXPECT_NE(why(stream).find("X_M changes sign or is zero at data row 3"), std::string::npos);
  }
}

}  // namespace
}  // namespace trueaxis
