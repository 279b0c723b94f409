// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "support/chain_matrices.hpp"
#include "support/random_machine.hpp"
#include "support/without_comments.hpp"
#include "trueaxis/compensation.hpp"

/// Programs of random machines as text, and the numbers that a new text says.
namespace trueaxis::testing {

inline constexpr const char* program_letters = "XYZABC";

inline std::string block(const Machine& machine, const std::array<double, axis_count>& words) {
  std::string text = "G1";
  char number[64];
  for (std::size_t k = 0; k < axis_count; ++k) {
    if (machine.find(static_cast<AxisName>(k)) == nullptr) continue;
    std::snprintf(number, sizeof number, " %c%.12f", program_letters[k],
                  words[k] / (k < 3 ? 1.0 : rad_per_deg));
    text += number;
  }
  return text + "\n";
}

/// The words of every line that has an axis word, missing ones as before; mm and rad.
inline std::vector<std::array<double, axis_count>> words_of(const std::string& text) {
  std::vector<std::array<double, axis_count>> out;
  std::istringstream lines(without_comments(text));
  std::array<double, axis_count> words{};
  for (std::string line; std::getline(lines, line);) {
    bool moves = false;
    for (std::size_t k = 0; k < axis_count; ++k) {
      const std::size_t at = line.find(program_letters[k]);
      if (at == std::string::npos) continue;
      words[k] = std::strtod(line.c_str() + at + 1, nullptr) * (k < 3 ? 1.0 : rad_per_deg);
      moves = true;
    }
    if (moves) out.push_back(words);
  }
  return out;
}

inline CompensationOptions fine() {
  CompensationOptions options;
  options.decimals = options.angle_decimals = 12;
  return options;
}

/// A machine of which some parts are turned into those of a program: mode, zeros.
struct ProgramCase {
  ProgramCase(const Layout& layout, std::uint64_t seed)
      : draw(seed), machine(draw.machine(layout)) {
    for (double& zero : machine.work_offsets[0]->zero) zero = draw.between(-1.0, 1.0);
    errors = draw.errors(machine, 0.02, 2e-4);
    setting = first_setting(machine);
  }
  Vector3 nominal_tip(const AxisPositions& q) const {
    return tip_of(ChainMatrices{machine, none}.tool_in_part(q, setting));
  }

  /// The axes to which a control takes a tip, by the nominal tip's being linear in X Y Z.
  AxisPositions axes_of_tip(const std::array<double, axis_count>& words) const {
    AxisPositions q{};
    for (std::size_t k = 3; k < axis_count; ++k)
      if (machine.find(static_cast<AxisName>(k)) != nullptr)
        q[k] = words[k] + machine.work_offsets[0]->zero[k];
    for (int round = 0; round < 2; ++round) {
      const Vector3 at = nominal_tip(q);
      double J[3][3], r[3];
      for (std::size_t k = 0; k < 3; ++k) {
        AxisPositions one = q;
        one[k] += 1.0;
        const Vector3 there = nominal_tip(one);
        for (std::size_t i = 0; i < 3; ++i) J[i][k] = there[i] - at[i];
        r[k] = words[k] - at[k];
      }
      const auto det = [](const double(&m)[3][3]) {
        return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
      };
      const double whole = det(J);
      for (std::size_t k = 0; k < 3; ++k) {
        double Jk[3][3];
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j) Jk[i][j] = j == k ? r[i] : J[i][j];
        q[k] += det(Jk) / whole;
      }
    }
    return q;
  }

  Draw draw;
  Machine machine;
  ErrorModel errors, none;
  Setting setting;
};

}  // namespace trueaxis::testing
