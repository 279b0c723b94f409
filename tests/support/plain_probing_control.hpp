// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/probed_part.hpp"

/// A lathe X Z C with a touch probe and the least of a control: it runs the probing programs of
/// FANUC and SINUMERIK. Everything that it does not know is an error of the program.
namespace trueaxis::testing {

class PlainProbingControl {
 public:
  struct Move {
    bool rapid = false, probing = false;
    double x = 0.0, z = 0.0, c = 0.0, feed = 0.0;  ///< where it ends; X as a radius
  };
  bool siemens = false;
  bool x_diameter = false;
  double x = 100.0, z = 60.0, c = 0.0, feed = 0.0;
  double part_mm = 30.0, off_mm = 0.1, ball_mm = 1.0;
  double slope = 0.0;  ///< of the part's radius over Z
  PartGap part;        ///< another one than the shaft of the numbers above
  std::vector<Move> moves;
  std::string log, alarm;

  /// X where the ball's centre is at contact, on the side of X > 0.
  double contact(double c_deg) const {
    const double turned = c_deg * std::acos(-1.0) / 180.0;
    return part_mm + ball_mm + off_mm * std::cos(turned);
  }

  void run(const std::string& program) {
    std::istringstream text(program);
    for (std::string line; std::getline(text, line);) lines_.push_back(line);
    for (at_ = 0; at_ < lines_.size() && !ended_; ++at_) {
      std::string line = lines_[at_];
      if (line.empty() || line[0] == '%' || line[0] == ';' || line[0] == '(' ||
          (line[0] == 'O' && !siemens))
        continue;
      siemens ? sinumerik(line) : fanuc(line);
    }
  }

 protected:
  [[noreturn]] static void unknown(const std::string& line) { throw std::runtime_error(line); }
  static bool take(std::string& line, const std::string& word) {
    if (line.rfind(word, 0) != 0) return false;
    line.erase(0, word.size());
    return true;
  }

  // Expressions: + - * / ( ) [ ], #n, names, FIX ABS TRUNC.
  double value(const std::string& text) {
    text_ = text, place_ = 0;
    const double out = sum();
    if (place_ != text_.size()) unknown("not a value: " + text);
    return out;
  }
  char now() {
    while (place_ < text_.size() && text_[place_] == ' ') ++place_;
    return place_ < text_.size() ? text_[place_] : '\0';
  }
  double sum() {
    double out = product();
    for (char sign = now(); sign == '+' || sign == '-'; sign = now()) {
      ++place_;
      out += sign == '+' ? product() : -product();
    }
    return out;
  }
  double product() {
    double out = factor();
    for (char sign = now(); sign == '*' || sign == '/'; sign = now()) {
      ++place_;
      const double other = factor();
      out = sign == '*' ? out * other : out / other;
    }
    return out;
  }
  double factor() {
    const char first = now();
    if (first == '-') return ++place_, -factor();
    if (first == '[' || first == '(') {
      ++place_;
      const double out = sum();
      if (now() != (first == '[' ? ']' : ')')) unknown("a bracket is open: " + text_);
      return ++place_, out;
    }
    std::size_t end = place_;
    if (std::isdigit(static_cast<unsigned char>(first))) {
      std::size_t used = 0;
      const double out = std::stod(text_.substr(place_), &used);
      return place_ += used, out;
    }
    while (end < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[end])) ||
                                  text_[end] == '#' || text_[end] == '_' || text_[end] == '$'))
      ++end;
    const std::string name = text_.substr(place_, end - place_);
    place_ = end;
    if (name == "FIX" || name == "TRUNC") return std::trunc(factor());
    if (name == "ABS") return std::abs(factor());
    std::string whole = name;
    if (name[0] == '$') {  // $AA_IW[X]
      const std::size_t close = text_.find(']', place_);
      whole += text_.substr(place_, close + 1 - place_), place_ = close + 1;
    }
    return variable(whole);
  }
  double variable(const std::string& name) {
    const double scale = x_diameter ? 2.0 : 1.0;
    if (name == "#5041") return scale * x;
    if (name == "#5042") return z;
    if (name == "#5061" || name == "$AA_MW[X]") return scale * measured_.x;
    if (name == "#5062" || name == "$AA_MW[Z]") return measured_.z;
    if (name == "$AA_IW[X]") return x;
    if (name == "$AA_IW[Z]") return z;
    if (name == "$AC_MEA[1]") return touched_ ? 1.0 : 0.0;
    const auto found = variables_.find(name);
    if (found == variables_.end()) unknown("not set: " + name);
    return found->second;
  }

  void to(bool rapid, bool probing, std::map<char, double> words) {
    if (words.contains('F')) feed = words['F'];
    if (words.contains('C')) c = words['C'];
    const BallAt from{x, z, c};
    if (words.contains('Z')) z = words['Z'];
    if (words.contains('X')) {
      const double end = words['X'] / (x_diameter ? 2.0 : 1.0);
      const double met = x > 0.0 ? contact(c) + slope * z : -(contact(c + 180.0) + slope * z);
      touched_ = !part && std::abs(end) < std::abs(met) && x * end > 0.0 && z < 5.0;
      x = touched_ ? met : end;
    }
    if (part) {
      const Met met = first_met(part, from, {x, z, c});
      x = met.at.x, z = met.at.z, touched_ = met.part;
    }
    if (touched_ && !probing) alarm = "collision";
    measured_ = {x, z, c};
    moves.push_back({rapid, probing, x, z, c, feed});
  }

  void fanuc(std::string line) {
    if (take(line, "IF[")) {
      const std::size_t close = line.rfind(']', std::min(line.find("GOTO"), line.find("THEN")));
      if (!holds(line.substr(0, close), "GE", "LT")) return;
      line.erase(0, close + 1);
      if (take(line, "GOTO")) {
        while (lines_.at(at_) != "N" + line) ++at_;
        return;
      }
      if (!take(line, "THEN ")) unknown(line);
    }
    if (take(line, "WHILE[")) {
      const std::size_t close = line.rfind("]DO1");
      if (holds(line.substr(0, close), "GE", "LT"))
        loop_ = at_;
      else
        while (lines_.at(at_) != "END1") ++at_;
    } else if (line == "END1") {
      at_ = loop_ - 1;
    } else if (take(line, "#3000=")) {
      alarm = line, ended_ = true;
    } else if (line[0] == '#') {
      const std::size_t equal = line.find('=');
      variables_[line.substr(0, equal)] = value(line.substr(equal + 1));
    } else if (take(line, "DPRNT[")) {
      print(line.substr(0, line.size() - 1));
    } else if (line == "M30") {
      ended_ = true;
    } else if (line == "POPEN" || line == "PCLOS" || line[0] == 'N') {
    } else {
      blocks(line);
    }
  }

  /// "X#5061[44]*C": w digits before the point and f after it, padded with blanks.
  void print(const std::string& format) {
    for (std::size_t i = 0; i < format.size(); ++i) {
      if (format[i] == '#') {
        const std::size_t open = format.find('[', i);
        char number[60];
        std::snprintf(number, sizeof number, "%*.*f",
                      format[open + 1] - '0' + format[open + 2] - '0' + 2, format[open + 2] - '0',
                      variable(format.substr(i, open - i)));
        log += number;
        i = open + 3;
      } else {
        log += format[i] == '*' ? ' ' : format[i];
      }
    }
    log += '\n';
  }

  bool holds(const std::string& text, const std::string& at_least, const std::string& less) {
    for (const std::string& word : {at_least, less}) {
      const std::size_t at = text.find(word);
      if (at == std::string::npos) continue;
      const double a = value(text.substr(0, at)), b = value(text.substr(at + word.size()));
      return word == less ? a < b : word == "==" ? a == b : a >= b;
    }
    unknown("not a condition: " + text);
  }

  void sinumerik(std::string line) {
    if (take(line, "DEF ") || line == "STOPRE" || line == "ENDIF") return;
    if (take(line, "IF ")) {
      bool all = true;
      for (std::size_t at = 0; at < line.size();) {
        const std::size_t next = std::min(line.find(" AND ", at), line.size());
        std::string one = line.substr(at, next - at);
        if (one[0] == '(') one = one.substr(1, one.size() - 2);
        all = holds(one, "==", " < ") && all;
        at = next + 5;
      }
      if (!all)
        while (lines_.at(at_) != "ENDIF") ++at_;
    } else if (take(line, "FOR K=0 TO ")) {
      loop_ = at_, last_ = value(line), variables_["K"] = 0.0;
    } else if (line == "ENDFOR") {
      if ((variables_["K"] += 1.0) <= last_) at_ = loop_;
    } else if (take(line, "SETAL(")) {
      alarm = line;
    } else if (line == "M30") {
      ended_ = true;
    } else if (take(line, "WRITE(ERR,\"p_LOG\",")) {
      line.pop_back();
      for (std::size_t at = 0; at < line.size();) {
        const std::size_t next = std::min(line.find("<<", at), line.size());
        const std::string one = line.substr(at, next - at);
        char number[40];
        std::snprintf(number, sizeof number, "%.10g", one[0] == '"' ? 0.0 : value(one));
        log += one[0] == '"' ? one.substr(1, one.size() - 2) : number;
        at = next + 2;
      }
      log += '\n';
    } else if (line.find(' ') == std::string::npos && line.find('=') != std::string::npos) {
      const std::size_t equal = line.find('=');
      variables_[line.substr(0, equal)] = value(line.substr(equal + 1));
    } else {
      blocks(line);
    }
  }

  void blocks(const std::string& line) {
    std::istringstream words(line);
    bool rapid = false, feeding = false, probing = false;
    std::map<char, double> axes;
    for (std::string word; words >> word;) {
      if (word == "G0" || word == "G1" || word == "G31") {
        rapid = word == "G0", feeding = !rapid, probing = probing || word == "G31";
      } else if (word == "MEAS=1") {
        probing = true;
      } else if (word[0] == 'G' || word == "DIAMOF") {
      } else if (std::string("XZCF").find(word[0]) != std::string::npos) {
        std::string number = word.substr(word[1] == '=' ? 2 : 1);
        if (number.rfind("DC", 0) == 0) number.erase(0, 2);
        axes[word[0]] = value(number);
      } else {
        unknown(line);
      }
    }
    if (!axes.empty() && !rapid && !feeding) unknown("a move without G0 or G1: " + line);
    if (!axes.empty()) to(rapid, probing, axes);
  }

  std::vector<std::string> lines_;
  std::size_t at_ = 0, loop_ = 0, place_ = 0;
  bool ended_ = false, touched_ = false;
  BallAt measured_;
  double last_ = 0.0;
  std::string text_;
  std::map<std::string, double> variables_;
};

}  // namespace trueaxis::testing
