// SPDX-License-Identifier: Apache-2.0
#include "fit/plausible.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <vector>

#include "base/counted.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

// The largest form in the catalogue is 0.2 mm in amplitude, 0.14 mm RMS; large parts more. Eq. 308.
constexpr double most_left_mm = 0.5, most_left_per_radius = 1e-3;
constexpr double alternate_least_mm = 5e-3;
constexpr double alternate_share = 0.2;  // of the residuals' square
constexpr double six_sigma = 36.0;
constexpr double most_scatter_mm = 0.1;   // of single readings; dirty probes show 0.02
constexpr double more_than_stated = 3.0;  // a noise that is stated may be exceeded by as much
constexpr double other_is_far_better = 1.0 / 3.0;              // of the RMS
constexpr double mostly_scatter = 0.7;                         // of the residuals' RMS
constexpr double sphere_leaves_mm = 0.01, sphere_share = 0.1;  // of the RMS
constexpr double off_nominal_mm = 1.0, off_nominal = 0.05;     // more than stock, less than a unit
constexpr double flattest_noise = 1.8;                         // kurtosis of a uniform distribution
constexpr double least_for_kurtosis = 100.0, many_digits = 10.0, white_sds = 4.0;
constexpr double dense_step_rad = two_pi / 36.0;  // neighbours meet the same form

double largest_radius_mm(const ProbeStream& stream) {
  if (stream.kind == StreamKind::face) return std::abs(range_of(stream.position_mm).high);
  if (stream.indication == Indication::relative) return stream.nominal_radius_mm.value_or(0.0);
  const auto [low, high] = range_of(stream.reading_mm);
  return std::max(std::abs(low), std::abs(high));
}

/// Standard deviation of single readings from second differences of the residuals, where C moves by
/// less than 10° from one to the next; 0: too few such readings.
double scatter_mm(const ProbeStream& stream, const std::vector<double>& residual_mm) {
  double squares = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 2; i < residual_mm.size(); ++i) {
    if (std::abs(stream.c_rad[i] - stream.c_rad[i - 1]) > dense_step_rad ||
        std::abs(stream.c_rad[i - 1] - stream.c_rad[i - 2]) > dense_step_rad)
      continue;
    const double d = residual_mm[i] - 2.0 * residual_mm[i - 1] + residual_mm[i - 2];
    squares += d * d;
    ++count;
  }
  constexpr std::size_t enough = 20;
  return count < enough ? 0.0 : std::sqrt(squares / (6.0 * static_cast<double>(count)));
}

/// "; a cone leaves 2.1 µm: --surface cone"
std::string other_surface(const ProbeStream& stream, const FitResult& fit, const Refit& refit) {
  if (fit.surface != SurfaceKind::cylinder) return "";
  const FitResult cone = refit(stream, SurfaceKind::cone);
  if (cone.status != FitStatus::converged || !(cone.rms_mm < other_is_far_better * fit.rms_mm))
    return "";
  return fmt::format(". A cone leaves {:.3g} µm: use --surface cone (surface = \"cone\" in a job)",
                     cone.rms_mm / mm_per_um);
}

std::string out_of_proportion(const ProbeStream& stream, const FitResult& fit, const Refit& refit) {
  const double stated_mm = more_than_stated * stream.sensor_noise_mm.value_or(0.0);
  const double limit_mm =
      std::max(most_left_mm + most_left_per_radius * largest_radius_mm(stream), stated_mm);
  const std::string remedy =
      "Check that columns, units and surface are right. If the part has grooves or slots, exclude "
      "them (--loss tukey). If the sensor really scatters like that, state it: "
      "'# sensor_noise: 1 mm'";
  // A keyway or a chip is not scatter: the bulk of the residuals counts.
  if (fit.rms_mm > limit_mm && mad_sigma(fit.residual_mm) > limit_mm) {
    const std::string other = other_surface(stream, fit, refit);
    return fmt::format(
        "the residuals are {:.3g} mm RMS. No turned part and probe leave more than {:.2g} mm, so "
        "these readings are not those of a probe on a {}{}",
        fit.rms_mm, limit_mm, to_string(fit.surface), other.empty() ? ". " + remedy : other);
  }
  if (fit.rms_mm < most_scatter_mm) return "";
  const double scatter = scatter_mm(stream, fit.residual_mm);
  if (scatter > std::max(most_scatter_mm, stated_mm) && scatter > mostly_scatter * fit.rms_mm) {
    return fmt::format(
        "single readings scatter by {:.2g} mm, and a working probe by less than {:.2g} mm: the "
        "readings are probably not those of a probe. {}",
        scatter, most_scatter_mm, remedy);
  }
  return "";
}

/// Whether lobes of two readings each can be: an even number of readings in every revolution.
bool has_lobes_of_two_readings(const ProbeStream& stream) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < stream.size() && steps.size() < 2000; ++i)
    steps.push_back(std::abs(stream.c_rad[i] - stream.c_rad[i - 1]));
  const double step = steps.empty() ? 0.0 : median(std::move(steps));
  if (!(step > 0.0)) return true;
  const double lobes = 0.5 * two_pi / step;
  return std::abs(lobes - std::round(lobes)) < 0.01;
}

/// Residuals that alternate from row to row, by more than all else that is left; empty: none do.
std::string alternate_rows(const ProbeStream& stream, const FitResult& fit) {
  if (!stream.x_convention || has_lobes_of_two_readings(stream)) return "";
  if (fit.residual_mm.size() < 4 * 8 || fit.rms_mm < alternate_least_mm) return "";
  double sum = 0.0, squares = 0.0, sign = 1.0;
  for (const double r : fit.residual_mm) {
    sum += sign * r;
    squares += r * r;
    sign = -sign;
  }
  const auto n = static_cast<double>(fit.residual_mm.size());
  const double half_mm = std::abs(sum) / n;
  const double explained = n * half_mm * half_mm / squares;  // share; n times it is chi-squared
  if (explained < alternate_share || n * explained < six_sigma) return "";
  return fmt::format(
      "odd and even rows of {} differ by {:.3g} µm all through: two recordings are interleaved, or "
      "two sensors are in one column. Write each to its own file",
      stream.source, 2.0 * half_mm / mm_per_um);
}

/// A sphere fits far better than a cone, which two sections are as well: any line through its
/// centre is an axis of it; empty: none does.
std::string is_sphere(const ProbeStream& stream, const FitResult& fit, const Refit& refit) {
  if (fit.surface != SurfaceKind::cone && fit.surface != SurfaceKind::cylinder) return "";
  if (fit.rms_mm < sphere_leaves_mm || stream.indication == Indication::relative ||
      list_set_ups(stream).size() > 1)
    return "";
  const FitResult sphere = refit(stream, SurfaceKind::sphere);
  const FitResult cone = fit.surface == SurfaceKind::cone ? fit : refit(stream, SurfaceKind::cone);
  const double other_mm =
      cone.status == FitStatus::converged ? std::min(cone.rms_mm, fit.rms_mm) : fit.rms_mm;
  if (sphere.status != FitStatus::converged || !(sphere.rms_mm < sphere_share * other_mm))
    return "";
  return fmt::format(
      "the readings are those of a sphere of radius {:.6g} mm, not of a cone or cylinder, and a "
      "sphere has no axis: `trueaxis fit {} --surface sphere` finds its centre; a job cannot use a "
      "sphere",
      sphere.parameter("radius").value, stream.source);
}

/// A part of another radius than is stated, all along the probed length; empty: it is not.
std::string not_nominal(const ProbeStream& stream, const FitResult& fit) {
  if (!stream.nominal_radius_mm || stream.indication == Indication::relative ||
      !is_diagnosed(fit.surface) || fit.surface == SurfaceKind::plane)
    return "";
  const double nominal_mm = *stream.nominal_radius_mm, radius_mm = fit.shape.radius_mm;
  const double length_mm = fit.position_max_mm - fit.position_min_mm;
  const double off_mm =
      std::abs(radius_mm - nominal_mm) - 0.5 * length_mm * std::abs(fit.shape.tan_half_angle);
  if (!(off_mm > off_nominal_mm + off_nominal * nominal_mm)) return "";
  return fmt::format(
      "the readings show a radius of {:.5g} mm, and nominal_radius is {:.5g} mm: check whether X_M "
      "is a radius or a diameter, its unit and zero, or correct nominal_radius",
      radius_mm, nominal_mm);
}

/// Correlation of the residuals in the order of `rows`, from one to the next.
double neighbours_correlate(const std::vector<double>& left_mm,
                            const std::vector<std::size_t>& rows) {
  double products = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double r = left_mm[rows[i]];
    squares += r * r;
    if (i > 0) products += r * left_mm[rows[i - 1]];
  }
  return squares > 0.0 ? products / squares : 0.0;
}

/// Residuals that are white in time and in angle and yet have the distribution of a sine, with a
/// kurtosis of 1.5, below the 1.8 of the flattest noise: X_M and C are not of the same instants.
/// Empty: they are like noise, or form.
std::string unlike_noise(const ProbeStream& stream, const FitResult& fit) {
  const std::vector<double>& left_mm = fit.residual_mm;
  const auto n = static_cast<double>(left_mm.size());
  std::vector<double> steps;
  for (std::size_t i = 1; i < stream.size(); ++i)
    if (const double step = std::abs(stream.reading_mm[i] - stream.reading_mm[i - 1]); step > 0.0)
      steps.push_back(step);
  if (n < least_for_kurtosis || steps.empty() ||
      fit.rms_mm < many_digits * *std::ranges::min_element(steps))
    return "";
  double second = 0.0, fourth = 0.0, eighth = 0.0;
  for (const double r : left_mm) {
    const double r2 = r * r;
    second += r2 / n;
    fourth += r2 * r2 / n;
    eighth += r2 * r2 * r2 * r2 / n;
  }
  const double kurtosis = fourth / (second * second);
  const double u = std::sqrt((eighth - fourth * fourth) / n) / (second * second);
  if (!(kurtosis + 3.0 * u < flattest_noise)) return "";
  std::vector<std::size_t> rows(left_mm.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  const double in_time = neighbours_correlate(left_mm, rows);
  std::ranges::sort(rows, {},
                    [&](std::size_t i) { return std::remainder(stream.c_rad[i], two_pi); });
  const double in_angle = neighbours_correlate(left_mm, rows);
  if (std::max(std::abs(in_time), std::abs(in_angle)) * std::sqrt(n) > white_sds) return "";
  return fmt::format(
      "the residuals ({:.3g} µm RMS) are not ordered in time or angle, but have the distribution "
      "of a sine: X_M and C of a row were not recorded at the same instant (a column was sorted or "
      "shuffled), or X_M is another channel",
      fit.rms_mm / mm_per_um);
}

void withhold_all(FitResult& fit, const std::string& why) {
  const auto withhold = [&](std::vector<FitParameter>& parameters) {
    for (FitParameter& one : parameters) one.estimate = {.unit = one.estimate.unit, .why_not = why};
  };
  withhold(fit.parameters);
  withhold(fit.derived);
  for (SetUpFit& one : fit.set_ups) withhold(one.parameters);
}

}  // namespace

std::string implausible(const ProbeStream& stream, const FitResult& fit, const Refit& refit) {
  if (fit.status == FitStatus::too_few) return "";
  if (std::string why = column_objection(stream); !why.empty()) return why;
  if (std::string why = alternate_rows(stream, fit); !why.empty()) return why;
  if (std::string why = likely_misreading(stream, fit, refit); !why.empty()) return why;
  // A program that fills a stream knows its units: a model may have any scale.
  if (!stream.x_convention || fit.status != FitStatus::converged) return "";
  if (std::string why = not_nominal(stream, fit); !why.empty()) return why;
  if (std::string why = is_sphere(stream, fit, refit); !why.empty()) return why;
  if (std::string why = unlike_noise(stream, fit); !why.empty()) return why;
  return out_of_proportion(stream, fit, refit);
}

void refuse(FitResult& fit, const std::string& why) {
  fit.status = FitStatus::implausible;
  fit.message = why;
  withhold_all(fit, "the readings are implausible");
}

void withhold_if_drawn(const ProbeStream& stream, FitResult& fit) {
  if (fit.loss != Loss::plain || !fit.axis_known() || !is_diagnosed(fit.surface)) return;
  const double limit_mm = suspect_sds * mad_sigma(fit.residual_mm);
  std::complex<double> sum = 0.0;
  std::size_t far = 0;
  for (std::size_t i = 0; i < fit.residual_mm.size(); ++i) {
    if (std::abs(fit.residual_mm[i]) <= limit_mm) continue;
    sum += std::polar(fit.residual_mm[i], stream.c_rad[i]);
    ++far;
  }
  const double drawn_mm = 2.0 * std::abs(sum) / static_cast<double>(fit.residual_mm.size());
  const double U_mm = fit.coverage_factor * std::min(fit.axis.u_at(fit.position_min_mm),
                                                     fit.axis.u_at(fit.position_max_mm));
  if (far == 0 || !(drawn_mm > U_mm)) return;
  withhold_all(fit, fmt::format("{} far off and draw{} it by about {:.3g} µm, as a keyway does: "
                                "exclude them (--loss tukey)",
                                counted(far, "reading lies", "readings lie"), far == 1 ? "s" : "",
                                drawn_mm / mm_per_um));
}

}  // namespace trueaxis
