// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "support/chain_matrices.hpp"
#include "trueaxis/units.hpp"

/// The block of data/five_axis/holes.nc and the machine Z'X'A'C'Y of zxacy.toml, worked out here.
namespace trueaxis::testing {

/// Positions of X Y Z (mm) and A C (deg).
using FiveAxes = std::array<double, 5>;

struct Holes {
  std::vector<FiveAxes> at;           ///< of the axes at the end of every G1
  std::vector<Vector3> bottom, axis;  ///< of the twelve holes, in the part
};

/// The ends of the G1 moves of a program: words, zero of G54, and the tool's length on Z.
inline std::vector<FiveAxes> ends_of_moves(const std::string& program) {
  std::vector<FiveAxes> ends;
  std::map<char, double> word;
  std::istringstream lines(program);
  for (std::string line; std::getline(lines, line);) {
    if (line.compare(0, 2, "G0") != 0 && line.compare(0, 2, "G1") != 0) continue;
    std::istringstream words(line.substr(3));
    for (std::string one; words >> one;) word[one[0]] = std::stod(one.substr(1));
    if (line[1] == '1')
      ends.push_back(
          {word['X'] - 60.0, word['Y'] - 45.0, word['Z'] - 380.0 + 130.0, word['A'], word['C']});
  }
  return ends;
}

inline Holes twelve_holes(const std::string& program) {
  Holes holes{ends_of_moves(program), {}, {}};
  for (int n = 0; n < 12; ++n) {
    const double tilt = (30 + 10 * (n % 3)) * rad_per_deg, azimuth = (15 + 30 * n) * rad_per_deg;
    const Vector3 axis{std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth),
                       std::cos(tilt)};
    holes.axis.push_back(axis);
    holes.bottom.push_back({18.0 + 28.0 * (n % 4) - 12.0 * axis[0],
                            17.0 + 28.0 * (n / 4) - 12.0 * axis[1], 60.0 - 12.0 * axis[2]});
  }
  return holes;
}

/// The tool in the fixture by Z'X'A'C'Y: tables C about (0, 0), A about z = -50; tip 270 mm above
/// the table in the zero position; G54 at (-60, -45, 20).
inline Matrix4 tool_in_fixture(const FiveAxes& at) {
  const double a = at[3] * rad_per_deg, c = at[4] * rad_per_deg;
  const Matrix4 table = times(Tr(0, 0, -at[2]), Tr(-at[0], 0, 0), Tr(0, 0, -50), exp({-a, 0, 0}),
                              Tr(0, 0, 50), exp({0, 0, -c}), Tr(-60, -45, 20));
  return times(inverse(table), Tr(0, at[1], 270));
}

inline std::string positions_csv(const std::vector<FiveAxes>& positions) {
  std::string csv = "X[mm],Y[mm],Z[mm],A[deg],C[deg]\n";
  for (const FiveAxes& at : positions) {
    char row[200];
    std::snprintf(row, sizeof row, "%.17g,%.17g,%.17g,%.17g,%.17g\n", at[0], at[1], at[2], at[3],
                  at[4]);
    csv += row;
  }
  return csv;
}

/// The rows of a CSV of numbers under a header.
inline std::vector<std::vector<double>> rows_of(const std::string& csv) {
  std::vector<std::vector<double>> rows;
  std::istringstream in(csv);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    rows.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');)
      rows.back().push_back(std::stod(field));
  }
  return rows;
}

}  // namespace trueaxis::testing
