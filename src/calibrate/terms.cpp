// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "calibrate/term.hpp"

namespace trueaxis::calibrate_detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double least_range = 1e-6;        // of an axis that moved
constexpr std::size_t slips_a_target = 16;  // tried in the search, then refined

/// Columns times a function of the row.
template <class Function>
MatrixXd times_rows(const Problem& problem, const MatrixXd& columns, const Function& value) {
  MatrixXd out = columns;
  for (const Row& row : problem.rows) out.middleRows(row.first, row.equations()) *= value(row);
  return out;
}

Term of_errors(const Problem& problem, const Geometry& geometry, std::size_t k,
               const std::string& effect, std::vector<ErrorTerm> errors) {
  Term term;
  term.effect = effect;
  term.angle = errors.front().name.angular();
  term.columns.resize(problem.equations, static_cast<Index>(errors.size()));
  for (std::size_t i = 0; i < errors.size(); ++i)
    term.columns.col(static_cast<Index>(i)) = error_column(problem, geometry, k, errors[i]);
  term.parameters = errors.size() == 2 ? std::vector<std::string>{"cos", "sin"}
                                       : std::vector<std::string>{"legendre"};
  term.errors = std::move(errors);
  return term;
}

void add_polynomials(const Problem& problem, const Geometry& geometry, std::size_t k, int last,
                     std::size_t direction, std::vector<Term>& terms) {
  const AxisName axis = problem.machine->axes[k].name;
  const AxisRange range = axis_range(problem, axis);
  const ErrorName name{true, direction, index_of(axis)};
  const bool squareness = !is_rotary(axis) && direction < 3 && direction != index_of(axis);
  const char* const unit = is_rotary(axis) ? "rad" : "mm";
  for (int degree = squareness ? 2 : 1; degree <= last; ++degree) {
    terms.push_back(of_errors(problem, geometry, k,
                              to_string(name) + ".poly" + std::to_string(degree),
                              {{name, legendre(degree, range.low, range.high), 0.0}}));
    terms.back().formula = "legendre P_degree((2 q - low - high)/(high - low))";
    terms.back().shape = {{"degree", static_cast<double>(degree), "1"},
                          {"low", range.low, unit},
                          {"high", range.high, unit}};
  }
}

void add_harmonics(const Problem& problem, const Geometry& geometry, std::size_t k,
                   std::size_t direction, std::vector<Term>& terms) {
  const ErrorName name{true, direction, index_of(problem.machine->axes[k].name)};
  for (int order = 1; order <= 4; ++order) {
    terms.push_back(
        of_errors(problem, geometry, k, to_string(name) + ".harmonic" + std::to_string(order),
                  {{name, FourierError{{{static_cast<double>(order), 1.0, 0.0}}, two_pi}, 0.0},
                   {name, FourierError{{{static_cast<double>(order), 0.0, 1.0}}, two_pi}, 0.0}}));
    terms.back().formula = "cos cos(order q) + sin sin(order q)";
    terms.back().shape = {{"order", static_cast<double>(order), "1"}};
  }
}

/// The way in which an axis goes first: that in which it is taken to have come before.
double first_way(const Problem& problem, std::size_t axis) {
  for (const Row& row : problem.rows) {
    const double move = row.axes[axis] - problem.rows.front().axes[axis];
    if (std::abs(move) > 1e-9) return move > 0.0 ? 0.5 : -0.5;
  }
  return 0.0;
}

/// + or − half by the way in which the axis came, which files that follow each other go on with.
void add_reversal(const Problem& problem, const Geometry& geometry, std::size_t k,
                  std::vector<Term>& terms) {
  const MachineAxis& axis = problem.machine->axes[k];
  const std::size_t index = index_of(axis.name), first = is_rotary(axis.name) ? 3 : 0;
  VectorXd own = VectorXd::Zero(problem.equations);
  for (std::size_t i = 0; i < 3; ++i)
    own += axis.direction[i] * geometry.unit_errors.col(static_cast<Index>(6 * k + first + i));
  double way = first_way(problem, index), last = problem.rows.front().axes[index];
  bool both = false;
  double seen = 0.0;
  Term term;
  term.columns = times_rows(problem, own, [&](const Row& row) {
    const double move = row.axes[index] - last;
    if (std::abs(move) > 1e-9) way = move > 0.0 ? 0.5 : -0.5;
    last = row.axes[index];
    both = both || (seen * way < 0.0);
    if (way != 0.0) seen = way;
    return way;
  });
  if (!both) return;
  term.effect = std::string("reversal.") + letter_of(axis.name);
  term.parameters = {"size"};
  term.formula = "size/2 where the axis came from below, -size/2 where from above";
  term.angle = first == 3;
  terms.push_back(std::move(term));
}

void add_drifts(const Problem& problem, const Geometry& geometry, std::vector<Term>& terms) {
  const auto [first, last] = std::ranges::minmax(problem.rows, {}, &Row::time_s);
  if (!(last.time_s > first.time_s)) return;
  const double begin = first.time_s, length = last.time_s - first.time_s;
  for (Index i = 0; i < 3; ++i) {
    Term term;
    term.effect = std::string("drift.") + "XYZ"[i];
    term.parameters = {"over_all"};
    term.formula = "over_all (t - begin)/(end - begin)";
    term.shape = {{"begin", begin, "s"}, {"end", begin + length, "s"}};
    term.columns = times_rows(problem, geometry.tip_shift.col(i),
                              [&](const Row& row) { return (row.time_s - begin) / length - 0.5; });
    terms.push_back(std::move(term));
  }
}

void add_slips(const Problem& problem, const Geometry& geometry, std::vector<Term>& terms) {
  for (std::size_t t = 0; t < problem.targets.size(); ++t) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < problem.rows.size(); ++i)
      if (problem.rows[i].target == t) rows.push_back(i);
    const std::size_t step = std::max<std::size_t>(1, rows.size() / slips_a_target);
    for (std::size_t i = step; i < rows.size(); i += step) {
      terms.push_back(slip_term(problem, geometry, t, rows[i]));
      terms.back().tests = static_cast<double>(step);
    }
  }
}

}  // namespace

VectorXd error_column(const Problem& problem, const Geometry& geometry, std::size_t k,
                      const ErrorTerm& error) {
  const std::size_t axis = error.name.body;
  return times_rows(problem,
                    geometry.unit_errors.col(static_cast<Index>(6 * k + error.name.direction)),
                    [&](const Row& row) { return value_at(error.function, row.axes[axis]); });
}

Term slip_term(const Problem& problem, const Geometry& geometry, std::size_t target,
               std::size_t row) {
  Term term;
  term.effect = "ball.slip";
  term.parameters = {"x", "y", "z"};
  term.formula = "(x, y, z) from the row on";
  const Row& from = problem.rows[row];
  term.shape = {{"file", static_cast<double>(from.file + 1), "1"},
                {"row", static_cast<double>(from.row + 1), "1"},
                {"setup", static_cast<double>(problem.targets[target].setup), "1"},
                {"ball", static_cast<double>(problem.targets[target].ball), "1"}};
  term.target = target;
  term.row = row;
  term.columns = geometry.part_shift;
  for (std::size_t i = 0; i < problem.rows.size(); ++i) {
    const Row& one = problem.rows[i];
    if (one.target != target || i < row)
      term.columns.middleRows(one.first, one.equations()).setZero();
  }
  return term;
}

std::vector<Term> effect_terms(const Problem& problem, const Geometry& geometry, bool timed) {
  std::vector<Term> terms;
  const auto& axes = problem.machine->axes;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const double length = axis_range(problem, axes[k].name).length();
    if (length < least_range) continue;
    for (std::size_t direction = 0; direction < 6; ++direction) {
      if (is_rotary(axes[k].name) && length >= whole_turn)
        add_harmonics(problem, geometry, k, direction, terms);
      else
        add_polynomials(problem, geometry, k, !is_rotary(axes[k].name) && direction >= 3 ? 2 : 3,
                        direction, terms);
    }
    add_reversal(problem, geometry, k, terms);
  }
  if (timed) add_drifts(problem, geometry, terms);
  add_slips(problem, geometry, terms);
  return terms;
}

}  // namespace trueaxis::calibrate_detail
