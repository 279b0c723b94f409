// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "nc/program.hpp"

/// Random programs of the words that are read, in every style that a post may have, and hand-made
/// ugly ones.
namespace trueaxis::testing {

inline std::vector<std::string> ugly_programs() {
  return {
      "",
      "\n",
      "%",
      "\xEF\xBB\xBF%\nO1000 (T\xC3\x9CR)\n\n  \n\t\nG0X1.Y2.Z3.A0C0\n%\nfree text [#1] behind it",
      "%\r\n( a ; b )\r\ng01 x+1.50y-.5z 0. a-0c.0 f1000;(not "
      "closed\r\nX-0.000\r\n\r\nM30\r\n%\r\n",
      "/N10 G90 G1 X1 Y2 Z3 A4 C5\n/2 N20 X2\n N 30 Z-3.250000\r\r\nM2",
      "N5 G0 G17 G21 G40 G49 G80 G90 G94\nT1 M6\nG43 H1\nG54\nX0 Y0 Z0 A0 C0\nG1 X10. F500 M8 "
      "(on)\nG4 P1.5\nG4 X2\nG61\nG64 P0.01 Q0.02\nG28\nM3 S1000\nM30\n(after)\n",
      "G20\nG1 F10\nX.5Y.25Z1A-90C720\nG21\nX12.7\nG93 F2\nX13 F3\nG95 F.1\nX14\n",
      "G1X1Y1Z1A1C1(c)(d)X\n2\n",  // refused: X without a number, a number without a letter
      "G1 X00001.2300 Y-00 Z+0 A360.000000000 C-1.123456789012345678\n",
      "O1\nG0 X1 Y1 Z1 A1 C1\nM99\nO2\nG0 X2 Y2 Z2 A2 C2\nM99\n"};
}

class ProgramMaker {
 public:
  explicit ProgramMaker(std::uint64_t seed) : random_(seed) {}

  /// Moves on X Y Z A C, all named in the first of them.
  std::string next(int blocks) {
    blank_ = one_in(2) ? " " : one_in(2) ? "  " : "";
    lower_ = one_in(4);
    end_ = one_in(3) ? "\r\n" : "\n";
    numbered_ = one_in(2);
    const std::string tape = one_in(2) ? "%" + end_ : "";
    std::string text = tape;
    if (one_in(2)) text += "O" + std::to_string(1 + pick(9999)) + " (NAME)" + end_;
    if (one_in(3)) text += block({"G21", "G90"});
    text += block({"G0", "X1", "Y1", "Z1", "A1", "C1", "F500"});
    for (int i = 0; i < blocks; ++i) text += some_line(i);
    text += "M30" + (tape.empty() ? "" : end_ + "%");
    if (one_in(2)) text += end_;
    return text;
  }

  std::size_t pick(std::size_t count) { return random_() % count; }
  bool one_in(std::size_t count) { return pick(count) == 0; }

  /// A number of up to `digits` before and six after the point, in any of its spellings.
  std::string number(std::size_t digits) {
    std::string text = one_in(3) ? "-" : one_in(5) ? "+" : "";
    const std::size_t before = pick(digits + 1), behind = before == 0 ? 1 + pick(6) : pick(7);
    for (std::size_t i = 0; i < before; ++i) text += static_cast<char>('0' + pick(10));
    if (behind > 0 || one_in(2)) text += '.';
    for (std::size_t i = 0; i < behind; ++i) text += static_cast<char>('0' + pick(10));
    return text;
  }

 private:
  std::string block(const std::vector<std::string>& words) {
    std::string text;
    if (one_in(12)) text += "/";
    if (numbered_) text += "N" + std::to_string(10 * ++count_) + blank_;
    for (std::size_t i = 0; i < words.size(); ++i) text += (i == 0 ? "" : blank_) + words[i];
    if (lower_)
      for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (one_in(8)) text += blank_ + "(hole " + std::to_string(pick(100)) + " X1)";
    if (one_in(12)) text += " ; Y2 #[";
    if (one_in(10)) text += "  ";
    return text + end_;
  }

  std::string some_line(int i) {
    switch (pick(12)) {
      case 0:
        return one_in(2) ? end_ : "(comment G2 [#1])" + end_;
      case 1:
        return block({one_in(2) ? "M8" : "S" + std::to_string(pick(9000))});
      case 2:
        return block({one_in(2) ? "G4" : "G04", "P1.5"});
      default:
        break;
    }
    std::vector<std::string> words;
    if (one_in(4) || i == 0) words.push_back(one_in(3) ? "G0" : one_in(2) ? "G01" : "G1");
    const std::string order = one_in(2) ? "XYZAC" : "CZXAY";
    bool any = false;
    for (const char letter : order) {
      if (!one_in(2)) continue;
      words.push_back(letter + number(letter >= 'X' ? 3 : 2));
      any = true;
    }
    if (!any) words.push_back("X" + number(3));
    if (one_in(5)) words.push_back("F" + std::to_string(100 + pick(900)));
    return block(words);
  }

  std::mt19937_64 random_;
  std::string blank_, end_;
  bool lower_ = false, numbered_ = false;
  int count_ = 0;
};

/// A machine of X Y Z A C.
inline nc::ReadOptions xyzac() {
  nc::ReadOptions options;
  options.axes = 0b101111;
  return options;
}

/// The text as a C++ literal that can be pasted into a test.
inline std::string pasted(const std::string& text) {
  std::string out = "\"";
  char escaped[8];
  for (const char c : text) {
    std::snprintf(escaped, sizeof escaped, "\\%03o",
                  static_cast<unsigned>(static_cast<unsigned char>(c)));
    out += c >= ' ' && c < 127 && c != '"' && c != '\\' ? std::string(1, c) : std::string(escaped);
  }
  return out + '"';
}

}  // namespace trueaxis::testing
