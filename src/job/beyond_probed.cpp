// SPDX-License-Identifier: Apache-2.0
#include "job/beyond_probed.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "job/references.hpp"
#include "job/target_datum.hpp"

namespace trueaxis {
namespace {

/// A line and the length that it was probed over.
struct ProbedLine {
  AxisEstimate axis;
  double low_mm, high_mm;
};

/// What causes that the data cannot tell would add is not of a line.
const FitResult& of_the_line(const PlannedJob& result, std::size_t i) {
  const bool named = i < result.diagnoses.size() && result.diagnoses[i] &&
                     result.diagnoses[i]->named.status == FitStatus::converged;
  return named ? result.diagnoses[i]->named : fit_used(result, i);
}

bool counts(const AxisMatrix& share) {
  return std::ranges::any_of(share.by_rows, [](double one) { return one != 0.0; });
}

/// The axis of the datum, over the length of all that it rests on.
ProbedLine line_of_datum(const PlannedJob& result) {
  std::vector<Reference> references = references_of(result);
  constexpr double far = std::numeric_limits<double>::infinity();
  ProbedLine out{{}, far, -far};
  for (std::size_t i = 0; i < references.size(); ++i) {
    const FitResult& fit = of_the_line(result, i);
    references[i].axis = fit.axis;
    if (fit.surface == SurfaceKind::plane || !counts(result.datum->shares[i])) continue;
    out.low_mm = std::min(out.low_mm, fit.position_min_mm);
    out.high_mm = std::max(out.high_mm, fit.position_max_mm);
  }
  out.axis = judged(result, references).front().axis;
  return out;
}

ProbedLine line_of(const PlannedJob& result, std::size_t i) {
  if (result.datum) return line_of_datum(result);
  const FitResult& fit = of_the_line(result, i);
  return {fit.axis, fit.position_min_mm, fit.position_max_mm};
}

double u_beyond(const ProbedLine& line, const TargetSurface& target) {
  constexpr int places = 32;
  double least = line.axis.u_at(line.low_mm);
  for (int k = 1; k <= places; ++k)
    least =
        std::min(least, line.axis.u_at(line.low_mm + (line.high_mm - line.low_mm) * k / places));
  const double worst = std::max(line.axis.u_at(target.z_start_mm), line.axis.u_at(target.z_end_mm));
  return least > 0.0 && std::isfinite(worst) ? worst / least : 1.0;
}

}  // namespace

double u_beyond_probed(const PlannedJob& result, std::size_t i) {
  if (!result.job.target || result.job.target->kind == TargetKind::face ||
      of_the_line(result, i).surface == SurfaceKind::plane)
    return 1.0;
  if (result.datum && !counts(result.datum->shares[i])) return 1.0;
  return u_beyond(line_of(result, i), *result.job.target);
}

std::optional<Reason> extrapolation(const PlannedJob& result, double factor, ReasonCode code) {
  for (std::size_t i = 0; i < result.fits.size(); ++i) {
    const double times = u_beyond_probed(result, i);
    if (!(times > factor)) continue;
    const ProbedLine line = line_of(result, i);
    Reason reason{code,
                  {i},
                  {{"z_start", result.job.target->z_start_mm, "mm"},
                   {"z_end", result.job.target->z_end_mm, "mm"},
                   {"z_low", line.low_mm, "mm"},
                   {"z_high", line.high_mm, "mm"},
                   {"times", times}}};
    if (result.datum) {
      reason.references.clear();
      reason.names = {{"datum", result.datum->name}};
    }
    return reason;
  }
  return {};
}

std::optional<Reason> common_datum(const PlannedJob& result) {
  if (result.datum || !result.job.target) return {};
  double low_mm = std::numeric_limits<double>::infinity(), high_mm = -low_mm;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < result.fits.size(); ++i) {
    const FitResult& fit = of_the_line(result, i);
    if (fit.surface == SurfaceKind::plane) continue;
    low_mm = std::min(low_mm, fit.position_min_mm);
    high_mm = std::max(high_mm, fit.position_max_mm);
    names.push_back("\"" + result.job.references[i].name + "\"");
  }
  const auto [from_mm, to_mm] =
      std::minmax(result.job.target->z_start_mm, result.job.target->z_end_mm);
  if (names.size() < 2 || from_mm < low_mm || to_mm > high_mm) return {};
  return Reason{ReasonCode::take_common_datum,
                {},
                {},
                {{"references", fmt::format("{}", fmt::join(names, ", "))}}};
}

}  // namespace trueaxis
