// SPDX-License-Identifier: Apache-2.0
#include "format/folded.hpp"

#include "base/text.hpp"

namespace trueaxis {
namespace {

/// Letters without accents of U+00C0 to U+00FF, then of U+0100 to U+017F; '?' stays as it is.
constexpr std::string_view plain =
    "aaaaaaaceeeeiiiidnooooo??uuuuy?saaaaaaaceeeeiiiidnooooo??uuuuy?y"
    "aaaaaaccccccccddddeeeeeeeeeegggggggghhhhiiiiiiiiiiiijjkkklllllll"
    "lllnnnnnnnnnoooooooorrrrrrssssssssttttttuuuuuuuuuuuuwwyyyzzzzzzs";
static_assert(plain.size() == 64 + 128);

/// The character at `at` of UTF-8 text, which goes on after it.
unsigned take_code(std::string_view text, std::size_t& at) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned>(static_cast<unsigned char>(text[i])) : 0U;
  };
  const unsigned lead = byte(at++);
  if (lead < 0xC0U) return lead;
  const int more = lead < 0xE0U ? 1 : lead < 0xF0U ? 2 : 3;
  unsigned code = lead & (0x3FU >> static_cast<unsigned>(more));
  for (int k = 0; k < more && at < text.size(); ++k) code = code << 6U | (byte(at++) & 0x3FU);
  return code;
}

}  // namespace

void append_utf8(std::string& out, unsigned code) {
  const auto put = [&](unsigned byte) { out += static_cast<char>(byte); };
  if (code < 0x80U) return put(code);
  if (code < 0x800U) {
    put(0xC0U | (code >> 6U));
  } else {
    if (code < 0x10000U) {
      put(0xE0U | (code >> 12U));
    } else {
      put(0xF0U | (code >> 18U));
      put(0x80U | ((code >> 12U) & 0x3FU));
    }
    put(0x80U | ((code >> 6U) & 0x3FU));
  }
  put(0x80U | (code & 0x3FU));
}

std::string folded(std::string_view text) {
  constexpr unsigned micro = 0xB5, mu = 0x3BC, diameter = 0x2300, empty_set = 0x2205;
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    unsigned code = take_code(text, at);
    if (code >= 0x300U && code < 0x370U) continue;  // an accent of its own
    if (code == 0xA0U || code == 0x3000U || code == 0x202FU) code = ' ';
    if (code >= 0xFF01U && code < 0xFF5FU) code -= 0xFEE0U;
    if (code >= 0x391U && code <= 0x3A9U) code += 0x20U;
    if (code == 0x3D1U) code = 0x3B8U;  // ϑ, a θ
    if (code == 0x2019U) code = '\'';
    if (code == micro || code == mu) code = 'u';
    if (code == diameter || code == empty_set || code == 0xD8U) code = 0xF8U;  // ø
    const char letter = code >= 0xC0U && code < 0x180U ? plain[code - 0xC0U] : '?';
    if (code < 0x80U) {
      out += lower_case(static_cast<char>(code));
    } else if (letter != '?') {
      out += letter;
    } else {
      append_utf8(out, code);
    }
  }
  return out;
}

}  // namespace trueaxis
