// SPDX-License-Identifier: Apache-2.0
// Streams in which the statistics of a diagnosis are hard put to it: few readings with correlated
// noise, a pattern that beats fast, readings rounded in steps of many σ, a dent in a short stream.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <iostream>
#include <numbers>
#include <random>

#include "axis/axis_case.hpp"
#include "axis/draw.hpp"

namespace trueaxis::axis {
namespace {

constexpr std::uint64_t seed = 7700;
constexpr double sigma_mm = 1e-3;

/// A plan of the blind study stretched to a length and to so many readings, with 20 µm of
/// eccentricity.
Case stream_of(blind::PlanId plan, blind::SurfaceId surface, double readings, std::uint64_t own,
               double length_mm = blind::end_mm) {
  std::mt19937_64 random(own);
  const double per_turn = std::uniform_real_distribution(9.3, 36.7)(random);
  Case out;
  out.surface = blind::to_string(surface);
  out.low_mm = blind::start_mm, out.high_mm = length_mm;
  virtual_lathe::Scenario& s = out.scenario;
  s = blind::plain_scenario(plan, surface, static_cast<int>(own % 4));
  for (double* v : {&s.part.x0_mm, &s.part.y0_mm, &s.part.l, &s.part.m}) *v *= 0.1;
  double now = 0.0;
  for (const virtual_lathe::PlannedPass& pass : s.plan.passes)
    now += std::abs(pass.end_mm - pass.start_mm) / pass.feed_mm_per_rev * per_turn;
  s.u_end_mm = length_mm;
  for (virtual_lathe::PlannedPass& pass : s.plan.passes) {
    pass.start_mm *= length_mm / blind::end_mm, pass.end_mm *= length_mm / blind::end_mm;
    pass.feed_mm_per_rev *= now / readings * length_mm / blind::end_mm;
    pass.readings_per_revolution = per_turn;
    pass.jitter = 0.2;
  }
  s.noise.sigma_mm = sigma_mm, s.probe.states_noise = false, s.seed = own;
  return out;
}

Diagnosis diagnosed(const Case& of) { return diagnosed(of, virtual_lathe::simulate(of.scenario)); }

bool is_silent(const Diagnosis& d) { return d.findings.empty() && d.unexplained.empty(); }

// At 1 % a stream. Without the autoregression of streams this short half of them had causes.
TEST(ShortStream, OfCorrelatedNoiseIsSilent) {
  constexpr int streams = 80;
  std::cout << "seed " << seed << '\n';
  int loud = 0;
  for (std::uint64_t i = 0; i < streams; ++i) {
    const auto plan = i % 2 == 0 ? blind::PlanId::p1 : blind::PlanId::p3;
    const auto surface = i % 4 < 2 ? blind::SurfaceId::cone : blind::SurfaceId::cylinder;
    Case of = stream_of(plan, surface, 100.0 + 3.0 * static_cast<double>(i), seed + i);
    of.scenario.noise.rho = 0.8;
    loud += !is_silent(diagnosed(of));
  }
  std::cout << loud << " of " << streams << " streams with findings\n";
  EXPECT_LE(loud, quantile(complement(boost::math::binomial(streams, 0.01), 1e-3)));
}

// 3 lobes that beat 50 times: 0.4 of a cycle in a turn of the slow pass. A product of two cosines
// is two lines, and the axis, of order 1, is where it was.
TEST(FastBeat, IsTwoLinesOfItsOrder) {
  Case of = stream_of(blind::PlanId::p3, blind::SurfaceId::cylinder, 3000.0, seed);
  const double lasts = blind::duration_s(of.scenario.plan);
  of.scenario.effects = {{"extra.beat",
                          {{"order", 3.0},
                           {"amplitude_mm", 4.0 * sigma_mm},
                           {"beat_hz", 50.0 / lasts},
                           {"phase_rad", 0.4}}}};
  const Diagnosis d = diagnosed(of);
  EXPECT_TRUE(d.findings.empty());
  ASSERT_EQ(d.unexplained.size(), 2U);
  for (const Unexplained& u : d.unexplained) {
    EXPECT_EQ(u.term.pattern.order, 3.0);
    // Half a resolution cell of a frequency is half a cycle over the stream.
    EXPECT_NEAR(std::abs(u.term.pattern.frequency) * lasts, 50.0, 0.5);
    EXPECT_NEAR(u.amplitude.value, 2.0 * sigma_mm, 4.0 * u.amplitude.u);
  }
}

// Rounded to 4 µm, readings of σ = 0.3 µm err by a period of X; it is not an error of the scale.
TEST(Rounding, IsTakenOffAndNoFinding) {
  for (const auto surface : {blind::SurfaceId::cone, blind::SurfaceId::cylinder}) {
    Case of = stream_of(blind::PlanId::p3, surface, 1500.0, seed + 1);
    of.scenario.noise.sigma_mm = 3e-4;
    of.scenario.noise.quantisation_mm = 4e-3;
    const Diagnosis d = diagnosed(of);
    EXPECT_TRUE(is_silent(d)) << of.surface;
    const auto check = std::ranges::find(d.checks, "probe.quantisation", &QualityCheck::effect);
    ASSERT_NE(check, d.checks.end());
    EXPECT_TRUE(check->found);
    EXPECT_NE(check->text.find("subtracts its error"), std::string::npos) << check->text;
    EXPECT_LE(judge(of, d.extended.axis).rms_mm(), judge(of, d.baseline.axis).rms_mm());
  }
}

// In one pass feed marks of nearly the probe's lead show as few cycles along the part, like a
// waviness, or on a cone a period of the scale: they are in the class of what is named.
// (The mirror of the line, at the same distance on the other side of the lead, fitted better at its
// first shape.)
TEST(FeedMarks, OfNearlyTheProbesLeadStayInTheClass) {
  struct Marks {
    double lead_mm, per_turn, feed_mm, phase_rad;
    double x0_mm, y0_mm, l, m, amplitude_mm, sigma_mm;
    std::uint64_t seed;
  };
  constexpr Marks cases[] = {
      {0.4012471875055193, 10.031179687637984, 0.38204552788081997, 2.911733135112251,
       -0.10522673895595223, 0.11777120171469821, 5.3985362580990154e-05, 5.416603651977779e-06,
       0.004753885736530362, 0.0018227863935139285, 15565646650211514275U},
      {0.8583720038357174, 21.459300095892935, 0.8264214768650421, 2.0901734073024576,
       -0.003665711256758348, 0.004102714045222314, 9.864255402480276e-05, 9.897268311749888e-06,
       0.0045025162511680055, 0.0014489863911791186, 14450580687455728348U}};
  for (const Marks& marks : cases) {
    Case of = stream_of(blind::PlanId::p1, blind::SurfaceId::cone, 1500.0, seed);
    virtual_lathe::Scenario& s = of.scenario;
    s.part.x0_mm = marks.x0_mm, s.part.y0_mm = marks.y0_mm, s.part.l = marks.l, s.part.m = marks.m;
    s.plan.passes[0].feed_mm_per_rev = marks.lead_mm;
    s.plan.passes[0].readings_per_revolution = marks.per_turn;
    s.noise.sigma_mm = marks.sigma_mm, s.seed = marks.seed;
    s.effects = {{"part.feed_marks",
                  {{"feed_mm_per_rev", marks.feed_mm},
                   {"amplitude_mm", marks.amplitude_mm},
                   {"phase_rad", marks.phase_rad}}}};
    const Diagnosis d = diagnosed(of);
    ASSERT_EQ(d.findings.size(), 1U) << marks.seed;
    EXPECT_TRUE(d.findings[0].may_be("part.feed_marks")) << d.findings[0].effect();
  }
}

/// What of so many streams the binomial law allows of a rate of 5 %: once in 1000.
double allowed(int streams) {
  return quantile(complement(boost::math::binomial(streams, 0.05), 1e-3));
}

bool may_be(const Diagnosis& d, std::string_view effect) {
  return std::ranges::any_of(d.findings, [&](const Finding& f) { return f.may_be(effect); });
}

// As slow along a single pass as a taper with a barrel, marks of nearly its lead have neither name:
// the classes hold both. One line of marks stood for taper and barrel in 7 of 20.
TEST(FeedMarks, OfTheProbesLeadTaperAndBarrelAreNotToldApart) {
  constexpr int streams = 40;
  std::cout << "seed " << seed << '\n';
  int lost = 0, named = 0, marks_lost = 0;
  for (std::uint64_t i = 0; i < streams; ++i) {
    Draw draw(seed + i);
    const auto size = [&] {
      return std::copysign(draw.between(2.0, 8.0), draw.between(-1.0, 1.0)) * sigma_mm;
    };
    Case of = stream_of(blind::PlanId::p1, blind::SurfaceId::cylinder, draw.between(400.0, 2000.0),
                        seed + i);
    of.scenario.effects = {{"part.barrel", {{"amplitude_mm", size()}, {"cubic_mm", 0.0}}},
                           {"part.taper", {{"amplitude_mm", size()}}}};
    const Diagnosis form = diagnosed(of);
    lost += !may_be(form, "part.barrel") || !may_be(form, "part.taper");
    const double lead_mm = of.scenario.plan.passes[0].feed_mm_per_rev;
    of.scenario.effects = {
        {"part.feed_marks",
         {{"feed_mm_per_rev", 1.0 / (1.0 / lead_mm + draw.between(-0.5, 0.5) / of.high_mm)},
          {"amplitude_mm", draw.between(4.0, 12.0) * sigma_mm},
          {"phase_rad", draw.phase()}}}};
    const Diagnosis spiral = diagnosed(of);
    named += !spiral.findings.empty();
    marks_lost += !spiral.findings.empty() && !may_be(spiral, "part.feed_marks");
  }
  std::cout << lost << " of " << streams << " without taper or barrel, " << marks_lost << " of "
            << named << " without the marks\n";
  EXPECT_LE(lost, allowed(streams));
  EXPECT_LE(marks_lost, allowed(named));
}

// Up to two thirds of the probed length; beyond 30 mm none was looked for, and half were missed or
// had another name.
TEST(Waviness, OfALongWaveIsFound) {
  constexpr int streams = 32;
  std::cout << "seed " << seed << '\n';
  int lost = 0;
  double ideal = 0.0, stated = 0.0;
  for (std::uint64_t i = 0; i < streams; ++i) {
    Draw draw(seed + i);
    const auto surface = i % 2 == 0 ? blind::SurfaceId::cone : blind::SurfaceId::cylinder;
    const double length_mm = draw.between(60.0, 120.0);
    Case of = stream_of(blind::all_plans()[i % 4], surface, draw.between(400.0, 3000.0), seed + i,
                        length_mm);
    of.scenario.effects = {{"part.waviness",
                            {{"amplitude_mm", draw.between(2.0, 8.0) * sigma_mm},
                             {"wavelength_mm", draw.between(35.0, length_mm / 1.5)},
                             {"phase_rad", draw.phase()}}}};
    if (i % 3 == 0) {
      of.scenario.noise.outlier_fraction = 0.01;
      of.scenario.noise.outlier_size_mm = draw.between(10.0, 100.0) * sigma_mm;
    }
    const Diagnosis d = diagnosed(of);
    lost += !may_be(d, "part.waviness");
    ideal += std::pow(judge(of, d.baseline.axis).rms_mm(), 2);
    stated += std::pow(judge(of, d.extended.axis).rms_mm(), 2);
  }
  std::cout << lost << " of " << streams << " lost, axis " << 1e3 * std::sqrt(ideal / streams)
            << " and " << 1e3 * std::sqrt(stated / streams) << " µm\n";
  EXPECT_LE(lost, allowed(streams));
  EXPECT_LT(stated, ideal);
}

// A machine that moved between two set-ups that are a jog apart looks like a gain of some −70 %,
// by which the axis would go 23 µm off: nothing is named, and the ideal fit stays.
TEST(Gain, OfAnImpossibleSizeIsNoCause) {
  constexpr int streams = 24;
  std::cout << "seed " << seed << '\n';
  int gains = 0, named = 0, said = 0, hidden = 0;
  for (std::uint64_t i = 0; i < streams; ++i) {
    Draw draw(seed + i);
    const auto surface = i % 2 == 0 ? blind::SurfaceId::cone : blind::SurfaceId::cylinder;
    Case of = stream_of(blind::all_plans()[i % 4], surface, draw.between(400.0, 1500.0), seed + i);
    of.scenario = *blind::with_measurement(of.scenario, "XJ");
    ProbeStream stream = virtual_lathe::simulate(of.scenario);
    const double moved_mm = draw.between(-0.09, -0.03);
    for (std::size_t k = 0; k < stream.size(); ++k)
      if (stream.setup[k] == 2) stream.reading_mm[k] += moved_mm;
    const Diagnosis d = diagnosed(of, stream);
    gains += may_be(d, "probe.gain");
    named += !is_silent(d);
    said += std::ranges::any_of(d.remarks, [](const std::string& remark) {
      return remark.find("at an impossible size") != std::string::npos;
    });
    hidden += std::ranges::any_of(d.shares, [](const AxisShare& share) {
      return share.effect == "probe.gain" && share.probability > 0.5;
    });
  }
  std::cout << gains << " gains, " << hidden << " hidden, " << named << " of " << streams
            << " named\n";
  EXPECT_EQ(gains, 0);
  EXPECT_EQ(hidden, 0) << "a gain that cannot be is in no U";
  EXPECT_GE(said, streams - allowed(streams)) << "what would fit is said";
  EXPECT_LE(named, allowed(streams));
}

// Play of the slide acts like a delay of either sign, and no sensor leads what it follows: only the
// delay is named, with its class.
TEST(Lag, ThatWouldLeadIsNoCause) {
  int delays = 0;
  for (std::uint64_t i = 0; i < 4; ++i) {
    Case of = stream_of(blind::PlanId::p2, blind::SurfaceId::cone, 1500.0, seed + i);
    for (double* v : {&of.scenario.part.x0_mm, &of.scenario.part.y0_mm}) *v *= 10.0;
    of.scenario.effects = {
        {"slide.backlash", {{"across_mm", i % 2 == 0 ? 0.004 : -0.004}, {"along_mm", 0.0}}}};
    for (const Finding& f : diagnosed(of).findings) {
      delays += f.effect() == "probe.latency" && f.parameter("delay").value < 0.0;
      if (f.effect() == "probe.lag") {
        EXPECT_GT(f.parameter("time_constant").value, 0.0) << "seed " << seed + i;
      }
      if (f.may_be("probe.latency")) {
        EXPECT_TRUE(f.may_be("slide.backlash")) << "seed " << seed + i;
      }
    }
  }
  EXPECT_GT(delays, 0) << "none of the streams asks the question";
}

// Of few readings a dent has few: it is a local form and none of the catalogue's. The blind study's
// goal for what no catalogue has is 95 %; with boxes of eight readings and more it was 75 %.
TEST(Dent, OfAShortStreamHasNoOtherName) {
  constexpr int streams = 60;
  constexpr std::uint64_t seed = 9000;
  std::cout << "seed " << seed << '\n';
  int named = 0;
  double ideal = 0.0, stated = 0.0;
  for (std::uint64_t i = 0; i < streams; ++i) {
    const blind::PlanId plans[] = {blind::PlanId::p1, blind::PlanId::p2, blind::PlanId::p3};
    const auto surface = i % 2 == 0 ? blind::SurfaceId::cone : blind::SurfaceId::cylinder;
    Draw draw(seed + i);
    Case of = stream_of(plans[i % 3], surface, draw.between(300.0, 700.0), seed + i);
    of.scenario.effects = {{"extra.dent",
                            {{"angle_rad", draw.phase()},
                             {"position_mm", draw.between(0.15, 0.85) * of.high_mm},
                             {"depth_mm", draw.between(8.0, 40.0) * sigma_mm},
                             {"width_rad", draw.between(0.1, 0.4)},
                             {"length_mm", draw.between(0.05, 0.2) * of.high_mm}}}};
    const Diagnosis d = diagnosed(of);
    named += !d.findings.empty();
    ideal += std::pow(judge(of, d.baseline.axis).rms_mm(), 2);
    stated += std::pow(judge(of, d.extended.axis).rms_mm(), 2);
  }
  std::cout << named << " of " << streams << " named, axis " << 1e3 * std::sqrt(ideal / streams)
            << " and " << 1e3 * std::sqrt(stated / streams) << " µm\n";
  EXPECT_LE(named, allowed(streams));
  EXPECT_LT(stated, 0.05 * ideal);
}

// Of 100 to 200 readings a slip dated a few readings off leaves as many that are off by all of it:
// smooth lines then fitted better, and took the axis with them.
TEST(Slip, InFewReadingsIsDatedAndMovesTheAxis) {
  constexpr int streams = 40;
  std::cout << "seed " << seed << '\n';
  int named = 0, within = 0;
  for (std::uint64_t i = 0; i < streams; ++i) {
    Draw draw(seed + i);
    const auto surface = i % 2 == 0 ? blind::SurfaceId::cone : blind::SurfaceId::cylinder;
    Case of = stream_of(blind::all_plans()[i % 4], surface, draw.between(100.0, 200.0), seed + i);
    const double lasts = blind::duration_s(of.scenario.plan), direction = draw.phase();
    const double size_mm = draw.between(0.02, 0.15);
    of.scenario.effects = {{"part.waviness",
                            {{"amplitude_mm", draw.between(2.0, 6.0) * sigma_mm},
                             {"wavelength_mm", draw.between(5.0, 15.0)},
                             {"phase_rad", draw.phase()}}},
                           {"part.slip",
                            {{"dx_mm", size_mm * std::cos(direction)},
                             {"dy_mm", size_mm * std::sin(direction)},
                             {"turn_rad", 0.0},
                             {"time_s", draw.between(0.2, 0.8) * lasts}}}};
    const Diagnosis d = diagnosed(of);
    named += may_be(d, "part.slip");
    within += judge(of, d.extended.axis).covered();
  }
  std::cout << named << " of " << streams << " named, " << within << " numbers within U\n";
  // A slip in the pause between two passes of the same speed is a step from pass to pass as well.
  EXPECT_GE(named, streams - allowed(streams));
  // The four numbers of a stream hang together: counted as one each.
  EXPECT_GE(within / 4, quantile(boost::math::binomial(streams, 0.935), 1e-3));
}

// Block by block, the second reading of a pass from behind was whitened with one that is not there
// (noise of second order, a bore of eight passes): another answer each time, and then an exception.
TEST(ShortStream, OfAPassFromBehindHasOneAnswer) {
  const Case of = draw_case(Group::outside, 20261796);
  const Diagnosis first = diagnosed(of), second = diagnosed(of);
  EXPECT_EQ(first.extended.status, FitStatus::converged);
  EXPECT_EQ(first.residual_after_mm, second.residual_after_mm);
}

}  // namespace
}  // namespace trueaxis::axis
