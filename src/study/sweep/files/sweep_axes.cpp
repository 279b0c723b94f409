// SPDX-License-Identifier: Apache-2.0
#include "study/sweep/files/sweep_axes.hpp"

#include <algorithm>
#include <cmath>

#include "simulate/files/scenario_files.hpp"
#include "simulate/noise.hpp"

namespace trueaxis {
namespace {

using namespace study;

constexpr long long most_points = 10'000;
constexpr std::size_t most_autoregressions = 2'000;  // a cell that fails tells more

std::string case_words(const std::string& label, const std::string& axis) {
  return "the case \"" + label + "\" of \"" + axis + "\"";
}

std::vector<double> spaced(TomlTable& table) {
  const double from = table.required_number("from"), to = table.required_number("to");
  const auto count = table.integer("count", 2, 2, most_points);
  if (!table.has("count")) table.complain("count", "is missing: give the number of values");
  const bool log = table.choice("spacing", {{"linear", false}, {"log", true}}, false);
  if (log && !(from > 0.0 && to > 0.0)) {
    table.complain("spacing", "is \"log\": `from` and `to` must be more than 0");
    return {};
  }
  std::vector<double> values;
  for (long long i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    values.push_back(log ? from * std::pow(to / from, share) : from + share * (to - from));
  }
  return values;
}

/// rho is an autoregression of the first order.
bool is_autoregression(const std::string& path) {
  return path.starts_with("noise.autoregression") || path == "noise.rho";
}

bool sets_rho(const GridAxis& axis) {
  return std::ranges::any_of(axis.points, [](const AxisPoint& point) {
    return std::ranges::find(point.settings, "noise.rho", &Setting::path) != point.settings.end();
  });
}

/// The part of a point that sets the autoregression, and words for it.
AxisPoint autoregression_of(const std::string& axis, const AxisPoint& point) {
  AxisPoint out{axis + " = " + point.label, {}};
  for (const Setting& setting : point.settings) {
    if (is_autoregression(setting.path)) out.settings.push_back(setting);
  }
  return out;
}

/// The ends of a distribution; a normal one has none and counts at its mean.
GridAxis ends_of(const Drawn& drawn) {
  GridAxis axis{drawn.name, {}};
  const auto add = [&](double value) {
    axis.points.push_back({drawn.name + " = " + sweep_label(value), {{drawn.path, value}}});
  };
  add(drawn.first);
  if (drawn.kind != Drawn::Kind::normal) add(drawn.second);
  return axis;
}

}  // namespace

SweepAxes::SweepAxes(TomlDocument& document, TomlTable root, Sweep& sweep) : sweep_(sweep) {
  const bool whole = document.ok();
  for (const TomlTable& table : root.tables("axis")) axes_.push_back({table, {}, {}, {}});
  for (Axis& axis : axes_) {
    axis.cases = axis.table.tables("case");
    for (TomlTable& one : axis.cases) {
      for (const char* list : {"pass", "setup", "effect"})
        axis.replaces = one.has(list) || axis.replaces;
    }
    if (whole && axis.replaces) read_lists(axis);
  }
  readable_ = document.ok();
  if (readable_) keys_ = SweepKeys(sweep.base, lists_but_of(nullptr), "");
  for (Axis& axis : axes_) read_axis(axis);
  if (document.ok()) check_autoregression(document);
  if (document.ok()) check_gauge(root);
}

void SweepAxes::read_lists(Axis& axis) {
  axis.lists.name = axis.table.text("name");
  const bool face = sweep_.base.part.kind == virtual_lathe::PartKind::face;
  for (TomlTable one : axis.cases) {
    AxisPoint point{one.text("label"), {}};
    if (one.has("pass")) point.lists.passes = read_passes(one, face);
    if (one.has("setup")) point.lists.setups = read_setups(one);
    if (one.has("effect")) point.lists.effects = read_effects(one);
    const auto alone = [&](const char* key, auto list) {
      if (!(point.lists.*list)) return;
      for (const Axis& other : axes_) {
        if (&other == &axis) continue;
        for (const AxisPoint& before : other.lists.points) {
          if (!(before.lists.*list)) continue;
          one.complain(key, "is replaced by " + case_words(before.label, other.lists.name) +
                                " too: only one axis may replace a list");
          return;
        }
      }
    };
    alone("pass", &Lists::passes);
    alone("setup", &Lists::setups);
    alone("effect", &Lists::effects);
    axis.lists.points.push_back(std::move(point));
  }
}

std::vector<GridAxis> SweepAxes::lists_but_of(const Axis* without) const {
  std::vector<GridAxis> out;
  for (const Axis& axis : axes_) {
    if (axis.replaces && &axis != without) out.push_back(axis.lists);
  }
  return out;
}

const WrittenKey* SweepAxes::taken_by(const std::string& path,
                                      const std::vector<WrittenKey>& list) const {
  const auto at = std::ranges::find_if(
      list, [&](const WrittenKey& one) { return keys_.same_number(one.path, path); });
  return at == list.end() ? nullptr : &*at;
}

void SweepAxes::take(TomlTable& table, std::string_view at, const WrittenKey& written) {
  if (const WrittenKey* before = taken_by(written.path, taken_))
    table.complain(
        at, "writes the number of \"" + before->key + "\" in an axis before: vary a number once");
  taken_.push_back(written);
}

/// Complains of a number that is written twice in the set.
std::vector<Setting> SweepAxes::read_set(TomlTable& set, const SweepKeys& keys) const {
  std::vector<Setting> settings;
  std::vector<WrittenKey> here;
  for (const std::string& key : set.keys()) {
    const double value = set.required_number(key);
    const std::optional<KnownKey> known = keys.find(set, key, key);
    if (!known) continue;
    SweepKeys::check_range(set, key, *known, value);
    const std::string& path = known->parameter.path;
    if (const WrittenKey* other = taken_by(path, here))
      set.complain(key, "writes the number of \"" + other->key + "\" too: keep one of them");
    here.push_back({path, key});
    settings.push_back({path, value * known->factor});
  }
  return settings;
}

std::vector<Setting> SweepAxes::read_set_before_axes(TomlTable set) const {
  std::vector<Setting> settings = read_set(set, keys_);
  for (const Setting& setting : settings) {
    const WrittenKey* axis = taken_by(setting.path, taken_);
    // A pass' end is the way of a travel that an axis sets.
    if (axis == nullptr || (is_travel(axis->path) && !is_travel(setting.path))) continue;
    set.complain("set", "writes " + setting.path + ", which the axis of \"" + axis->key +
                            "\" sets afterwards: remove it");
  }
  return settings;
}

void SweepAxes::read_axis(Axis& axis) {
  if (!axis.cases.empty()) {
    read_cases(axis);
    return;
  }
  TomlTable table = axis.table;
  if (table.has("name") && !table.has("key")) {
    table.complain("name", "names an axis without a case: give it [[axis.case]]");
    return;
  }
  const std::string key = table.required_text("key");
  axis.name = key;
  const std::optional<KnownKey> known = key.empty() ? std::nullopt : keys_.find(table, "key", key);
  if (table.has("distribution")) {
    read_distribution(table, key, known);
  } else {
    read_grid(table, key, known);
  }
}

/// What the `set` of a case can set: its own lists and those of all cases of other axes.
SweepKeys SweepAxes::keys_of_case(const Axis& axis, const AxisPoint& point) const {
  virtual_lathe::Scenario scenario = sweep_.base;
  point.lists.put_into(scenario);
  return {scenario, lists_but_of(&axis), case_words(point.label, axis.lists.name)};
}

void SweepAxes::read_cases(Axis& axis) {
  GridAxis out{axis.table.required_text("name"), {}};
  axis.name = out.name;
  if (std::ranges::find(sweep_.axes, out.name, &GridAxis::name) != sweep_.axes.end())
    axis.table.complain("name", "is that of an axis before: give each its own");
  std::vector<WrittenKey> written;
  for (std::size_t i = 0; i < axis.cases.size(); ++i) {
    TomlTable one = axis.cases[i];
    AxisPoint point{one.required_text("label"), {}};
    if (std::ranges::find(out.points, point.label, &AxisPoint::label) != out.points.end())
      one.complain("label", "is that of a case before: give each its own");
    if (i < axis.lists.points.size()) point.lists = axis.lists.points[i].lists;
    std::optional<TomlTable> set =
        axis.replaces ? one.maybe_table("set") : std::optional(one.required_table("set"));
    if (set) {
      const bool own = axis.replaces && readable_;
      point.settings = read_set(*set, own ? keys_of_case(axis, point) : keys_);
      for (const Setting& setting : point.settings) {
        if (const WrittenKey* before = taken_by(setting.path, taken_))
          one.complain("set", "writes " + setting.path + ", the number of \"" + before->key +
                                  "\" in an axis before: vary a number once");
        if (std::ranges::find(written, setting.path, &WrittenKey::path) == written.end())
          written.push_back({setting.path, setting.path});
      }
    }
    out.points.push_back(std::move(point));
  }
  taken_.insert(taken_.end(), written.begin(), written.end());
  sweep_.axes.push_back(std::move(out));
}

void SweepAxes::read_grid(TomlTable table, const std::string& key,
                          const std::optional<KnownKey>& known) {
  const bool listed = table.has("values");
  if (!listed && !table.has("from")) {
    table.complain("key", "needs `values`, `from` `to` `count`, or a `distribution`");
    return;
  }
  const std::vector<double> values = listed ? table.numbers("values") : spaced(table);
  if (listed && values.empty()) table.complain("values", "is empty: give at least one number");
  if (!known) return;
  const std::string& path = known->parameter.path;
  take(table, "key", {path, key});
  GridAxis axis{key, {}};
  for (const double value : values) {
    SweepKeys::check_range(table, listed ? "values" : "from", *known, value);
    axis.points.push_back({sweep_label(value), {{path, value * known->factor}}});
  }
  sweep_.axes.push_back(std::move(axis));
}

void SweepAxes::read_distribution(TomlTable table, const std::string& key,
                                  const std::optional<KnownKey>& known) {
  Drawn drawn;
  drawn.name = key;
  drawn.kind = table.required_choice<Drawn::Kind>("distribution",
                                                  {{"uniform", Drawn::Kind::uniform},
                                                   {"normal", Drawn::Kind::normal},
                                                   {"log-uniform", Drawn::Kind::log_uniform}});
  const bool normal = drawn.kind == Drawn::Kind::normal;
  const double first = table.required_number(normal ? "mean" : "low");
  const double second =
      table.required_number(normal ? "sd" : "high", normal ? Range::non_negative() : Range{});
  if (!normal && !(first < second) && std::isfinite(first + second))
    table.complain("high", "must be more than `low`");
  if (drawn.kind == Drawn::Kind::log_uniform && !(first > 0.0) && std::isfinite(first))
    table.complain("low", "must be more than 0 for a log-uniform distribution");
  if (!known) return;
  take(table, "key", {known->parameter.path, key});
  SweepKeys::check_range(table, normal ? "mean" : "low", *known, first);
  if (!normal) SweepKeys::check_range(table, "high", *known, second);
  drawn.path = known->parameter.path;
  drawn.first = first * known->factor;
  drawn.second = second * known->factor;
  sweep_.drawn.push_back(std::move(drawn));
}

/// A relative gauge does not show the radius, and without one no repeat has a fit.
void SweepAxes::check_gauge(TomlTable root) const {
  const std::string zero = "probe.relative_zero_mm", nominal = "probe.nominal_radius_mm";
  const virtual_lathe::Scenario& base = sweep_.base;
  if (base.part.kind == virtual_lathe::PartKind::face || base.probe.nominal_radius_mm ||
      taken_by(nominal, taken_))
    return;
  const std::string what = "a relative gauge that does not show the radius: give `" + nominal +
                           "` too, in [probe] or by an axis";
  if (base.probe.relative_zero_mm) {
    if (root.has("scenario")) {
      root.complain("scenario", "has `relative_zero_mm` in [probe], " + what);
    } else if (std::optional<TomlTable> probe = root.maybe_table("probe")) {
      probe->ignore_rest();
      probe->complain("relative_zero_mm", "makes " + what);
    }
    return;
  }
  const WrittenKey* axis = taken_by(zero, taken_);
  if (axis == nullptr) return;
  const auto sets_zero = [&](const GridAxis& grid) {
    return std::ranges::any_of(grid.points, [&](const AxisPoint& point) {
      return std::ranges::find(point.settings, zero, &Setting::path) != point.settings.end();
    });
  };
  const auto grid = std::ranges::find_if(sweep_.axes, sets_zero);
  const std::string& name = grid == sweep_.axes.end() ? axis->key : grid->name;
  const auto at = std::ranges::find(axes_, name, &Axis::name);
  TomlTable table = at->table;
  table.complain(at->cases.empty() ? "key" : "name", "sets `" + zero + "`, " + what);
}

/// Looks at the grid of those axes alone that set the autoregression.
void SweepAxes::check_autoregression(TomlDocument& document) const {
  Sweep grid;
  grid.base = sweep_.base;
  for (const GridAxis& axis : sweep_.axes) {
    GridAxis part{axis.name, {}};
    bool sets = false;
    for (const AxisPoint& point : axis.points) {
      part.points.push_back(autoregression_of(axis.name, point));
      sets = sets || !part.points.back().settings.empty();
    }
    if (sets) grid.axes.push_back(std::move(part));
  }
  for (const Drawn& drawn : sweep_.drawn) {
    if (is_autoregression(drawn.path)) grid.axes.push_back(ends_of(drawn));
  }
  if (grid.axes.empty() || cell_count(grid) > most_autoregressions) return;
  for (std::size_t cell = 0; cell < cell_count(grid); ++cell) {
    const virtual_lathe::Noise noise = scenario_of(grid, cell).noise;
    if (noise.rho != 0.0 && !noise.autoregression.empty()) {
      const auto rho = std::ranges::find_if(grid.axes, sets_rho);
      const auto axis = std::ranges::find(axes_, rho->name, &Axis::name);
      document.add(axis->table.here(
          "sets noise.rho of a scenario that has an `autoregression`: keep one of them"));
      return;
    }
    if (virtual_lathe::is_stationary(noise.autoregression)) continue;
    std::string where;
    const Cell at = cell_at(grid, cell);
    for (std::size_t a = 0; a < grid.axes.size(); ++a)
      where += (a > 0 ? ", " : "") + grid.axes[a].points[at.point[a]].label;
    const std::string& last = grid.axes.back().name;
    const auto axis = std::ranges::find(axes_, last, &Axis::name);
    document.add(axis->table.here("the autoregression is not stationary at " + where +
                                  ": make its numbers smaller"));
    return;
  }
}

}  // namespace trueaxis
