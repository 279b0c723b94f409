// SPDX-License-Identifier: Apache-2.0
#include "study/sweep/sweep.hpp"

#include <cmath>

#include "simulate/variates.hpp"
#include "study/bound/quantities.hpp"
#include "study/sweep/cut.hpp"
#include "study/sweep/form.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::study {
namespace {

using virtual_lathe::Scenario;

constexpr std::uint32_t for_drawn_numbers = 16;  // the noise's own purposes are 1 to 4

double middle(const Drawn& drawn) {
  if (drawn.kind == Drawn::Kind::normal) return drawn.first;
  return drawn.kind == Drawn::Kind::log_uniform ? std::sqrt(drawn.first * drawn.second)
                                                : 0.5 * (drawn.first + drawn.second);
}

double draw(const Drawn& drawn, virtual_lathe::Xoshiro& bits) {
  if (drawn.kind == Drawn::Kind::normal)
    return drawn.first + drawn.second * virtual_lathe::normal_variate(bits);
  const double share = bits.uniform();
  return drawn.kind == Drawn::Kind::log_uniform
             ? drawn.first * std::pow(drawn.second / drawn.first, share)
             : drawn.first + share * (drawn.second - drawn.first);
}

/// The scenario of a cell before the numbers of its axes, which are put into `numbers`.
Scenario with_lists(const Sweep& sweep, std::size_t cell, std::vector<Setting>& numbers) {
  const Cell at = cell_at(sweep, cell);
  Scenario scenario = sweep.base;
  for (std::size_t a = 0; a < sweep.axes.size(); ++a) {
    const AxisPoint& point = sweep.axes[a].points[at.point[a]];
    point.lists.put_into(scenario);
    numbers.insert(numbers.end(), point.settings.begin(), point.settings.end());
  }
  set_parameters(scenario, sweep.settings);
  return scenario;
}

/// φ = 0 at the end of an autoregression does not count.
void shorten(std::vector<double>& autoregression) {
  while (!autoregression.empty() && autoregression.back() == 0.0) autoregression.pop_back();
}

}  // namespace

void Lists::put_into(Scenario& scenario) const {
  if (passes) scenario.plan.passes = *passes;
  if (setups) scenario.plan.setups = *setups;
  if (effects) scenario.effects = *effects;
}

std::size_t cell_count(const Sweep& sweep) {
  std::size_t count = sweep.methods.size();
  for (const GridAxis& axis : sweep.axes) count *= axis.points.size();
  return count;
}

Cell cell_at(const Sweep& sweep, std::size_t cell) {
  expects(cell < cell_count(sweep), "a cell of the sweep");
  Cell out;
  out.method = sweep.methods[cell % sweep.methods.size()];
  out.grid = cell / sweep.methods.size();
  out.point.resize(sweep.axes.size());
  std::size_t rest = out.grid;
  for (std::size_t a = sweep.axes.size(); a-- > 0; rest /= sweep.axes[a].points.size())
    out.point[a] = rest % sweep.axes[a].points.size();
  return out;
}

std::vector<std::string> labels_of(const Sweep& sweep, const Cell& cell) {
  std::vector<std::string> labels;
  for (std::size_t a = 0; a < sweep.axes.size(); ++a)
    labels.push_back(sweep.axes[a].points[cell.point[a]].label);
  return labels;
}

Scenario scenario_of(const Sweep& sweep, std::size_t cell) {
  std::vector<Setting> numbers;
  Scenario scenario = with_lists(sweep, cell, numbers);
  for (const Drawn& drawn : sweep.drawn) numbers.push_back({drawn.path, middle(drawn)});
  set_parameters(scenario, numbers);
  shorten(scenario.noise.autoregression);
  scenario.seed = seed_of(sweep, cell, 0);
  return scenario;
}

// If nothing is drawn, the instants of a jittered pass are those of repeat 0: the clean stream is
// then one for the whole cell, and only the noise differs.
Scenario scenario_of(const Sweep& sweep, std::size_t cell, std::size_t repeat) {
  if (sweep.drawn.empty()) return scenario_of(sweep, cell);
  std::vector<Setting> numbers;
  Scenario scenario = with_lists(sweep, cell, numbers);
  scenario.seed = seed_of(sweep, cell, repeat);
  virtual_lathe::Xoshiro bits(scenario.seed, for_drawn_numbers);
  for (const Drawn& drawn : sweep.drawn) numbers.push_back({drawn.path, draw(drawn, bits)});
  set_parameters(scenario, numbers);
  shorten(scenario.noise.autoregression);
  return scenario;
}

std::uint64_t seed_of(const Sweep& sweep, std::size_t cell, std::size_t repeat) {
  return virtual_lathe::hashed(sweep.seed, cell / sweep.methods.size(), repeat);
}

SurfaceKind fitted_surface(const Sweep& sweep) {
  return sweep.surface.empty() ? surface_of(sweep.base.part.kind) : surface_from_id(sweep.surface);
}

std::vector<Quantity> compared_quantities(const Sweep& sweep) {
  std::vector<Quantity> out = quantities(fitted_surface(sweep));
  if (sweep.base.cut)
    for (Quantity& left : cut_quantities()) out.push_back(std::move(left));
  if (sweep.form_upr)
    for (Quantity& form : form_quantities()) out.push_back(std::move(form));
  return out;
}

const char* to_string(Method method) {
  static constexpr const char* words[] = {"fit", "huber", "tukey", "diagnosis"};
  return words[static_cast<std::size_t>(method)];
}

}  // namespace trueaxis::study
