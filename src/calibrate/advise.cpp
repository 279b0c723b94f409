// SPDX-License-Identifier: Apache-2.0
#include "calibrate/advise.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "calibrate/uncertain.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::calibrate_detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double typical(const Term& term, const MachineDiagnoseOptions& options) {
  return term.angle ? options.typical_angle_rad : options.typical_length_mm;
}

/// The size that could hide: what is found with power one half, or the largest plausible one.
double hidden_size(const std::optional<double>& detectable, const Term& term,
                   const CalibrationOptions& options) {
  const double largest = term.angle ? options.largest_angle_rad : options.largest_length_mm;
  return detectable ? std::min(*detectable, largest) : largest;
}

/// What effects a machine of this kind may have, whatever these rows show.
void expect_untested(const Problem& problem, const std::vector<Term>& terms,
                     std::vector<MachineNotObservable>& out) {
  std::set<std::string> tested;
  for (const Term& term : terms) tested.insert(term.effect);
  const auto add = [&](const std::string& effect, const std::string& why, const char* unit) {
    if (!tested.contains(effect)) out.push_back({effect, why, std::nullopt, unit, {}, {}, 0.0});
  };
  for (const MachineAxis& axis : problem.machine->axes) {
    const std::string letter(1, letter_of(axis.name));
    if (axis_range(problem, axis.name).length() < 1e-6)
      add("E*" + letter, letter + " does not move in these rows",
          is_rotary(axis.name) ? "rad" : "mm");
    else
      add("reversal." + letter, letter + " comes from one side only",
          is_rotary(axis.name) ? "rad" : "mm");
  }
  for (const char* drift : {"drift.X", "drift.Y", "drift.Z"})
    add(drift, "the rows have no times: measure with a column t", "mm");
}

/// d of a finding's prediction beside a rival's best fit, with the data of a plan.
double distance(const Regression& regression, const std::vector<Term>& terms,
                const MachineFinding& finding, const std::string& rival, double variance) {
  const auto of = [&](const std::string& effect) {
    return static_cast<std::size_t>(std::ranges::find(terms, effect, &Term::effect) -
                                    terms.begin());
  };
  const std::size_t own = of(finding.effect), other = of(rival);
  if (own == terms.size() || other == terms.size()) return 0.0;
  const auto &a = regression.block(own), &b = regression.block(other);
  if (a.rank == 0) return 0.0;
  VectorXd size(static_cast<Index>(finding.parameters.size()));
  for (Index k = 0; k < size.size(); ++k)
    size[k] = finding.parameters[static_cast<std::size_t>(k)].estimate.value;
  const VectorXd mu = linear::least_squares(a.back, size);
  const MatrixXd& all = regression.products();
  const VectorXd cross = all.block(b.first, a.first, b.rank, a.rank) * mu;
  const double left = mu.squaredNorm() - (b.rank > 0 ? cross.squaredNorm() : 0.0);
  return std::sqrt(std::max(0.0, left) / variance);
}

/// The effects that matter to the questions, as columns of the data with a plan.
struct Extended {
  std::vector<Term> terms;
  Regression regression;
  std::vector<double> covariance;
};
Extended extended(const Questions& q, const Plan& plan, const std::set<std::string>& wanted,
                  const std::vector<UncertainParameter>& uncertain) {
  const Problem problem = make_problem(*q.fit.problem.machine, plan.data, q.fit.given);
  const Geometry geometry = geometry_of(problem, q.fit.given, problem.start);
  std::vector<Term> terms = effect_terms(
      problem, geometry,
      std::ranges::any_of(problem.rows, [](const Row& row) { return row.time_s > 0.0; }));
  std::erase_if(terms, [&](const Term& term) { return !wanted.contains(term.effect); });
  const MatrixXd all = weighted_jacobian(problem, q.fit.given, q.fit.unknowns, problem.start);
  const auto count = static_cast<Index>(q.fit.unknowns.size());
  const Determined determined = determine(all.leftCols(count), all.rightCols(problem.places));
  MatrixXd base(problem.equations, static_cast<Index>(determined.kept.size()) + problem.places);
  for (std::size_t k = 0; k < determined.kept.size(); ++k)
    base.col(static_cast<Index>(k)) = all.col(static_cast<Index>(determined.kept[k]));
  base.rightCols(problem.places) = all.rightCols(problem.places);
  Regression regression(terms, base, problem.weights, q.options.calibration.largest_length_mm,
                        q.options.calibration.largest_angle_rad);
  return {std::move(terms), std::move(regression),
          covariance_of(q.fit, problem, geometry, all, uncertain, q.variance)};
}

void weigh_plan(const Questions& q, const Plan& plan, const std::set<std::string>& wanted,
                MachineDiagnosis& out) {
  Extended with = extended(q, plan, wanted, out.uncertain);
  MachinePlan weighed = plan.plan;
  weighed.covariance = std::move(with.covariance);
  for (MachineNotObservable& one : out.not_observable) {
    const auto term = std::ranges::find(with.terms, one.effect, &Term::effect);
    if (term == with.terms.end()) continue;
    const auto at = static_cast<std::size_t>(term - with.terms.begin());
    const auto size = surely_shown_size(with.regression, at, q.variance, q.search);
    if (!size || *size > typical(*term, q.options)) continue;
    one.plans.push_back(weighed.code);
    weighed.shows.push_back(one.effect);
  }
  for (MachineFinding& finding : out.findings) {
    const bool apart = std::ranges::all_of(finding.rivals, [&](const MachineRival& rival) {
      return distance(with.regression, with.terms, finding, rival.effect, q.variance) >=
             surely_told_apart;
    });
    if (finding.rivals.empty() || !apart) continue;
    weighed.separates.push_back(finding.effect);
    if (finding.separate_with.empty()) finding.separate_with = weighed.code;
  }
  out.plans.push_back(std::move(weighed));
}

void choose_next(MachineDiagnosis& out) {
  double best = 0.0;
  for (const MachinePlan& plan : out.plans) {
    // A class told apart is worth more than an effect that is merely looked for.
    const double worth =
        10.0 * static_cast<double>(plan.separates.size()) + static_cast<double>(plan.shows.size());
    if (worth / plan.minutes <= best) continue;
    best = worth / plan.minutes;
    out.next_plan = plan.code;
  }
}

}  // namespace

void advise(const Questions& q, const Regression& regression, const std::vector<Term>& terms,
            MachineDiagnosis& out) {
  std::set<std::string> wanted;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    if (terms[t].pattern || terms[t].effect == "ball.slip") continue;
    const auto size = detectable_size(regression, t, q.variance, q.search);
    if (size && *size <= typical(terms[t], q.options)) continue;
    wanted.insert(terms[t].effect);
    out.not_observable.push_back({terms[t].effect,
                                  regression.block(t).rank == 0
                                      ? "what is always fitted takes it up at these positions"
                                      : "these positions show it less than the noise does",
                                  size,
                                  terms[t].angle ? "rad" : "mm",
                                  {},
                                  terms[t].errors,
                                  hidden_size(size, terms[t], q.options.calibration)});
  }
  expect_untested(q.fit.problem, terms, out.not_observable);
  for (const MachineNotObservable& one : out.not_observable) wanted.insert(one.effect);
  for (const MachineFinding& finding : out.findings) {
    if (finding.rivals.empty()) continue;
    wanted.insert(finding.effect);
    for (const MachineRival& rival : finding.rivals) wanted.insert(rival.effect);
  }
  if (q.options.covariances) {
    const Problem& problem = q.fit.problem;
    out.uncertain = uncertain_of(q.fit, out, q.options);
    out.covariance =
        covariance_of(q.fit, problem, geometry_of(problem, q.fit.given, problem.start),
                      weighted_jacobian(problem, q.fit.given, q.fit.unknowns, problem.start),
                      out.uncertain, q.variance);
  } else if (wanted.empty()) {
    return;
  }
  for (const Plan& plan : plans_for(q.fit.problem, q.data, q.fit.given, q.fit.problem.start))
    weigh_plan(q, plan, wanted, out);
  choose_next(out);
}

}  // namespace trueaxis::calibrate_detail
