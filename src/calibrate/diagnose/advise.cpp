// SPDX-License-Identifier: Apache-2.0
#include "calibrate/diagnose/advise.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "calibrate/diagnose/catalogue.hpp"
#include "calibrate/estimate/geometry.hpp"
#include "infer/advice.hpp"
#include "infer/classes.hpp"
#include "math/covariance.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::calibrate_detail {
namespace {

/// What a tip depends on: every location error and what was found, of the largest plausible size
/// before the measurement, and what these rows do not show, of its typical one.
std::vector<UncertainParameter> uncertain_of(const TipFit& fit, const MachineDiagnosis& found,
                                             const MachineDiagnoseOptions& options) {
  std::vector<UncertainParameter> out;
  for (const Unknown& one : fit.unknowns) out.push_back({one.name, one.unit, one.largest});
  const auto unit_of = [](ErrorTerm term, double size) {
    term.function = scaled(term.function, 1.0 / size);
    return term;
  };
  for (const MachineFinding& finding : found.findings)
    for (std::size_t k = 0; k < finding.errors.size(); ++k) {
      const double value = finding.parameters[k].estimate.value;
      if (value == 0.0) continue;
      out.push_back({finding.effect(), unit_of(finding.errors[k], value),
                     finding.errors[k].name.angular() ? options.calibration.largest_angle_rad
                                                      : options.calibration.largest_length_mm});
    }
  for (const MachineNotObservable& one : found.not_observable)
    for (const ErrorTerm& term : one.errors)
      out.push_back({one.effect, term,
                     term.name.angular() ? options.typical_angle_rad : options.typical_length_mm});
  return out;
}

/// Their covariance after a measurement, by rows, with the places free (Eq. 189). Empty of none.
/// @param base columns of all unknowns per largest size, then of the places, over σ
Covariance covariance_of(const TipFit& fit, const Problem& problem, const Geometry& geometry,
                         const MatrixXd& base, const std::vector<UncertainParameter>& uncertain,
                         double variance) {
  const auto count = static_cast<Index>(uncertain.size());
  if (count == 0) return {};
  const auto known = static_cast<Index>(fit.unknowns.size());
  MatrixXd columns(problem.equations, count);
  columns.leftCols(known) = base.leftCols(known);
  for (Index j = known; j < count; ++j) {
    const UncertainParameter& one = uncertain[static_cast<std::size_t>(j)];
    columns.col(j) =
        one.prior * problem.weights.cwiseProduct(error_column(problem, geometry, one.unit));
  }
  const MatrixXd places = base.rightCols(problem.places);
  columns = linear::beside(linear::orthonormal_basis(places), columns);
  const MatrixXd normal = linear::gram(columns) / variance + MatrixXd::Identity(count, count);
  const MatrixXd inverse = linear::inverse_of_normal(normal);
  std::vector<std::string> names;
  VectorXd prior(count);
  for (const UncertainParameter& one : uncertain) {
    prior[static_cast<Index>(names.size())] = one.prior;
    names.push_back(one.effect);
  }
  return with_names(std::move(names), linear::scaled_both(inverse, prior));
}

constexpr double weight_of_hidden =
    0.1;  // an effect that is merely looked for, compared with a class
constexpr double may_be_determined = 0.7;  // σ (Eq. 174), where it is 1 of rows that were read

double typical(const Term& term, const MachineDiagnoseOptions& options) {
  return term.angle() ? options.typical_angle_rad : options.typical_length_mm;
}

/// An effect that these rows do not show, and the power to find it at its typical size.
struct Hidden {
  std::size_t entry = 0;  ///< of `not_observable`
  double power = 0.0;
};

/// Whether a term was found, or is of the class of a cause, which names it.
bool is_stated(const Questions& q, const std::vector<Term>& terms, const std::string& effect,
               const MachineDiagnosis& out) {
  return std::ranges::any_of(q.found, [&](std::size_t t) { return terms[t].effect() == effect; }) ||
         std::ranges::any_of(out.findings, [&](const MachineFinding& finding) {
           return std::ranges::find(finding.rivals, effect, &Rival::effect) != finding.rivals.end();
         });
}

std::vector<Hidden> add_hidden(const Questions& q, const infer::Dictionary& dictionary,
                               const std::vector<Term>& terms, MachineDiagnosis& out) {
  const infer::Detection alone(dictionary, {}, q.variance, q.search),
      detection(dictionary, q.found, q.variance, q.search);
  std::vector<Hidden> hidden;
  const auto add = [&](MachineNotObservable one, double power) {
    hidden.push_back({out.not_observable.size(), power});
    out.not_observable.push_back(std::move(one));
  };
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const Term& term = terms[t];
    // Of a periodic error the longest period stands for all.
    if (term.is_pattern() || term.is_slip() ||
        (term.is_periodic() && t > 0 && terms[t - 1].effect() == term.effect()))
      continue;
    const double wanted = typical(term, q.options), power = detection.power(t, wanted);
    if (power >= infer::found_for_sure || is_stated(q, terms, term.effect(), out)) continue;
    const double size = detection.detectable_size(t);
    const infer::Dictionary::Block& block = dictionary.block(t);
    const char* const why =
        block.columns.empty() ? "what is always fitted takes it up at these positions"
        : !(alone.lambda(t) > 0.0)
            ? "what is always fitted takes up a part of it at these positions"
        : alone.power(t, wanted) >= infer::found_for_sure
            ? "what was found takes it up at these positions"
        : size > wanted ? "these positions show it less than the noise does"
                        : "these positions miss it in more than one of ten measurements";
    // The size that could hide: what is found with power one half, or the largest plausible one.
    add({{term.effect(), why, size, term.angle() ? "rad" : "mm", {}},
         term.errors,
         std::min(size, block.largest)},
        power);
  }
  for (const MachineEffect& effect : out.effects)
    if (!effect.why_not.empty())
      add({{effect.id, effect.why_not, std::numeric_limits<double>::infinity(), effect.unit, {}},
           {},
           0.0},
          0.0);
  return hidden;
}

/// The effects that matter to the questions, as columns of the data with a plan.
struct Extended {
  std::vector<Term> terms;
  Set found;  ///< those of the data
  infer::Dictionary dictionary;
  infer::SearchOptions search;
  Covariance covariance;
};

/// The term of a cause, at its own shape where there is one; none: it has none here.
std::optional<std::size_t> term_of_cause(const std::vector<Term>& terms,
                                         const MachineEffect& cause) {
  std::optional<std::size_t> first;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    if (terms[t].effect() != cause.id) continue;
    if (std::ranges::equal(terms[t].of.shape, cause.shape, {}, &MachineShape::value,
                           &MachineShape::value))
      return t;
    if (!first) first = t;
  }
  return first;
}

/// What was found in the data, among the terms of the data with a plan: a slip is added at its row.
/// A pattern is part of no plan.
Set found_with(const Problem& problem, const Geometry& geometry, const Questions& q,
               const std::vector<Term>& of_data, std::vector<Term>& terms) {
  Set found;
  for (const std::size_t t : q.found) {
    const Term& term = of_data[t];
    if (term.is_slip()) {
      const Row& from = q.fit.problem.rows[term.row];
      const auto row = std::ranges::find_if(problem.rows, [&](const Row& one) {
        return one.file == from.file && one.row == from.row;
      });
      found.push_back(terms.size());
      terms.push_back(slip_term(problem, geometry, term.of, row->target,
                                static_cast<std::size_t>(row - problem.rows.begin())));
    } else if (term.is_periodic()) {
      found.push_back(terms.size());
      terms.push_back(periodic_term(problem, geometry, term.of, term.period()));
    } else if (const auto own = term_of_cause(terms, term.of)) {
      found.push_back(*own);
    }
  }
  return found;
}

Extended extended(const Questions& q, const Plan& plan, const std::vector<Term>& of_data,
                  const std::set<std::string>& wanted,
                  const std::vector<UncertainParameter>& uncertain) {
  const Problem problem = make_problem(*q.fit.problem.machine, plan.data, q.fit.given);
  const Geometry geometry = geometry_of(problem, q.fit.given, problem.start);
  const bool timed =
      std::ranges::any_of(problem.rows, [](const Row& row) { return row.time_s > 0.0; });
  std::vector<MachineEffect> catalogue = machine_effects(problem, timed, q.options.own_effects);
  std::erase_if(catalogue, [&](const MachineEffect& one) { return !wanted.contains(one.id); });
  std::vector<Term> terms = effect_terms(problem, geometry, catalogue);
  const Set found = found_with(problem, geometry, q, of_data, terms);
  const MatrixXd all = weighted_jacobian(problem, q.fit.given, q.fit.unknowns, problem.start);
  infer::Dictionary dictionary = dictionary_of(terms, planned_base(all, q.fit.unknowns.size()),
                                               problem.weights, q.options.calibration);
  // More rows are more places of a slip, and what they show is tested then.
  infer::SearchOptions search = q.search;
  search.tests += static_cast<double>(plan.plan.visits.size() + catalogue.size());
  return {std::move(terms), found, std::move(dictionary), search,
          covariance_of(q.fit, problem, geometry, all, uncertain, q.variance)};
}

/// d of a cause's prediction after the best fit of an effect, with the data of a plan.
double distance(const Extended& with, const MachineFinding& finding, const std::string& rival,
                double variance) {
  const auto own = term_of_cause(with.terms, finding.cause);
  if (!own) return 0.0;
  const auto& block = with.dictionary.block(*own);
  if (block.columns.empty()) return 0.0;
  VectorXd size(static_cast<Index>(finding.parameters.size()));
  for (Index k = 0; k < size.size(); ++k)
    size[k] = finding.parameters[static_cast<std::size_t>(k)].estimate.value;
  const VectorXd mu = linear::least_squares(block.back, size);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < with.terms.size(); ++t)
    if (with.terms[t].effect() == rival)
      least = std::min(least,
                       infer::left_of(with.dictionary.beside({t}), block.columns, mu) / variance);
  return std::isfinite(least) ? std::sqrt(least) : 0.0;
}

/// What the data with a plan find of hidden effects, and the probability of the right name of each
/// cause.
struct Outlook {
  std::vector<double> found, told;
};
Outlook outlook_of(const Questions& q, const Extended& with, const std::vector<Hidden>& hidden,
                   const MachineDiagnosis& out) {
  Outlook outlook;
  const infer::Detection detection(with.dictionary, with.found, q.variance, with.search);
  for (const Hidden& one : hidden) {
    const auto term =
        std::ranges::find(with.terms, out.not_observable[one.entry].effect, &Term::effect);
    const double power = term == with.terms.end()
                             ? 0.0
                             : detection.power(static_cast<std::size_t>(term - with.terms.begin()),
                                               typical(*term, q.options));
    outlook.found.push_back(std::max(one.power, power));
  }
  for (const MachineFinding& finding : out.findings) {
    std::vector<double> distances;
    for (const Rival& rival : finding.rivals)
      distances.push_back(
          std::max(rival.distance, distance(with, finding, rival.effect, q.variance)));
    outlook.told.push_back(infer::right_name_of(finding.rivals, distances));
  }
  return outlook;
}

/// Every question with the plan to take for it; the next of all.
void conclude(const std::vector<Hidden>& hidden, const std::vector<Outlook>& outlooks,
              MachineDiagnosis& out) {
  std::vector<infer::Measure> measures;
  for (const MachinePlan& plan : out.plans)
    measures.push_back({plan.code, plan.what, plan.minutes});
  infer::Ranking ranking(measures);
  const auto after = [&](auto member, std::size_t k) {
    std::vector<double> values;
    for (const Outlook& one : outlooks) values.push_back((one.*member)[k]);
    return values;
  };
  for (std::size_t k = 0; k < hidden.size(); ++k) {
    const std::vector<double> values = after(&Outlook::found, k);
    MachineNotObservable& entry = out.not_observable[hidden[k].entry];
    entry.separate_with = infer::choose(measures, hidden[k].power, values, infer::found_for_sure,
                                        "none of the plans shows it");
    ranking.count(hidden[k].power, values, infer::found_for_sure, weight_of_hidden);
    for (std::size_t p = 0; p < values.size(); ++p)
      if (values[p] >= infer::found_for_sure) out.plans[p].shows.push_back(entry.effect);
  }
  for (std::size_t k = 0; k < out.findings.size(); ++k) {
    MachineFinding& finding = out.findings[k];
    if (finding.rivals.empty()) continue;
    std::vector<double> distances;
    for (const Rival& rival : finding.rivals) distances.push_back(rival.distance);
    const double before = infer::right_name_of(finding.rivals, distances);
    const std::vector<double> values = after(&Outlook::told, k);
    finding.separate_with = infer::choose(measures, before, values, infer::told_for_sure,
                                          "none of the plans tells them apart");
    ranking.count(before, values, infer::told_for_sure, 1.0);
    for (std::size_t p = 0; p < values.size(); ++p)
      if (values[p] >= infer::told_for_sure) out.plans[p].separates.push_back(finding.effect());
  }
  if (ranking.any()) out.next_plan = measures[ranking.order().front()].code;
}

}  // namespace

MatrixXd planned_base(const MatrixXd& all, std::size_t unknowns) {
  const auto count = static_cast<Index>(unknowns), places = all.cols() - count;
  const Determined determined =
      determine(all.leftCols(count), all.rightCols(places), may_be_determined);
  MatrixXd base(all.rows(), static_cast<Index>(determined.kept.size()) + places);
  base << all(Eigen::all, determined.kept), all.rightCols(places);
  return base;
}

void advise(const Questions& q, const infer::Dictionary& dictionary, const std::vector<Term>& terms,
            MachineDiagnosis& out) {
  const std::vector<Hidden> hidden = add_hidden(q, dictionary, terms, out);
  std::set<std::string> wanted;
  for (const std::size_t t : q.found)
    if (!terms[t].is_pattern() && !terms[t].is_slip()) wanted.insert(terms[t].effect());
  for (const MachineNotObservable& one : out.not_observable) wanted.insert(one.effect);
  for (const MachineFinding& finding : out.findings) {
    if (finding.rivals.empty()) continue;
    wanted.insert(finding.effect());
    for (const Rival& rival : finding.rivals) wanted.insert(rival.effect);
  }
  if (q.options.covariances) {
    const Problem& problem = q.fit.problem;
    out.uncertain = uncertain_of(q.fit, out, q.options);
    out.covariance =
        covariance_of(q.fit, problem, geometry_of(problem, q.fit.given, problem.start),
                      weighted_jacobian(problem, q.fit.given, q.fit.unknowns, problem.start),
                      out.uncertain, q.variance);
  } else if (hidden.empty() && std::ranges::all_of(out.findings, [](const MachineFinding& one) {
               return one.rivals.empty();
             })) {
    return;
  }
  std::vector<Outlook> outlooks;
  for (const Plan& plan : plans_for(q.fit.problem, q.data, q.fit.given, q.fit.problem.start)) {
    Extended with = extended(q, plan, terms, wanted, out.uncertain);
    outlooks.push_back(outlook_of(q, with, hidden, out));
    out.plans.push_back(plan.plan);
    out.plans.back().covariance = std::move(with.covariance);
  }
  conclude(hidden, outlooks, out);
}

}  // namespace trueaxis::calibrate_detail
