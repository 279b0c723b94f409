// SPDX-License-Identifier: Apache-2.0
#include "diagnose/explain/named_values.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace trueaxis::diagnose_detail {
namespace {

void add_shape(const TermValue& term, std::vector<NamedValue>& out) {
  const bool rate_alone = std::holds_alternative<GrowthInTime>(term.effect->term) &&
                          !term.free.empty() && term.free.front() == 0;
  if (rate_alone) return;
  for (const std::string& name : shape_parameters(term.effect->term)) {
    if (const EffectParameter* told = parameter_for(*term.effect, name))
      out.push_back(
          {std::string(told->name), std::string(told->unit), shape_value(term.shape, name)});
  }
}

}  // namespace

std::vector<NamedValue> values_of(const TermValue& term) {
  const Effect& effect = *term.effect;
  std::vector<NamedValue> out;
  const auto names = linear_parameters(effect.term, term.shape);
  const auto free = [&](std::size_t j) {
    return term.free.empty() || std::ranges::find(term.free, j) != term.free.end();
  };
  for (std::size_t j = 0; j < names.size(); ++j) {
    if (!free(j)) continue;
    const LinearParameter& linear = names[j];
    const std::string& unit = linear.unit;
    if (linear.factor != LinearParameter::Factor::cosine) {
      const EffectParameter* told = parameter_for(effect, linear.name);
      out.push_back({told ? std::string(told->name) : linear.name, unit, term.linear[j]});
      continue;
    }
    const std::string of(linear.size_name());
    const double c = term.linear[j], s = term.linear[j + 1];
    out.push_back({of, unit, std::hypot(c, s)});
    const double phase = std::atan2(effect.line ? -s : s, c);
    if (of != "amplitude")
      out.push_back({of + "_phase", "rad", phase});
    else if (has_two_orders(effect.term))
      out.push_back({"jaw_angle", "rad", phase / term.shape.order});
    else
      out.push_back({"phase", "rad", phase});
    ++j;
  }
  add_shape(term, out);
  return out;
}

}  // namespace trueaxis::diagnose_detail
