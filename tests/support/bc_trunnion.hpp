// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

#include "machine/files/errors_files.hpp"
#include "machine/files/machine_toml.hpp"
#include "support/chain_matrices.hpp"
#include "support/command_fixture.hpp"
#include "support/plain_control.hpp"
#include "support/trunnion.hpp"

namespace trueaxis::testing {

inline const char* const bc_trunnion =
    "schema = \"trueaxis.machine/1\"\nname = \"BC trunnion\"\nchain = \"w C' B' Y' b X Z t\"\n"
    "[axes.B]\npoint_mm = [0, 0, -50]\n[axes.C]\npoint_mm = [3, 2, 0]\n"
    "[tool]\ngauge_point_mm = [0, 0, 150]\nlength_mm = 120\n"
    "[workpiece.G54]\norigin_mm = [10, -5, 20]\n[program]\nmode = \"axes\"\n";

/// Errors of the trunnion of some 10 µm and 40 µrad, with angular errors of the linear axes.
inline std::string bc_errors(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  std::string text = "schema = \"trueaxis.errors/1\"\nsign = \"tool_minus_workpiece\"\n";
  char entry[300];
  for (const char* name : {"X0C", "Y0C", "X0B", "Z0B"}) {
    std::snprintf(entry, sizeof entry, "[[error]]\nname = \"%s\"\nvalue_um = %.3f\n", name,
                  10.0 * draw(random));
    text += entry;
  }
  for (const char* name : {"A0C", "B0C", "A0B", "C0B", "C0Y", "B0Z"}) {
    std::snprintf(entry, sizeof entry, "[[error]]\nname = \"%s\"\nvalue_urad = %.3f\n", name,
                  60.0 * draw(random));
    text += entry;
  }
  for (const char* name : {"EBX", "EAY", "ECX"}) {
    std::snprintf(entry, sizeof entry,
                  "[[error]]\nname = \"%s\"\nkind = \"polynomial\"\nscale_mm = 200\n"
                  "coefficients_urad = [%.3f, %.3f, %.3f]\n",
                  name, 10.0 * draw(random), 40.0 * draw(random), 30.0 * draw(random));
    text += entry;
  }
  for (const char* name : {"EZX", "EYX", "EXY", "EXX"}) {
    std::snprintf(entry, sizeof entry,
                  "[[error]]\nname = \"%s\"\nkind = \"polynomial\"\nscale_mm = 200\n"
                  "coefficients_um = [0, %.3f, %.3f]\n",
                  name, 15.0 * draw(random), 10.0 * draw(random));
    text += entry;
  }
  return text;
}

/// Where the tip is in the part, by matrices that are multiplied out.
class BcTrunnion {
 public:
  explicit BcTrunnion(const std::filesystem::path& folder)
      : machine_(read_machine_toml((folder / "m.toml").string()).machine),
        errors_(read_errors_toml((folder / "e.toml").string(), machine_)),
        setting_(first_setting(machine_)) {}

  Vector3 nominal(const AxisPositions& q) const { return tip_of(tool(q, none_)); }
  Vector3 actual(const AxisPositions& q) const { return tip_of(tool(q, errors_)); }
  double angle_off(const AxisPositions& commanded, const AxisPositions& q) const {
    return distance(turned(tool(commanded, none_), machine_.tool.direction),
                    turned(tool(q, errors_), machine_.tool.direction));
  }

  /// The largest distance of the tip from the straight line between the nominal tips at the ends of
  /// `block`, by 200 points. The way goes from one position of the axes to another.
  double off_mm(const PlainMove& block, const AxisPositions& from, const AxisPositions& to) const {
    const Vector3 a = nominal(block.from), b = nominal(block.to);
    double largest = 0.0;
    for (int i = 0; i <= 200; ++i) {
      AxisPositions q;
      for (std::size_t k = 0; k < axis_count; ++k) q[k] = std::lerp(from[k], to[k], i / 200.0);
      largest = std::max(largest, off_line(actual(q), a, b));
    }
    return largest;
  }

  static double off_line(const Vector3& p, const Vector3& a, const Vector3& b) {
    double along = 0.0, length = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      along += (p[i] - a[i]) * (b[i] - a[i]);
      length += (b[i] - a[i]) * (b[i] - a[i]);
    }
    const double s = length > 0.0 ? std::clamp(along / length, 0.0, 1.0) : 0.0;
    return std::hypot(p[0] - std::lerp(a[0], b[0], s), p[1] - std::lerp(a[1], b[1], s),
                      p[2] - std::lerp(a[2], b[2], s));
  }

 private:
  Matrix4 tool(const AxisPositions& q, const ErrorModel& errors) const {
    return ChainMatrices{machine_, errors}.tool_in_part(q, setting_);
  }
  Machine machine_;
  ErrorModel errors_, none_;
  Setting setting_;
};

}  // namespace trueaxis::testing
