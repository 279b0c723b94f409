// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <ranges>

#include "calibrate/estimate/geometry.hpp"
#include "calibrate/estimate/read_out_rows.hpp"
#include "calibrate/estimate/tip_fit.hpp"
#include "calibrate/estimate/total_uncertainty.hpp"
#include "math/covariance.hpp"
#include "math/linear_algebra.hpp"
#include "trueaxis/calibration.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace calibrate_detail {
namespace {

/// Position and straightness of the axis that an array lies along, over the range of its rows.
void add_array_unknowns(const MachineMeasurement& file, double largest,
                        std::vector<Unknown>& unknowns) {
  const std::size_t axis = index_of(*file.axis);
  const auto at = [&](const AxisPositions& axes) { return axes[axis]; };
  const auto [low, high] = std::ranges::minmax(file.axes | std::views::transform(at));
  if (!(high > low)) return;
  for (std::size_t direction = 0; direction < 3; ++direction) {
    const ErrorName name{true, direction, axis};
    // The linear part of straightness is the bar's line, or squareness.
    for (int degree = direction == axis ? 1 : 2; degree <= 3; ++degree) {
      const std::string full = to_string(name) + ".poly" + std::to_string(degree);
      if (std::ranges::find(unknowns, full, &Unknown::name) != unknowns.end()) continue;
      unknowns.push_back({full, {name, legendre(degree, low, high), 0.0}, largest});
    }
  }
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

NotDetermined in_words(const Held& held, const std::vector<Unknown>& unknowns) {
  NotDetermined out;
  const std::string name = unknowns[held.unknown].name;
  out.members.push_back(name);
  std::vector<std::string> others;
  for (const std::size_t k : held.alike) {
    out.members.push_back(unknowns[k].name);
    others.push_back(unknowns[k].name);
  }
  if (held.places) {
    out.members.emplace_back("ball");
    others.emplace_back("the ball's centre");
  }
  if (held.effect < 1.0)
    out.why = name + " moves no reading by more than the noise, whatever its size";
  else if (others.size() == 1)
    out.why = name + " is not told from " + others[0] + ": every position moves both alike";
  else
    out.why = name + " is not told from " + listed(others) +
              " together: at these positions they move the readings in the same way";
  return out;
}

/// σ² of the covariance: that of the residuals where they show more than is stated.
double covariance_scale(const Problem& problem, const Solution& solution, Calibration& out) {
  const bool stated = problem.noise_stated && solution.variance <= 1.0;
  out.noise_basis = stated ? NoiseBasis::stated : NoiseBasis::residuals;
  return stated ? 1.0 : solution.variance;
}

void describe(const Problem& problem, const std::vector<Unknown>& unknowns,
              const Solution& solution, Calibration& out) {
  const double scale = covariance_scale(problem, solution, out);
  const MatrixXd inverse = scale * linear::pseudo_inverse(linear::gram(solution.jacobian));
  const auto& kept = solution.determined.kept;
  std::vector<std::string> names;
  Eigen::VectorXd unit(static_cast<Index>(kept.size()));
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const Unknown& one = unknowns[kept[i]];
    const auto at = static_cast<Index>(i);
    Estimate estimate;
    estimate.value = solution.unknowns[static_cast<Index>(kept[i])];
    estimate.u = std::sqrt(inverse(at, at)) * one.largest;
    estimate.unit = one.unit.name.angular() ? "rad" : "mm";
    out.parameters.push_back({one.name, estimate});
    ErrorTerm term = one.unit;
    term.function = scaled(term.function, estimate.value);
    if (std::holds_alternative<ConstantError>(term.function)) term.u = estimate.u;
    out.errors.terms.push_back(std::move(term));
    names.push_back(one.name);
    unit[at] = one.largest;
  }
  out.covariance = with_names(std::move(names), linear::scaled_both(inverse, unit));
  std::vector<std::string> held;
  for (const Held& one : solution.determined.held) {
    out.not_determined.push_back(in_words(one, unknowns));
    held.push_back(unknowns[one.unknown].name);
  }
  out.gauge = held.empty() ? "nothing is fixed" : "fixed at the given values: " + listed(held);
}

void place_balls(const Problem& problem, const VectorXd& places, Calibration& out) {
  for (const Target& target : problem.targets) {
    if (target.zero) continue;
    const double* const place = places.data() + target.first;
    PlacedBall ball{
        target.file, target.setup, target.ball, rigid::array(target.point(place, 0.0)), {}};
    if (target.line)
      ball.direction = rigid::array(target.point(place, 1.0) - target.point(place, 0.0));
    out.balls.push_back(ball);
  }
}

/// σ of files that state none becomes that of the residuals of the tip; once is enough, as what is
/// kept changes little with it.
void estimate_noise(std::span<const MachineMeasurement> data,
                    std::span<const AxisReadOut> read_outs, const Solution& solution,
                    Problem& problem) {
  double square = 0.0, freedom = solution.freedom;
  for (const Row& row : problem.rows)
    if (row.read_out)
      freedom -= 1.0;
    else
      square += solution.residuals.segment(row.first, row.equations()).squaredNorm();
  for (const Target& target : problem.targets)
    if (target.zero)
      freedom += static_cast<double>(unknowns_of(read_out_of_file(data, read_outs, target.file)));
  const double sigma_mm =
      std::max(std::sqrt(square / std::max(freedom, 1.0)) * unstated_noise_mm, 1e-9);
  for (Row& row : problem.rows) {
    if (row.read_out || data[row.file].noise_mm) continue;
    row.sigma_mm = sigma_mm;
    problem.weights.segment(row.first, row.equations()).setConstant(1.0 / sigma_mm);
  }
}

/// RMS and noise of a calibration of nothing but read-outs: of all readings of linear axes.
void summarise_read_outs(Calibration& out) {
  double before = 0.0, after = 0.0, noise = 0.0, readings = 0.0;
  for (const AxisReadOut& one : out.read_outs) {
    if (is_rotary(one.axis)) continue;
    const auto n = static_cast<double>(one.readings);
    before += n * one.rms_before * one.rms_before, after += n * one.rms_after * one.rms_after;
    noise += n * one.noise * one.noise, readings += n;
  }
  if (readings == 0.0) return;
  out.rms_before_mm = std::sqrt(before / readings), out.rms_after_mm = std::sqrt(after / readings);
  out.rms_parameters_mm = out.rms_after_mm;
  out.noise_mm = std::sqrt(noise / readings);
  out.noise_basis = NoiseBasis::residuals;
}

}  // namespace

std::optional<TipFit> fit_tips(const Machine& machine, std::span<const MachineMeasurement> data,
                               const CalibrationOptions& options, bool array_errors,
                               Calibration& out) {
  const bool alone = read_outs_alone(data);
  if (alone && array_errors) return std::nullopt;
  const ErrorModel& given = alone ? options.errors : out.errors;
  TipFit fit{make_problem(machine, data, given), {}, {}, given};
  Problem& problem = fit.problem;
  take_noise(data, out.read_outs, problem);
  if (!alone)
    fit.unknowns = location_unknowns(machine, options.largest_length_mm, options.largest_angle_rad);
  for (const Target& target : problem.targets)
    if (target.zero && !alone) {
      const AxisReadOut& one = read_out_of_file(data, out.read_outs, target.file);
      add_read_out_unknowns(
          one, is_rotary(one.axis) ? options.largest_angle_rad : options.largest_length_mm,
          fit.unknowns);
    }
  for (const MachineMeasurement& file : data)
    if (array_errors && file.kind == MeasurementKind::array)
      add_array_unknowns(file, options.largest_length_mm, fit.unknowns);
  for (Unknown& one : fit.unknowns) one.unit.known_over = measured_over(problem, one.unit);
  fit.solution = solve(problem, fit.given, fit.unknowns);
  if (!alone && !problem.noise_stated && fit.solution.freedom > 0.0) {
    estimate_noise(data, out.read_outs, fit.solution, problem);
    fit.solution = solve(problem, fit.given, fit.unknowns);
  }
  const Solution& solution = fit.solution;
  out.converged = solution.converged;
  out.message = solution.message;
  if (!(solution.freedom > 0.0))
    throw InputError(data.front().source, "has " + std::to_string(problem.equations) +
                                              " numbers for " +
                                              std::to_string(solution.jacobian.cols()) +
                                              " unknowns: measure more positions");
  describe(problem, fit.unknowns, solution, out);
  place_balls(problem, solution.places, out);
  out.equations = static_cast<std::size_t>(problem.equations);
  out.unknowns = static_cast<std::size_t>(solution.jacobian.cols());
  const VectorXd sigma = problem.weights.cwiseInverse();
  if (problem.noise_stated) out.stated_noise_mm = problem.rms_mm(sigma);
  out.rms_after_mm = problem.rms_mm(solution.residuals.cwiseProduct(sigma));
  out.rms_parameters_mm = out.rms_after_mm;
  out.rms_before_mm = problem.rms_mm(problem.residuals(fit.given, best_places(problem, fit.given)));
  out.noise_mm = std::sqrt(out.noise_basis == NoiseBasis::stated ? 1.0 : solution.variance) *
                 problem.rms_mm(sigma);
  return fit;
}

Calibration of_read_outs(const Machine& machine, std::span<const MachineMeasurement> data,
                         const CalibrationOptions& options) {
  expects(!data.empty(), "a measurement");
  Calibration out;
  out.converged = true;
  out.errors = options.errors;
  out.coverage_factor = options.coverage_factor;
  for (const MachineMeasurement& file : data) {
    out.sources.push_back(file.source);
    out.input_hashes.push_back(file.input_hash);
  }
  from_read_outs(machine, data, options, out);
  return out;
}

}  // namespace calibrate_detail

const char* to_string(NoiseBasis basis) {
  return basis == NoiseBasis::stated ? "stated" : basis == NoiseBasis::residuals ? "residuals" : "";
}

Calibration calibrate(const Machine& machine, std::span<const MachineMeasurement> data,
                      const CalibrationOptions& options) {
  using namespace calibrate_detail;
  Calibration out = of_read_outs(machine, data, options);
  const auto fit = fit_tips(machine, data, options, true, out);
  if (!fit) summarise_read_outs(out);
  if (!fit || !out.converged) return out;
  const Eigen::VectorXd places = take_component_errors(*fit, options, out);
  out.balls.clear();
  place_balls(fit->problem, places, out);
  out.rms_after_mm = fit->problem.rms_mm(fit->problem.residuals(out.errors, places));
  return out;
}

}  // namespace trueaxis
