// SPDX-License-Identifier: Apache-2.0
#include "calibrate/diagnose/find.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "calibrate/diagnose/pattern.hpp"
#include "infer/stepwise.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::calibrate_detail {
namespace {

/// Patterns that no effect makes, thousands of them, each as a gain only. A pattern is an error of
/// an axis (or a shift of the tip or the part) times functions of the row. Its products with
/// whatever is fitted are therefore sums over the rows of few columns (Eq. 184).
class PatternScan {
 public:
  PatternScan(const Problem& problem, const Geometry& geometry, const MatrixXd& base, bool timed);

  std::size_t size() const { return entries_.size(); }

  /// The best patterns after columns that are orthogonal to the base, by what they gain less their
  /// price. @param beside over σ, of any rank
  std::vector<std::size_t> best(const MatrixXd& beside, const VectorXd& residuals,
                                std::size_t most) const;

  Term term(std::size_t entry) const;
  /// The same pattern at places near its own; empty where it has none.
  std::vector<Term> finer(const Term& term) const;

 private:
  struct Entry {
    std::size_t unit = 0, function = 0;
    MatrixXd products;  ///< of its columns after the base
  };
  void add(std::size_t unit, const std::vector<std::size_t>& functions);
  std::vector<std::size_t> keep(std::vector<PatternFunction> functions);
  MatrixXd folded(std::size_t unit, const MatrixXd& columns) const;
  Term term_of(std::size_t unit, const PatternFunction& function) const;

  const Problem& problem_;
  MatrixXd units_;    ///< columns over σ: six errors an axis, the tip's shifts, the part's
  MatrixXd raw_;      ///< the same, per mm or rad
  MatrixXd squares_;  ///< of each row and unit
  MatrixXd base_;
  std::vector<PatternFunction> functions_;
  std::vector<Entry> entries_;
};

constexpr double least_part = 1e-3;  // of a pattern that the base leaves, over what it is

PatternScan::PatternScan(const Problem& problem, const Geometry& geometry, const MatrixXd& base,
                         bool timed)
    : problem_(problem), base_(base) {
  raw_.resize(problem.equations, geometry.unit_errors.cols() + 6);
  raw_ << geometry.unit_errors, geometry.tip_shift, geometry.part_shift;
  units_ = problem.weights.asDiagonal() * raw_;
  squares_.resize(static_cast<Index>(problem.rows.size()), units_.cols());
  for (Index i = 0; i < squares_.rows(); ++i) {
    const Row& row = problem.rows[static_cast<std::size_t>(i)];
    squares_.row(i) = units_.middleRows(row.first, row.equations()).colwise().squaredNorm();
  }
  const std::size_t axes = problem.machine->axes.size();
  const auto moves = [&](std::size_t k) {
    return axis_range(problem, problem.machine->axes[k].name).length() > 1e-6;
  };
  for (std::size_t k = 0; k < axes; ++k) {
    if (!moves(k)) continue;
    const bool rotary = is_rotary(problem.machine->axes[k].name);
    const auto own = keep(functions_of_axis(problem, k, 3));
    const auto angles = rotary ? own : keep(functions_of_axis(problem, k, 2));
    for (std::size_t direction = 0; direction < 6; ++direction)
      add(6 * k + direction, direction < 3 ? own : angles);
    for (std::size_t other = 0; other < k; ++other) {
      if (!moves(other) || problem.read_outs()) continue;
      const auto both = keep(functions_of_two(problem, k, other));
      for (std::size_t direction = 0; direction < 6; ++direction) {
        add(6 * k + direction, both);
        add(6 * other + direction, both);
      }
    }
  }
  if (!timed) return;
  const auto courses = keep(functions_of_time(problem));
  for (std::size_t unit = 0; unit < 6 * axes + 6; ++unit) add(unit, courses);
  for (std::size_t k = 0; k < axes; ++k) {
    if (!moves(k)) continue;
    const auto growing = keep(growths(problem, k));
    for (std::size_t direction = 0; direction < 6; ++direction) add(6 * k + direction, growing);
  }
}

std::vector<std::size_t> PatternScan::keep(std::vector<PatternFunction> functions) {
  std::vector<std::size_t> at;
  for (PatternFunction& one : functions) {
    at.push_back(functions_.size());
    functions_.push_back(std::move(one));
  }
  return at;
}

MatrixXd PatternScan::folded(std::size_t unit, const MatrixXd& columns) const {
  MatrixXd out(static_cast<Index>(problem_.rows.size()), columns.cols());
  for (Index i = 0; i < out.rows(); ++i) {
    const Row& row = problem_.rows[static_cast<std::size_t>(i)];
    out.row(i) =
        units_.col(static_cast<Index>(unit)).segment(row.first, row.equations()).transpose() *
        columns.middleRows(row.first, row.equations());
  }
  return out;
}

void PatternScan::add(std::size_t unit, const std::vector<std::size_t>& functions) {
  const VectorXd square = squares_.col(static_cast<Index>(unit));
  if (!(square.maxCoeff() > 0.0)) return;
  const MatrixXd with_base = folded(unit, base_);
  for (const std::size_t f : functions) {
    const MatrixXd& w = functions_[f].values;
    const MatrixXd cross = linear::transposed_product(with_base, w);
    const MatrixXd whole = linear::transposed_product(linear::scaled_rows(square, w), w);
    MatrixXd left = whole - linear::gram(cross);
    if (left.trace() > least_part * whole.trace()) entries_.push_back({unit, f, std::move(left)});
  }
}

std::vector<std::size_t> PatternScan::best(const MatrixXd& beside, const VectorXd& residuals,
                                           std::size_t most) const {
  MatrixXd columns(beside.rows(), beside.cols() + 1);
  Index rank = 0;
  if (beside.cols() > 0) {
    const MatrixXd basis = linear::orthonormal_basis(beside, 1e-6);
    rank = basis.cols();
    columns.leftCols(rank) = basis;
  }
  const MatrixXd q = columns.leftCols(rank);
  columns.conservativeResize(Eigen::NoChange, rank + 1);
  columns.col(rank) = linear::beside(q, residuals);
  std::vector<std::pair<double, std::size_t>> scores;
  MatrixXd fold;
  std::size_t folded_unit = static_cast<std::size_t>(-1);
  for (std::size_t e = 0; e < entries_.size(); ++e) {
    const Entry& entry = entries_[e];
    if (entry.unit != folded_unit) fold = folded(folded_unit = entry.unit, columns);
    const MatrixXd products = linear::transposed_product(fold, functions_[entry.function].values);
    const MatrixXd cross = products.topRows(rank);
    const MatrixXd left = entry.products - linear::gram(cross);
    const VectorXd right = products.row(rank).transpose();
    // To orthonormal columns: what others take up wholly is dropped by its share.
    const linear::Spectrum of = linear::spectrum(left);
    double gain = 0.0;
    for (Index k = 0; k < left.rows(); ++k) {
      if (!(of.values[k] > least_part * entry.products.trace())) continue;
      const double along = of.vectors.col(k).dot(right);
      gain += along * along / of.values[k];
    }
    // Of two alike (orders that the positions alias) the first stays.
    const double score = 2.0 * static_cast<double>(left.rows()) - gain;
    scores.emplace_back(std::round(1e5 * score), e);
  }
  std::ranges::sort(scores);
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < std::min(most, scores.size()); ++i) out.push_back(scores[i].second);
  return out;
}

Term PatternScan::term_of(std::size_t unit, const PatternFunction& function) const {
  const auto& axes = problem_.machine->axes;
  Term term;
  term.unit = unit;
  term.place = function.place;
  term.letters = function.letters;
  term.of.formula = "amplitude times " + function.words;
  const std::size_t k = unit / 6, direction = unit % 6;
  if (k < axes.size()) {
    const ErrorName name{true, direction, index_of(axes[k].name)};
    term.of.id = to_string(name) + ": " + function.words;
    if (name.angular()) term.of.unit = "rad";
    term.letters += letter_of(axes[k].name);
    for (const ErrorFunction& one : function.functions) term.errors.push_back({name, one, 0.0});
  } else {
    term.of.id = std::string(direction < 3 ? "machine " : "part ") + "XYZ"[direction % 3] + ": " +
                 function.words;
  }
  term.columns.resize(problem_.equations, function.values.cols());
  for (std::size_t i = 0; i < problem_.rows.size(); ++i) {
    const Row& row = problem_.rows[i];
    term.columns.middleRows(row.first, row.equations()) =
        raw_.col(static_cast<Index>(unit)).segment(row.first, row.equations()) *
        function.values.row(static_cast<Index>(i));
  }
  term.of.parameters.assign(static_cast<std::size_t>(function.values.cols()), "amplitude");
  return term;
}

Term PatternScan::term(std::size_t entry) const {
  return term_of(entries_[entry].unit, functions_[entries_[entry].function]);
}

std::vector<Term> PatternScan::finer(const Term& term) const {
  std::vector<Term> out;
  if (!term.place) return out;
  for (const PatternFunction& one : near(problem_, *term.place)) {
    out.push_back(term_of(term.unit, one));
    out.back().tests = term.tests;
  }
  return out;
}

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
    out_.options.pattern_tests = static_cast<double>(std::max<std::size_t>(1, scan_->size()));
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
};

}  // namespace

Found find_terms(const TipFit& fit, const Geometry& geometry,
                 const std::vector<MachineEffect>& catalogue, const MachineDiagnoseOptions& options,
                 bool timed) {
  return Finder(fit, geometry, catalogue, options, timed).found();
}

}  // namespace trueaxis::calibrate_detail
