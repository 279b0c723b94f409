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

/// What a cause may be that must not be copied into the cut.
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

/// Why a cause must not be cut with; none: it may. A line that is free in its order fits noise a
/// little better than the whole order next to it. Noise therefore keeps it in the class with a
/// small probability. What may be copied by mistake is what a go may be wrong by.
std::optional<Reason> motion_objection(const Job& job, const Diagnosis& diagnosis,
                                       const Finding& finding) {
  const ForbiddenCause other = forbidden_cause(diagnosis, finding);
  if (other.probability > nonconformity_risk)
    return Reason{ReasonCode::not_told_from_forbidden,
                  {},
                  {{"probability", other.probability}, {"allowed", nonconformity_risk}},
                  {{"cause", other.effect},
                   {"class", fmt::format("{}", fmt::join(finding.members(), ", "))}}};
  if (std::abs(finding.term.shape.order - std::round(finding.term.shape.order)) > 1e-9)
    return Reason{ReasonCode::not_repeating};
  if (job.target->kind == TargetKind::face)
    return Reason{diagnosis.baseline.surface == SurfaceKind::plane ? ReasonCode::seen_on_a_face
                                                                   : ReasonCode::seen_along_x};
  if (side_of_tool(job.tool.angle_from_probe_rad) == 0)
    return Reason{ReasonCode::tool_off_probe_line};
  const auto [low, high] = std::minmax(job.target->z_start_mm, job.target->z_end_mm);
  const bool outside = low < diagnosis.z_mid_mm - 1.05 * diagnosis.z_half_mm ||
                       high > diagnosis.z_mid_mm + 1.05 * diagnosis.z_half_mm;
  // Motions that the readings do not tell apart are one where they were read, and not beyond.
  double others = 0.0;
  for (const Rival& rival : finding.rivals) others += rival.probability;
  const bool same_beyond =
      finding.term.effect->frame != EffectFrame::machine && others <= nonconformity_risk;
  if (outside && !same_beyond) return Reason{ReasonCode::beyond_probed_length};
  return {};
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

namespace {

/// What becomes of a wish at a cause that may be it.
Inclusion inclusion_of(const std::string& wish, const IdentifiedJob& job, std::size_t i,
                       const Finding& finding, const std::vector<RepeatingMotion>& motions) {
  Inclusion out{wish, job.job.references[i].name, false, false,
                motion_objection(job.job, *job.diagnoses[i], finding)};
  out.refused = out.why.has_value();
  if (out.refused) return out;
  const ForbiddenCause other = forbidden_cause(*job.diagnoses[i], finding);
  if (finding.effect() != wish) {
    out.why = Reason{ReasonCode::named_otherwise, {}, {}, {{"effect", finding.effect()}}};
  } else if (known_already(motions, finding)) {
    out.why = Reason{ReasonCode::shown_by_another};
  } else {
    out.included = true;
    if (!other.effect.empty())
      out.why = Reason{ReasonCode::may_be_forbidden,
                       {},
                       {{"probability", other.probability}},
                       {{"cause", other.effect}}};
  }
  return out;
}

}  // namespace

IncludedMotions included_motions(const IdentifiedJob& job) {
  IncludedMotions out;
  for (const std::string& wish : job.job.include) {
    bool found = false;
    for (std::size_t i = 0; i < job.diagnoses.size(); ++i) {
      if (!job.diagnoses[i]) continue;
      const Diagnosis& diagnosis = *job.diagnoses[i];
      for (const Finding& finding : diagnosis.findings) {
        if (!finding.may_be(wish)) continue;
        found = true;
        out.inclusions.push_back(inclusion_of(wish, job, i, finding, out.motions));
        if (out.inclusions.back().included)
          out.motions.push_back({finding.term, diagnosis.z_mid_mm, diagnosis.z_half_mm});
      }
    }
    if (!found) out.inclusions.push_back({wish, "", false, false, Reason{ReasonCode::not_found}});
  }
  return out;
}

}  // namespace trueaxis
