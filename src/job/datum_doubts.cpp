// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "correct/coaxiality_distribution.hpp"
#include "job/checks.hpp"
#include "job/references.hpp"
#include "job/slip.hpp"
#include "job/target_datum.hpp"

namespace trueaxis {
namespace {

bool is_member(const PlannedJob& result, std::size_t i) {
  return std::ranges::any_of(result.job.datums, [&](const auto& names) {
    return std::ranges::count(names, result.job.references[i].name) > 0;
  });
}

/// How far off an axis a reference is at least (95 %), where that is more than the tolerance.
std::optional<Reason> too_far(const PlannedJob& result, std::size_t i, const Axis& axis,
                              ReasonCode code, const std::string& datum) {
  if (result.fits[i].surface == SurfaceKind::plane || !result.job.coaxiality_tolerance_mm)
    return {};
  const Reference reference = references_of(result)[i];
  const TargetSurface& target = *result.job.target;
  const double least_mm =
      CoaxialityDistribution({&reference, 1}, axis, target.z_start_mm, target.z_end_mm)
          .quantile(nonconformity_risk);
  if (!(least_mm > *result.job.coaxiality_tolerance_mm)) return {};
  return Reason{code, {i}, {{"off", least_mm, "mm"}}, {{"datum", datum}}};
}

Reasons find_slip(const CheckInput& in) {
  return first_of_references(in.job, [&](std::size_t i) -> std::optional<Reason> {
    if (const auto slipped = slipped_since(in.job, i))
      return Reason{ReasonCode::slipped_between_references, {*slipped}, {}, {}, {},
                    {Reason{ReasonCode::probe_all_again}}};
    return {};
  });
}

/// References of one datum share one axis; a face and the axis after it, two datums, need not be
/// square.
Reasons find_members_apart(const CheckInput& in) {
  if (!in.job.datum || !in.job.target_axis) return {};
  for (const auto& names : in.job.job.datums) {
    if (names.size() < 2) continue;
    const Axis axis = shared_axis(in.job, names);
    for (std::size_t i = 0; i < in.job.fits.size(); ++i)
      if (std::ranges::count(names, in.job.job.references[i].name) > 0)
        if (const auto far = too_far(in.job, i, axis, ReasonCode::datum_members_apart,
                                     fmt::format("{}", fmt::join(names, "-"))))
          return {*far};
  }
  return {};
}

Reasons find_off_datum(const CheckInput& in) {
  Reasons found;
  if (!in.job.datum || !in.job.target_axis) return found;
  for (std::size_t i = 0; i < in.job.fits.size(); ++i)
    if (!is_member(in.job, i))
      if (const auto far = too_far(in.job, i, in.job.target_axis->axis.axis,
                                   ReasonCode::reference_off_datum, in.job.datum->name))
        found.push_back(*far);
  return found;
}

constexpr Threshold beyond_tolerance[] = {
    {"off", 1.0, "of the tolerance", "what is less is within what the job allows"}};

}  // namespace

constinit const JobCheck slipped_between_references{
    "slipped_between_references", CheckedAt::references, Weight::leaves_open, {}, find_slip};
constinit const JobCheck datum_members_apart{"datum_members_apart", CheckedAt::cut,
                                             Weight::leaves_open, beyond_tolerance,
                                             find_members_apart};
constinit const JobCheck references_off_datum{"references_off_datum", CheckedAt::cut,
                                              Weight::reserves, beyond_tolerance, find_off_datum};

}  // namespace trueaxis
