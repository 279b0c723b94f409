// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "diagnose/explain/named_values.hpp"
#include "resimulate/diagnosed_scenarios.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using LatheEffect = virtual_lathe::Effect;
using LatheEffects = std::vector<LatheEffect>;
using Parameters = std::map<std::string, double>;

/// The lathe's name without the unit that ends it.
std::string_view without_unit(std::string_view name) {
  for (const std::string_view unit : {"_mm_per_rev", "_mm_per_s", "_mm", "_rad", "_hz", "_s"}) {
    if (name.ends_with(unit)) return name.substr(0, name.size() - unit.size());
  }
  return name;
}

std::string catalogue_name(const Effect& effect, std::string_view lathe_name) {
  const std::string_view bare = without_unit(lathe_name);
  const auto renamed = std::ranges::find(effect.names_in_lathe, bare, &NameInLathe::in_lathe);
  return std::string(renamed == effect.names_in_lathe.end() ? bare : renamed->name);
}

/// The catalogue's parameters of a term, inside units, and what the frame gives.
Parameters values_in(const TermValue& term, const LatheFrame& frame) {
  // A bent axis about its nearest line (Eq. 40); the part as it is after a step (Eq. 46).
  const double end_mm = std::abs(frame.z_mid_mm) + frame.z_half_mm;
  const double squares = frame.z_mid_mm * frame.z_mid_mm + frame.z_half_mm * frame.z_half_mm / 3.0;
  Parameters values{{"length", 2.0 * frame.z_half_mm},
                    {"middle", frame.z_mid_mm},
                    {"share", 1.0 / 3.0},
                    {"ends", 1.0},
                    {"radius", end_mm},
                    {"dish_mean", squares / end_mm / end_mm}};
  for (const auto& [name, unit, value] : diagnose_detail::values_of(term)) values[name] = value;
  return values;
}

/// Every parameter of the lathe's effect that has a value.
LatheEffect by_name(const Effect& entry, const Parameters& values) {
  LatheEffect effect{std::string(entry.id), {}};
  for (const auto& p : virtual_lathe::find_effect_kind(entry.id).parameters) {
    const auto found = values.find(catalogue_name(entry, p.name));
    if (found != values.end()) effect.parameters[std::string(p.name)] = found->second;
  }
  virtual_lathe::validate(effect);
  return effect;
}

/// The lathe has one phase for amplitude and growth.
LatheEffects growing(const Effect& entry, const Parameters& values) {
  Parameters growth = values;
  growth["amplitude"] = 0.0;
  growth["phase"] = values.at("growth_phase");
  LatheEffect constant = by_name(entry, values);
  constant.parameters.erase("growth_mm");
  return {constant, by_name(entry, growth)};
}

/// In the lathe a tilt is about a bearing; the motion with it is another effect.
LatheEffects tilt(const Effect& entry, const Parameters& values) {
  const std::string motion(linear_parameters(entry.term, {}).at(2).size_name());
  return {by_name(entry, values),
          {std::string(entry.motion_beside),
           {{"order", values.at("order")},
            {"amplitude_mm", values.at(motion)},
            {"phase_rad", values.at(motion + "_phase")}}}};
}

/// In the lathe the ring's theory ties the second harmonic to the first.
LatheEffects chuck_lobing(const TermValue& term) {
  const TermShape& shape = term.shape;
  const auto harmonic = [&](double order, double c, double s) {
    return LatheEffect{"extra.jaw_harmonic",
                       {{"order", order},
                        {"amplitude_mm", std::hypot(c, s)},
                        {"phase_rad", std::atan2(s, c)},
                        {"decay_length_mm", shape.decay_length_mm},
                        {"jaw_position_mm", shape.lever_from_mm}}};
  };
  return {harmonic(shape.order, term.linear[0], term.linear[1]),
          harmonic(2.0 * shape.order, term.linear[2], term.linear[3])};
}

/// A degree each.
LatheEffects straightness(const TermValue& term, int first) {
  LatheEffects list;
  for (std::size_t j = 0; j < term.linear.size(); ++j) {
    list.push_back({term.id(),
                    {{"degree", static_cast<double>(first) + static_cast<double>(j)},
                     {"amplitude_mm", term.linear[j]}}});
  }
  return list;
}

/// The kind of the term says what the lathe has apart.
LatheEffects of_effect(TermValue term, const LatheFrame& frame) {
  const Effect& entry = *term.effect;
  const std::string id = term.id();
  const auto known = virtual_lathe::effect_kinds();
  if (std::ranges::find(known, id, &virtual_lathe::EffectKind::id) == known.end())
    throw InputError("diagnosis", "the virtual lathe has no `" + id + "`");
  if (term.linear.size() != linear_parameters(entry.term, term.shape).size())
    throw InputError("diagnosis", "the term of " + id + " is not fitted");
  term.free.clear();  // those that were not free are 0
  if (const auto* curve = std::get_if<PolynomialInZ>(&entry.term); curve && curve->last == 0)
    return straightness(term, curve->first);
  const auto* harmonic = std::get_if<Harmonic>(&entry.term);
  const auto envelope = harmonic ? harmonic->envelope : Harmonic::Envelope::constant;
  if (envelope == Harmonic::Envelope::jaws) return chuck_lobing(term);
  const Parameters values = values_in(term, frame);
  if (envelope == Harmonic::Envelope::growing) return growing(entry, values);
  if (envelope == Harmonic::Envelope::lever) return tilt(entry, values);
  return {by_name(entry, values)};
}

LatheEffect of_pattern(const TermValue& term, const LatheFrame& frame) {
  const Pattern& p = term.pattern;
  if (term.linear.empty()) throw InputError("diagnosis", "an unexplained pattern has no factors");
  const double c = term.linear[0], s = term.linear.size() > 1 ? term.linear[1] : 0.0;
  if (p.kind == Pattern::Kind::bump) {
    if (!(p.width_rad > 0.0)) throw InputError("diagnosis", "a local form has no width");
    return {"extra.bump",
            {{"amplitude_mm", c},
             {"angle_rad", p.angle_rad},
             {"width_rad", p.width_rad},
             {"position_mm", p.position_mm},
             {"length_mm", p.length_mm}}};
  }
  Parameters wave{
      {"order", p.order}, {"amplitude_mm", std::hypot(c, s)}, {"phase_rad", std::atan2(s, c)}};
  if (p.kind == Pattern::Kind::line) {
    if (p.in_time) {
      wave["frequency_hz"] = p.frequency;
      return {"extra.motion_line", wave};
    }
    if (p.frequency == 0.0) return {"extra.form_cell", wave};
    wave["period_mm"] = 1.0 / p.frequency;
    return {"extra.form_line", wave};
  }
  wave["degree"] = p.degree;
  if (!p.in_time) return {p.spindle ? "extra.motion_cell" : "extra.form_cell", wave};
  if (!p.spindle)
    throw InputError("diagnosis", "a form of the part that changes with time has no place");
  wave["start_s"] = frame.time_start_s;
  wave["end_s"] = frame.time_end_s;
  return {"extra.motion_time_cell", wave};
}

}  // namespace

LatheEffects lathe_effects(const TermValue& term, const LatheFrame& frame) {
  if (term.effect == nullptr) return {of_pattern(term, frame)};
  return of_effect(term, frame);
}

}  // namespace trueaxis
