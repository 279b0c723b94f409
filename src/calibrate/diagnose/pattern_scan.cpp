// SPDX-License-Identifier: Apache-2.0
#include "calibrate/diagnose/pattern_scan.hpp"

#include <algorithm>
#include <cmath>

#include "math/linear_algebra.hpp"

namespace trueaxis::calibrate_detail {
namespace {

constexpr double least_part = 1e-3;  // of a pattern that the base leaves, over what it is

}  // namespace

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
    term.error = name;
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

}  // namespace trueaxis::calibrate_detail
