// SPDX-License-Identifier: Apache-2.0
#include "calibrate/diagnose/pattern.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "base/angle.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::calibrate_detail {
namespace {

constexpr int most_steps = 24, bump_centres = 24, corners_of_bump = 24;

struct Axis {
  AxisName name;
  AxisRange range;
  bool whole_turn;
  double at(const Row& row) const { return row.axes[index_of(name)]; }
  std::string letter() const { return std::string(1, letter_of(name)); }
};

Axis axis_of(const Problem& problem, std::size_t k) {
  const AxisName name = problem.machine->axes[k].name;
  const AxisRange range = axis_range(problem, name);
  return {name, range, is_rotary(name) && range.length() >= whole_turn};
}

std::string place_text(AxisName axis, double value) {
  return is_rotary(axis) ? fmt::format("{:.0f} deg", value / rad_per_deg)
                         : fmt::format("{:.0f} mm", value);
}

PatternFunction of_axis(const Problem& problem, const Axis& axis, std::string words,
                        std::vector<ErrorFunction> functions) {
  PatternFunction out{std::move(words), {}, std::move(functions), std::nullopt, axis.letter()};
  out.values.resize(static_cast<Index>(problem.rows.size()),
                    static_cast<Index>(out.functions.size()));
  for (Index i = 0; i < out.values.rows(); ++i)
    for (Index j = 0; j < out.values.cols(); ++j)
      out.values(i, j) = value_at(out.functions[static_cast<std::size_t>(j)],
                                  axis.at(problem.rows[static_cast<std::size_t>(i)]));
  return out;
}

/// The two lowest orders, or degrees.
std::vector<PatternFunction> lowest(const Problem& problem, const Axis& axis) {
  std::vector<PatternFunction> out;
  for (int order = 1; order <= 2; ++order)
    out.push_back(axis.whole_turn ? of_axis(problem, axis, "", harmonic(order))
                                  : of_axis(problem, axis, "",
                                            {legendre(order, axis.range.low, axis.range.high)}));
  return out;
}

PatternFunction product(const PatternFunction& a, const PatternFunction& b, std::string words) {
  PatternFunction out{std::move(words), {}, {}, std::nullopt, a.letters + b.letters};
  out.values.resize(a.values.rows(), a.values.cols() * b.values.cols());
  for (Index i = 0; i < a.values.cols(); ++i)
    for (Index j = 0; j < b.values.cols(); ++j)
      out.values.col(i * b.values.cols() + j) = a.values.col(i).cwiseProduct(b.values.col(j));
  return out;
}

/// Middles of the gaps between the positions of an axis, not more than `most_steps` of them.
std::vector<double> gaps(const Problem& problem, const Axis& axis) {
  std::vector<double> at;
  for (const Row& row : problem.rows) at.push_back(axis.at(row));
  std::ranges::sort(at);
  const double apart = 1e-3 * axis.range.length();
  std::vector<double> middles;
  for (std::size_t i = 1; i < at.size(); ++i)
    if (at[i] - at[i - 1] > apart) middles.push_back(0.5 * (at[i] + at[i - 1]));
  const std::size_t step = (middles.size() + most_steps - 1) / most_steps;
  std::vector<double> out;
  for (std::size_t i = step / 2; step > 0 && i < middles.size(); i += step)
    out.push_back(middles[i]);
  return out;
}

/// An orthonormal basis of functions of the row.
struct Orthonormal {
  MatrixXd basis;
  /// Whether they leave less than a hundredth of functions.
  bool make(const MatrixXd& values) const {
    const MatrixXd left = linear::beside(basis, values);
    return left.squaredNorm() < 0.01 * values.squaredNorm();
  }
};

/// What the effects of an axis and what is always fitted make of its positions.
Orthonormal effects_of_axis(const Problem& problem, const Axis& axis, int highest) {
  std::vector<ErrorFunction> functions{ConstantError{1.0}};
  for (int n = 1; n <= (axis.whole_turn ? 4 : highest); ++n) {
    if (axis.whole_turn)
      std::ranges::move(harmonic(n), std::back_inserter(functions));
    else
      functions.emplace_back(legendre(n, axis.range.low, axis.range.high));
  }
  const MatrixXd values = of_axis(problem, axis, "", std::move(functions)).values;
  return {linear::orthonormal_basis(values, 1e-9)};
}

}  // namespace

std::vector<ErrorFunction> harmonic(int order) {
  const auto n = static_cast<double>(order);
  return {FourierError{{{n, 1.0, 0.0}}, two_pi}, FourierError{{{n, 0.0, 1.0}}, two_pi}};
}

// A raised cosine; of a whole turn it goes round.
PatternFunction bump(const Problem& problem, std::size_t k, double at, double width) {
  const Axis axis = axis_of(problem, k);
  TableError table;
  for (int i = 0; i <= corners_of_bump; ++i) {
    const double s = static_cast<double>(i) / corners_of_bump;
    table.at.push_back(at + width * (s - 0.5));
    table.values.push_back(0.5 - 0.5 * std::cos(two_pi * s));
  }
  if (axis.whole_turn) {
    table.at.push_back(table.at.front() + two_pi);
    table.values.push_back(0.0);
    table.periodic = true;
  }
  PatternFunction out = of_axis(problem, axis,
                                "a bump of " + axis.letter() + " about " +
                                    place_text(axis.name, axis.whole_turn ? within_turn(at) : at),
                                {std::move(table)});
  out.place = {PatternPlace::Kind::bump, k, at, width};
  return out;
}

PatternFunction step(const Problem& problem, std::size_t k, double at) {
  const Axis axis = axis_of(problem, k);
  const double half = 1e-7 * axis.range.length();
  PatternFunction out =
      of_axis(problem, axis, "a step of " + axis.letter() + " at " + place_text(axis.name, at),
              {TableError{{at - half, at + half}, {-0.5, 0.5}, false}});
  out.place = {PatternPlace::Kind::step, k, at, 0.0};
  return out;
}

std::vector<PatternFunction> near(const Problem& problem, const PatternPlace& place) {
  std::vector<PatternFunction> out;
  const double length = axis_of(problem, place.axis).range.length();
  if (place.kind == PatternPlace::Kind::step) {
    const Axis axis = axis_of(problem, place.axis);
    std::vector<double> at;
    const double reach = 2.0 * length / most_steps;
    for (const Row& row : problem.rows)
      if (std::abs(axis.at(row) - place.at) <= reach) at.push_back(axis.at(row));
    std::ranges::sort(at);
    for (std::size_t i = 1; i < at.size(); ++i)
      if (at[i] - at[i - 1] > 1e-6 * length)
        out.push_back(step(problem, place.axis, 0.5 * (at[i] + at[i - 1])));
    return out;
  }
  for (int i = -4; i <= 4; ++i)
    for (int j = -4; j <= 4; ++j)
      out.push_back(bump(problem, place.axis, place.at + 0.25 * i * length / bump_centres,
                         place.width * std::pow(1.5, 0.25 * j)));
  return out;
}

std::vector<PatternFunction> functions_of_axis(const Problem& problem, std::size_t k, int highest) {
  std::vector<PatternFunction> out;
  const Axis axis = axis_of(problem, k);
  const double length = axis.range.length();
  for (int order = 5; axis.whole_turn && order <= 12; ++order)
    out.push_back(of_axis(problem, axis, fmt::format("harmonic {} of {}", order, axis.letter()),
                          harmonic(order)));
  for (int degree = highest + 1; !axis.whole_turn && degree <= 6; ++degree)
    out.push_back(of_axis(problem, axis,
                          fmt::format("polynomial of degree {} of {}", degree, axis.letter()),
                          {legendre(degree, axis.range.low, axis.range.high)}));
  for (const double width : {1.0 / 8.0, 3.0 / 16.0, 9.0 / 32.0})
    for (int i = 0; i < bump_centres; ++i)
      out.push_back(
          bump(problem, k, axis.range.low + (i + 0.5) * length / bump_centres, width * length));
  for (const double at : gaps(problem, axis)) out.push_back(step(problem, k, at));
  const Orthonormal own = effects_of_axis(problem, axis, highest);
  std::erase_if(out, [&](const PatternFunction& one) { return own.make(one.values); });
  return out;
}

std::vector<PatternFunction> functions_of_two(const Problem& problem, std::size_t a,
                                              std::size_t b) {
  const Axis one = axis_of(problem, a), other = axis_of(problem, b);
  std::vector<PatternFunction> out;
  for (const PatternFunction& f : lowest(problem, one))
    for (const PatternFunction& g : lowest(problem, other))
      out.push_back(product(f, g, "a function of " + one.letter() + " and " + other.letter()));
  return out;
}

std::vector<PatternFunction> functions_of_time(const Problem& problem) {
  const TimeSpan times = times_of_tip(problem);
  std::vector<PatternFunction> out;
  if (!(times.end_s > times.begin_s)) return out;
  const auto add = [&](std::string words, auto&& value) {
    PatternFunction one{std::move(words), MatrixXd(problem.rows.size(), 1), {}, std::nullopt, "t"};
    for (std::size_t i = 0; i < problem.rows.size(); ++i)
      one.values(static_cast<Index>(i), 0) =
          value(std::clamp(times.share(problem.rows[i].time_s), 0.0, 1.0));
    out.push_back(std::move(one));
  };
  for (const double share : {0.05, 0.08, 0.12, 0.18, 0.27, 0.5})
    add("a course in time as of warming up", [=](double s) { return std::exp(-s / share); });
  add("a bend in time", [](double s) { return s * s; });
  for (int i = 1; i < 12; ++i)
    add("a step in time", [=](double s) { return s < i / 12.0 ? -0.5 : 0.5; });
  return out;
}

std::vector<PatternFunction> growths(const Problem& problem, std::size_t k) {
  const Axis axis = axis_of(problem, k);
  const PatternFunction along =
      of_axis(problem, axis, "", {legendre(1, axis.range.low, axis.range.high)});
  std::vector<PatternFunction> out;
  for (const PatternFunction& course : functions_of_time(problem))
    out.push_back(product(along, course, course.words + " that grows with " + axis.letter()));
  PatternFunction line{"", MatrixXd(problem.rows.size(), 1), {}, std::nullopt, "t"};
  for (std::size_t i = 0; i < problem.rows.size(); ++i)
    line.values(static_cast<Index>(i), 0) = problem.rows[i].time_s;
  line.values.array() -= line.values.mean();
  if (line.values.norm() > 0.0) {
    line.values /= line.values.cwiseAbs().maxCoeff();
    out.push_back(product(along, line, "a drift that grows with " + axis.letter()));
  }
  return out;
}

}  // namespace trueaxis::calibrate_detail
