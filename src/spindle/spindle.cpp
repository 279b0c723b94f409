// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/spindle.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/angle.hpp"
#include "spindle/joint_estimate.hpp"
#include "spindle/recording.hpp"
#include "spindle/resolved.hpp"
#include "spindle/seen_angles.hpp"
#include "spindle/synchronous.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

constexpr double noted_rad = 2.0 * rad_per_deg, refused_rad = 10.0 * rad_per_deg;
constexpr double largest_shown_rad = 90.0 * rad_per_deg;
constexpr double sure = 3.0;  // u of an angle that the motion shows
constexpr double noted_gain = 0.03;
constexpr double times_motion = 3.0;  // the spindle's own order 1 is no larger than its others.

/// Compares the stated angles with those that the motion shows which does not repeat.
void check_moving(const RunReadings& run, std::span<const SeenAngle> seen, double u_stated_rad,
                  std::vector<Diagnostic>& wrong) {
  const auto degrees = [](double rad) { return std::fmod(rad / rad_per_deg + 720.0, 360.0); };
  for (std::size_t s = 1; s < seen.size(); ++s) {
    const double stated_rad = run.angles_rad[s] - run.angles_rad[0];
    const double off_rad = apart_rad(seen[s].from_first_rad, stated_rad);
    const double u_rad = std::hypot(seen[s].u_rad, u_stated_rad);
    if (off_rad <= std::max(noted_rad, sure * u_rad)) continue;
    wrong.push_back(
        {run.stream, 0, 0,
         fmt::format("by the motion that does not repeat, sensor {} is {:.1f} ± {:.1f}° from "
                     "sensor 1 (k = 2), but {:.1f}° is stated: check the angles and the gains, or "
                     "state a larger u of the angles (--u-angle-deg)",
                     s + 1, degrees(seen[s].from_first_rad), 2.0 * seen[s].u_rad / rad_per_deg,
                     degrees(stated_rad))});
  }
}

/// Holds the stated angles against the eccentricity, which all sensors of a set-up see alike, each
/// at its own angle: where columns are exchanged or an angle has the other sign, it is far off.
/// Small differences, of angle or of gain, are notes.
/// @throws InputError where an angle cannot be the stated one.
void check_sensors_agree(std::span<const RunReadings> runs, std::span<const SynchronousPart> parts,
                         double u_angle_rad, std::vector<std::string>& notes) {
  std::vector<Diagnostic> wrong;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const RunReadings& run = runs[r];
    const Eigen::MatrixXcd& z = parts[r].harmonics;
    const double others = std::sqrt(z.rightCols(z.cols() - 2).squaredNorm() /
                                    static_cast<double>(run.angles_rad.size()));
    const std::complex<double> first = z(0, 1);
    const double blurred = times_motion * others / std::abs(first);
    const auto seen_moving = seen_angles(run.angles_rad, parts[r].asynchronous_mm,
                                         parts[r].free_share, refused_rad / sure);
    check_moving(run, seen_moving, u_angle_rad, wrong);
    if (run.angles_rad.size() > 1 && blurred > noted_rad && seen_moving.empty())
      notes.push_back(
          2.0 * blurred > largest_shown_rad
              ? run.stream +
                    ": the eccentricity does not show the sensors' angles because of the "
                    "other orders: an error of them remains undetected"
              : fmt::format("{}: the eccentricity shows the sensors' angles only to {:.0f}° "
                            "because of the other orders: a smaller error remains undetected",
                            run.stream, std::max(2.0 * blurred, refused_rad) / rad_per_deg));
    for (std::size_t s = 1; s < run.angles_rad.size(); ++s) {
      const std::complex<double> seen = z(static_cast<Eigen::Index>(s), 1) / first;
      const double stated_rad = run.angles_rad[s] - run.angles_rad[0];
      const double off_rad = apart_rad(std::arg(seen), stated_rad);
      const double seen_deg = std::fmod(std::arg(seen) / rad_per_deg + 360.0, 360.0);
      const std::string what = fmt::format(
          "from the eccentricity, sensor {} is {:.1f}° from sensor 1, but {:.1f}° is stated", s + 1,
          seen_deg, std::fmod(stated_rad / rad_per_deg + 720.0, 360.0));
      const double gain = std::abs(seen);
      if (off_rad > std::max(refused_rad, 2.0 * blurred)) {
        wrong.push_back({run.stream, 0, 0,
                         what + ": correct the angles (from +X towards +Y) or the order of the "
                                "columns"});
      } else if (off_rad > std::max(noted_rad, blurred)) {
        notes.push_back(run.stream + ": " + what);
      } else if (std::abs(gain - 1.0) > std::max(noted_gain, blurred)) {
        notes.push_back(
            fmt::format("{}: sensor {} shows the eccentricity {:.3g} times as large as sensor 1: "
                        "check its gain",
                        run.stream, s + 1, gain));
      }
    }
  }
  if (!wrong.empty()) throw InputError(std::move(wrong));
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t polar_points = 720, cloud_points = 4000;

SpindleHarmonic harmonic_of(const JointEstimate& all, const OrderSolution& one, Index unknown) {
  if (unknown < 0 || !one.determined[static_cast<std::size_t>(unknown)]) return {nan, nan, nan};
  const double noise = all.widening() * one.u_mm[unknown];
  const double moved = one.moved_mm.row(unknown).norm();
  return {one.unknowns[unknown].real(), -one.unknowns[unknown].imag(), std::hypot(noise, moved)};
}

std::string why_suppressed(const OrderSolution& one) {
  if (std::ranges::find(one.determined, false) == one.determined.end()) return "";
  if (!std::isfinite(one.condition))
    return "the layout cannot separate form and motion of this order (singular)";
  return fmt::format(
      "condition number {:.0f} above {:.0f}: errors of noise and angles would become too large",
      one.condition, one.largest_condition);
}

std::vector<SeparatedOrder> orders_of(const JointEstimate& all) {
  std::vector<SeparatedOrder> out;
  const Layout& layout = all.layout();
  for (std::size_t k = 0; k < all.orders().size(); ++k) {
    const OrderSolution& one = all.orders()[k];
    out.push_back({all.order_min() + static_cast<int>(k), one.condition, why_suppressed(one),
                   harmonic_of(all, one, layout.form()), harmonic_of(all, one, layout.along()),
                   harmonic_of(all, one, layout.across())});
  }
  return out;
}

std::vector<SpindleRun> runs_of(const JointEstimate& all) {
  std::vector<SpindleRun> out;
  for (std::size_t r = 0; r < all.runs().size(); ++r) {
    const RunReadings& run = all.runs()[r];
    const SynchronousPart& part = all.parts()[r];
    SpindleRun one;
    one.stream = run.stream;
    one.setup = run.set_up.number;
    one.sensors = run.angles_rad.size();
    one.readings = run.c_rad.size();
    one.left_out = run.left_out;
    one.turns = all.fits()[r].turns();
    one.readings_per_turn = static_cast<double>(one.readings) / one.turns;
    one.asynchronous_rms_mm = std::sqrt(part.asynchronous_mm.squaredNorm() /
                                        static_cast<double>(part.asynchronous_mm.size()));
    const Complex e = all.eccentricity(r);
    const double sensors = static_cast<double>(one.sensors);
    one.eccentricity = {std::abs(e),
                        std::sqrt(0.5 * part.covariance[1].diagonal().real().sum()) / sensors, "mm",
                        ""};
    one.eccentricity_angle_rad = -std::arg(e);
    out.push_back(std::move(one));
  }
  return out;
}

double least_per_turn(const JointEstimate& all) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t r = 0; r < all.runs().size(); ++r)
    least =
        std::min(least, static_cast<double>(all.runs()[r].c_rad.size()) / all.fits()[r].turns());
  return least;
}

MotionValues values_of(const JointEstimate& all, const ResolvedSeries& series, bool across) {
  const auto moving = all.asynchronous(across);
  MotionValues out{range_estimate(series), {}, {}};
  if (moving.empty()) {
    out.asynchronous = out.total = {nan, nan, "mm", "no set-up sees this direction alone"};
    return out;
  }
  std::tie(out.asynchronous, out.total) =
      asynchronous_and_total(series, moving, least_per_turn(all));
  return out;
}

PolarCurves polar_of(const JointEstimate& all, const ResolvedSeries& motion,
                     const ResolvedSeries& form) {
  PolarCurves out;
  for (std::size_t i = 0; i < polar_points; ++i) {
    out.angle_rad.push_back(two_pi * static_cast<double>(i) / static_cast<double>(polar_points));
    out.motion_mm.push_back(value_at(motion.mean, out.angle_rad.back()));
    if (all.layout().has_form()) out.form_mm.push_back(value_at(form.mean, out.angle_rad.back()));
  }
  out.u_motion_mm = u_of_curve(motion, out.angle_rad);
  if (all.layout().has_form()) out.u_form_mm = u_of_curve(form, out.angle_rad);
  for (const AsynchronousMotion& run : all.asynchronous(false)) {
    const std::size_t shown = std::min(run.c_rad.size(), cloud_points - out.total_mm.size());
    for (std::size_t i = 0; i < shown; ++i) {
      out.total_angle_rad.push_back(run.c_rad[i]);
      out.total_mm.push_back(value_at(motion.mean, run.c_rad[i]) + run.motion_mm[i]);
    }
  }
  return out;
}

/// Once per revolution, and the whole orders above it.
void split_axial(const UncertainSeries& series, ErrorMotion& motion) {
  const double u_mm =
      std::hypot(series.u_mm[1], series.u_not_noise_mm[1], series.moved_mm.row(1).norm());
  motion.fundamental = {2.0 * std::abs(series.harmonics[1]), 2.0 * u_mm, "mm", ""};
  UncertainSeries rest = series;
  rest.harmonics[1] = 0.0;
  rest.u_mm[1] = 0.0;
  rest.moved_mm.row(1).setZero();
  motion.residual = range_estimate(resolve(rest));
}

/// The amplitude of the highest orders fitted, RMS, of the sensor that reads most of them.
struct Folded {
  double rms_mm = 0.0;
  int first = 0, last = 0;
};
Folded folded_of(const JointEstimate& all) {
  Folded out;
  for (std::size_t r = 0; r < all.parts().size(); ++r) {
    const double rms_mm = std::sqrt(all.parts()[r].folded_mm2.maxCoeff());
    const auto [first, last] = all.fits()[r].end_orders();
    if (rms_mm > out.rms_mm) out = {rms_mm, first, last};
  }
  return out;
}

/// @throws InputError where set-ups contradict each other by much of what they read
void expect_agreement(const JointEstimate& all, std::vector<RunReadings> runs,
                      const SpindleOptions& options) {
  if (!all.contradicts()) return;
  for (RunReadings& run : runs) run.set_up.reindex_rad = -run.set_up.reindex_rad;
  const bool negated = !JointEstimate(std::move(runs), options).contradicts();
  throw InputError(
      all.runs().front().stream,
      fmt::format("sensors and set-ups contradict each other by {:.0f} % of what they read "
                  "(χ²/ν = {:.0f}): {}",
                  100.0 * all.contradicted_share(), all.disagreement(),
                  negated ? "they agree if every re-indexing angle has the other sign: turn the "
                            "signs of # setup.N.reindex"
                          : "check the re-indexing angles and the sensors' angles and sides, their "
                            "gains, and whether it is the same part"));
}

void add_notes(const JointEstimate& all, const SpindleOptions& options,
               std::vector<std::string>& notes) {
  const std::string which = all.axial() ? "axial: " : "";
  const Folded folded = folded_of(all);
  if (folded.rms_mm > 0.0)
    notes.push_back(fmt::format(
        "{}the highest orders of a revolution that the readings support, {} to {}, still have "
        "{:.2g} µm: as much may fold into every order from higher ones, and U includes it; take "
        "more readings per revolution",
        which, folded.first, folded.last, folded.rms_mm / mm_per_um));
  else if (all.order_max() < options.order_max)
    notes.push_back(fmt::format(
        "{}the readings of a revolution support orders up to {}: higher orders are not computed",
        which, all.order_max()));
  for (std::size_t r = 0; r < all.runs().size(); ++r)
    if (all.fits()[r].cut())
      notes.push_back(fmt::format("{}: set-up {} has no readings {}, and fewer orders for that",
                                  all.runs()[r].stream, all.runs()[r].set_up.number,
                                  gap_words(all.fits()[r].gap())));
  notes.push_back(which +
                  "the asynchronous value and the total include the sensors' noise; no U includes "
                  "an error of a gain");
  if (!all.axial())
    notes.push_back(
        "order 1 is the part's eccentricity together with the spindle's fundamental motion; ISO "
        "230-7 does not define a radial error motion of order 1");
  if (!all.axial() && !all.layout().has_across())
    notes.push_back(fmt::format("the motion is known only along {:g}°, the line of the sensors",
                                all.sensitive_rad() / rad_per_deg));
  if (!all.axial() && !all.has_radius())
    notes.push_back(
        "the radius is not known, so the form includes the part of order 2 that eccentricity adds "
        "(e²/4R): state nominal_radius");
  if (all.axial() && !all.runs().front().on_axis)
    notes.push_back(all.layout().has_form()
                        ? "axial: order 1 is the squareness of the face together with the "
                          "fundamental motion: to measure the latter, read at X = 0"
                        : "axial: off the axis one sensor in one set-up reads the face's form "
                          "together with the motion: read at X = 0 or re-index the part");
  if (all.widening() > 1.0)
    notes.push_back(fmt::format(
        "{}sensors and set-ups contradict each other, χ²/ν = {:.1f}: TrueAxis widens every u by "
        "{:.2f}; check the angles, the sensors' gains and whether the part kept its form",
        which, all.disagreement(), all.widening()));
  for (const RunReadings& run : all.runs())
    if (run.left_out > 0)
      notes.push_back(
          fmt::format("{}: {} readings of set-up {} lie far from all others and are excluded",
                      run.stream, run.left_out, run.set_up.number));
}

/// Says which angles have a u that nobody stated.
void add_default_angles(const JointEstimate& all, const SpindleOptions& options,
                        std::vector<std::string>& notes) {
  const auto moved = [](const RunReadings& run) { return run.set_up.moved(); };
  std::string what, option;
  if (options.u_angle_rad == default_u_angle_rad && all.layout().has_across())
    what = "each sensor's angle", option = "--u-angle-deg";
  if (options.u_reindex_rad == default_u_angle_rad && std::ranges::any_of(all.runs(), moved)) {
    what += what.empty() ? "each re-indexing" : " and each re-indexing";
    option += option.empty() ? "--u-reindex-deg" : ", --u-reindex-deg";
  }
  if (what.empty()) return;
  notes.push_back(
      fmt::format("U includes a standard uncertainty of {:g}° of {}, because none is stated: state "
                  "yours ({}, 0 for exact angles)",
                  default_u_angle_rad / rad_per_deg, what, option));
}

/// Radial runs, or axial ones, in one estimate. @throws InputError for a layout without a solution.
ErrorMotion error_motion(std::vector<RunReadings> runs, const SpindleOptions& options,
                         std::vector<std::string>& notes) {
  const JointEstimate all(runs, options);
  if (!all.axial()) check_sensors_agree(all.runs(), all.parts(), options.u_angle_rad, notes);
  expect_agreement(all, runs, options);
  const Layout& layout = all.layout();
  ErrorMotion out;
  out.sensitive_rad = all.sensitive_rad();
  out.across_seen = layout.has_across();
  out.orders = orders_of(all);
  const ResolvedSeries motion = resolve(all.series(layout.along()));
  const ResolvedSeries form = resolve(all.series(layout.form()));
  out.sensitive = values_of(all, motion, false);
  if (layout.has_across()) out.across = values_of(all, resolve(all.series(layout.across())), true);
  out.form =
      layout.has_form() ? range_estimate(form) : Estimate{nan, nan, "mm", "no form is separated"};
  if (all.axial() && all.order_min() == 1) split_axial(all.series(layout.along()), out);
  out.runs = runs_of(all);
  out.disagreement = all.disagreement();
  out.polar = polar_of(all, motion, form);
  add_notes(all, options, notes);
  add_default_angles(all, options, notes);
  return out;
}

}  // namespace

double SpindleHarmonic::amplitude_mm() const { return std::hypot(cos_mm, sin_mm); }
double SpindleHarmonic::phase_rad() const { return std::atan2(sin_mm, cos_mm); }
bool SpindleHarmonic::determined() const { return std::isfinite(cos_mm); }

SpindleResult separate_spindle(std::span<const ProbeStream> streams,
                               const SpindleOptions& options) {
  expects(!streams.empty(), "a stream");
  expects(options.order_max >= 2 && options.order_max <= 1000, "orders 2 to 1000 at most");
  std::vector<RunReadings> radial, axial;
  for (RunReadings& run : take_runs(streams))
    (run.axial ? axial : radial).push_back(std::move(run));
  SpindleResult result;
  result.coverage_factor = options.coverage_factor;
  for (const ProbeStream& stream : streams) {
    result.sources.push_back(stream.source);
    result.input_hashes.push_back(stream.input_hash);
  }
  if (!radial.empty()) result.radial = error_motion(std::move(radial), options, result.notes);
  if (!axial.empty()) result.axial = error_motion(std::move(axial), options, result.notes);
  const auto leaves_out = [](const std::optional<ErrorMotion>& motion) {
    return motion && std::ranges::any_of(motion->orders, [](const SeparatedOrder& one) {
             return !one.suppressed.empty();
           });
  };
  if (leaves_out(result.radial) || leaves_out(result.axial))
    result.notes.push_back(
        "the values do not include the suppressed orders and may be larger with them");
  return result;
}

}  // namespace trueaxis
