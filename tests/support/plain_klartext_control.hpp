// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdio>

#include "support/plain_probing_control.hpp"

namespace trueaxis::testing {

/// The lathe with the least of a HEIDENHAIN control: blocks of Klartext, cycle 3, FN 16 with a
/// mask.
class PlainKlartextControl : public PlainProbingControl {
 public:
  std::string mask;  ///< of FN 16
  double y = 0.0;

  void run(const std::string& program) {
    std::istringstream text(program);
    for (std::string line; std::getline(text, line);) {
      const std::string number = std::to_string(lines_.size()) + " ";
      if (!take(line, number)) unknown("block number: " + line);
      lines_.push_back(line);
    }
    if (lines_.front() != "BEGIN PGM p MM" || lines_.back() != "END PGM p MM")
      unknown("begin and end of the program");
    for (at_ = 0; at_ < lines_.size() && !ended_; ++at_) block(lines_[at_]);
  }

 private:
  double number(const std::string& text) {
    if (text.empty()) unknown("a number is missing");
    return value(text[0] == '+' || text[0] == '-' ? "0" + text : text);
  }

  void block(std::string line) {
    const std::string whole = line;
    if (line[0] == ';' || take(line, "LBL ") || line == "M126" || line == "FUNCTION MODE MILL" ||
        line == "FN 20: WAIT FOR SYNC" || take(line, "BEGIN PGM "))
      return;
    if (line == "M30") {
      ended_ = true;
    } else if (take(line, "FN 14: ERROR = ")) {
      alarm = line, ended_ = true;
    } else if (take(line, "FN 18: SYSREAD ")) {
      const double axes[] = {x, y, z};
      const std::size_t idx = line.find(" = ID270 NR1 IDX");
      if (idx == std::string::npos) unknown(whole);
      variables_[line.substr(0, idx)] = axes[line.back() - '1'];
    } else if (take(line, "FN 16: F-PRINT ")) {
      if (line != "TNC:\\trueaxis_line.a / TNC:\\p_log.txt") unknown(whole);
      print();
    } else if (take(line, "FN ")) {
      jump(line);
    } else if (take(line, "DECLARE STRING ")) {
      const std::size_t equal = line.find(" = \"");
      if (line.back() != '"' || line.find('"', equal + 4) != line.size() - 1) unknown(whole);
      texts_[line.substr(0, equal)] = line.substr(equal + 4, line.size() - equal - 5);
    } else if (line.rfind("QS", 0) == 0) {
      joined(line);
    } else if (line[0] == 'Q') {
      const std::size_t equal = line.find(" = ");
      variables_[line.substr(0, equal)] = formula(line.substr(equal + 3));
    } else if (take(line, "TCH PROBE 3.")) {
      probe(line);
    } else if (take(line, "L ")) {
      move(line);
    } else {
      unknown(whole);
    }
  }

  /// Klartext has a blank around every sign.
  double formula(std::string text) {
    for (std::size_t at = 0; (at = text.find("INT", at)) != std::string::npos;)
      text.replace(at, 3, "FIX");
    return value(text);
  }

  /// "12: IF +Q34 LT +0 GOTO LBL 2"
  void jump(const std::string& line) {
    std::istringstream words(line);
    std::string kind, is, left, sign, right, go, label, to;
    words >> kind >> is >> left >> sign >> right >> go >> label >> to;
    const double a = number(left), b = number(right);
    const bool holds = kind == "9:" && sign == "EQU"   ? a == b
                       : kind == "11:" && sign == "GT" ? a > b
                       : kind == "12:" && sign == "LT" ? a < b
                                                       : (unknown(line), false);
    if (is != "IF" || go != "GOTO" || label != "LBL") unknown(line);
    if (!holds) return;
    const auto found = std::find(lines_.begin(), lines_.end(), "LBL " + to);
    if (found == lines_.end() || std::find(found + 1, lines_.end(), *found) != lines_.end())
      unknown("a label that is not there once: " + line);
    at_ = static_cast<std::size_t>(found - lines_.begin());
  }

  /// "QS1 = QS2 || QS3" or "QS3 = TOCHAR ( DAT+Q31 DECIMALS5 )"
  void joined(const std::string& line) {
    std::istringstream words(line);
    std::string name, equal, one;
    words >> name >> equal >> one;
    std::string text;
    if (one == "TOCHAR") {
      std::string open, what, digits, close;
      words >> open >> what >> digits >> close;
      if (!take(what, "DAT") || !take(digits, "DECIMALS")) unknown(line);
      char buffer[60];
      std::snprintf(buffer, sizeof buffer, "%.*f", std::stoi(digits), number(what));
      text = buffer;
    } else {
      for (;;) {
        if (!texts_.contains(one)) unknown("not set: " + line);
        text += texts_[one];
        if (!(words >> equal)) break;
        if (equal != "||" || !(words >> one)) unknown(line);
      }
    }
    texts_[name] = text;
  }

  void print() {
    std::istringstream lines(mask);
    bool append = false;
    for (std::string line; std::getline(lines, line);) {
      if (line == "M_APPEND;")
        append = true;
      else if (line == "\"%S\",QS1;")
        log = (append ? log : "") + texts_.at("QS1") + '\n';
      else if (line != "M_CLOSE;")
        unknown("mask: " + line);
    }
  }

  /// "L Z+Q13 C+Q12 R0 FMAX"
  void move(const std::string& line) {
    std::istringstream words(line);
    std::map<char, double> axes;
    bool rapid = false, uncompensated = false;
    for (std::string word; words >> word;) {
      if (word == "FMAX")
        rapid = true;
      else if (word == "R0")
        uncompensated = true;
      else if (std::string("XZCF").find(word[0]) != std::string::npos)
        axes[word[0]] = number(word.substr(1));
      else
        unknown(line);
    }
    if (!uncompensated || rapid == axes.contains('F')) unknown(line);
    to(rapid, false, axes);
  }

  /// Cycle 3: from where the probe is, at most ABST; then back by MB, at most to where it was.
  void probe(std::string line) {
    if (line == "0 MEASURING") return;
    if (line == "1 Q31") return;
    if (take(line, "2 ")) {
      axis_ = line[0];
      if (line.substr(1) != " ANGLE: +180" && line.substr(1) != " ANGLE: +0") unknown(line);
      towards_ = line.substr(1) == " ANGLE: +0" ? 1.0 : -1.0;
      return;
    }
    std::istringstream words(line);
    std::string step, abst, way, f, mb, reference, system, zero;
    words >> step >> abst >> way >> f >> mb >> reference >> system >> zero;
    if (line != "4 ERRORMODE0") {
      if (step != "3" || abst != "ABST" || reference != "REFERENCE" || system != "SYSTEM:" ||
          zero != "0" || !take(f, "F") || !take(mb, "MB"))
        unknown(line);
      way_ = number(way), back_ = number(mb), cycle_feed_ = number(f);
      return;
    }
    double& at = axis_ == 'X' ? x : z;
    const double from = at;
    to(false, true, {{axis_, from + towards_ * way_}, {'F', cycle_feed_}});
    variables_["Q31"] = x, variables_["Q32"] = y, variables_["Q33"] = z;
    variables_["Q34"] = touched_ ? 1.0 : -1.0;
    at -= towards_ * std::min(back_, std::abs(at - from));
  }

  std::map<std::string, std::string> texts_;
  char axis_ = 'X';
  double towards_ = 0.0, way_ = 0.0, back_ = 0.0, cycle_feed_ = 0.0;
};

}  // namespace trueaxis::testing
