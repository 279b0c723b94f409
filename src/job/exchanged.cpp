// SPDX-License-Identifier: Apache-2.0
#include "job/exchanged.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>

#include "fit/plausible.hpp"
#include "job/mistakes.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double far_better = 1.0 / 3.0;  // of the RMS
constexpr double as_good = 1.2;

std::string um_text(double length_mm) { return fmt::format("{:.3g} µm", length_mm / mm_per_um); }

}  // namespace

std::string reference_and_file(const JobResult& result, std::size_t i) {
  const JobReference& reference = result.job.references[i];
  const std::string file = std::filesystem::path(reference.stream).filename().string();
  return reference.name + (file.empty() ? "" : " (" + file + ")");
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
