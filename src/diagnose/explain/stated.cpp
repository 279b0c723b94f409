// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "diagnose/explain/explanation.hpp"

namespace trueaxis::diagnose_detail {
Effect as_stated(Effect effect, const Influence& influence) {
  effect.stated = influence;
  for (const LinearParameter& one : linear_parameters(effect.term, {}))
    for (EffectParameter& parameter : effect.parameters) {
      if (&parameter != size_for(effect, one)) continue;
      parameter.least -= influence.value, parameter.most -= influence.value;
    }
  return effect;
}

namespace {

/// What a cause says of its own statement, beyond its value, or of its twin's if that cancels what
/// is stated. A twin that adds to it is another cause.
bool contradicts(const Finding& finding, const Effect& stated) {
  if (finding.effect() == stated.id) return true;
  return finding.effect() == stated.second_order_twin && !finding.term.effect->stated &&
         finding.term.linear.front() * stated.stated->value < 0.0;
}

}  // namespace

std::vector<RefutedStatement> refuted_statements(const std::vector<Finding>& findings,
                                                 std::span<const Effect> entries) {
  std::vector<RefutedStatement> out;
  for (const Effect& effect : entries)
    for (const Finding& finding : findings) {
      if (!effect.stated || !contradicts(finding, effect)) continue;
      const double remains = finding.term.linear.front();
      const double u = std::sqrt(std::max(0.0, finding.term.covariance(0, 0)));
      if (std::abs(remains) <= refuted_by * std::hypot(effect.stated->u, u)) continue;
      out.push_back({*effect.stated,
                     {effect.stated->value + remains, u,
                      std::string(info_of(effect.stated->kind).unit), ""}});
    }
  return out;
}

}  // namespace trueaxis::diagnose_detail
