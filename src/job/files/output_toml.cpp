// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

#include "format/file.hpp"
#include "job/files/job_toml_parts.hpp"
#include "nc/lexer.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

const char* usual_name(ControlFormat format) {
  constexpr const char* names[] = {"grid.csv", "halstreamer.txt", "servo.nc", "cec.ini",
                                   "crosscomp2.lis"};
  return names[static_cast<std::size_t>(format)];
}

/// What the lines before the blocks put into force that the blocks are not made for, and what to
/// do; empty: nothing.
std::string against_blocks(const std::string& head, bool x_is_diameter) {
  std::vector<Diagnostic> other;  // words that only the shop's control knows
  const nc::Lexed program = nc::lex(head, "", other);
  std::map<std::string, std::string> wrong;  // by what a later word ends
  for (const nc::Word& word : program.words) {
    const auto is = [&](char letter, std::initializer_list<double> numbers) {
      return word.letter == letter && std::ranges::find(numbers, word.number) != numbers.end();
    };
    if (is('G', {20, 70})) wrong["unit"] = "sets inches, and the blocks are in mm: set G21";
    if (is('G', {21, 71})) wrong.erase("unit");
    if (is('G', {91})) wrong["distance"] = "sets distances (G91): set G90, the blocks are places";
    if (is('G', {90})) wrong.erase("distance");
    if (is('G', {7, 8})) wrong.erase("x");
    if (is('G', {7}) && !x_is_diameter) wrong["x"] = "sets diameters (G7), and x is \"radius\"";
    if (is('G', {8}) && x_is_diameter) wrong["x"] = "sets radii (G8), and x is \"diameter\"";
    if (is('G', {41, 42, 41.1, 42.1}))
      wrong["nose"] = "offsets the nose (G41, G42), and the blocks are of its centre: set G40";
    if (is('G', {40})) wrong.erase("nose");
    if (is('M', {2, 30})) wrong["end"] = "ends the program before the blocks";
  }
  return wrong.empty() ? "" : wrong.begin()->second;
}

/// What the shop has before and after the blocks: a template with a line `( CUTTING BLOCK )`.
void read_template(TomlTable& table, ControlTable& out, std::vector<std::string>& templates) {
  const auto path = table.maybe_path("template");
  if (!path) {
    out.head = "G21 G90\n";
    out.tail = "M30\n";
    return;
  }
  templates.push_back(*path);
  constexpr std::string_view place = "( CUTTING BLOCK )";
  std::string text;
  try {
    text = read_file(*path);
  } catch (const InputError& error) {
    return table.complain("template", error.diagnostics().front().message);
  }
  const std::size_t at = text.find(place);
  if (at == std::string::npos || text.find(place, at + 1) != std::string::npos)
    return table.complain("template",
                          "must hold the line ( CUTTING BLOCK ) once, where the blocks go");
  out.head = text.substr(0, at);
  const std::size_t rest = text.find('\n', at);
  out.tail = rest == std::string::npos ? "" : text.substr(rest + 1);
  if (const std::string wrong = against_blocks(out.head, out.x_is_diameter); !wrong.empty())
    table.complain("template", wrong);
}

}  // namespace

ControlTable read_output(TomlTable table, std::vector<std::string>& templates) {
  ControlTable out;
  out.format = table.required_choice<ControlFormat>(
      "format", {{"grid", ControlFormat::grid},
                 {"halstreamer", ControlFormat::halstreamer},
                 {"servo_nc", ControlFormat::servo_nc},
                 {"sinumerik_cec", ControlFormat::sinumerik_cec},
                 {"beckhoff_crosscomp2", ControlFormat::beckhoff_crosscomp2}});
  out.file = table.text("file", usual_name(out.format));
  if (out.file.empty() || out.file != std::filesystem::path(out.file).filename().string() ||
      out.file == ".." || out.file == "." || out.file == "-")
    table.complain("file", "is not a plain file name: it goes into the folder of the results");
  const bool cec = out.format == ControlFormat::sinumerik_cec;
  const bool gridded =
      cec || out.format == ControlFormat::grid || out.format == ControlFormat::beckhoff_crosscomp2;
  if (gridded) {
    out.c_step_rad = table.number("c_step_rad", (cec ? 2.0 : 1.0) * rad_per_deg, Range::positive());
    out.position_step_mm = cec ? table.required_number("band_mm", Range::positive())
                               : table.number("position_step_mm", 1.0, Range::positive());
  }
  if (out.format == ControlFormat::servo_nc) {
    out.x_is_diameter = table.required_choice<bool>("x", {{"radius", false}, {"diameter", true}});
    out.minutes = table.required_choice<bool>(
        "f", {{"blocks_per_minute", false}, {"minutes_per_block", true}});
    read_template(table, out, templates);
  }
  if (out.format == ControlFormat::beckhoff_crosscomp2) {
    const auto axis = [&](const char* key) {
      if (!table.has(key))
        table.complain(key, "is missing: give the number of the axis in the control");
      return static_cast<int>(table.integer(key, 1, 1, 1000));
    };
    out.x_axis = axis("x_axis");
    out.c_axis = axis("c_axis");
    out.z_axis = axis("z_axis");
    if (table.has("x_axis") && table.has("c_axis") && table.has("z_axis") &&
        (out.x_axis == out.c_axis || out.x_axis == out.z_axis || out.c_axis == out.z_axis))
      table.complain("x_axis", fmt::format("is {}, c_axis {} and z_axis {}: each is another axis "
                                           "of the control",
                                           out.x_axis, out.c_axis, out.z_axis));
  }
  return out;
}

}  // namespace trueaxis
