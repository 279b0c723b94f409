// SPDX-License-Identifier: Apache-2.0
#include "studies/published/published_toml.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/number.hpp"
#include "format/file.hpp"
#include "study/bound/quantities.hpp"
#include "study/sweep/files/sweep_toml.hpp"

namespace trueaxis {
namespace {

using namespace study;

/// "402.036": its value and three decimals. Nothing if it is not a plain decimal number.
std::optional<PrintedNumber> printed(const std::string& text) {
  std::string_view left = text;
  const auto value = take_plain_number(left);
  if (!value || !left.empty()) return std::nullopt;
  PrintedNumber number{text, *value, 0};
  const std::size_t point = text.find('.');
  if (point != std::string::npos) number.decimals = static_cast<int>(text.size() - point - 1);
  return number;
}

std::vector<std::string> read_parameters(TomlTable& paper, const Sweep& sweep) {
  std::vector<std::string> known;
  for (const Quantity& quantity : quantities(fitted_surface(sweep))) known.push_back(quantity.name);
  const std::vector<std::string> names = paper.texts("parameters");
  if (names.empty())
    paper.complain("parameters",
                   "must name what was printed: " + fmt::format("{}", fmt::join(known, ", ")));
  for (const std::string& name : names) {
    if (std::ranges::find(known, name) == known.end())
      paper.complain("parameters", "names \"" + name + "\": the part has " +
                                       fmt::format("{}", fmt::join(known, ", ")));
    if (std::ranges::count(names, name) > 1)
      paper.complain("parameters", "names \"" + name + "\" twice");
  }
  return names;
}

/// Every point sets the amplitude of the noise and nothing else: its level is one number.
bool is_noise_level(const GridAxis& axis) {
  return std::ranges::all_of(axis.points, [&](const AxisPoint& point) {
    const Lists& lists = point.lists;
    return point.settings.size() == 1 && !(lists.passes || lists.setups || lists.effects) &&
           point.settings.front().value > 0.0 &&
           point.settings.front().path == axis.points.front().settings.front().path &&
           (point.settings.front().path == "noise.sigma_mm" ||
            point.settings.front().path == "noise.uniform_mm");
  });
}

/// The place in the grid of one label an axis, "?" for a noise level that print has lost.
void read_place(TomlTable& table, const Sweep& sweep, PublishedRow& row) {
  const std::vector<std::string> at = table.texts("at");
  if (at.size() != sweep.axes.size()) {
    table.complain("at", "must give " + std::to_string(sweep.axes.size()) +
                             " texts, one value of every axis of the grid");
    return;
  }
  for (std::size_t a = 0; a < at.size(); ++a) {
    const GridAxis& axis = sweep.axes[a];
    row.grid *= axis.points.size();
    row.name += (a > 0 ? ", " : "") + axis.name + " = " + at[a];
    if (at[a] == "?") {
      if (row.unknown_axis || !is_noise_level(axis))
        table.complain("at",
                       "has \"?\" for " + axis.name + ": only one noise level can be unknown");
      row.unknown_axis = a;
      continue;
    }
    const auto point = std::ranges::find(axis.points, at[a], &AxisPoint::label);
    if (point != axis.points.end()) {
      row.grid += static_cast<std::size_t>(point - axis.points.begin());
      continue;
    }
    std::vector<std::string> labels;
    for (const AxisPoint& one : axis.points) labels.push_back(one.label);
    table.complain("at", "gives " + axis.name + " = \"" + at[a] + "\": the axis has " +
                             fmt::format("{}", fmt::join(labels, ", ")) +
                             ", or \"?\" where it is not known");
  }
}

PublishedRow read_row(TomlTable table, const Sweep& sweep, std::size_t parameters) {
  PublishedRow row;
  read_place(table, sweep, row);
  row.name = table.text("name", row.name);
  const std::vector<std::string> values = table.texts("values");
  if (values.size() != parameters)
    table.complain("values", "must give as many texts as there are parameters, as printed");
  for (const std::string& text : values) {
    const std::optional<PrintedNumber> number = printed(text);
    if (!number) table.complain("values", "has \"" + text + "\", which is not a decimal number");
    row.values.push_back(number.value_or(PrintedNumber{}));
  }
  return row;
}

PublishedReading read_reading(TomlTable table, const std::vector<std::string>& parameters,
                              const ReadSet& read_set) {
  PublishedReading reading;
  reading.name = table.required_text("name");
  if (const std::optional<TomlTable> set = table.maybe_table("set"))
    reading.settings = read_set(*set);
  reading.printed_per_error.assign(parameters.size(), 1.0);
  if (std::optional<TomlTable> factors = table.maybe_table("printed_per_error")) {
    for (std::size_t i = 0; i < parameters.size(); ++i)
      reading.printed_per_error[i] = factors->number(parameters[i], 1.0, Range::positive());
  }
  reading.noise_factor = table.number("noise_factor", 1.0, Range::positive());
  reading.fit_noise = table.flag("fit_noise", false);
  reading.least_decimals.assign(parameters.size(), 0);
  if (std::optional<TomlTable> decimals = table.maybe_table("least_decimals")) {
    for (std::size_t i = 0; i < parameters.size(); ++i)
      reading.least_decimals[i] = static_cast<int>(decimals->integer(parameters[i], 0, 0, 12));
  }
  return reading;
}

Published read_published(TomlTable paper, const Sweep& sweep, const ReadSet& read_set) {
  Published published;
  published.source = paper.required_text("source");
  published.parameters = read_parameters(paper, sweep);
  for (const TomlTable& row : paper.tables("row"))
    published.rows.push_back(read_row(row, sweep, published.parameters.size()));
  if (published.rows.empty()) paper.complain("row", "is missing: [[paper.row]] gives a run");
  for (const TomlTable& reading : paper.tables("reading"))
    published.readings.push_back(read_reading(reading, published.parameters, read_set));
  if (published.readings.empty()) {
    const std::size_t count = published.parameters.size();
    published.readings.push_back(
        {"as stated", {}, std::vector<double>(count, 1.0), 1.0, false, std::vector<int>(count, 0)});
  }
  return published;
}

}  // namespace

PublishedSweep parse_published_sweep(std::string_view content, const std::string& path) {
  PublishedSweep out;
  const auto read = [&](TomlTable table, const Sweep& sweep, const ReadSet& read_set) {
    out.published = read_published(table, sweep, read_set);
  };
  out.sweep = parse_sweep_toml(content, path, {{"paper", read}});
  return out;
}

PublishedSweep read_published_sweep(const std::string& path) {
  return parse_published_sweep(read_file(path), path);
}

}  // namespace trueaxis
