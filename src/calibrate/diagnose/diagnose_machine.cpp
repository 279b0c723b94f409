// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Core>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "calibrate/diagnose/advise.hpp"
#include "calibrate/diagnose/catalogue.hpp"
#include "calibrate/diagnose/explain.hpp"
#include "calibrate/diagnose/find.hpp"
#include "calibrate/diagnose/unexplained.hpp"
#include "calibrate/estimate/plausible_errors.hpp"
#include "calibrate/estimate/tip_fit.hpp"
#include "calibrate/estimate/total_uncertainty.hpp"
#include "math/linear_algebra.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/machine_diagnosis.hpp"

namespace trueaxis {

namespace calibrate_detail {
namespace {

constexpr double times_the_unknown = 4.0;  // twice in amplitude

/// Letter of the axis that a term is a function of; t of drifts and slips.
char letter_of(const MachineTerm& term) {
  if (std::holds_alternative<ZeroDrift>(term) || std::holds_alternative<ZeroStep>(term)) return 't';
  const auto axis = axis_of(term);
  return axis ? trueaxis::letter_of(*axis) : 't';
}

/// The catalogue's term of every cause of a class.
std::vector<const MachineTerm*> terms_of(const MachineFinding& finding, const Found& search) {
  std::vector<const MachineTerm*> out;
  for (const std::string& member : finding.members()) {
    const auto at = std::ranges::find(search.terms, member, &Term::effect);
    if (at != search.terms.end() && !at->is_pattern()) out.push_back(&at->of.term);
  }
  return out;
}

bool shares_its_axis(const MachineFinding& finding, const Found& search) {
  return std::ranges::any_of(terms_of(finding, search), [&](const MachineTerm* member) {
    return std::ranges::any_of(search.found, [&](std::size_t t) {
      return search.terms[t].letters.find(letter_of(*member)) != std::string::npos;
    });
  });
}

/// Whether a cause of a class is that component error, as a function of its axis.
bool may_be(const MachineFinding& finding, const Found& search, const ErrorName& error) {
  return std::ranges::any_of(terms_of(finding, search), [&](const MachineTerm* member) {
    const auto* own = std::get_if<ErrorOfPosition>(member);
    return own != nullptr && own->error == error;
  });
}

/// The third of one error among the classes is not an order or degree of it.
bool one_of_three(const MachineFinding& finding, const std::vector<MachineFinding>& all,
                  const Found& search) {
  return std::ranges::any_of(terms_of(finding, search), [&](const MachineTerm* member) {
    const auto* own = std::get_if<ErrorOfPosition>(member);
    return own != nullptr && std::ranges::count_if(all, [&](const MachineFinding& other) {
                               return may_be(other, search, own->error);
                             }) >= 3;
  });
}

/// A ball that slips twice is one that goes along with something in time.
bool slips_again(std::size_t at, const Found& search) {
  const Term& own = search.terms[search.found[at]];
  return own.is_slip() && std::ranges::count_if(search.found, [&](std::size_t t) {
                            return search.terms[t].is_slip() &&
                                   search.terms[t].target == own.target;
                          }) > 1;
}

/// What some of the terms gain together after the others.
double gain_of_some(const Found& search, const std::vector<bool>& some) {
  Set others;
  for (std::size_t i = 0; i < some.size(); ++i)
    if (!some[i]) others.push_back(search.found[i]);
  return search.dictionary->gain(search.found) - search.dictionary->gain(others);
}

/// What gains less than some times all that is unknown together may be what the nearest form leaves
/// of it.
void add_what_gains_less(const Found& search, std::vector<bool>& unknown) {
  for (bool added = std::ranges::find(unknown, true) != unknown.end(); added;) {
    added = false;
    const double least = times_the_unknown * gain_of_some(search, unknown);
    for (std::size_t at = 0; at < unknown.size(); ++at) {
      std::vector<bool> alone(unknown.size(), false);
      alone[at] = true;
      if (unknown[at] || gain_of_some(search, alone) >= least) continue;
      unknown[at] = added = true;
    }
  }
}

/// Which of the causes do not get a name: patterns, and what may be part of something unknown (Eqs.
/// 184, 230). @param findings one each of `search.found`
/// @param read_outs alone: they show one error, of which every order and degree is a cause
std::vector<bool> parts_of_unknown(const Found& search, const std::vector<MachineFinding>& findings,
                                   bool read_outs) {
  std::vector<bool> unknown(findings.size());
  const auto of_one_reading = [&](std::size_t at) {
    return search.terms[search.found[at]].of_one_reading;
  };
  for (std::size_t at = 0; at < findings.size(); ++at)
    unknown[at] = (search.terms[search.found[at]].is_pattern() && !of_one_reading(at)) ||
                  shares_its_axis(findings[at], search) ||
                  (!read_outs && one_of_three(findings[at], findings, search)) ||
                  slips_again(at, search);
  add_what_gains_less(search, unknown);
  // What is off in one reading alone is not part of another cause.
  for (std::size_t at = 0; at < findings.size(); ++at)
    if (of_one_reading(at)) unknown[at] = true;
  return unknown;
}

bool is_sure(const Term& term) { return term.errors.empty() || form_is_sure(term.of.term); }

/// Base and what was found together, in the units of their columns.
struct JointFit {
  VectorXd base;        ///< of the base's columns, and more
  MatrixXd covariance;  ///< of base and `found`
  std::vector<FoundColumns> found;
  std::vector<ErrorTerm> errors;  ///< in place of those found whose form is not sure
};

/// What was found in a form that is not sure is random instead, with the errors that it may be as
/// well: in the forms of Eq. 210, at the sizes that the data show (Eq. 332). @param findings one
/// each of `search.found`
JointFit with_open_forms(const TipFit& fit, const Geometry& geometry, const Found& search,
                         const std::vector<MachineFinding>& findings) {
  JointFit out;
  MatrixXd fixed = fit.solution.jacobian;
  std::vector<ErrorName> open;
  for (std::size_t at = 0; at < search.found.size(); ++at) {
    const Term& term = search.terms[search.found[at]];
    if (!is_sure(term)) {
      for (const MachineTerm* member : terms_of(findings[at], search))
        if (is_machine_error(*member)) open.push_back(std::get<ErrorOfPosition>(*member).error);
      continue;
    }
    out.found.push_back({term.columns.cols(), term.errors});
    fixed.conservativeResize(Eigen::NoChange, fixed.cols() + term.columns.cols());
    fixed.rightCols(term.columns.cols()) = linear::scaled_rows(fit.problem.weights, term.columns);
  }
  std::vector<PlausibleError> plausible = plausible_errors(fit.problem, {}, open);
  std::erase_if(plausible, [&](const PlausibleError& error) {
    return std::ranges::find(open, error.name) == open.end();
  });
  std::vector<UncertainAmount> amounts;
  FoundColumns forms;
  for (const PlausibleError& error : plausible)
    for (const UncertainAmount& amount : error.amounts) {
      amounts.push_back(amount);
      forms.errors.push_back({amount.name, amount.unit(), 0.0});
    }
  forms.count = static_cast<Index>(amounts.size());
  MatrixXd random = amount_columns(fit.problem, geometry, amounts);
  weigh(fit.problem, random);
  RandomEffects effects = regress(fit.solution.residuals, fixed, random, groups_of(plausible),
                                  fit.problem.noise_stated);
  out.base = std::move(effects.fixed);
  out.covariance = std::move(effects.covariance);
  out.found.push_back(std::move(forms));
  for (std::size_t k = 0; k < amounts.size(); ++k)
    add_amount(out.errors, amounts[k], effects.random[static_cast<Index>(k)]);
  for (ErrorTerm& one : out.errors) one.known_over = measured_over(fit.problem, one);
  return out;
}

/// Base and found terms fitted together: linear about the base's solution, whose second order in
/// effects of 10 µm stays below a nanometre.
void fit_jointly(const TipFit& fit, const Geometry& geometry, const Found& search,
                 const std::vector<MachineFinding>& findings, MachineDiagnosis& out) {
  const Problem& problem = fit.problem;
  MatrixXd columns = fit.solution.jacobian;
  std::vector<FoundColumns> found;
  for (const std::size_t t : search.found) {
    const MatrixXd& own = search.terms[t].columns;
    found.push_back({own.cols(), search.terms[t].errors});
    columns.conservativeResize(Eigen::NoChange, columns.cols() + own.cols());
    columns.rightCols(own.cols()) = linear::scaled_rows(problem.weights, own);
  }
  const VectorXd& readings = fit.solution.residuals;
  const auto [x, inverse, rank] = linear::shortest_solution(columns, readings);
  const VectorXd left = readings - columns * x;
  const double freedom = static_cast<double>(columns.rows() - rank);
  const double variance = left.squaredNorm() / freedom;
  const bool sure = fit.problem.read_outs() || std::ranges::all_of(search.found, [&](auto t) {
                      return is_sure(search.terms[t]);
                    });
  const JointFit joint =
      sure ? JointFit{x, linear::product_transposed(variance * inverse, inverse), found, {}}
           : with_open_forms(fit, geometry, search, findings);
  const auto& kept = fit.solution.determined.kept;
  out.errors = fit.given;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Unknown& one = fit.unknowns[kept[k]];
    const auto at = static_cast<Index>(k);
    const double value =
        fit.solution.unknowns[static_cast<Index>(kept[k])] + joint.base[at] * one.largest;
    const double u = std::sqrt(joint.covariance(at, at)) * one.largest;
    out.extended.push_back({one.name, {value, u, one.unit.name.angular() ? "rad" : "mm", ""}});
    ErrorTerm term = one.unit;
    term.function = scaled(term.function, value);
    out.errors.terms.push_back(std::move(term));
  }
  out.errors.terms.insert(out.errors.terms.end(), joint.errors.begin(), joint.errors.end());
  state_covariance(fit, joint.found, joint.covariance, out.errors);
  const VectorXd sigma = problem.weights.cwiseInverse();
  out.gain.rms_before_mm = problem.rms_mm(readings.cwiseProduct(sigma));
  out.gain.rms_after_mm = problem.rms_mm(left.cwiseProduct(sigma));
  out.noise_mm = std::sqrt(variance) * problem.rms_mm(sigma);
  hold_out(problem, columns, fit.solution.jacobian.cols(), readings, out);
}

/// If a machine warmed up while it was measured, errors of axes found with a course in time may be
/// part of that course. They are not errors of the machine as it is, and are not written.
void leave_out_what_warms(Found& search) {
  const bool warms = std::ranges::any_of(search.found, [&](std::size_t t) {
    return search.terms[t].letters.find('t') != std::string::npos;
  });
  if (!warms) return;
  for (const std::size_t t : search.found) search.terms[t].errors.clear();
}

std::vector<MachineFinding> findings_of(const Found& search) {
  std::vector<MachineFinding> all;
  for (std::size_t at = 0; at < search.found.size(); ++at)
    all.push_back(finding_of(*search.dictionary, search.terms, search.found, at, search.options));
  return all;
}

/// χ² of all that is left: p if the stated noise does not explain the scatter.
std::optional<double> scatter(const TipFit& fit, const Found& search, double false_alarm) {
  if (!fit.problem.noise_stated) return {};
  const infer::Solution all = search.dictionary->fitted(search.found);
  const auto freedom = static_cast<double>(search.dictionary->rows() - all.rank);
  const double p = infer::Family{1.0 / infer::share_of_scatter}.p_value(
      cdf(complement(boost::math::chi_squared(freedom), all.rss)));
  if (p >= false_alarm) return {};
  return p;
}

void state_findings(const TipFit& fit, const Found& search, const std::vector<MachineFinding>& all,
                    const std::vector<bool>& unknown, const std::optional<Unexplained>& unexplained,
                    MachineDiagnosis& out) {
  const double to_rms = fit.problem.rms_mm(fit.problem.weights.cwiseInverse()) /
                        std::sqrt(static_cast<double>(fit.problem.equations));
  for (std::size_t at = 0; at < search.found.size(); ++at) {
    const Term& term = search.terms[search.found[at]];
    MachineFinding found = all[at];
    found.rms_mm *= to_rms;
    if (fit.problem.read_outs() || is_sure(term))
      out.errors.terms.insert(out.errors.terms.end(), found.errors.begin(), found.errors.end());
    weigh_aliases(fit.problem, term, found);
    found.pairs = pairs_like(*search.dictionary, search.terms, search.found, at, found);
    if (unknown[at])
      out.unexplained.push_back(unexplained->pattern(term, found));
    else
      out.findings.push_back(std::move(found));
  }
  std::ranges::stable_sort(out.findings, {}, &MachineFinding::p_value);
  std::ranges::stable_sort(out.unexplained, {}, &MachineUnexplained::p_value);
}

}  // namespace
}  // namespace calibrate_detail

bool is_machine_error(const MachineTerm& term) {
  const auto* error = std::get_if<ErrorOfPosition>(&term);
  return error != nullptr && !error->of;
}

bool form_is_sure(const MachineTerm& term) {
  const auto* error = std::get_if<ErrorOfPosition>(&term);
  return error == nullptr || error->of || !is_rotary(static_cast<AxisName>(error->error.body)) ||
         error->functions.empty() ||
         !std::holds_alternative<PolynomialError>(error->functions.front());
}

std::optional<AxisName> axis_of(const MachineTerm& term) {
  if (const auto* sense = std::get_if<ErrorOfSense>(&term)) return sense->axis;
  if (const auto* drift = std::get_if<ZeroDrift>(&term)) return drift->axis;
  if (const auto* step = std::get_if<ZeroStep>(&term)) return step->axis;
  if (const auto* scale = std::get_if<ZeroScale>(&term)) return scale->axis;
  const auto* error = std::get_if<ErrorOfPosition>(&term);
  if (error == nullptr) return std::nullopt;
  return error->of.value_or(static_cast<AxisName>(error->error.body));
}

const MachinePlan* MachineDiagnosis::next() const {
  const auto plan = std::ranges::find(plans, next_plan, &MachinePlan::code);
  return next_plan.empty() || plan == plans.end() ? nullptr : &*plan;
}

std::vector<std::string> MachineNotObservable::plans() const {
  std::vector<std::string> codes;
  if (!separate_with || separate_with->plan.empty()) return codes;
  codes.push_back(separate_with->plan);
  for (const Separating::Other& other : separate_with->others) codes.push_back(other.plan);
  return codes;
}

MachineDiagnosis diagnose_machine(const Machine& machine, std::span<const MachineMeasurement> data,
                                  const MachineDiagnoseOptions& options) {
  using namespace calibrate_detail;
  MachineDiagnosis out;
  if (options.covariances && read_outs_alone(data))
    throw InputError(
        data.front().source,
        "is a read-out, which leaves most errors of the tip unknown, so no program is "
        "weighed by it: add a measurement of kind ball, bar or array, or run `trueaxis "
        "machine diagnose` without a program");
  out.false_alarm = options.false_alarm;
  out.baseline = of_read_outs(machine, data, options.calibration);
  const auto fit = fit_tips(machine, data, options.calibration, false, out.baseline);
  expects(fit.has_value(), "a measurement");
  const bool timed = std::ranges::none_of(data, [&](const MachineMeasurement& file) {
    return file.time_s.empty() && (file.kind != MeasurementKind::axis || fit->problem.read_outs());
  });
  const Geometry geometry = geometry_of(fit->problem, out.baseline.errors, fit->solution.places);
  out.effects = machine_effects(fit->problem, timed, options.own_effects);
  Found found = find_terms(*fit, geometry, out.effects, options, timed);
  leave_out_what_warms(found);
  out.hypotheses = static_cast<std::size_t>(found.options.tests + found.options.pattern_tests) + 1;
  out.threshold = found.options.effects().single_level(options.false_alarm);
  const std::vector<MachineFinding> findings = findings_of(found);
  fit_jointly(*fit, geometry, found, findings, out);
  const std::vector<bool> unknown = parts_of_unknown(found, findings, fit->problem.read_outs());
  const std::optional<double> scatter_p = scatter(*fit, found, options.false_alarm);
  std::optional<Calibration> counted;
  std::optional<Unexplained> unexplained;
  if (scatter_p || std::ranges::find(unknown, true) != unknown.end())
    unexplained.emplace(*fit, counted.emplace(calibrate(machine, data, options.calibration)));
  state_findings(*fit, found, findings, unknown, unexplained, out);
  if (scatter_p) {
    const auto rank = found.dictionary->fitted(found.found).rank;
    out.unexplained.push_back(unexplained->scatter(
        out.noise_mm, static_cast<double>(found.dictionary->rows() - rank), *scatter_p));
  }
  // With something unknown, names and sizes of the rest are not sure. A calibration of the
  // readings, which counts what it does not fit, predicts the tip elsewhere better.
  if (counted) out.errors = std::move(counted->errors);
  out.effective_hypotheses = found.dictionary->independent_tests();
  out.typical_length_mm = options.typical_length_mm;
  out.typical_angle_rad = options.typical_angle_rad;
  add_checks(*fit, *found.dictionary, found.found, timed, options.calibration, out);
  add_remarks(out);
  out.verdict = verdict_of(!out.findings.empty(), !out.unexplained.empty());
  advise({*fit, data, options, found.options, found.dictionary->variance(found.found), found.found},
         *found.dictionary, found.terms, out);
  return out;
}

}  // namespace trueaxis
