// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "calibrate/advise.hpp"
#include "calibrate/explain.hpp"
#include "calibrate/tip_fit.hpp"
#include "calibrate/total_uncertainty.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/machine_diagnosis.hpp"

namespace trueaxis {
namespace calibrate_detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double share_of_scatter = 0.1;  // of the false alarm: scatter against the stated noise

/// Terms, their products, and what was found.
struct Search {
  std::vector<Term> terms;
  std::optional<Regression> regression;
  Regression::Set found;
  SearchOptions options;
};

void make_regression(const TipFit& fit, const MachineDiagnoseOptions& options, Search& search) {
  search.regression.emplace(search.terms, fit.solution.jacobian, fit.problem.weights,
                            options.calibration.largest_length_mm,
                            options.calibration.largest_angle_rad);
  search.regression->take(fit.solution.residuals);
}

/// The slip that was found at one of the rows tried, moved to the row where it is; false: none was.
bool refine_slip(const TipFit& fit, const Geometry& geometry, const MachineDiagnoseOptions& options,
                 Search& search) {
  const auto slip = std::ranges::find_if(search.found, [&](std::size_t t) {
    return search.terms[t].effect == "ball.slip" && search.terms[t].tests > 1.0;
  });
  if (slip == search.found.end()) return false;
  Term& coarse = search.terms[*slip];
  Search near;
  Regression::Set others;
  for (const std::size_t t : search.found) {
    if (t == *slip) continue;
    others.push_back(near.terms.size());
    near.terms.push_back(search.terms[t]);
  }
  const std::size_t first = near.terms.size();
  const auto reach = static_cast<std::size_t>(4.0 * coarse.tests) + 4;
  for (std::size_t row = 1; row < fit.problem.rows.size(); ++row)
    if (fit.problem.rows[row].target == coarse.target && row + reach > coarse.row &&
        row < coarse.row + reach)
      near.terms.push_back(slip_term(fit.problem, geometry, coarse.target, row));
  make_regression(fit, options, near);
  std::size_t best = first;
  double most = -1.0;
  for (std::size_t t = first; t < near.terms.size(); ++t) {
    auto with = others;
    with.push_back(t);
    if (const double gain = near.regression->gain(with); gain > most) most = gain, best = t;
  }
  coarse = near.terms[best];
  return true;
}

Search search_for(const TipFit& fit, const Geometry& geometry,
                  const MachineDiagnoseOptions& options, bool timed) {
  Search out;
  out.terms = effect_terms(fit.problem, geometry, timed);
  std::vector<Term> patterns = pattern_terms(fit.problem, geometry);
  std::ranges::move(patterns, std::back_inserter(out.terms));
  make_regression(fit, options, out);
  out.options.tests = 0.0;
  for (std::size_t t = 0; t < out.terms.size(); ++t)
    if (out.regression->block(t).rank > 0) out.options.tests += out.terms[t].tests;
  out.options.tests = std::max(1.0, out.options.tests);
  out.options.false_alarm = options.false_alarm * (1.0 - share_of_scatter);
  out.options.most = options.max_findings;
  out.found = search(*out.regression, out.terms, out.options);
  if (refine_slip(fit, geometry, options, out)) {
    make_regression(fit, options, out);
    out.found = search(*out.regression, out.terms, out.options);
  }
  return out;
}

/// Base and found terms fitted together: linear beside the base's solution, whose second order in
/// effects of 10 µm stays below a nanometre.
void fit_jointly(const TipFit& fit, const Search& search, MachineDiagnosis& out) {
  const Problem& problem = fit.problem;
  MatrixXd columns = fit.solution.jacobian;
  for (const std::size_t t : search.found) {
    const MatrixXd& own = search.terms[t].columns;
    columns.conservativeResize(Eigen::NoChange, columns.cols() + own.cols());
    columns.rightCols(own.cols()) = problem.weights.asDiagonal() * own;
  }
  const VectorXd& readings = fit.solution.residuals;
  const Eigen::CompleteOrthogonalDecomposition<MatrixXd> qr(columns);
  const VectorXd x = qr.solve(readings);
  const VectorXd left = readings - columns * x;
  const double freedom = static_cast<double>(columns.rows() - qr.rank());
  const double variance = left.squaredNorm() / freedom;
  const MatrixXd inverse = qr.pseudoInverse();
  const auto& kept = fit.solution.determined.kept;
  out.errors = fit.given;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Unknown& one = fit.unknowns[kept[k]];
    const auto at = static_cast<Index>(k);
    const double value = fit.solution.unknowns[static_cast<Index>(kept[k])] + x[at] * one.largest;
    const double u = std::sqrt(variance) * inverse.row(at).norm() * one.largest;
    out.extended.push_back({one.name, {value, u, one.unit.name.angular() ? "rad" : "mm", ""}});
    ErrorTerm term = one.unit;
    term.function = scaled(term.function, value);
    out.errors.terms.push_back(std::move(term));
  }
  state_covariance(fit, search.terms, search.found, variance * inverse * inverse.transpose(),
                   out.errors);
  const VectorXd sigma = problem.weights.cwiseInverse();
  const auto n = static_cast<double>(problem.equations);
  out.rms_before_mm = std::sqrt(readings.cwiseProduct(sigma).squaredNorm() / n);
  out.rms_after_mm = std::sqrt(left.cwiseProduct(sigma).squaredNorm() / n);
  out.noise_mm = std::sqrt(variance * sigma.squaredNorm() / n);
  const HeldOutRms before = held_out(problem, fit.solution.jacobian, readings),
                   after = held_out(problem, columns, readings);
  out.held_out_before = before.rms;
  out.held_out_after = after.rms;
  out.blocks = after.blocks;
}

void state_findings(const TipFit& fit, const Search& search, MachineDiagnosis& out) {
  const double to_rms = std::sqrt(fit.problem.weights.cwiseInverse().squaredNorm()) /
                        static_cast<double>(fit.problem.equations);
  for (std::size_t at = 0; at < search.found.size(); ++at) {
    MachineFinding found =
        finding_of(*search.regression, search.terms, search.found, at, search.options);
    found.rms_mm *= to_rms;
    if (search.terms[search.found[at]].pattern) {
      double square = 0.0;
      for (const auto& one : found.parameters) square += one.estimate.u * one.estimate.u;
      out.unexplained.push_back(
          {found.effect,
           {found.size, std::sqrt(square / static_cast<double>(found.parameters.size())), "mm", ""},
           found.p_value});
      continue;
    }
    out.errors.terms.insert(out.errors.terms.end(), found.errors.begin(), found.errors.end());
    out.findings.push_back(std::move(found));
  }
  std::ranges::stable_sort(out.findings, {}, &MachineFinding::p_value);
}

/// Scatter that the stated noise does not explain: χ² of all that is left.
void judge_scatter(const TipFit& fit, const Search& search, const MachineDiagnoseOptions& options,
                   MachineDiagnosis& out) {
  if (!fit.problem.noise_stated) return;
  const Regression& r = *search.regression;
  const double freedom = r.freedom() - static_cast<double>(r.rank(search.found));
  const double p =
      cdf(complement(boost::math::chi_squared(freedom), r.rss() - r.gain(search.found)));
  if (p >= options.false_alarm * share_of_scatter) return;
  out.unexplained.push_back({"scatter above the noise that is stated",
                             {out.noise_mm, out.noise_mm / std::sqrt(2.0 * freedom), "mm", ""},
                             std::min(1.0, p / share_of_scatter)});
}

}  // namespace
}  // namespace calibrate_detail

std::vector<std::string> MachineFinding::members() const {
  std::vector<std::string> all{effect};
  for (const MachineRival& rival : rivals) all.push_back(rival.effect);
  return all;
}

const char* to_string(MachineVerdict verdict) {
  constexpr const char* names[] = {"ideal", "effects", "unexplained"};
  return names[static_cast<std::size_t>(verdict)];
}

MachineDiagnosis diagnose_machine(const Machine& machine, std::span<const MachineMeasurement> data,
                                  const MachineDiagnoseOptions& options) {
  using namespace calibrate_detail;
  MachineDiagnosis out;
  out.false_alarm = options.false_alarm;
  out.baseline = of_read_outs(machine, data, options.calibration);
  const auto fit = fit_tips(machine, data, options.calibration, false, out.baseline);
  if (!fit)
    throw InputError(data.front().source,
                     "is no measurement of balls: give one of kind ball, bar or array as well");
  const bool timed = std::ranges::none_of(data, [](const MachineMeasurement& file) {
    return file.kind != MeasurementKind::axis && file.time_s.empty();
  });
  const Geometry geometry = geometry_of(fit->problem, out.baseline.errors, fit->solution.places);
  const Search found = search_for(*fit, geometry, options, timed);
  out.hypotheses = static_cast<std::size_t>(found.options.tests) + 1;
  out.threshold = found.options.single_level();
  fit_jointly(*fit, found, out);
  state_findings(*fit, found, out);
  judge_scatter(*fit, found, options, out);
  out.verdict = !out.unexplained.empty() ? MachineVerdict::unexplained
                : !out.findings.empty()  ? MachineVerdict::effects
                                         : MachineVerdict::ideal;
  const double variance =
      (found.regression->rss() - found.regression->gain(found.found)) /
      (found.regression->freedom() - static_cast<double>(found.regression->rank(found.found)));
  advise({*fit, data, options, found.options, variance}, *found.regression, found.terms, out);
  return out;
}

}  // namespace trueaxis
