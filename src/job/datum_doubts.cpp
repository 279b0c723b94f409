// SPDX-License-Identifier: Apache-2.0
#include "job/datum_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "correct/coaxiality_distribution.hpp"
#include "job/references.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

bool is_member(const JobResult& result, std::size_t i) {
  return std::ranges::any_of(result.job.datums, [&](const auto& names) {
    return std::ranges::count(names, result.job.references[i].name) > 0;
  });
}

/// That the coaxiality of reference i with the datum is above in 95 of 100.
double least_off_mm(const JobResult& result, std::size_t i) {
  const Reference reference = references_of(result)[i];
  const TargetSurface& target = *result.job.target;
  return CoaxialityDistribution({&reference, 1}, result.target_axis->axis.axis, target.z_start_mm,
                                target.z_end_mm)
      .quantile(nonconformity_risk);
}

/// "A is at least 23 µm (a diameter) off the datum A-B, tolerance 10 µm"; empty: it is not.
std::string too_far(const JobResult& result, std::size_t i) {
  if (result.fits[i].surface == SurfaceKind::plane || !result.job.coaxiality_tolerance_mm)
    return "";
  const double least_mm = least_off_mm(result, i),
               tolerance_mm = *result.job.coaxiality_tolerance_mm;
  if (!(least_mm > tolerance_mm)) return "";
  return fmt::format("{} is at least {:.3g} µm (a diameter, over the cut) off the datum {}",
                     result.job.references[i].name, least_mm / mm_per_um, result.datum->name);
}

}  // namespace

std::string datum_objection(const JobResult& result) {
  if (!result.datum || !result.target_axis) return "";
  for (std::size_t i = 0; i < result.diagnoses.size() && result.fits.size() > 1; ++i)
    if (result.diagnoses[i] && result.diagnoses[i]->slip())
      return fmt::format(
          "the part slipped while {} was probed, and the other references may have been probed "
          "before: probe all of them again as the part now stands",
          result.job.references[i].name);
  for (std::size_t i = 0; i < result.fits.size(); ++i) {
    if (!is_member(result, i)) continue;
    if (const std::string far = too_far(result, i); !far.empty())
      return far +
             ", more than the tolerance, so that the references of the datum share no axis: "
             "see whether all were probed in one clamping and whether Z and C are counted alike";
  }
  return "";
}

std::vector<std::string> datum_reservations(const JobResult& result) {
  std::vector<std::string> list;
  if (!result.datum || !result.target_axis) return list;
  for (std::size_t i = 0; i < result.fits.size(); ++i) {
    if (is_member(result, i)) continue;
    if (const std::string far = too_far(result, i); !far.empty())
      list.push_back(far +
                     ", and no tolerance is held against it: see whether it was probed in the "
                     "same clamping");
  }
  return list;
}

}  // namespace trueaxis
