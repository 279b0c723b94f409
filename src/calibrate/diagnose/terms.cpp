// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibrate/diagnose/term.hpp"
#include "calibrate/estimate/read_out.hpp"
#include "infer/size_prior.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::calibrate_detail {
namespace {

constexpr std::size_t slips_a_target = 16;  // tried in the search, then refined

/// The way in which an axis goes first: that in which it is assumed to have come before.
double first_way(const Problem& problem, std::size_t axis) {
  const Row& first = *std::ranges::find(problem.rows, true, &Row::of_tip);
  for (const Row& row : problem.rows) {
    const double move = row.read_out ? 0.0 : row.axes[axis] - first.axes[axis];
    if (std::abs(move) > least_move) return move > 0.0 ? 0.5 : -0.5;
  }
  return 0.0;
}

/// Columns of every kind of term; a step of a ball has its own terms.
struct Columns {
  const Problem& problem;
  const Geometry& geometry;

  MatrixXd operator()(std::monostate) const { return {}; }
  MatrixXd operator()(const BallStep&) const { return {}; }
  MatrixXd operator()(const ZeroStep&) const { return {}; }

  /// A read-out's own zero times a function of the row.
  template <class Function>
  VectorXd of_read_out(AxisName axis, const Function& value) const {
    VectorXd out = VectorXd::Zero(problem.equations);
    for (const Row& row : problem.rows)
      if (row.read_out == axis) out[row.first] = value(row);
    return out;
  }

  MatrixXd operator()(const ZeroDrift& term) const {
    const TimeSpan times = times_of(problem, term.axis);
    return of_read_out(term.axis, [&](const Row& row) { return times.share(row.time_s) - 0.5; });
  }

  /// Half at an end of the range.
  MatrixXd operator()(const ZeroScale& term) const {
    const auto position = [&](const Row& row) { return row.axes[index_of(term.axis)]; };
    AxisRange range{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
    for (const Row& row : problem.rows)
      if (row.read_out == term.axis)
        range = {std::min(range.low, position(row)), std::max(range.high, position(row))};
    return of_read_out(term.axis, [&](const Row& row) {
      return (position(row) - range.low) / range.length() - 0.5;
    });
  }

  MatrixXd operator()(const ErrorOfPosition& term) const {
    MatrixXd out(problem.equations, static_cast<Index>(term.functions.size()));
    for (std::size_t i = 0; i < term.functions.size(); ++i)
      out.col(static_cast<Index>(i)) =
          error_column(problem, geometry, {term.error, term.functions[i], 0.0}, term.of);
    return out;
  }

  /// + or − half by the way in which the axis came, which files that follow each other go on with.
  MatrixXd operator()(const ErrorOfSense& term) const {
    if (problem.read_outs())
      return of_read_out(term.axis, [](const Row& row) { return row.sense; });
    const std::size_t index = index_of(term.axis), first = is_rotary(term.axis) ? 3 : 0;
    const auto& axes = problem.machine->axes;
    const auto axis = std::ranges::find(axes, term.axis, &MachineAxis::name);
    const auto k = static_cast<std::size_t>(axis - axes.begin());
    VectorXd own = VectorXd::Zero(problem.equations);
    for (std::size_t i = 0; i < 3; ++i)
      own += axis->direction[i] * geometry.unit_errors.col(static_cast<Index>(6 * k + first + i));
    double way = first_way(problem, index);
    double last = std::ranges::find(problem.rows, true, &Row::of_tip)->axes[index];
    return times_rows(problem, own, [&](const Row& row) {
      if (row.read_out) return 0.0;  // its own reversal value is always fitted
      const double move = row.axes[index] - last;
      if (std::abs(move) > least_move) way = move > 0.0 ? 0.5 : -0.5;
      last = row.axes[index];
      return way;
    });
  }

  MatrixXd operator()(const TipDrift& term) const {
    const TimeSpan times = times_of_tip(problem);
    return times_rows(problem, geometry.tip_shift.col(static_cast<Index>(term.direction)),
                      [&](const Row& row) { return times.share(row.time_s) - 0.5; });
  }
};

/// @param problem where an error is known
Term term_of(const Problem& problem, const MachineEffect& of) {
  Term term;
  term.of = of;
  if (of.low > 0.0) {
    const bool pair = of.parameters.size() == 2;  // cos and sin share their size
    term.size_median = std::sqrt(of.low * of.high) / (pair ? std::sqrt(2.0) : 1.0);
    term.size_spread = infer::spread_of_size(std::log(of.high / of.low));
  }
  const auto* error = std::get_if<ErrorOfPosition>(&of.term);
  for (std::size_t i = 0; error != nullptr && !error->of && i < error->functions.size(); ++i)
    term.errors.push_back({error->error, error->functions[i], 0.0});
  for (ErrorTerm& one : term.errors) one.known_over = measured_over(problem, one);
  return term;
}

void add_slips(const Problem& problem, const Geometry& geometry, const MachineEffect& of,
               std::vector<Term>& terms) {
  for (std::size_t t = 0; t < problem.targets.size(); ++t) {
    const auto* zero = std::get_if<ZeroStep>(&of.term);
    if (problem.targets[t].zero != (zero != nullptr)) continue;
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < problem.rows.size(); ++i)
      if (problem.rows[i].target == t && (!zero || problem.rows[i].read_out == zero->axis))
        rows.push_back(i);
    const std::size_t step = std::max<std::size_t>(1, rows.size() / slips_a_target);
    for (std::size_t i = step; i < rows.size(); i += step) {
      terms.push_back(slip_term(problem, geometry, of, t, rows[i]));
      terms.back().tests = static_cast<double>(step);
    }
  }
}

}  // namespace

Term slip_term(const Problem& problem, const Geometry& geometry, const MachineEffect& of,
               std::size_t target, std::size_t row) {
  Term term = term_of(problem, of);
  const Row& from = problem.rows[row];
  term.of.shape = {{"file", static_cast<double>(from.file + 1), "1"},
                   {"row", static_cast<double>(from.row + 1), "1"},
                   {"setup", static_cast<double>(problem.targets[target].setup), "1"},
                   {"ball", static_cast<double>(problem.targets[target].ball), "1"}};
  if (problem.targets[target].zero) term.of.shape.resize(2);
  term.target = target;
  term.row = row;
  term.columns = geometry.places.middleCols(problem.targets[target].first,
                                            static_cast<Index>(of.parameters.size()));
  term.columns.topRows(from.first).setZero();
  return term;
}

Term periodic_term(const Problem& problem, const Geometry& geometry, MachineEffect of,
                   double period) {
  auto& error = std::get<ErrorOfPosition>(of.term);
  const bool angle = is_rotary(static_cast<AxisName>(error.error.body));
  error.functions = {FourierError{{{1.0, 1.0, 0.0}}, period},
                     FourierError{{{1.0, 0.0, 1.0}}, period}};
  of.shape = {{"period", period, angle ? "rad" : "mm"}};
  of.title += fmt::format(", period {:.4g} {}", angle ? period / rad_per_deg : period,
                          angle ? "deg" : "mm");
  Term term = term_of(problem, of);
  term.columns = Columns{problem, geometry}(error);
  term.reach = 1.0 / (frequencies_a_width *
                      axis_range(problem, static_cast<AxisName>(error.error.body)).length());
  return term;
}

std::string row_in_words(const Problem& problem, Eigen::Index equation) {
  const auto row = std::ranges::find_if(problem.rows, [&](const Row& one) {
    return equation >= one.first && equation < one.first + one.equations();
  });
  return fmt::format("row {} of file {}", row->row + 1, row->file + 1);
}

Term reading_term(const Problem& problem, Eigen::Index equation) {
  Term term;
  term.of_one_reading = true;
  term.of.id = row_in_words(problem, equation) + ": one reading that is off";
  term.of.formula = "amplitude of one reading";
  term.of.parameters = {"amplitude"};
  term.columns = MatrixXd::Zero(problem.equations, 1);
  term.columns(equation, 0) = 1.0;
  return term;
}

infer::Dictionary dictionary_of(const std::vector<Term>& terms, const MatrixXd& base,
                                const VectorXd& weights, const CalibrationOptions& options) {
  std::vector<infer::Hypothesis> list;
  for (const Term& term : terms)
    list.push_back({term.effect(), linear::scaled_rows(weights, term.columns),
                    term.angle() ? options.largest_angle_rad : options.largest_length_mm,
                    term.size_median, term.size_spread, term.tests, term.is_pattern(),
                    term.barred});
  return {list, base};
}

std::vector<Term> effect_terms(const Problem& problem, const Geometry& geometry,
                               const std::vector<MachineEffect>& catalogue) {
  std::vector<Term> terms;
  for (const MachineEffect& effect : catalogue) {
    if (!effect.why_not.empty()) continue;
    terms.push_back(term_of(problem, effect));
    if (terms.back().is_slip() || terms.back().is_periodic()) {
      terms.pop_back();
      if (const auto* error = std::get_if<ErrorOfPosition>(&effect.term))
        for (const double period :
             periods_of(positions_of(problem, static_cast<AxisName>(error->error.body))))
          terms.push_back(periodic_term(problem, geometry, effect, period));
      else
        add_slips(problem, geometry, effect, terms);
      continue;
    }
    terms.back().columns = std::visit(Columns{problem, geometry}, effect.term);
  }
  return terms;
}

}  // namespace trueaxis::calibrate_detail
