// SPDX-License-Identifier: Apache-2.0
#include "study/sweep/scenario_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "trueaxis/error.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::study {
namespace {

using namespace virtual_lathe;

constexpr double no_limit = std::numeric_limits<double>::infinity();

struct Limits {
  double low = -no_limit, high = no_limit;
  bool open = false;
};
constexpr Limits any{}, positive{0.0, no_limit, true}, not_negative{0.0, no_limit, false},
    fraction{0.0, 1.0, false}, cosine{-1.0, 1.0, true};
// As a scenario's file has them.
constexpr Limits set_up_cosine{-0.7, 0.7, true}, with_a_variance{2.0, no_limit, true};

/// A number in its place; a travel is written through its pass.
struct Place {
  double* number = nullptr;
  std::optional<double>* maybe = nullptr;
  PlannedPass* travels = nullptr;

  double get() const {
    if (travels != nullptr) return std::abs(travels->end_mm - travels->start_mm);
    return number != nullptr ? *number : maybe->value_or(std::numeric_limits<double>::quiet_NaN());
  }
  /// What is written, to compare with that of another place.
  const void* address() const {
    if (travels != nullptr) return &travels->end_mm;
    return number != nullptr ? static_cast<const void*>(number) : maybe;
  }
  void set(double value) const {
    if (travels != nullptr) {
      const double way = travels->end_mm < travels->start_mm ? -1.0 : 1.0;
      travels->end_mm = travels->start_mm + way * value;
    } else if (number != nullptr) {
      *number = value;
    } else {
      *maybe = value;
    }
  }
};

Place at(double& number) { return {&number, nullptr, nullptr}; }
Place at(std::optional<double>& maybe) { return {nullptr, &maybe, nullptr}; }

// Each calls visit(path, Limits, Place); several places may have one path.
template <class Visit>
void visit_part(Scenario& scenario, const Visit& visit) {
  Part& part = scenario.part;
  constexpr double right_angle = 0.5 * std::numbers::pi;
  visit("part.x0_mm", any, at(part.x0_mm));
  visit("part.y0_mm", any, at(part.y0_mm));
  visit("part.l", cosine, at(part.l));
  visit("part.m", cosine, at(part.m));
  if (part.kind == PartKind::face) {
    visit("part.d_mm", any, at(part.d_mm));
  } else if (part.apex_mm) {
    visit("part.k_mm", any, at(part.apex_mm));
    visit("part.half_angle_rad", Limits{0.0, right_angle, true}, at(part.half_angle_rad));
  } else {
    visit("part.radius_mm", positive, at(part.radius_mm));
    if (part.kind == PartKind::cone) {
      visit("part.radius_at_mm", any, at(part.radius_at_mm));
      visit("part.half_angle_rad", Limits{-right_angle, right_angle, true},
            at(part.half_angle_rad));
    }
  }
  visit("part.u_start_mm", any, at(scenario.u_start_mm));
  visit("part.u_end_mm", any, at(scenario.u_end_mm));
}

template <class Visit>
void visit_probe_and_noise(Scenario& scenario, const Visit& visit) {
  Probe& probe = scenario.probe;
  visit("probe.ball_radius_mm", not_negative, at(probe.ball_radius_mm));
  visit("probe.relative_zero_mm", any, at(probe.relative_zero_mm));
  visit("probe.nominal_radius_mm", positive, at(probe.nominal_radius_mm));
  Noise& noise = scenario.noise;
  visit("noise.sigma_mm", not_negative, at(noise.sigma_mm));
  visit("noise.uniform_mm", not_negative, at(noise.uniform_mm));
  visit("noise.rho", cosine, at(noise.rho));
  std::size_t order = 0;
  for (double& phi : noise.autoregression)
    visit("noise.autoregression." + std::to_string(order++), any, at(phi));
  visit("noise.student_dof", with_a_variance, at(noise.student_dof));
  visit("noise.incidence", not_negative, at(noise.incidence));
  visit("noise.outlier_fraction", fraction, at(noise.outlier_fraction));
  visit("noise.outlier_size_mm", not_negative, at(noise.outlier_size_mm));
  visit("noise.quantisation_mm", not_negative, at(noise.quantisation_mm));
}

template <class Visit>
void visit_pass(const std::string& prefix, const char* axis, PlannedPass& pass,
                const Visit& visit) {
  const auto put = [&](const char* key, const Limits& limits, const Place& place) {
    visit(prefix + key, limits, place);
  };
  put((std::string(axis) + "_start_mm").c_str(), any, at(pass.start_mm));
  put((std::string(axis) + "_end_mm").c_str(), any, at(pass.end_mm));
  put("length_mm", positive, Place{nullptr, nullptr, &pass});
  put("feed_mm_per_rev", positive, at(pass.feed_mm_per_rev));
  put("speed_rpm", any, at(pass.speed_rpm));
  put("readings_per_revolution", positive, at(pass.readings_per_revolution));
  put("revolutions", positive, at(pass.revolutions));
  put("duration_s", positive, at(pass.duration_s));
  put("rate_hz", positive, at(pass.rate_hz));
  put("jitter", Limits{0.0, 1.0, false}, at(pass.jitter));
  put("pause_s", not_negative, at(pass.pause_s));
  put("c_start_rad", any, at(pass.c_start_rad));
}

template <class Visit>
void visit_lists(Scenario& scenario, const Visit& visit) {
  const char* axis = scenario.part.kind == PartKind::face ? "x" : "z";
  for (PlannedPass& pass : scenario.plan.passes) visit_pass("pass.", axis, pass, visit);
  std::size_t index = 0;
  for (PlannedPass& pass : scenario.plan.passes)
    visit_pass("pass." + std::to_string(index++) + '.', axis, pass, visit);
  index = 0;
  for (Chucking& setup : scenario.plan.setups) {
    const std::string prefix = "setup." + std::to_string(index++) + '.';
    visit(prefix + "reindex_rad", any, at(setup.reindex_rad));
    visit(prefix + "z_shift_mm", any, at(setup.z_shift_mm));
    visit(prefix + "x_jog_mm", any, at(setup.x_jog_mm));
    visit(prefix + "clamp_force_ratio", not_negative, at(setup.clamp_force_ratio));
    visit(prefix + "x0_mm", any, at(setup.x0_mm));
    visit(prefix + "y0_mm", any, at(setup.y0_mm));
    visit(prefix + "l", set_up_cosine, at(setup.l));
    visit(prefix + "m", set_up_cosine, at(setup.m));
  }
  index = 0;
  for (virtual_lathe::Effect& effect : scenario.effects) {
    const std::string prefix = "effect." + std::to_string(index++) + '.';
    for (const LatheParameter& known : find_effect_kind(effect.id).parameters) {
      const std::string name(known.name);
      const auto given = effect.parameters.try_emplace(name, known.fallback.value_or(0.0)).first;
      visit(prefix + name, any, at(given->second));
    }
  }
}

template <class Visit>
void visit_cut(CutProgram& cut, const Visit& visit) {
  visit("cut.target.z_start_mm", any, at(cut.target.start_mm));
  visit("cut.target.z_end_mm", any, at(cut.target.end_mm));
  visit("cut.target.radius_mm", positive, at(cut.target.radius_mm));
  visit("cut.tool.nose_radius_mm", not_negative, at(cut.tool.nose_radius_mm));
  visit("cut.tool.height_mm", any, at(cut.tool.height_mm));
  visit("cut.tool.angle_from_probe_rad", any, at(cut.tool.angle_from_probe_rad));
  visit("cut.tool.speed_rpm", positive, at(cut.tool.speed_rpm));
  visit("cut.tool.feed_mm_per_rev", positive, at(cut.tool.feed_mm_per_rev));
  visit("cut.tool.c_start_rad", any, at(cut.tool.c_start_rad));
  if (cut.actuator.perfect) return;
  visit("cut.actuator.natural_frequency_hz", positive, at(cut.actuator.natural_frequency_hz));
  visit("cut.actuator.damping", positive, at(cut.actuator.damping));
  visit("cut.actuator.delay_s", not_negative, at(cut.actuator.delay_s));
  visit("cut.actuator.sampling_hz", positive, at(cut.actuator.sampling_hz));
}

template <class Visit>
void visit_all(Scenario& scenario, const Visit& visit) {
  visit_part(scenario, visit);
  visit_probe_and_noise(scenario, visit);
  visit_lists(scenario, visit);
  if (scenario.cut) visit_cut(*scenario.cut, visit);
}

}  // namespace

std::vector<ScenarioParameter> scenario_parameters(const Scenario& scenario) {
  Scenario copy = scenario;
  std::vector<ScenarioParameter> all;
  visit_all(copy, [&](const std::string& path, const Limits& limits, const Place&) {
    if (std::ranges::find(all, path, &ScenarioParameter::path) == all.end())
      all.push_back({path, limits.low, limits.high, limits.open});
  });
  return all;
}

double parameter(const Scenario& scenario, std::string_view path) {
  Scenario copy = scenario;
  std::optional<double> found;
  visit_all(copy, [&](const std::string& here, const Limits&, const Place& place) {
    if (here == path && !found) found = place.get();
  });
  expects(found.has_value(), "a parameter that the scenario has");
  return *found;
}

void set_parameter(Scenario& scenario, std::string_view path, double value) {
  bool found = false;
  visit_all(scenario, [&](const std::string& here, const Limits&, const Place& place) {
    if (here != path) return;
    place.set(value);
    found = true;
  });
  expects(found, "a parameter that the scenario has");
}

bool is_travel(std::string_view path) {
  return path.starts_with("pass.") && path.ends_with(".length_mm");
}

void set_parameters(Scenario& scenario, std::span<const Setting> settings) {
  const std::vector<PlannedPass> before = scenario.plan.passes;
  for (const Setting& setting : settings) {
    if (!is_travel(setting.path)) set_parameter(scenario, setting.path, setting.value);
  }
  for (const Setting& setting : settings) {
    if (!is_travel(setting.path)) continue;
    bool found = false;
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (setting.path != "pass.length_mm" &&
          setting.path != "pass." + std::to_string(i) + ".length_mm")
        continue;
      PlannedPass& pass = scenario.plan.passes[i];
      const bool back = before[i].end_mm < before[i].start_mm;
      pass.end_mm = pass.start_mm + (back ? -setting.value : setting.value);
      found = true;
    }
    expects(found, "a pass that the scenario has");
  }
}

bool write_same_number(const Scenario& scenario, std::string_view a, std::string_view b) {
  Scenario copy = scenario;
  std::vector<const void*> of_a, of_b;
  visit_all(copy, [&](const std::string& here, const Limits&, const Place& place) {
    if (here == a) of_a.push_back(place.address());
    if (here == b) of_b.push_back(place.address());
  });
  return std::ranges::find_first_of(of_a, of_b) != of_a.end();
}

}  // namespace trueaxis::study
