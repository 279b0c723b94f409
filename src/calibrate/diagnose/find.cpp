// SPDX-License-Identifier: Apache-2.0
#include "calibrate/diagnose/find.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "calibrate/diagnose/pattern_scan.hpp"
#include "infer/stepwise.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::calibrate_detail {
namespace {

constexpr std::size_t patterns_a_set = 12, most_rounds = 3;
constexpr double least_turns = 1.0 / 360.0;  // to which a period is found, over the range

class Finder {
 public:
  Finder(const TipFit& fit, const Geometry& geometry, const std::vector<MachineEffect>& catalogue,
         const MachineDiagnoseOptions& options, bool timed)
      : fit_(fit), geometry_(geometry), options_(options), catalogue_(catalogue) {
    out_.terms = effect_terms(fit.problem, geometry, catalogue);
    out_.dictionary = of(out_.terms);
    out_.options = {options.false_alarm, out_.dictionary->tests(), 1.0, options.max_findings};
    search_again();
    scan_.emplace(fit.problem, geometry, out_.dictionary->basis(), timed);
    out_.options.pattern_tests = static_cast<double>(scan_->size() + equations());
  }

  Found found() {
    for (std::size_t round = 0; round < most_rounds && add_patterns(); ++round) search_again();
    return std::move(out_);
  }

 private:
  infer::Dictionary of(const std::vector<Term>& terms) const {
    infer::Dictionary out =
        dictionary_of(terms, fit_.solution.jacobian, fit_.problem.weights, options_.calibration);
    out.take(fit_.solution.residuals);
    return out;
  }

  void search_again() {
    out_.found = infer::search(*out_.dictionary, out_.options);
    for (bool again = true; again;) {
      bool moved = false;
      for (const std::size_t t : Set(out_.found)) moved = refine(t) || moved;
      if (!moved) return;
      out_.dictionary = of(out_.terms);
      out_.found = infer::search(*out_.dictionary, out_.options);
      // What a coarse period leaves is not searched for another cause.
      again = std::ranges::any_of(out_.found, [&](std::size_t t) { return is_coarse(t); });
    }
  }

  /// Of a periodic error whose period may be half a degree of phase better at an end of the range.
  bool is_coarse(std::size_t t) const {
    const Term& term = out_.terms[t];
    return term.is_periodic() && term.reach * range_of_axis(term) > least_turns;
  }
  double range_of_axis(const Term& term) const {
    const auto axis = static_cast<AxisName>(std::get<ErrorOfPosition>(term.of.term).error.body);
    return axis_range(fit_.problem, axis).length();
  }
  /// Whether two periods are one to the resolution of their axis.
  bool are_one(std::size_t a, std::size_t b) const {
    const Term &one = out_.terms[a], &other = out_.terms[b];
    return one.is_periodic() && one.effect() == other.effect() &&
           std::abs(1.0 / one.period() - 1.0 / other.period()) * range_of_axis(one) < 1.5;
  }

  /// Places near that of a term, to which it may be moved.
  std::vector<Term> finer(const Term& term) const {
    if (scan_ && term.is_pattern()) return scan_->finer(term);
    std::vector<Term> out;
    if (term.is_periodic()) {
      if (term.reach * range_of_axis(term) > least_turns) return near_period(term);
      return out;
    }
    if (!term.is_slip() || term.tests <= 1.0) return out;
    const auto reach = static_cast<std::size_t>(4.0 * term.tests) + 4;
    for (std::size_t row = 1; row < fit_.problem.rows.size(); ++row)
      if (fit_.problem.rows[row].target == term.target && row + reach > term.row &&
          row < term.row + reach)
        out.push_back(slip_term(fit_.problem, geometry_, term.of, term.target, row));
    return out;
  }

  /// Periods within the step of those that were tried.
  std::vector<Term> near_period(const Term& term) const {
    constexpr int places = 20;
    const auto entry = std::ranges::find(catalogue_, term.effect(), &MachineEffect::id);
    std::vector<Term> out;
    for (int i = -places; i <= places; ++i) {
      out.push_back(periodic_term(fit_.problem, geometry_, *entry,
                                  1.0 / (1.0 / term.period() + term.reach * i / places)));
      out.back().reach = term.reach / places;
    }
    return out;
  }

  bool refine(std::size_t at) {
    std::vector<Term> near = finer(out_.terms[at]);
    if (near.empty()) return false;
    Set others;
    const std::size_t first = near.size();
    for (const std::size_t t : out_.found) {
      if (t == at || are_one(t, at)) continue;
      others.push_back(near.size());
      near.push_back(out_.terms[t]);
    }
    const infer::Dictionary dictionary = of(near);
    std::size_t best = 0;
    double most = -1.0;
    for (std::size_t t = 0; t < first; ++t) {
      auto with = others;
      with.push_back(t);
      if (const double gain = dictionary.gain(with); gain > most) most = gain, best = t;
    }
    out_.terms[at] = std::move(near[best]);
    return true;
  }

  std::size_t equations() const { return static_cast<std::size_t>(fit_.problem.equations); }

  /// The number of a row that is furthest off after a set, over its own σ there.
  Index furthest_off(const infer::Dictionary& dictionary, const Set& set) const {
    const MatrixXd columns = dictionary.columns(set), base = dictionary.basis();
    VectorXd freedom = VectorXd::Ones(base.rows()) - base.rowwise().squaredNorm();
    VectorXd left = dictionary.residuals();
    if (columns.cols() > 0) {
      const MatrixXd basis = linear::orthonormal_basis(columns, 1e-6);
      freedom -= basis.rowwise().squaredNorm();
      left = linear::beside(basis, left);
    }
    // What is fitted through one reading says nothing of it.
    Index at = 0;
    (freedom.array() > 1e-6).select(left.array().square() / freedom.array(), 0.0).maxCoeff(&at);
    return at;
  }

  /// Whether an effect makes all but a fiftieth of a pattern.
  static bool made_by_effect(const infer::Dictionary& dictionary, std::size_t pattern) {
    const auto& own = dictionary.block(pattern);
    for (std::size_t t = 0; t < dictionary.size(); ++t) {
      const auto& effect = dictionary.block(t);
      if (effect.pattern || own.columns.empty() || effect.columns.empty()) continue;
      const double part = MatrixXd(dictionary.gram()(effect.columns, own.columns)).squaredNorm();
      if (part > 0.98 * static_cast<double>(own.columns.size())) return true;
    }
    return false;
  }

  /// @returns whether one of them passes after the terms that the search had
  bool add_patterns() {
    const infer::Dictionary& now = *out_.dictionary;
    std::vector<Set> sets{{}, out_.found};
    for (std::size_t i = 0; out_.found.size() > 1 && i < out_.found.size(); ++i)
      sets.push_back(infer::without(out_.found, i));
    if (out_.found.empty()) sets.pop_back();
    const std::size_t before = out_.terms.size();
    std::vector<std::pair<std::size_t, Set>> looked;
    for (const Set& set : sets)
      for (const std::size_t entry :
           scan_->best(now.columns(set), now.residuals(), patterns_a_set)) {
        if (std::ranges::find(taken_, entry) != taken_.end()) continue;
        taken_.push_back(entry);
        looked.emplace_back(out_.terms.size(), set);
        out_.terms.push_back(scan_->term(entry));
        // One of many more than there are effects.
        out_.terms.back().tests = out_.options.pattern_tests / out_.options.tests;
      }
    for (const Set& set : sets) {
      const Index equation = furthest_off(now, set);
      if (std::ranges::find(readings_, equation) != readings_.end()) continue;
      readings_.push_back(equation);
      looked.emplace_back(out_.terms.size(), set);
      out_.terms.push_back(reading_term(fit_.problem, equation));
      out_.terms.back().tests = out_.options.pattern_tests / out_.options.tests;
    }
    if (looked.empty()) return false;
    infer::Dictionary wider = of(out_.terms);
    for (const auto& [term, set] : looked)
      wider.bar(term, out_.terms[term].barred = made_by_effect(wider, term));
    const bool passes = std::ranges::any_of(looked, [&](const auto& one) {
      const auto& [term, set] = one;
      return !out_.terms[term].barred &&
             infer::family_p(wider, out_.options, wider.beside(set), term) < options_.false_alarm;
    });
    if (!passes) {
      out_.terms.resize(before);
      return false;
    }
    out_.dictionary = std::move(wider);
    return true;
  }

  const TipFit& fit_;
  const Geometry& geometry_;
  const MachineDiagnoseOptions& options_;
  const std::vector<MachineEffect>& catalogue_;
  Found out_;
  std::optional<PatternScan> scan_;
  std::vector<std::size_t> taken_;
  std::vector<Index> readings_;  ///< numbers that were tried as off
};

}  // namespace

Found find_terms(const TipFit& fit, const Geometry& geometry,
                 const std::vector<MachineEffect>& catalogue, const MachineDiagnoseOptions& options,
                 bool timed) {
  return Finder(fit, geometry, catalogue, options, timed).found();
}

}  // namespace trueaxis::calibrate_detail
