// SPDX-License-Identifier: Apache-2.0
#include "measure/centre_step.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/number.hpp"
#include "math/linear_algebra.hpp"
#include "measure/step_model.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using namespace step_model;

constexpr double mostly = 0.25;        // of the scatter about a line, left by a step
constexpr std::size_t least_side = 2;  // centres
constexpr double likelier = 9.0;       // than a bump: e^4.5 times, or one in 90

/// What the best displacement that comes back leaves, as many parameters as a step: a bump of the
/// part that some turns meet.
double squares_about_bump(const Eigen::MatrixXd& line, const Eigen::MatrixX2d& centres) {
  constexpr double widths[] = {0.03, 0.045, 0.07, 0.1, 0.15, 0.22, 0.33};  // of the run
  Eigen::MatrixXd model(line.rows(), 4);
  model.leftCols(3) = line;
  const Eigen::ArrayXd t = line.col(2);
  const double range = t.maxCoeff() - t.minCoeff();
  double least = squares_about(line, centres);
  for (const double width : widths)
    for (Eigen::Index k = 0; k < line.rows(); ++k) {
      model.col(3) = (-0.5 * ((t - t[k]) / (width * range)).square()).exp();
      least = std::min(least, squares_about(model, centres));
    }
  return least;
}

/// The step in one run of turns: a line along Z and a drift in time are not steps, nor is a bend.
std::optional<CentreStep> step_in(std::span<const TurnCentre> run, double u_mm, double by_chance) {
  const auto n = static_cast<Eigen::Index>(run.size());
  const Eigen::MatrixX2d centres = places(run);
  Eigen::MatrixXd model(n, 5);
  model.leftCols(3) = line(run);
  const Eigen::VectorXd t = model.col(2);
  model.rightCols(2) << t.array().square(), t.array().cube();
  const double about_line = squares_about(model.leftCols(3), centres);
  const double about_bend = squares_about(model, centres);
  double least = about_bend;
  Eigen::Index at = 0;
  const auto side = static_cast<Eigen::Index>(least_side);
  const auto begin_at = [&](Eigen::Index k) {
    for (Eigen::Index i = 0; i < n; ++i) {
      model(i, 3) = i < k ? 0.0 : 1.0;
      model(i, 4) = i < k ? 0.0 : t(i) - t(k);
    }
  };
  for (Eigen::Index k = side; k + side <= n; ++k) {
    begin_at(k);
    const double squares = squares_about(model, centres);
    if (squares >= least) continue;
    least = squares;
    at = k;
  }
  const double noise = 2.0 * static_cast<double>(n) * u_mm * u_mm;
  if (at == 0 || least - noise > mostly * (about_line - noise)) return {};
  // A step and a change of slope of x and of y are four parameters, each centre a place for them.
  const double unit = variance(centres, u_mm);
  if (about_bend - least < enough(by_chance, run.size()) * unit ||
      squares_about_bump(model.leftCols(3), centres) - least < likelier * unit)
    return {};
  // What a fit took of the step is a line, which is another column. The first turn may hold it.
  begin_at(at);
  const Eigen::MatrixXd sizes = linear::least_squares(model, Eigen::MatrixXd(centres));
  return CentreStep{run[static_cast<std::size_t>(at)].begin,
                    (sizes.row(3) + model(at + 1, 4) * sizes.row(4)).norm()};
}

}  // namespace

std::optional<CentreStep> find_centre_step(const TurnCentres& centres, double by_chance) {
  std::optional<CentreStep> found;
  for (std::size_t begin = 0; begin < centres.list.size();) {
    std::size_t end = begin;
    while (end < centres.list.size() && centres.list[end].run == centres.list[begin].run) ++end;
    if (end - begin >= least_run) {
      const auto step =
          step_in(std::span(centres.list).subspan(begin, end - begin), centres.u_mm, by_chance);
      if (step && (!found || step->size_mm > found->size_mm)) found = step;
    }
    begin = end;
  }
  return found;
}

std::string moved_text(const CentreStep& step) {
  std::string text = fmt::format("the centre of the turns moves by {} µm about data row {}: ",
                                 significant(step.size_mm / mm_per_um, 3), step.reading + 1);
  if (!step.may_be_delay)
    return text +
           "the part slipped there, C lost its place, or two recordings were joined. Give each "
           "part of the stream a file of its own, or clamp the part again and probe again";
  text += std::isnan(step.delay_s)
              ? "X is late and the speed changed there, or the part slipped"
              : fmt::format(
                    "the speed changed there and X is {} by about {:.3g} ms, or the part slipped",
                    step.delay_s < 0.0 ? "early" : "late", 1e3 * std::abs(step.delay_s));
  return text + ". Give each speed a file of its own; `trueaxis diagnose` tells a delay";
}

}  // namespace trueaxis
