// SPDX-License-Identifier: Apache-2.0
#include "form/sampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "trueaxis/units.hpp"

namespace trueaxis::form {
namespace {

constexpr double kept_by = 0.75;              // of the length of a trace
constexpr double turn_rounding = 1.0 + 1e-6;  // angles of a text file
constexpr double standard_upr[] = {500.0, 150.0, 50.0, 15.0};

std::string more_points(double upr, std::size_t count, double step) {
  const double carried = std::floor(turn_rounding * two_pi / (least_points_per_cycle * step));
  const double needed = std::ceil(least_points_per_cycle * upr);
  std::string text = fmt::format(
      "{:g} UPR needs {:.0f} readings per revolution, 7 per wave, and {} {:.0f}: ", upr, needed,
      static_cast<double>(count) < needed
          ? "there are"
          : fmt::format("{} at uneven angles are in places as sparse as", count),
      two_pi / step);
  if (carried < 2.0)
    return text +
           "too few for any filter; '--filter none' gives the range of the unfiltered readings";
  double standard = 0.0;
  for (const double one : standard_upr)
    if (one <= carried) standard = std::max(standard, one);
  text += fmt::format("they support up to {:.0f} UPR", carried);
  if (standard > 0.0) text += fmt::format(" (--upr 1-{:g})", standard);
  return text + ", or probe more per revolution";
}

/// The step that so much of the length of a trace keeps below.
double usual_step(const Trace& trace) {
  std::vector<double> steps;
  for (std::size_t i = 0; i + (trace.closed() ? 0 : 1) < trace.size(); ++i)
    steps.push_back(trace.step(i));
  std::ranges::sort(steps);
  const double all = std::accumulate(steps.begin(), steps.end(), 0.0);
  double below = 0.0;
  for (const double step : steps) {
    below += step;
    if (below >= kept_by * all) return step;
  }
  return steps.empty() ? std::numeric_limits<double>::infinity() : steps.back();
}

}  // namespace

double points_per_cycle(const Trace& trace, double cutoff) { return cutoff / usual_step(trace); }

int highest_order(const Trace& trace, bool gaps_count) {
  double widest = 0.0;
  for (std::size_t i = 0; i < trace.size(); ++i) widest = std::max(widest, trace.step(i));
  const double by_step = trace.period / (least_points_per_cycle * usual_step(trace));
  const double by_gap = gaps_count ? 0.5 * trace.period / widest : 500.0;
  return static_cast<int>(std::floor(turn_rounding * std::min({by_step, by_gap, 500.0})));
}

std::string sampling_trouble(const Trace& trace, const FormOptions& options) {
  double widest = 0.0;
  for (std::size_t i = 0; i < trace.size(); ++i) widest = std::max(widest, trace.step(i));
  if (widest > 0.5 * two_pi)
    return fmt::format(
        "{:.0f}° without a reading: a section needs readings over more than half a turn to "
        "determine its circle",
        widest / rad_per_deg);
  if (options.filter == ProfileFilter::none) return "";
  const double allowed = turn_rounding * two_pi / (options.high_upr * least_points_per_cycle);
  if (usual_step(trace) <= allowed) return "";
  const std::vector<Gap> gaps =
      gaps_of(trace, turn_rounding * longest_step(two_pi / options.high_upr));
  double in_gaps = 0.0;
  for (const Gap& gap : gaps) in_gaps += gap.length;
  if (in_gaps <= (1.0 - kept_by) * two_pi || 2 * gaps.size() >= trace.size())
    return more_points(options.high_upr, trace.size(), usual_step(trace));
  return fmt::format(
      "{:.0f}° of the turn without a reading: a filter cannot bridge more than a quarter of it; "
      "'--filter none' gives the range of the unfiltered readings",
      in_gaps / rad_per_deg);
}

double followed_amplitude_mm(double upr, double radius_mm, double ball_mm, bool bore) {
  const double room = 1.0 / ball_mm + (bore ? -1.0 : 1.0) / radius_mm;
  return ball_mm > 0.0 ? room * radius_mm * radius_mm / (upr * upr)
                       : std::numeric_limits<double>::infinity();
}

double measured_transmission(const Trace& trace, const LowPass& filter, double cutoff) {
  double before = 0.0, after = 0.0;
  for (const double phase : {0.0, 0.25 * two_pi}) {
    std::vector<double> wave;
    for (const double at : trace.at) wave.push_back(std::cos(two_pi * at / cutoff - phase));
    const std::vector<double> passed = filter(wave);
    for (std::size_t i = 0; i < wave.size(); ++i) {
      before += wave[i] * wave[i];
      after += passed[i] * passed[i];
    }
  }
  return std::sqrt(after / before);
}

namespace {

double passed(ProfileFilter kind, double upr, double order, double step_rad) {
  if (order == 0.0) return 1.0;
  const double cutoff = two_pi / upr, wave = two_pi / order;
  switch (kind) {
    case ProfileFilter::gaussian:
      return gaussian_transmission(cutoff, wave);
    case ProfileFilter::robust_gaussian:
      return robust_transmission(cutoff, wave);
    case ProfileFilter::spline:
      return spline_transmission(cutoff, wave, step_rad);
    case ProfileFilter::none:
      break;
  }
  return 1.0;
}

}  // namespace

double passed_by_low_pass(const FormOptions& options, double order, double step_rad) {
  return passed(options.filter, options.high_upr, order, step_rad);
}

double passed_by_band(const FormOptions& options, double order) {
  constexpr double fine = 1e-4;  // of a spline
  const double high = passed_by_low_pass(options, order, fine);
  if (options.low_upr <= 1.0) return high;
  return high * (1.0 - passed(options.filter, options.low_upr, order, fine));
}

std::unique_ptr<LowPass> low_pass(ProfileFilter kind, const Trace& trace, double cutoff) {
  switch (kind) {
    case ProfileFilter::none:
      return nullptr;
    case ProfileFilter::gaussian:
      return gaussian_low_pass(trace, cutoff);
    case ProfileFilter::robust_gaussian:
      return robust_low_pass(trace, cutoff);
    case ProfileFilter::spline:
      return spline_low_pass(trace, cutoff);
  }
  return nullptr;
}

}  // namespace trueaxis::form
