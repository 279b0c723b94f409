// SPDX-License-Identifier: Apache-2.0
#include "job/exchanged.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>

#include "job/mistakes.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double far_better = 1.0 / 3.0;  // of the RMS
constexpr double as_good = 1.2;
constexpr double most_feed_mm = 5.0;  // a turn: nobody probes coarser

/// What a fit leaves; of one that has no surface at all the scatter of the readings.
double left_mm(const ProbeStream& stream, const FitResult& fit) {
  if (!fit.residual_mm.empty()) return fit.rms_mm;
  const auto n = static_cast<double>(stream.size());
  const double mean = std::accumulate(stream.reading_mm.begin(), stream.reading_mm.end(), 0.0) / n;
  double squares = 0.0;
  for (const double reading : stream.reading_mm) squares += (reading - mean) * (reading - mean);
  return std::sqrt(squares / n);
}

double median_step_rad(const ProbeStream& stream) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < stream.size(); ++i)
    steps.push_back(std::abs(stream.c_rad[i] - stream.c_rad[i - 1]));
  return steps.empty() ? 0.0 : median(std::move(steps));
}

double travel_mm(const ProbeStream& stream) {
  return stream.has_position() ? range_of(stream.position_mm).length() : 0.0;
}

/// Whether C turns as a spindle's: about a turn or more, several readings each.
bool turns_around(const ProbeStream& stream) {
  return range_of(stream.c_rad).length() >= 0.9 * two_pi &&
         median_step_rad(stream) <= 0.25 * two_pi;
}

/// And with turns as close together along Z as is probed.
bool like_a_spindle(const ProbeStream& stream) {
  return turns_around(stream) &&
         travel_mm(stream) <= most_feed_mm * range_of(stream.c_rad).length() / two_pi;
}

std::string um_text(double length_mm) { return fmt::format("{:.3g} µm", length_mm / mm_per_um); }

}  // namespace

std::string reference_and_file(const JobResult& result, std::size_t i) {
  const JobReference& reference = result.job.references[i];
  const std::string file = std::filesystem::path(reference.stream).filename().string();
  return reference.name + (file.empty() ? "" : " (" + file + ")");
}

std::string turns_of(const ProbeStream& stream) {
  const Extent c = range_of(stream.c_rad);
  const double turns = c.length() / two_pi, travel = travel_mm(stream);
  std::string text = fmt::format("C runs from {:.4g}° to {:.4g}° ({:.3g} turns",
                                 c.low / rad_per_deg, c.high / rad_per_deg, turns);
  if (travel > 0.0) text += fmt::format(", {:.3g} per mm", turns / travel);
  return text + ")";
}

std::string wrong_unit_of_c(const JobResult& result, std::size_t i) {
  const ProbeStream& stream = result.streams[i];
  const FitResult& as_read = result.fits[i];
  if (as_read.status == FitStatus::too_few || like_a_spindle(stream)) return "";
  const double before_mm = left_mm(stream, as_read);
  for (const Mistake& mistake : mistakes_of_unit()) {
    const ProbeStream right = mended(stream, mistake);
    if (!turns_around(right)) continue;
    const FitResult again = fit(right, result.job.references[i].fit);
    if (again.status != FitStatus::converged || again.rms_mm > far_better * before_mm ||
        again.points < 2 * again.parameters.size() + 10)
      continue;
    return fmt::format("{}: {}; as written {} are left and {}, else {} and {}",
                       fmt::format(fmt::runtime(mistake.what), reference_and_file(result, i)),
                       mistake.mend, um_text(before_mm), turns_of(stream), um_text(again.rms_mm),
                       turns_of(right));
  }
  return "";
}

std::string exchanged_streams(const JobResult& result) {
  for (std::size_t i = 0; i < result.streams.size(); ++i) {
    for (std::size_t j = i + 1; j < result.streams.size(); ++j) {
      const FitOptions &of_i = result.job.references[i].fit, &of_j = result.job.references[j].fit;
      const FitResult &a = result.fits[i], &b = result.fits[j];
      if (of_i.surface == of_j.surface || of_i.profile || of_j.profile ||
          result.streams[i].kind != result.streams[j].kind || a.status == FitStatus::too_few ||
          b.status == FitStatus::too_few || of_i.surface == SurfaceKind::section ||
          of_j.surface == SurfaceKind::section)
        continue;
      const double a_mm = left_mm(result.streams[i], a), b_mm = left_mm(result.streams[j], b);
      const FitResult a_by_j = fit(result.streams[i], of_j), b_by_i = fit(result.streams[j], of_i);
      const bool fits = a_by_j.status == FitStatus::converged &&
                        b_by_i.status == FitStatus::converged && a_by_j.rms_mm <= as_good * a_mm &&
                        b_by_i.rms_mm <= as_good * b_mm;
      const bool better = a_by_j.rms_mm <= far_better * a_mm || b_by_i.rms_mm <= far_better * b_mm;
      if (!fits || !better) continue;
      return fmt::format(
          "{} and {} have each other's stream: as given their fits leave {} and {}, exchanged {} "
          "and {}: exchange their `stream`",
          reference_and_file(result, i), reference_and_file(result, j), um_text(a_mm),
          um_text(b_mm), um_text(b_by_i.rms_mm), um_text(a_by_j.rms_mm));
    }
  }
  return "";
}

}  // namespace trueaxis
