// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "format/toml_reader.hpp"
#include "machine/files/machine_toml.hpp"
#include "trueaxis/machine.hpp"

/// What the tables of a machine and of its errors have alike.
namespace trueaxis {

/// Three numbers, in the unit inside.
inline Vector3 read_vector(TomlTable& table, std::string_view key, const Vector3& fallback = {}) {
  if (!table.has(key)) return fallback;
  const std::vector<double> values = table.numbers(key);
  if (values.size() == 3) return {values[0], values[1], values[2]};
  table.complain(key, "must hold three numbers [x, y, z]");
  return fallback;
}

/// The same made a unit vector.
inline Vector3 read_direction(TomlTable& table, std::string_view key, const Vector3& fallback) {
  Vector3 v = read_vector(table, key, fallback);
  const double length = std::hypot(v[0], v[1], v[2]);
  if (!(length > 1e-9)) {
    table.complain(key, "has no length: give the direction as a vector, such as [0, 0, 1]");
    return fallback;
  }
  for (double& component : v) component /= length;
  return v;
}

inline std::optional<AxisName> axis_of(std::string_view letter) {
  const std::size_t number = std::string_view("XYZABC").find(letter);
  if (letter.size() != 1 || number == std::string_view::npos) return std::nullopt;
  return static_cast<AxisName>(number);
}

/// From mm or degrees, in which files give positions of an axis, to inside.
inline double edge_unit(AxisName axis) { return is_rotary(axis) ? rad_per_deg : 1.0; }

/// A basic string of TOML.
inline std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20)
      out += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
    else
      out += c;
  }
  return out + '"';
}

/// The table [covariance] of an errors file (machine.md) into `errors`, whose terms give up
/// the u that it has. Complains of amounts that are unknown or occur twice, of a matrix that is not
/// a covariance, and of a u that differs from the matrix. Unless `large_errors`, also of one that
/// no error of a machine has.
void read_covariance(TomlTable& root, const Machine& machine, bool large_errors,
                     ErrorModel& errors);

/// What `read_covariance` reads back; "" where there is none.
std::string covariance_toml(const ErrorCovariance& covariance);

}  // namespace trueaxis
