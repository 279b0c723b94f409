// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "trueaxis/machine.hpp"

/// A control of the tests' own, of G0 to G3 (G17), G81 to G83, G90, G91, G98 and G99 in mm: it
/// shares no code with the reader of programs.
namespace trueaxis::testing {

struct PlainMove {
  std::size_t line = 0;  ///< 1-based
  bool rapid = false;
  AxisPositions from{}, to{};  ///< words, mm and rad
  bool known = true;           ///< the program gave `from`
};

class PlainControl {
 public:
  explicit PlainControl(const std::string& program) {
    std::istringstream lines(program);
    for (std::string line; std::getline(lines, line);) {
      ++line_;
      read(line);
      carry_out();
    }
  }

  std::vector<PlainMove> moves;
  std::vector<std::string> dwells;  ///< P of each, as written by G4 and by G82

 private:
  void read(std::string line) {
    for (std::size_t open; (open = line.find('(')) != std::string::npos;)
      line.erase(open, line.find(')', open) - open + 1);
    g_.clear(), word_.clear();
    for (std::size_t i = 0; i < line.size();) {
      const char letter = line[i++];
      if (letter < 'A' || letter > 'Z') continue;
      const std::size_t after = std::min(line.find_first_not_of("+-.0123456789", i), line.size());
      const double number = std::stod(line.substr(i, after - i));
      if (letter == 'G')
        g_.insert(static_cast<int>(std::lround(number)));
      else
        word_[letter] = {number, line.substr(i, after - i)};
      i = after;
    }
  }
  bool has(char letter) const { return word_.contains(letter); }
  double number(char letter) const { return word_.at(letter).first; }

  void carry_out() {
    for (const int code : g_) {
      if (code <= 3) motion_ = code, cycle_ = 0;
      if (code == 80) cycle_ = 0;
      if (code >= 81 && code <= 83) {
        if (cycle_ == 0) initial_ = at_[2];
        cycle_ = code;
      }
      if (code == 90 || code == 91) incremental_ = code == 91;
      if (code == 98 || code == 99) to_r_ = code == 99;
    }
    if (g_.contains(4)) return dwells.push_back(word_.at('P').second);
    if (cycle_ != 0) return drill();
    AxisPositions to = at_;
    bool some = false;
    for (std::size_t k = 0; k < axis_count; ++k) {
      if (!has("XYZABC"[k])) continue;
      to[k] = number("XYZABC"[k]) * (k < 3 ? 1.0 : rad_per_deg);
      some = true;
    }
    if (!some) return;
    if (motion_ == 2 || motion_ == 3) return arc(to);
    go(to, motion_ == 0);
  }

  void go(const AxisPositions& to, bool rapid) {
    moves.push_back({line_, rapid, at_, to, moved_});
    at_ = to;
    moved_ = true;
  }
  void level(double z, bool rapid) {
    AxisPositions to = at_;
    to[2] = z;
    if (to != at_) go(to, rapid);
  }

  void arc(const AxisPositions& to) {
    const double x = at_[0] + (has('I') ? number('I') : 0.0),
                 y = at_[1] + (has('J') ? number('J') : 0.0);
    const AxisPositions from = at_;
    const double radius = std::hypot(from[0] - x, from[1] - y);
    const double start = std::atan2(from[1] - y, from[0] - x);
    double turn = std::atan2(to[1] - y, to[0] - x) - start;
    if (motion_ == 2 && turn >= -1e-9) turn -= two_pi;
    if (motion_ == 3 && turn <= 1e-9) turn += two_pi;
    for (int i = 1; i <= 400; ++i) {
      AxisPositions next = to;
      if (i < 400) {
        next[0] = x + radius * std::cos(start + turn * i / 400.0);
        next[1] = y + radius * std::sin(start + turn * i / 400.0);
      }
      go(next, false);
    }
  }

  /// As LinuxCNC does: up to R first where it is below, above the hole, to R, down, back; G83 comes
  /// back to R after each peck and goes on 0.254 mm above.
  void drill() {
    if (has('R')) r_word_ = number('R');
    if (has('Z')) z_word_ = number('Z');
    r_ = r_word_ + (incremental_ ? initial_ : 0.0);
    z_ = z_word_ + (incremental_ ? r_ : 0.0);
    if (has('Q')) q_ = number('Q');
    if (has('P')) p_ = word_.at('P').second;
    if (!has('X') && !has('Y') && !has('Z') && !has('R')) return;
    const int repeats = static_cast<int>(has('K') ? number('K') : has('L') ? number('L') : 1.0);
    const double back = to_r_ ? r_ : std::max(initial_, r_);
    if (at_[2] < r_) level(r_, true);
    for (int n = 0; n < repeats; ++n) {
      AxisPositions over = at_;
      for (const std::size_t k : {0, 1})
        if (has("XY"[k])) over[k] = number("XY"[k]) + (incremental_ ? at_[k] : 0.0);
      if (!to_r_) over[2] = std::max(over[2], initial_);  // after G99
      if (over != at_) go(over, true);
      level(r_, true);
      for (double depth = r_; depth > z_;) {
        if (depth < r_) {
          level(r_, true);
          level(depth + 0.254, true);
        }
        depth = cycle_ == 83 ? std::max(depth - q_, z_) : z_;
        level(depth, false);
      }
      if (cycle_ == 82) dwells.push_back(p_);
      level(back, true);
    }
  }

  std::set<int> g_;
  std::map<char, std::pair<double, std::string>> word_;
  AxisPositions at_{};
  std::size_t line_ = 0;
  int motion_ = 0, cycle_ = 0;
  bool incremental_ = false, to_r_ = false, moved_ = false;
  double initial_ = 0.0, r_word_ = 0.0, z_word_ = 0.0, r_ = 0.0, z_ = 0.0, q_ = 0.0;
  std::string p_;
};

}  // namespace trueaxis::testing
