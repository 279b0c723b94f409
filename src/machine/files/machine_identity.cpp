// SPDX-License-Identifier: Apache-2.0
#include "machine/files/machine_identity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "machine/files/errors_files.hpp"
#include "machine/files/toml_parts.hpp"

namespace trueaxis {
namespace {

constexpr double grid = 1e-6;  // mm, and of a direction

std::string three(const Vector3& v) {
  std::string text;
  for (const double one : v)
    text += fmt::format(" {}", std::round(one / grid) == 0.0 ? 0.0 : std::round(one / grid) * grid);
  return text;
}

/// A point of a line as the one nearest to the origin: any point of the line says the same.
Vector3 foot(const Vector3& point, const Vector3& direction) {
  double along = 0.0;
  for (std::size_t i = 0; i < 3; ++i) along += point[i] * direction[i];
  Vector3 out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = point[i] - along * direction[i];
  return out;
}

void check_kinematics(TomlTable& table, const std::vector<std::string>& said,
                      const Machine& machine) {
  const std::vector<std::string> here = kinematics_of(machine);
  constexpr const char* what_to_do =
      "errors hold for one kinematics only: give the errors of this machine, or calibrate it anew "
      "with this machine file";
  if (said.empty()) {
    table.complain("kinematics",
                   "is needed: leave out the whole table [machine] to give errors for any machine");
  } else if (said.size() != here.size()) {
    table.complain("kinematics",
                   fmt::format("belongs to the machine \"{}\", and this one is \"{}\": {}",
                               said.front(), here.front(), what_to_do));
  } else {
    for (std::size_t i = 0; i < here.size(); ++i)
      if (said[i] != here[i]) {
        table.complain("kinematics", fmt::format("has \"{}\", and this machine \"{}\": {}", said[i],
                                                 here[i], what_to_do));
        return;
      }
  }
}

}  // namespace

std::vector<std::string> kinematics_of(const Machine& machine) {
  std::string chain = "w";
  bool bed = false;
  std::vector<std::string> lines;
  for (const MachineAxis& axis : machine.axes) {
    if (!axis.carries_workpiece && !std::exchange(bed, true)) chain += " b";
    chain += std::string(" ") + letter_of(axis.name) + (axis.carries_workpiece ? "'" : "");
    std::string line = std::string(1, letter_of(axis.name)) + " along" + three(axis.direction);
    if (is_rotary(axis.name))
      line = std::string(1, letter_of(axis.name)) + " about" + three(axis.direction) + " through" +
             three(foot(axis.point_mm, axis.direction));
    lines.push_back(line);
  }
  lines.insert(lines.begin(), chain + (bed ? " t" : " b t"));
  lines.push_back("tool along" + three(machine.tool.direction) + " from" +
                  three(machine.tool.gauge_point_mm));
  return lines;
}

std::string machine_identity_toml(const Machine& machine) {
  std::vector<std::string> lines;
  for (const std::string& line : kinematics_of(machine)) lines.push_back("  " + quoted(line));
  return fmt::format(
      "\n[machine] # the machine with these errors\nname = {}\nkinematics = [\n{},\n]\n",
      quoted(machine.name), fmt::join(lines, ",\n"));
}

void check_machine_identity(TomlTable& root, const Machine& machine) {
  auto table = root.maybe_table("machine");
  if (!table) return;
  const std::string name = table->text("name");
  if (!name.empty() && !machine.name.empty() && name != machine.name)
    table->complain("name",
                    fmt::format("is \"{}\", and this machine is \"{}\": give the errors of "
                                "this machine, or write its name here if it is the same one",
                                name, machine.name));
  check_kinematics(*table, table->texts("kinematics"), machine);
}

std::string machine_not_said(const std::string& path, const ErrorModel& errors,
                             const Machine& machine) {
  const bool of_machine = std::ranges::any_of(
      errors.terms, [](const ErrorTerm& term) { return term.name.body != workpiece_body; });
  if (!of_machine) return "";
  if (is_errors_toml(path) && TomlDocument(path).root().has("machine")) return "";
  return fmt::format(
      "{} does not name the machine of its errors: TrueAxis uses them for {}. trueaxis errors "
      "writes them with the table [machine], which names it",
      std::filesystem::path(path).filename().string(),
      machine.name.empty() ? "this one" : machine.name);
}

}  // namespace trueaxis
