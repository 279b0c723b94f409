// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "calibrate/diagnose/catalogue.hpp"
#include "calibrate/diagnose/term.hpp"
#include "calibrate/estimate/tip_fit.hpp"
#include "support/ball_bench.hpp"
#include "trueaxis/machine_diagnosis.hpp"

namespace trueaxis::testing {
namespace {

using namespace calibrate_detail;

struct Tally {
  int cases = 0, named = 0, more = 0, far = 0;
  std::size_t findings = 0, members = 0;
};

/// Whether each of two effects has λ of 50 and more after the other.
bool told_beside(const infer::Dictionary& dictionary, std::size_t term, const Eigen::VectorXd& mu,
                 const std::vector<std::pair<std::size_t, Eigen::VectorXd>>& others) {
  const auto left = [&](std::size_t a, const Eigen::VectorXd& of_a, std::size_t b) {
    const Eigen::MatrixXd products =
        dictionary.gram()(dictionary.block(b).columns, dictionary.block(a).columns);
    return of_a.squaredNorm() - (products * of_a).squaredNorm();
  };
  return std::ranges::all_of(others, [&](const auto& other) {
    return left(term, mu, other.first) >= 50.0 && left(other.first, other.second, term) >= 50.0;
  });
}

/// Effects that the plan shows, each drawn with λ of 60 to 400, or two with 50 and more after each
/// other. They are added to readings of a machine with location errors.
void one_case(std::uint64_t seed, int effects, Tally& tally) {
  Draw draw(seed);
  const Machine machine = trunnion();
  const ErrorModel truth = drawn_location_errors(machine, draw);
  BallPlan plan;
  plan.c_deg.clear();
  for (int k = 0; k < 12; ++k) plan.c_deg.push_back(30.0 * k);
  if (draw.whole(0, 1) == 0) plan.tool_lengths_mm = {120.0};
  if (draw.whole(0, 1) == 0) plan.balls.resize(1);
  const BallBench bench{machine, truth};
  MachineMeasurement data = measure_balls(bench, plan, 1e-3, draw);
  for (std::size_t i = 0; i < data.rows(); ++i) data.time_s.push_back(6.0 * static_cast<double>(i));

  CalibrationOptions options;
  Calibration base = of_read_outs(machine, std::span(&data, 1), options);
  const auto fit = fit_tips(machine, std::span(&data, 1), options, false, base);
  const Geometry geometry = geometry_of(fit->problem, base.errors, fit->solution.places);
  const auto terms = effect_terms(fit->problem, geometry, machine_effects(fit->problem, true));
  const infer::Dictionary dictionary =
      dictionary_of(terms, fit->solution.jacobian, fit->problem.weights, options);
  std::vector<std::string> put;
  std::vector<std::pair<std::size_t, Eigen::VectorXd>> places;
  const auto clean = data.deviation_mm;
  while (put.size() < static_cast<std::size_t>(effects)) {
    const auto t = static_cast<std::size_t>(draw.whole(0, static_cast<int>(terms.size()) - 1));
    const auto& block = dictionary.block(t);
    if (block.columns.empty() || std::ranges::find(put, terms[t].effect()) != put.end()) continue;
    Eigen::VectorXd mu(static_cast<Eigen::Index>(block.columns.size()));
    for (auto& one : mu) one = draw.between(-1.0, 1.0);
    mu *= std::sqrt(draw.between(60.0, 400.0)) / mu.norm();
    if (!told_beside(dictionary, t, mu, places)) {
      put.clear();
      places.clear();
      data.deviation_mm = clean;
      continue;
    }
    const Eigen::VectorXd added = terms[t].columns * (block.back * mu);
    for (const Row& row : fit->problem.rows)
      for (std::size_t k = 0; k < 3; ++k)
        data.deviation_mm[row.row][k] += added[row.first + static_cast<Eigen::Index>(k)];
    put.push_back(terms[t].effect());
    places.emplace_back(t, mu);
  }
  const MachineDiagnosis found = diagnose_machine(machine, std::span(&data, 1));
  ++tally.cases;
  bool all = true;
  for (const std::string& effect : put)
    all = all && std::ranges::any_of(found.findings, [&](const MachineFinding& f) {
            const auto members = f.members();
            return std::ranges::find(members, effect) != members.end();
          });
  tally.named += all ? 1 : 0;
  tally.more += found.findings.size() + found.unexplained.size() > put.size() ? 1 : 0;
  for (const MachineFinding& f : found.findings) {
    ++tally.findings;
    tally.members += f.members().size();
    for (const Rival& r : f.rivals) tally.far += r.distance >= 6.6 ? 1 : 0;
  }
  if (!all) {
    std::cout << "seed " << seed << ": put";
    for (const auto& one : put) std::cout << ' ' << one;
    std::cout << ", found";
    for (const auto& f : found.findings) {
      std::cout << ' ' << f.effect() << '(';
      for (const auto& r : f.rivals) std::cout << r.effect << ' ';
      std::cout << ')';
    }
    for (const auto& u : found.unexplained) std::cout << " ?" << u.pattern;
    std::cout << '\n';
  }
}

int cases_wanted(int usual) {
  const char* const said = std::getenv("TRUEAXIS_CASES");
  return said != nullptr ? std::atoi(said) : usual;
}

// Named or in the class in 97 %: at least 36 of 40 (binomial, 99 %).
TEST(DiagnoseMachinePower, OneEffectIsNamed) {
  Tally tally;
  const int cases = cases_wanted(40);
  for (int seed = 1; seed <= cases; ++seed) one_case(static_cast<std::uint64_t>(seed), 1, tally);
  std::cout << tally.named << " of " << tally.cases << " named, " << tally.more
            << " with more than was there, " << tally.members << " members of " << tally.findings
            << " classes\n";
  EXPECT_GE(tally.named, 0.97 * tally.cases - 2.33 * std::sqrt(0.03 * 0.97 * tally.cases) - 0.5);
  EXPECT_EQ(tally.far, 0);
  // A class that held everything would name everything.
  EXPECT_LT(tally.members, 2 * tally.findings);
}

// Both named in 94 of 100.
TEST(DiagnoseMachinePower, TwoEffectsAreNamed) {
  Tally tally;
  const int cases = cases_wanted(40);
  for (int seed = 1001; seed <= 1000 + cases; ++seed)
    one_case(static_cast<std::uint64_t>(seed), 2, tally);
  std::cout << tally.named << " of " << tally.cases << " named, " << tally.more
            << " with more than was there, " << tally.members << " members of " << tally.findings
            << " classes\n";
  EXPECT_GE(tally.named, 0.94 * tally.cases - 2.33 * std::sqrt(0.06 * 0.94 * tally.cases) - 0.5);
  EXPECT_EQ(tally.far, 0);
}

}  // namespace
}  // namespace trueaxis::testing
