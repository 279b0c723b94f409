// SPDX-License-Identifier: Apache-2.0
#include "machine/files/errors_files.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/angle.hpp"
#include "format/file.hpp"
#include "format/outputs.hpp"
#include "machine/files/machine_identity.hpp"
#include "machine/uncertainty.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

ErrorModel read_one(std::string_view content, const std::string& path, const Machine& machine,
                    const ErrorsFiles& said) {
  if (is_errors_toml(path)) return parse_errors_toml(content, path, machine, said.large_errors);
  if (!said.foreign_sign)
    throw InputError(path,
                     "does not state the sign of its component errors: give --sign moving_part or "
                     "--sign tool_minus_workpiece");
  return path.ends_with(".csv")
             ? read_isg_csv(content, path, machine, *said.foreign_sign, said.large_errors)
             : read_etalon(content, path, machine, *said.foreign_sign, said.large_errors);
}

bool has_components(const ErrorModel& errors) {
  return std::ranges::any_of(errors.terms,
                             [](const ErrorTerm& term) { return term.name.component; });
}

}  // namespace

bool is_errors_toml(const std::string& path) {
  return path.ends_with(".toml") || schema_of_file(path) == "trueaxis.errors";
}

ErrorsOfFiles read_errors_files(std::span<const std::string> paths, const MachineFile& machine,
                                const ErrorsFiles& said) {
  ErrorsOfFiles out{machine.parameter_errors, {}, {}};
  ErrorModel& all = out.errors;
  std::vector<Diagnostic> wrong;
  std::string of_components;
  std::map<std::string, std::string> path_of;  // of a hash
  for (const std::string& path : paths) {
    try {
      const std::string content = read_file(path);
      out.hashes.push_back(content_hash(content));
      if (const auto [first, is_new] = path_of.emplace(out.hashes.back(), path); !is_new)
        throw InputError(path, first->second == path
                                   ? "is named twice, and its errors would add: name it once"
                                   : "holds the errors of " + first->second +
                                         " again, and they would add: name one of the two");
      const ErrorModel one = read_one(content, path, machine.machine, said);
      all.terms.insert(all.terms.end(), one.terms.begin(), one.terms.end());
      add_covariance(all.covariance, one.covariance);
      if (auto remark = machine_not_said(path, one, machine.machine); !remark.empty())
        out.remarks.push_back(std::move(remark));
      if (!has_components(one)) continue;
      if (!of_components.empty())
        wrong.push_back({path, 0, 0,
                         "has component errors, and so has " + of_components +
                             ": they come from one file (location errors may come from several)"});
      of_components = path;
      all.sign = one.sign;
      all.reference_mm = one.reference_mm;
    } catch (const InputError& error) {
      wrong.insert(wrong.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  }
  if (!wrong.empty()) throw InputError(std::move(wrong));
  gather_uncertainty(all);
  return out;
}

ErrorModel read_errors(std::span<const std::string> paths, const MachineFile& machine,
                       const ErrorsFiles& said) {
  return read_errors_files(paths, machine, said).errors;
}

TableError table_of_turns(AxisName axis, TableError table) {
  constexpr double same = 1e-9;
  std::vector<double>&at = table.at, &values = table.values;
  if (!is_rotary(axis) || at.size() < 3) return table;
  const auto [low, high] = std::ranges::minmax(values);
  const double first = at.front(), to_turn = two_pi - (at.back() - first);
  double step = 0.0;  // the largest
  for (std::size_t i = 1; i < at.size(); ++i) step = std::max(step, at[i] - at[i - 1]);
  table.periodic = std::abs(to_turn) < same
                       ? std::abs(values.back() - values.front()) <= 1e-6 * (high - low)
                       : to_turn > 0.0 && to_turn <= step + same;
  if (!table.periodic) return table;
  if (to_turn >= same) at.push_back(first + two_pi), values.push_back(0.0);
  values.back() = values.front();
  return table;
}

std::string turn_trouble(AxisName axis, const TableError& table) {
  if (!is_rotary(axis) || table.at.empty() ||
      !is_turn_in_radians((table.at.back() - table.at.front()) / rad_per_deg))
    return "";
  return "the positions cover one revolution in rad: write them in deg";
}

std::string error_name_trouble(const std::string& text, const Machine& machine) {
  const auto name = parse_error_name(text);
  if (!name)
    return "is \"" + text +
           "\", which is not an error: component errors are EXX … ECC, location errors X0X … C0C, "
           "those of the spindle X0S … C0S, of the workpiece X0W … C0W";
  if (name->body < axis_count && machine.find(static_cast<AxisName>(name->body)) == nullptr)
    return "is \"" + text + "\", of an axis this machine does not have";
  return "";
}

}  // namespace trueaxis
