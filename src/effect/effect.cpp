// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/effect.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "effect/entries.hpp"
#include "effect/kinds.hpp"
#include "effect/linear_count.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

// A column that is not there is empty; the one that only lag and hysteresis read may be.
void check(const EffectTerm& term, const TermContext& at) {
  for (const auto column :
       {at.z_mm, at.time_s, at.speed_rad_per_s, at.velocity_mm_per_s, at.x_mm, at.sensed_mm,
        at.dx_dc, at.dx_dz, at.theta_rad, at.theta_chuck_rad, at.s_mm, at.clamp_force_ratio}) {
    expects(column.size() == at.size(), "every column of the context has its size");
  }
  const auto* response = std::get_if<Response>(&term);
  const bool second = response != nullptr && (response->of == Response::Of::lag ||
                                              response->of == Response::Of::hysteresis);
  expects(!second || at.d2x_dc2.size() == at.size(), "a sensor that follows has d2x_dc2");
  expects(!at.face || at.dx_dy.size() == at.size(), "a face has dx_dy");
  expects(at.z_half_mm > 0.0, "the probed length is not 0");
}

// The readings [from, from + count) of every column that is there.
TermContext part_of(const TermContext& at, std::size_t from, std::size_t count) {
  TermContext part = at;
  for (auto* column : {&part.c_rad, &part.z_mm, &part.time_s, &part.speed_rad_per_s,
                       &part.velocity_mm_per_s, &part.x_mm, &part.sensed_mm, &part.dx_dc,
                       &part.dx_dz, &part.d2x_dc2, &part.dx_dy, &part.play_side, &part.theta_rad,
                       &part.theta_chuck_rad, &part.s_mm, &part.clamp_force_ratio}) {
    if (!column->empty()) *column = column->subspan(from, count);
  }
  return part;
}

constexpr Separator separator_list[] = {
    {"RV", "the same pass with the spindle reversed"},
    {"RZ", "a return pass in -Z"},
    {"2W", "the same pass at a second spindle speed, best in an irrational ratio"},
    {"DW", "a dwell: turns at constant Z"},
    {"ST", "a capture with the spindle standing still"},
    {"RC", "the part re-indexed against the spindle and probed again"},
    {"RE", "probing from the rear side; a face on the other side of the axis, X < 0"},
    {"MS", "a master cylinder or ball of known size"},
    {"OZ", "the part shifted along Z and probed again"},
    {"RM", "re-clamped with less force and probed again"},
    {"XJ", "a known jog of the X axis"},
};

/// Of a parameter of the shape other than its degree.
double TermShape::*place_of(std::string_view name) {
  static constexpr std::pair<std::string_view, double TermShape::*> places[] = {
      {"order", &TermShape::order},
      {"lever_from_mm", &TermShape::lever_from_mm},
      {"decay_length_mm", &TermShape::decay_length_mm},
      {"period_mm", &TermShape::period_mm},
      {"frequency_hz", &TermShape::frequency_hz},
      {"time_constant_s", &TermShape::time_constant_s},
      {"onset_s", &TermShape::onset_s},
      {"duration_s", &TermShape::duration_s},
      {"settling_s", &TermShape::settling_s},
      {"reference_x_mm", &TermShape::reference_x_mm},
      {"range_mm", &TermShape::range_mm},
      {"play_mm", &TermShape::play_mm}};
  for (const auto& [known, place] : places)
    if (known == name) return place;
  throw ContractViolation("no parameter of a shape: " + std::string(name));
}

std::string_view after_family(std::string_view id) { return id.substr(id.find('.') + 1); }

// The name alone counts too: the family is often not remembered.
std::size_t unlikeness(std::string_view asked, std::string_view id) {
  return std::min(edit_distance(asked, id),
                  edit_distance(after_family(asked), after_family(id)) + 1);
}

}  // namespace

std::vector<LinearParameter> linear_parameters(const EffectTerm& term, const TermShape& shape) {
  return std::visit([&](const auto& of) { return kind::parameters(of, shape).linear; }, term);
}

std::size_t linear_count(const EffectTerm& term, const TermShape& shape) {
  return std::visit([&](const auto& of) { return kind::count(of, shape); }, term);
}

std::vector<std::string> shape_parameters(const EffectTerm& term) {
  return std::visit([](const auto& of) { return kind::parameters(of, {}).shape; }, term);
}

void fill_columns(const EffectTerm& term, const TermContext& context, const TermShape& shape,
                  std::span<double* const> columns) {
  check(term, context);
  expects(columns.size() == linear_count(term, shape), "one column a linear parameter");
  std::vector<double*> out(columns.begin(), columns.end());
  for (std::size_t from = 0; from < context.size(); from += kind::chunk_size) {
    const std::size_t count = std::min(kind::chunk_size, context.size() - from);
    const TermContext part = part_of(context, from, count);
    std::visit([&](const auto& of) { kind::fill(of, part, shape, out); }, term);
    for (double*& column : out) column += count;
  }
}

double shape_value(const TermShape& shape, std::string_view name) {
  return name == "degree" ? shape.degree : shape.*place_of(name);
}

void set_shape_value(TermShape& shape, std::string_view name, double value) {
  if (name == "degree") {
    shape.degree = static_cast<int>(value);
  } else {
    shape.*place_of(name) = value;
  }
}

bool is_step(const EffectTerm& term) { return std::holds_alternative<PartStep>(term); }

bool has_two_orders(const EffectTerm& term) {
  const auto* harmonic = std::get_if<Harmonic>(&term);
  return harmonic && harmonic->envelope == Harmonic::Envelope::jaws;
}

std::vector<LinearParameter> TermValue::parameters() const {
  if (effect) return linear_parameters(effect->term, shape);
  if (columns() == 1) return {{"amplitude", "mm"}};
  return kind::amplitude_pair("mm").linear;
}

std::size_t TermValue::columns() const {
  if (!effect) {
    const bool line = pattern.kind == Pattern::Kind::line;
    return pattern.kind == Pattern::Kind::bump || (!line && pattern.order == 0.0) ? 1 : 2;
  }
  return free.empty() ? linear_count(effect->term, shape) : free.size();
}

std::span<const Effect> effect_catalogue() {
  static const std::vector<Effect> all = [] {
    std::vector<Effect> list;
    for (const auto family :
         {entries::part_roundness, entries::part_profile, entries::part_face, entries::spindle,
          entries::spindle_axial, entries::slide, entries::slide_face, entries::probe_geometry,
          entries::probe_response, entries::encoder_and_time, entries::checks}) {
      for (Effect& effect : family()) list.push_back(std::move(effect));
    }
    return with_mutual_confounders(std::move(list));
  }();
  return all;
}

const Effect* find_effect(std::string_view id, std::span<const Effect> own) {
  for (const std::span<const Effect> some : {own, effect_catalogue()})
    for (const Effect& effect : some)
      if (effect.id == id) return &effect;
  return nullptr;
}

const Effect& entry_of(DataCheck check) {
  return *std::ranges::find(effect_catalogue(), check, &Effect::check);
}

std::vector<Effect> with_mutual_confounders(std::vector<Effect> entries) {
  const auto names = [](const Effect& one, const Effect& other) {
    return std::ranges::find(one.confounders, other.id) != one.confounders.end();
  };
  std::vector<std::vector<std::string_view>> mutual;
  for (const Effect& one : entries) {
    for (const std::string_view id : one.confounders)
      expects(std::ranges::find(entries, id, &Effect::id) != entries.end(),
              "a confounder is an entry of the same catalogue");
    std::vector<std::string_view>& ids = mutual.emplace_back();
    for (const Effect& other : entries)
      if (names(one, other) || names(other, one)) ids.push_back(other.id);
  }
  for (std::size_t i = 0; i < entries.size(); ++i) entries[i].confounders = std::move(mutual[i]);
  return entries;
}

const EffectParameter* parameter_for(const Effect& effect, std::string_view name) {
  const auto found = std::ranges::find_if(
      effect.parameters, [&](const EffectParameter& p) { return p.of == name || p.name == name; });
  return found == effect.parameters.end() ? nullptr : &*found;
}

const EffectParameter* size_for(const Effect& effect, const LinearParameter& linear) {
  const auto found =
      std::ranges::find(effect.parameters, linear.size_name(), &EffectParameter::name);
  return found == effect.parameters.end() ? nullptr : &*found;
}

bool has_free_order(const Effect& effect) {
  const auto* harmonic = std::get_if<Harmonic>(&effect.term);
  return harmonic && harmonic->fixed_order == 0.0 && !effect.line;
}

std::vector<std::string_view> nearest_effects(std::string_view id, std::size_t count) {
  std::vector<std::string_view> ids;
  for (const Effect& effect : effect_catalogue()) ids.push_back(effect.id);
  std::stable_sort(ids.begin(), ids.end(), [&](std::string_view a, std::string_view b) {
    return unlikeness(id, a) < unlikeness(id, b);
  });
  ids.resize(std::min(count, ids.size()));
  return ids;
}

std::span<const Separator> separators() { return separator_list; }

std::string_view to_string(Slot slot) {
  static constexpr std::string_view words[] = {"A", "B", "C", "D", "E", "noise"};
  return words[static_cast<std::size_t>(slot)];
}

std::string_view to_string(EffectFrame frame) {
  static constexpr std::string_view words[] = {"part",    "chuck", "spindle",
                                               "machine", "probe", "time"};
  return words[static_cast<std::size_t>(frame)];
}

}  // namespace trueaxis
