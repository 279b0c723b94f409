// SPDX-License-Identifier: Apache-2.0
#include "nc/number_text.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "base/number.hpp"

namespace trueaxis::nc {
namespace {

constexpr std::array<double, 16> power_of_ten = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
constexpr double exact_integers = 4503599627370496.0;  // 2^52: halves are still seen below it
using Digits = std::array<char, 600>;                  // 309 before the point, 255 after it

std::size_t print(Digits& digits, double value, int decimals) {
  const auto [end, wrong] = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                          std::chars_format::fixed, decimals);
  return static_cast<std::size_t>(end - digits.data());
}

}  // namespace

double rounded(double value, int decimals) {
  if (decimals < static_cast<int>(power_of_ten.size())) {
    const double power = power_of_ten[static_cast<std::size_t>(decimals)];
    const double whole = std::nearbyint(value * power);
    // A quotient of two exact numbers is the double nearest to the decimal number.
    if (std::abs(whole) < exact_integers) return whole / power + 0.0;
  }
  Digits digits;
  const std::size_t count = print(digits, value, decimals);
  double out = value;
  parse_number({digits.data(), count}, out);
  return out + 0.0;
}

double half_of(int decimals) {
  return decimals < static_cast<int>(power_of_ten.size())
             ? 0.5 / power_of_ten[static_cast<std::size_t>(decimals)]
             : 0.5 * std::pow(10.0, -decimals);
}

void append_number(std::string& text, double value, int decimals) {
  Digits digits;
  text.append(digits.data(), print(digits, value, decimals));
}

}  // namespace trueaxis::nc
