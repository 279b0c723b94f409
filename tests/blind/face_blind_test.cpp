// SPDX-License-Identifier: Apache-2.0
// A blind study of faces and sections, small beside that of cones: silence, names, and the face's
// own tilt and height after the diagnosis.
#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <iostream>
#include <map>

#include "blind/face_case.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::blind {
namespace {

constexpr std::uint64_t seed = 20261122;
constexpr int silent_cases = 200, of_each_family = 12, sections = 60;

Diagnosis diagnosed(const FaceCase& one, SurfaceKind surface) {
  DiagnoseOptions options;
  options.fit.surface = surface;
  options.threads = 1;
  return diagnose(virtual_lathe::simulate(one.scenario), options);
}

bool silent(const Diagnosis& d) { return d.findings.empty() && d.unexplained.empty(); }

bool named(const Diagnosis& d, const std::string& effect) {
  return std::ranges::any_of(d.findings, [&](const Finding& f) { return f.may_be(effect); });
}

void print_share(const char* what, int good, int all) {
  using boost::math::binomial_distribution;
  const double low = binomial_distribution<>::find_lower_bound_on_p(all, good, 0.025),
               high = binomial_distribution<>::find_upper_bound_on_p(all, good, 0.025);
  std::cout << what << ' ' << good << " of " << all << " (95 %: " << 100.0 * low << " to "
            << 100.0 * high << " %)\n";
}

/// Squared errors of what the face is, at its outer end and in height, µm².
struct Errors {
  double tilt = 0.0, height = 0.0;
  void add(const FitResult& fit, const virtual_lathe::Part& part) {
    constexpr double outer_mm = 40.0, um = 1e3;
    const auto off = [&](const char* name, double truth) {
      return (fit.parameter(name).value - truth) * um;
    };
    tilt += std::pow(outer_mm * off("l", part.l), 2) + std::pow(outer_mm * off("m", part.m), 2);
    height += std::pow(off("d", part.d_mm), 2);
  }
};

// The false alarm is 1 %: more than 6 of 200 then have a probability of 0.4 %.
TEST(BlindFaces, NothingIsFoundWhereNothingIs) {
  int good = 0;
  for (int k = 0; k < silent_cases; ++k) {
    const FaceCase one = draw_face(nullptr, seed + static_cast<std::uint64_t>(k));
    const Diagnosis found = diagnosed(one, SurfaceKind::plane);
    good += silent(found);
    for (const Finding& f : found.findings)
      std::cout << "seed " << one.scenario.seed << ": " << f.effect() << ", p " << f.p_value
                << '\n';
  }
  std::cout << "seed " << seed << '\n';
  print_share("silent", good, silent_cases);
  EXPECT_GE(good, 194);
}

// The goal is 90 % within the class. Tilt and height: not worse than the ideal fit's by more than
// 5 %, and better where an effect moves them.
TEST(BlindFaces, OneEffectIsNamedAndTheFaceIsNoWorse) {
  int good = 0, all = 0;
  std::map<FaceHarm, Errors> ideal, extended;
  std::cout << "seed " << seed << '\n';
  std::uint64_t next = seed + 1'000'000;
  for (const FaceFamily& family : face_families()) {
    int own = 0;
    for (int k = 0; k < of_each_family; ++k, ++next) {
      const FaceCase one = draw_face(&family, next);
      const Diagnosis found = diagnosed(one, SurfaceKind::plane);
      own += named(found, one.effect);
      ideal[family.harm].add(found.baseline, one.scenario.part);
      extended[family.harm].add(found.extended, one.scenario.part);
    }
    print_share((family.id + ", " + family.size).c_str(), own, of_each_family);
    good += own, all += of_each_family;
  }
  print_share("named", good, all);
  EXPECT_GE(good, (9 * all + 9) / 10);
  for (const FaceHarm harm : {FaceHarm::none, FaceHarm::biases}) {
    const double tilt = std::sqrt(extended[harm].tilt / ideal[harm].tilt),
                 height = std::sqrt(extended[harm].height / ideal[harm].height);
    std::cout << (harm == FaceHarm::none ? "not biased" : "biased")
              << ": RMSE extended/ideal, tilt " << tilt << ", height " << height << '\n';
    EXPECT_LT(tilt, harm == FaceHarm::none ? 1.05 : 1.0);
    EXPECT_LT(height, harm == FaceHarm::none ? 1.05 : 1.0);
  }
}

// Lobes of part and spindle are one column at one Z: the class holds both. Re-indexing (RC) tells
// them, and from the rear side (RE), which is quicker, those of even order. A turn by 70° is nearly
// a period of order 5, which nothing tells. λ ≥ 60 is found with a power of 99.9 % at a threshold
// of 28.
TEST(BlindSections, RoundnessAndRadialMotionAreOneClass) {
  int quiet = 0, good = 0, told = 0, tellable = 0;
  for (int k = 0; k < sections; ++k) {
    const auto number = static_cast<std::uint64_t>(k);
    quiet += silent(diagnosed(draw_section(false, seed + number), SurfaceKind::section));
    const FaceCase one = draw_section(true, seed + 2'000'000 + number);
    const Diagnosis found = diagnosed(one, SurfaceKind::section);
    const auto both = std::ranges::find_if(found.findings, [](const Finding& f) {
      return f.may_be("part.roundness") && f.may_be("spindle.radial_synchronous");
    });
    if (both == found.findings.end()) continue;
    ++good;
    const double order = one.scenario.effects.front().parameters.at("order");
    if (order == 5.0) continue;
    const std::string plan = both->separate_with ? both->separate_with->plan : "";
    ++tellable;
    told += plan == "RC" || (plan == "RE" && std::fmod(order, 2.0) == 0.0);
    if (plan != "RC" && plan != "RE") std::cout << "order " << order << ": " << plan << '\n';
  }
  std::cout << "seed " << seed << '\n';
  print_share("silent", quiet, sections);
  print_share("both named", good, sections);
  print_share("with the measurement that tells", told, tellable);
  EXPECT_GE(quiet, sections - 4);  // more has a probability of 0.04 % at 1 %
  EXPECT_GE(good, (9 * sections + 9) / 10);
  EXPECT_GE(told, (9 * tellable + 9) / 10);
}

}  // namespace
}  // namespace trueaxis::blind
