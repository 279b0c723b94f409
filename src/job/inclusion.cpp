// SPDX-License-Identifier: Apache-2.0
#include "job/inclusion.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "trueaxis/effect.hpp"

namespace trueaxis {
namespace {

bool repeats(const Diagnosis& diagnosis, std::string_view id) {
  const Effect* effect = diagnosis.entry(id);
  return effect && effect->repeats_at_tool;
}

/// What a finding may be that must not be copied into the cut.
struct ForbiddenCause {
  std::string effect;        ///< the most probable of them; empty: there is none
  double probability = 0.0;  ///< of all of them
};

ForbiddenCause forbidden_cause(const Diagnosis& diagnosis, const Finding& finding) {
  ForbiddenCause out;
  if (!repeats(diagnosis, finding.effect())) out = {finding.effect(), finding.probability};
  for (const Rival& rival : finding.rivals) {  // the most probable first
    if (repeats(diagnosis, rival.effect)) continue;
    if (out.effect.empty()) out.effect = rival.effect;
    out.probability += rival.probability;
  }
  return out;
}

/// Why a finding must not be cut with; empty: it may. A line that is free in its order fits noise a
/// little better than the whole order beside it, so chance keeps it in the class with a small
/// probability: what may be copied by mistake is what a go may be wrong by.
std::string objection(const JobResult& result, const Diagnosis& diagnosis, const Finding& finding) {
  const ForbiddenCause other = forbidden_cause(diagnosis, finding);
  if (other.probability > nonconformity_risk) {
    return fmt::format(
        "the data cannot tell it from {} (class {}), which must not be copied into the cut; the "
        "probability of such a cause is {:.2g}, allowed are {:.2g}",
        other.effect, fmt::join(finding.members(), ", "), other.probability, nonconformity_risk);
  }
  if (std::abs(finding.term.shape.order - std::round(finding.term.shape.order)) > 1e-9)
    return "it does not repeat every revolution";
  if (result.job.target->kind == TargetKind::face)
    return diagnosis.baseline.surface == SurfaceKind::plane
               ? "a face is cut without the motions that were seen on it"
               : "it was seen along X, and a face is cut along Z";
  if (side_of_tool(result.job.tool.angle_from_probe_rad) == 0)
    return "the probe saw it along its own direction; the tool's angle from the probe must be 0 or "
           "180 deg";
  const auto [low, high] = std::minmax(result.job.target->z_start_mm, result.job.target->z_end_mm);
  const bool outside = low < diagnosis.z_mid_mm - 1.05 * diagnosis.z_half_mm ||
                       high > diagnosis.z_mid_mm + 1.05 * diagnosis.z_half_mm;
  if (finding.term.effect->frame == EffectFrame::machine && outside)
    return "the length to be cut reaches beyond the one that was probed";
  return "";
}

bool known_already(const std::vector<RepeatingMotion>& motions, const Finding& finding) {
  return std::ranges::any_of(motions, [&](const RepeatingMotion& m) {
    return m.term.effect == finding.term.effect && m.term.shape.order == finding.term.shape.order;
  });
}

}  // namespace

std::span<const std::string_view> repeating_effects() {
  static const std::vector<std::string_view> ids = [] {
    std::vector<std::string_view> list;
    for (const Effect& effect : effect_catalogue())
      if (effect.repeats_at_tool) list.push_back(effect.id);
    return list;
  }();
  return ids;
}

std::vector<RepeatingMotion> included_motions(JobResult& result) {
  std::vector<RepeatingMotion> motions;
  for (const std::string& wish : result.job.include) {
    bool found = false;
    for (std::size_t i = 0; i < result.diagnoses.size(); ++i) {
      if (!result.diagnoses[i]) continue;
      const Diagnosis& diagnosis = *result.diagnoses[i];
      for (const Finding& finding : diagnosis.findings) {
        if (!finding.may_be(wish)) continue;
        found = true;
        Inclusion inclusion{wish, result.job.references[i].name, false, false,
                            objection(result, diagnosis, finding)};
        if (!inclusion.why.empty()) {
          inclusion.refused = true;
        } else if (finding.effect() != wish) {
          inclusion.why = "it is named " + finding.effect() + " there";
        } else if (known_already(motions, finding)) {
          inclusion.why = "another reference shows it already";
        } else {
          inclusion.included = true;
          if (const ForbiddenCause other = forbidden_cause(diagnosis, finding);
              !other.effect.empty())
            inclusion.why =
                fmt::format("the probability that it is {}, which should not be, is {:.2g}",
                            other.effect, other.probability);
          motions.push_back({finding.term, diagnosis.z_mid_mm, diagnosis.z_half_mm});
        }
        result.inclusions.push_back(inclusion);
      }
    }
    if (!found) result.inclusions.push_back({wish, "", false, false, "it was not found"});
  }
  return motions;
}

}  // namespace trueaxis
