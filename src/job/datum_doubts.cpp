// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "correct/coaxiality_distribution.hpp"
#include "job/checks.hpp"
#include "job/references.hpp"
#include "job/slip.hpp"

namespace trueaxis {
namespace {

bool is_member(const PlannedJob& result, std::size_t i) {
  return std::ranges::any_of(result.job.datums, [&](const auto& names) {
    return std::ranges::count(names, result.job.references[i].name) > 0;
  });
}

/// The coaxiality of reference i with the datum is above this with 95 %.
double least_off_mm(const PlannedJob& result, std::size_t i) {
  const Reference reference = references_of(result)[i];
  const TargetSurface& target = *result.job.target;
  return CoaxialityDistribution({&reference, 1}, result.target_axis->axis.axis, target.z_start_mm,
                                target.z_end_mm)
      .quantile(nonconformity_risk);
}

/// How far off the datum a reference is at least, where that is more than the tolerance.
std::optional<Reason> too_far(const PlannedJob& result, std::size_t i, ReasonCode code) {
  if (result.fits[i].surface == SurfaceKind::plane || !result.job.coaxiality_tolerance_mm)
    return {};
  const double least_mm = least_off_mm(result, i);
  if (!(least_mm > *result.job.coaxiality_tolerance_mm)) return {};
  return Reason{code, {i}, {{"off", least_mm, "mm"}}, {{"datum", result.datum->name}}};
}

/// For the references that are in the datum, or for those that are not.
Reasons off_the_datum(const PlannedJob& result, bool members, ReasonCode code) {
  Reasons found;
  if (!result.datum || !result.target_axis) return found;
  for (std::size_t i = 0; i < result.fits.size(); ++i)
    if (is_member(result, i) == members)
      if (const auto far = too_far(result, i, code)) found.push_back(*far);
  return found;
}

Reasons find_slip(const CheckInput& in) {
  return first_of_references(in.job, [&](std::size_t i) -> std::optional<Reason> {
    if (const auto slipped = slipped_since(in.job, i))
      return Reason{ReasonCode::slipped_between_references, {*slipped}, {}, {}, {},
                    {Reason{ReasonCode::probe_all_again}}};
    return {};
  });
}

Reasons find_members_apart(const CheckInput& in) {
  Reasons found = off_the_datum(in.job, true, ReasonCode::datum_members_apart);
  if (found.size() > 1) found.resize(1);
  return found;
}

Reasons find_off_datum(const CheckInput& in) {
  return off_the_datum(in.job, false, ReasonCode::reference_off_datum);
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
