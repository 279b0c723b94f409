// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>

#include "correct/files/table_files.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr std::int64_t power_of_ten(int exponent) {
  std::int64_t power = 1;
  for (int i = 0; i < exponent; ++i) power *= 10;
  return power;
}

/// Writes units · 10^−Decimals; 0 has no sign.
template <int Decimals>
char* put_fixed(char* out, std::int64_t units) {
  if (units < 0) {
    *out++ = '-';
    units = -units;
  }
  const std::int64_t whole = units / power_of_ten(Decimals);
  std::int64_t part = units % power_of_ten(Decimals);
  out = std::to_chars(out, out + 20, whole).ptr;
  *out = '.';
  for (int digit = Decimals; digit > 0; --digit, part /= 10) {
    out[digit] = static_cast<char>('0' + part % 10);
  }
  return out + Decimals + 1;
}

template <int Decimals>
std::int64_t rounded(double value) {
  return std::llround(value * static_cast<double>(power_of_ten(Decimals)));
}

/// Angle in units of 1e-6 degrees, wrapped after rounding: never "360.000000".
std::int64_t wrapped_microdegrees(double c_rad) {
  constexpr std::int64_t turn = 360 * power_of_ten(6);
  const std::int64_t units = rounded<6>(c_rad / rad_per_deg) % turn;
  return units < 0 ? units + turn : units;
}

/// FNV-1a: a table's reader in a servo thread has no library.
std::uint64_t fnv1a(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211ULL;
  return hash;
}

/// A second line, with the checksum of all that follows it.
std::string with_checksum(const std::string& text) {
  const std::size_t second = text.find('\n') + 1;
  return text.substr(0, second) +
         fmt::format("# checksum: fnv1a-64:{:016x} of the lines below\n",
                     fnv1a(std::string_view(text).substr(second))) +
         text.substr(second);
}

}  // namespace

std::string correction_csv(const Correction& correction) {
  const CorrectionRows& rows = correction.rows;
  const std::size_t count = rows.position_mm.size();
  expects(rows.revolution.size() == count && rows.c_rad.size() == count &&
              rows.wanted_mm.size() == count && rows.command_mm.size() == count,
          "columns of one length");
  std::string text = correction_header(correction);
  text += correction.target.kind == TargetKind::face ? "rev,X[mm],C[deg],Z_fts[mm],Z_command[mm]\n"
                                                     : "rev,Z[mm],C[deg],X_fts[mm],X_command[mm]\n";

  constexpr std::size_t longest_row = 128;  // five numbers of at most 22 characters
  std::string block(longest_row * 4096, '\0');
  text.reserve(text.size() + count * 48);
  char* out = block.data();
  for (std::size_t i = 0; i < count; ++i) {
    out = std::to_chars(out, out + 12, rows.revolution[i]).ptr;
    *out++ = ',';
    out = put_fixed<6>(out, rounded<6>(rows.position_mm[i]));
    *out++ = ',';
    out = put_fixed<6>(out, wrapped_microdegrees(rows.c_rad[i]));
    *out++ = ',';
    out = put_fixed<7>(out, rounded<7>(rows.wanted_mm[i]));
    *out++ = ',';
    out = put_fixed<7>(out, rounded<7>(rows.command_mm[i]));
    *out++ = '\n';
    if (static_cast<std::size_t>(out - block.data()) + longest_row > block.size()) {
      text.append(block.data(), out);
      out = block.data();
    }
  }
  return with_checksum(text.append(block.data(), out));
}

}  // namespace trueaxis
