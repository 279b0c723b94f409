// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/io/sweep_toml.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "io/published_toml.hpp"
#include "io/scenario_tables.hpp"
#include "io/toml_units.hpp"
#include "trueaxis/base/error.hpp"
#include "trueaxis/io/file.hpp"
#include "trueaxis/io/scenario_toml.hpp"
#include "trueaxis/study/scenario_parameters.hpp"

namespace trueaxis {
namespace {

using namespace study;

constexpr long long most_repeats = 100'000'000, most_points = 10'000;

/// A key of the file as the scenario knows it.
struct Known {
  ScenarioParameter parameter;
  double factor = 1.0;  ///< from the unit of the key to the unit inside
};

class Keys {
 public:
  /// `readable`: whether the scenario was read; else no key is known, and none is wrong.
  Keys(const virtual_lathe::Scenario& scenario, bool readable) : readable_(readable) {
    if (!readable) return;
    for (const ScenarioParameter& parameter : scenario_parameters(scenario)) {
      for (const KeySpelling& spelling : key_spellings(parameter.path)) {
        words_.push_back(spelling.key);
        known_.push_back({parameter, spelling.factor});
      }
      usual_ += (usual_.empty() ? "" : ", ") + key_spellings(parameter.path).front().key;
    }
  }

  /// Notes at `at` what is wrong with a key that the scenario does not have.
  std::optional<Known> find(TomlTable& table, std::string_view at, const std::string& key) const {
    if (!readable_) return std::nullopt;
    const auto place = std::ranges::find(words_, key);
    if (place != words_.end()) return known_[static_cast<std::size_t>(place - words_.begin())];
    const std::string near = nearest_word(key, words_);
    table.complain(at, "names \"" + key + "\", which the scenario does not have" +
                           (near.empty() ? "." : ": did you mean \"" + near + "\"?") +
                           " It has: " + usual_);
    return std::nullopt;
  }

 private:
  std::vector<std::string> words_;
  std::vector<Known> known_;
  std::string usual_;
  bool readable_;
};

std::string label_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

/// In the unit of the key, where the value was written.
void check_range(TomlTable& table, std::string_view at, const Known& known, double value) {
  const ScenarioParameter& p = known.parameter;
  const double inside = value * known.factor;
  if (!std::isfinite(inside)) return;  // said already
  if (p.open ? inside > p.low && inside < p.high : inside >= p.low && inside <= p.high) return;
  std::string allowed =
      std::isinf(p.low) ? ""
                        : (p.open ? "more than " : "at least ") + label_of(p.low / known.factor);
  if (!std::isinf(p.high)) {
    allowed += (allowed.empty() ? "" : " and ") +
               ((p.open ? "less than " : "at most ") + label_of(p.high / known.factor));
  }
  table.complain(at, "gives " + label_of(value) + " but must give " + allowed);
}

/// A number is varied by one axis only.
void check_free(TomlTable& table, std::string_view at, const std::string& path,
                const Sweep& sweep) {
  bool taken = std::ranges::find(sweep.drawn, path, &Drawn::path) != sweep.drawn.end();
  for (const GridAxis& axis : sweep.axes) {
    for (const AxisPoint& point : axis.points)
      taken =
          taken || std::ranges::find(point.settings, path, &Setting::path) != point.settings.end();
  }
  if (taken) table.complain(at, "is set by an axis before: vary a number once");
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

void read_grid(TomlTable table, const std::string& key, const std::optional<Known>& known,
               Sweep& sweep) {
  const bool listed = table.has("values");
  if (!listed && !table.has("from")) {
    table.complain("key", "needs `values`, `from` `to` `count`, or a `distribution`");
    return;
  }
  const std::vector<double> values = listed ? table.numbers("values") : spaced(table);
  if (listed && values.empty()) table.complain("values", "is empty: give at least one number");
  if (!known) return;
  check_free(table, "key", known->parameter.path, sweep);
  GridAxis axis{key, {}};
  for (const double value : values) {
    check_range(table, listed ? "values" : "from", *known, value);
    axis.points.push_back({label_of(value), {{known->parameter.path, value * known->factor}}});
  }
  sweep.axes.push_back(std::move(axis));
}

void read_distribution(TomlTable table, const std::string& key, const std::optional<Known>& known,
                       Sweep& sweep) {
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
  check_free(table, "key", known->parameter.path, sweep);
  check_range(table, normal ? "mean" : "low", *known, first);
  if (!normal) check_range(table, "high", *known, second);
  drawn.path = known->parameter.path;
  drawn.first = first * known->factor;
  drawn.second = second * known->factor;
  sweep.drawn.push_back(std::move(drawn));
}

std::optional<Setting> read_setting(TomlTable& set, const std::string& key, const Keys& keys) {
  const double value = set.required_number(key);
  const std::optional<Known> known = keys.find(set, key, key);
  if (!known) return std::nullopt;
  check_range(set, key, *known, value);
  return Setting{known->parameter.path, value * known->factor};
}

void read_cases(TomlTable table, const std::vector<TomlTable>& cases, const Keys& keys,
                Sweep& sweep) {
  GridAxis axis{table.required_text("name"), {}};
  for (TomlTable one : cases) {
    AxisPoint point{one.required_text("label"), {}};
    TomlTable set = one.required_table("set");
    for (const std::string& key : set.keys()) {
      const std::optional<Setting> setting = read_setting(set, key, keys);
      if (!setting) continue;
      check_free(set, key, setting->path, sweep);
      point.settings.push_back(*setting);
    }
    axis.points.push_back(std::move(point));
  }
  sweep.axes.push_back(std::move(axis));
}

void read_axis(TomlTable table, const Keys& keys, Sweep& sweep) {
  const std::vector<TomlTable> cases = table.tables("case");
  if (!cases.empty()) {
    read_cases(table, cases, keys, sweep);
    return;
  }
  const std::string key = table.required_text("key");
  const std::optional<Known> known = key.empty() ? std::nullopt : keys.find(table, "key", key);
  if (table.has("distribution")) {
    read_distribution(table, key, known, sweep);
  } else {
    read_grid(table, key, known, sweep);
  }
}

std::vector<Method> read_methods(TomlTable root) {
  std::vector<Method> methods;
  for (const std::string& word : root.texts("methods")) {
    const Method all[] = {Method::fit, Method::huber, Method::tukey, Method::diagnosis};
    const auto* known =
        std::ranges::find_if(all, [&](Method method) { return word == to_string(method); });
    if (known == std::end(all)) {
      root.complain("methods", "names \"" + word + "\": known are fit, huber, tukey, diagnosis");
    } else if (std::ranges::find(methods, *known) != methods.end()) {
      root.complain("methods", "names \"" + word + "\" twice");
    } else {
      methods.push_back(*known);
    }
  }
  if (methods.empty()) methods.push_back(Method::fit);
  return methods;
}

/// "section" where the sweep wants a circle and not the surface of the part.
std::string read_surface(TomlTable root, const virtual_lathe::Scenario& base) {
  const bool section = root.choice("surface", {{"part", false}, {"section", true}}, false);
  if (section && base.part.kind == virtual_lathe::PartKind::face)
    root.complain("surface",
                  "is \"section\", but a face is probed across: give a cone or cylinder");
  return section ? "section" : "";
}

/// The scenario of the file or of the sweep's own tables, and its bytes for the hash.
std::string read_base(TomlDocument& document, TomlTable root, virtual_lathe::Scenario& base) {
  if (!root.has("scenario")) {
    read_scenario_tables(root, base);
    return {};
  }
  const std::string path = root.required_path("scenario");
  if (path.empty()) return {};
  try {
    std::string content = read_file(path);
    base = parse_scenario_toml(content, path);
    return content;
  } catch (const InputError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics()) document.add(diagnostic);
  }
  return {};
}

}  // namespace

study::Sweep parse_sweep_toml(std::string_view content, const std::string& path) {
  TomlDocument document(content, path);
  TomlTable root = document.root();
  Sweep sweep;
  const std::string scenario = read_base(document, root, sweep.base);
  const bool whole = document.ok();
  sweep.name = root.text("name");
  sweep.seed =
      static_cast<std::uint64_t>(root.integer("seed", 1, 0, std::numeric_limits<long long>::max()));
  sweep.repeats = static_cast<std::size_t>(root.integer("repeats", 2000, 1, most_repeats));
  sweep.methods = read_methods(root);
  sweep.surface = read_surface(root, sweep.base);
  sweep.input_hash = content_hash(std::string(content) + '\0' + scenario);
  if (sweep.base.cut)
    document.add({path, 0, 0, "a sweep probes a part; a [cut] is a study of its own: take it out"});
  const Keys keys(sweep.base, whole);
  for (const TomlTable& axis : root.tables("axis")) read_axis(axis, keys, sweep);
  if (std::optional<TomlTable> paper = root.maybe_table("paper")) {
    if (document.ok()) {
      sweep.published = read_published(*paper, sweep, [&](TomlTable& set, const std::string& key) {
        return read_setting(set, key, keys);
      });
    } else {
      paper->ignore_rest();
    }
  }
  document.finish();
  return sweep;
}

study::Sweep read_sweep_toml(const std::string& path) {
  return parse_sweep_toml(read_file(path), path);
}

}  // namespace trueaxis
