// SPDX-License-Identifier: Apache-2.0
#include "blind/by_entry.hpp"

#include <algorithm>
#include <cmath>

#include "blind/spectrum.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::blind {
namespace {

constexpr std::size_t shapes_tried = 4;
constexpr double finest_mm = 0.04, fastest_hz = 60.0;  // what no plan of the study samples

/// The lathe's name of a parameter, with its unit; empty: the lathe has none.
std::string_view in_lathe(const trueaxis::Effect& entry, std::string_view name) {
  const auto renamed = std::ranges::find(entry.names_in_lathe, name, &NameInLathe::name);
  if (renamed != entry.names_in_lathe.end()) name = renamed->in_lathe;
  for (const auto& one : virtual_lathe::find_effect_kind(entry.id).parameters)
    for (const char* unit : {"", "_mm", "_rad", "_s", "_hz", "_mm_per_s", "_mm_per_rev"})
      if (one.name == std::string(name) + unit) return one.name;
  return {};
}

std::vector<Size> sizes_of(const trueaxis::Effect& entry) {
  std::vector<Size> sizes;
  for (const LinearParameter& linear : linear_parameters(entry.term, {})) {
    const EffectParameter* size = size_for(entry, linear);
    const std::string_view name = size ? in_lathe(entry, size->name) : "";
    if (name.empty() || std::ranges::find(sizes, name, &Size::name) != sizes.end()) continue;
    sizes.push_back({name, size->high});
  }
  return sizes;
}

/// What a line is along, and the factor from its own frequency to rad per unit of that.
struct Along {
  const Eigen::VectorXd& x;
  double factor;
};

Along along(const Bench& bench, SpectralLine::In in) {
  switch (in) {
    case SpectralLine::In::angle:
      return {bench.c_rad(), 1.0};
    case SpectralLine::In::time:
      return {bench.time_s(), two_pi};
    case SpectralLine::In::sensed:
      return {bench.plain(), two_pi};
    default:
      return {bench.z_mm(), two_pi};
  }
}

bool is_frequency(SpectralLine::In in) {
  return in == SpectralLine::In::angle || in == SpectralLine::In::time;
}

}  // namespace

double ByEntry::value(double unit) const {
  const double value = low > 0.0 ? low * std::pow(high / low, unit) : low + (high - low) * unit;
  return whole ? std::round(value) : value;
}

ByEntry by_entry(const trueaxis::Effect& entry) {
  ByEntry out;
  out.entry = &entry;
  out.family = {entry.id, sizes_of(entry)};
  for (const std::string& name : shape_parameters(entry.term)) {
    const EffectParameter* parameter = parameter_for(entry, name);
    if (!parameter || !(parameter->high > parameter->low)) continue;
    out.shape = in_lathe(entry, parameter->name);
    out.low = parameter->low, out.high = parameter->high;
    out.whole = parameter->unit == "1" && !entry.line;
    if (!out.shape.empty()) break;
  }
  return out;
}

std::vector<Effect> mimics(const Bench& bench, const ByEntry& of, const Residue& left) {
  const std::string id(of.entry->id), shape(of.shape);
  std::vector<Effect> list;
  if (of.shape.empty()) return {{id, {}}};
  if (const auto& line = of.entry->line) {
    const auto [x, factor] = along(bench, line->in);
    const double most = is_frequency(line->in) ? fastest_hz : 1.0 / finest_mm;
    const Eigen::VectorXd turns = line->in == SpectralLine::In::spiral
                                      ? Eigen::VectorXd(-bench.c_rad())
                                      : Eigen::VectorXd(Eigen::VectorXd::Zero(bench.size()));
    const Band band{factor * line->low, factor * std::min(line->high, most)};
    for (const double w : strongest_lines(left.left, x, turns, band, shapes_tried))
      list.push_back({id, {{shape, is_frequency(line->in) ? w / factor : factor / w}}});
    return list;
  }
  for (std::size_t k = 0; k < shapes_tried; ++k)
    list.push_back({id, {{shape, of.value(static_cast<double>(k) / (shapes_tried - 1.0))}}});
  return list;
}

std::optional<Refinement> refinement(const Bench& bench, const ByEntry& of, const Effect& shaped) {
  if (of.shape.empty() || of.whole) return std::nullopt;
  const std::string shape(of.shape);
  if (!of.entry->line) return Refinement{shape, 1.5, true};
  const auto [x, factor] = along(bench, of.entry->line->in);
  const double bin = 0.125 * two_pi / (x.maxCoeff() - x.minCoeff()) / factor;
  if (is_frequency(of.entry->line->in)) return Refinement{shape, bin, false};
  return Refinement{shape, bin * shaped.parameters.at(shape), true};
}

}  // namespace trueaxis::blind
