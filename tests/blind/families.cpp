// SPDX-License-Identifier: Apache-2.0
#include "blind/families.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "blind/by_entry.hpp"
#include "trueaxis/effect.hpp"

namespace trueaxis::blind {
namespace {

constexpr double pi = std::numbers::pi;

const std::vector<Family>& outside_catalogue() {
  static const std::vector<Family> list{{"extra.spiral", {{"amplitude_mm", 0.02}}},
                                        {"extra.dent", {{"depth_mm", 0.1}}},
                                        {"extra.beat", {{"amplitude_mm", 0.02}}}};
  return list;
}

// The same effect with these sizes and no others.
Effect only(Effect effect, std::initializer_list<std::pair<const char*, double>> sizes) {
  for (const Size& size : family(effect.id).sizes) {
    effect.parameters[std::string(size.name)] = 0.0;
  }
  for (const auto& [name, value] : sizes) effect.parameters[name] = value;
  return effect;
}

Effect with(Effect effect, const char* name, double value) {
  effect.parameters[name] = value;
  return effect;
}

// cos and sin of what has `phase`: a quarter of a period apart.
std::vector<Effect> pair(const Effect& effect, const char* phase) {
  return {with(effect, phase, 0.0), with(effect, phase, 0.5 * pi)};
}

// A size each, and with a phase its cos and sin.
std::vector<Effect> directions(const ByEntry& of, const Effect& shaped) {
  const auto parameters = virtual_lathe::find_effect_kind(shaped.id).parameters;
  const bool phased = std::ranges::find(parameters, "phase_rad",
                                        &virtual_lathe::LatheParameter::name) != parameters.end();
  std::vector<Effect> list;
  for (const Size& size : of.family.sizes) {
    const Effect one = only(shaped, {{std::string(size.name).c_str(), 0.1 * size.typical_most}});
    for (const Effect& each : phased ? pair(one, "phase_rad") : std::vector<Effect>{one})
      list.push_back(each);
  }
  return list;
}

std::vector<Effect> lobing(const Effect& effect) {
  const double jaws = effect.parameters.at("jaws");
  std::vector<Effect> list;  // four angles of the jaws: both harmonics with phases of their own
  for (const double phase : {0.0, 0.25 * pi, 0.5 * pi, pi}) {
    list.push_back(with(effect, "jaw_angle_rad", phase / jaws));
  }
  return list;
}

std::vector<Effect> straightness(const Effect& effect) {
  std::vector<Effect> list;
  for (const double degree : {2.0, 3.0, 4.0, 5.0}) list.push_back(with(effect, "degree", degree));
  return list;
}

/// Those that the judge has words of its own for.
const std::vector<Family>& tabled() {
  static const std::vector<Family> list{
      {"part.chuck_lobing", {{"amplitude_mm", 0.1}}},
      {"part.roundness", {{"amplitude_mm", 0.02}, {"growth_mm", 0.02}}},
      {"part.barrel", {{"amplitude_mm", 0.03}, {"cubic_mm", 0.03}}},
      {"part.taper", {{"amplitude_mm", 0.02}}},
      {"part.waviness", {{"amplitude_mm", 0.005}}},
      {"part.feed_marks", {{"amplitude_mm", 0.005}}},
      {"part.bow", {{"sagitta_mm", 0.05}}},
      {"part.slip", {{"dx_mm", 0.2}, {"dy_mm", 0.2}, {"turn_rad", 0.1}}},
      {"spindle.radial_synchronous", {{"amplitude_mm", 0.01}}},
      {"spindle.tilt_synchronous", {{"amplitude_rad", 5e-5}}},
      {"spindle.axial_synchronous", {{"amplitude_mm", 0.015}}},
      {"spindle.asynchronous", {{"amplitude_mm", 0.005}}},
      {"slide.z_straightness", {{"amplitude_mm", 0.04}}},
      {"slide.xz_parallelism", {{"slope_rad", 5e-5}}},
      {"slide.leadscrew_periodic", {{"amplitude_mm", 0.012}}},
      {"slide.backlash", {{"along_mm", 0.02}, {"across_mm", 0.02}}},
      {"probe.height", {{"height_mm", 1.0}}},
      {"probe.tilt", {{"angle_rad", 2e-3}}},
      {"probe.ball_radius", {{"radius_mm", 3.0}}},
      {"probe.pretravel", {{"amplitude_mm", 0.01}, {"lobing_mm", 0.01}}},
      {"probe.gain", {{"gain", 0.02}}},
      {"probe.nonlinearity", {{"quadratic_mm", 0.01}, {"cubic_mm", 0.01}}},
      {"probe.cyclic", {{"amplitude_mm", 0.002}}},
      {"probe.latency", {{"delay_s", 0.035}}},
      {"probe.lag", {{"time_constant_s", 0.005}}},
      {"encoder.offset", {{"angle_rad", 0.1}}},
      {"encoder.eccentricity", {{"amplitude_rad", 9.7e-5}}},
      {"thermal.drift", {{"rate_mm_per_s", 0.01 / 600.0}, {"amplitude_mm", 0.01}}},
      {"environment.vibration", {{"amplitude_mm", 0.005}}},
      {"part.creep", {{"dx_mm", 0.02}, {"dy_mm", 0.02}}},
  };
  return list;
}

/// The others that a lateral surface shows.
const std::vector<ByEntry>& by_their_entries() {
  static const std::vector<ByEntry> list = [] {
    std::vector<ByEntry> out;
    for (const trueaxis::Effect& entry : effect_catalogue())
      if (!entry.check && entry.needs.stream.value_or(StreamKind::lateral) == StreamKind::lateral &&
          std::ranges::find(tabled(), entry.id, &Family::id) == tabled().end())
        out.push_back(by_entry(entry));
    return out;
  }();
  return list;
}

}  // namespace

const ByEntry* known_by_entry(std::string_view id) {
  const auto& list = by_their_entries();
  const auto found = std::ranges::find(list, id, [](const ByEntry& one) { return one.entry->id; });
  return found == list.end() ? nullptr : &*found;
}

const std::vector<Family>& families() {
  static const std::vector<Family> list = [] {
    std::vector<Family> all = tabled();
    for (const ByEntry& one : by_their_entries()) all.push_back(one.family);
    return all;
  }();
  return list;
}

const Family& family(std::string_view id) {
  for (const auto* list : {&families(), &outside_catalogue()}) {
    const auto found = std::ranges::find(*list, id, &Family::id);
    if (found != list->end()) return *found;
  }
  throw std::invalid_argument("the judge knows no effect `" + std::string(id) + '`');
}

Effect scaled(Effect effect, double factor) {
  for (const Size& size : family(effect.id).sizes) {
    const auto found = effect.parameters.find(std::string(size.name));
    if (found != effect.parameters.end()) found->second *= factor;
  }
  return effect;
}

Effect of_typical_size(Effect largest, const std::function<double()>& unit) {
  const trueaxis::Effect* entry = find_effect(largest.id);
  if (!entry) return largest;
  for (const EffectParameter& p : entry->parameters) {
    if (p.low > 0.0 && p.high > p.low && !p.of.ends_with("_mm") && p.name != "order" &&
        p.name != "frequency")
      return scaled(std::move(largest), p.low * std::pow(p.high / p.low, unit()) / p.high);
  }
  return largest;
}

double over_typical(const Effect& effect) {
  double most = 0.0;
  for (const Size& size : family(effect.id).sizes) {
    const auto found = effect.parameters.find(std::string(size.name));
    if (found == effect.parameters.end()) continue;
    most = std::max(most, std::abs(found->second) / size.typical_most);
  }
  return most;
}

std::vector<Effect> directions(const Effect& shaped) {
  const std::string& id = shaped.id;
  constexpr double um = 1e-3;
  if (id == "part.chuck_lobing") return lobing(only(shaped, {{"amplitude_mm", um}}));
  if (id == "part.roundness") {
    std::vector<Effect> list = pair(only(shaped, {{"amplitude_mm", um}}), "phase_rad");
    for (const Effect& e : pair(only(shaped, {{"growth_mm", um}}), "phase_rad")) list.push_back(e);
    return list;
  }
  if (id == "part.barrel") {
    return {only(shaped, {{"amplitude_mm", um}}), only(shaped, {{"cubic_mm", um}})};
  }
  if (id == "part.bow") return pair(only(shaped, {{"sagitta_mm", um}}), "direction_rad");
  if (id == "part.slip") {
    return {only(shaped, {{"dx_mm", um}}), only(shaped, {{"dy_mm", um}}),
            only(shaped, {{"turn_rad", 1e-3}})};
  }
  if (id == "part.creep") return {only(shaped, {{"dx_mm", um}}), only(shaped, {{"dy_mm", um}})};
  if (id == "slide.z_straightness") return straightness(only(shaped, {{"amplitude_mm", um}}));
  if (id == "slide.backlash") {
    return {only(shaped, {{"along_mm", um}}), only(shaped, {{"across_mm", um}})};
  }
  if (id == "probe.nonlinearity") {
    return {only(shaped, {{"quadratic_mm", um}}), only(shaped, {{"cubic_mm", um}})};
  }
  if (id == "probe.pretravel") {
    std::vector<Effect> list = pair(only(shaped, {{"lobing_mm", um}}), "phase_rad");
    list.push_back(only(shaped, {{"amplitude_mm", um}}));
    return list;
  }
  if (id == "thermal.drift") {
    return {only(shaped, {{"rate_mm_per_s", 1e-5}}), only(shaped, {{"amplitude_mm", um}})};
  }
  if (id == "spindle.tilt_synchronous" || id == "encoder.eccentricity") {
    return pair(only(shaped, {{"amplitude_rad", 1e-4}}), "phase_rad");
  }
  const Family& of = family(id);
  const std::string name(of.sizes.front().name);
  if (const ByEntry* known = known_by_entry(id)) return directions(*known, shaped);
  if (name == "amplitude_mm" && id != "part.taper") {
    return pair(only(shaped, {{"amplitude_mm", um}}), "phase_rad");
  }
  if (id == "probe.lag") return {shaped};  // not linear in its time constant
  Effect one = shaped;  // of one parameter: height, tilt, ball, gain, delay, angle, slope, taper
  one.parameters[name] = 0.1 * of.sizes.front().typical_most;
  return {one};
}

Eigen::MatrixXd columns(const Bench& bench, const Effect& shaped) {
  const std::vector<Effect> list = directions(shaped);
  Eigen::MatrixXd all(bench.size(), static_cast<Eigen::Index>(list.size()));
  for (std::size_t j = 0; j < list.size(); ++j) {
    all.col(static_cast<Eigen::Index>(j)) = bench.change({list[j]});
  }
  return all;
}

}  // namespace trueaxis::blind
