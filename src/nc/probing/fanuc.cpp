// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "nc/probing/dialect.hpp"

namespace trueaxis::nc {
namespace {

/// Custom macro B: G31 and DPRNT. #101 counts, #102 is C, #103 its word, #104 where the
/// pass is, #105 where the probe stops.
class Fanuc final : public Dialect {
 public:
  using Dialect::Dialect;

  void begin(const std::vector<std::string>& remarks) override {
    line("%");
    line("O8001");
    remark("schema: trueaxis.probing_program/1");
    for (const std::string& one : remarks) remark(one);
    remark(limits_.x_diameter ? "X is a diameter" : "X is a radius");
    remark("axis 1 is X; call the probe, its offset and the C axis before");
    line("G21 G18 G40 G80 " + limits_.offset());
    line(limits_.gcode_system == 'A' ? "G98" : "G90 G94");
    line(fmt::format("IF[#5041GE{}]GOTO10", value('X', limits_.clear_x_mm())));
    line(fmt::format("IF[#5042GE{}]GOTO10", number(limits_.clear_z_mm())));
    line("#3000=1(THE PROBE IS NOT CLEAR)");
    line("N10");
  }

  void open_log(const std::string&, const std::vector<std::string>& head) override {
    line("POPEN");
    for (const std::string& one : head) line(fmt::format("DPRNT[{}]", starred(one)));
  }
  void close_log() override {
    line(fmt::format("DPRNT[{}]", log_end));
    line("PCLOS");
  }

  void remark(const std::string& words) override { line(fmt::format("( {} )", words)); }
  void rapid(char axis, double to_mm) override {
    line(fmt::format("G0 {}{}", axis, value(axis, to_mm)));
  }
  void feed(char axis, double to_mm) override {
    line(fmt::format("G1 {}{} F{}", axis, value(axis, to_mm), number(feed_per_minute())));
  }

  void touch(const TouchRun& run) override {
    line("#101=0");
    line(fmt::format("WHILE[#101LT{}]DO1", run.count));
    line("#102=" + each('C', run.c_deg, run.c_step_deg));
    line("#103=#102-FIX[#102/360.]*360.");
    line("IF[#103LT0]THEN #103=#103+360.");
    const char axis = run.approach.axis, along = run.approach.along();
    const std::string met = axis == 'X' ? "#5061" : "#5062";
    line("#104=" + each(along, run.along_mm, run.along_step_mm));
    line("#105=" + each(axis, run.stop_mm, run.stop_step_mm));
    line(fmt::format("G0 {}#104 C#103", along));
    line(fmt::format("{} {}#105 F{}", dry_run_ ? "G1" : "G31", axis, number(feed_per_minute())));
    if (!dry_run_) {
      line(fmt::format("IF[ABS[{}-#105]LT0.001]THEN #3000=2(NO CONTACT)", met));
      line(fmt::format("DPRNT[X{}[44]*C#102[64]*Z{}[44]*P{}]", axis == 'X' ? met : "#104",
                       axis == 'Z' ? met : "#104", run.pass));
    }
    rapid(axis, run.approach.clear_mm);
    line("#101=#101+1");
    line("END1");
  }

  void end() override {
    line("M30");
    line("%");
  }

 private:
  /// Always with a point: without one a control may count in its least increment.
  static std::string number(double value, int decimals = 3) {
    std::string text = short_number(value, decimals);
    if (text.find('.') == std::string::npos) text += '.';
    return text;
  }
  double scale(char axis) const { return axis == 'X' && limits_.x_diameter ? 2.0 : 1.0; }
  std::string value(char axis, double mm) const { return number(scale(axis) * mm); }
  /// Of touch point #101.
  std::string each(char axis, double first, double more) const {
    const std::string text = number(scale(axis) * first, 5);
    return more == 0.0 ? text : fmt::format("{}+[{}]*#101", text, number(scale(axis) * more, 8));
  }
  static std::string starred(std::string words) {
    for (char& c : words)
      if (c == ' ') c = '*';
    return words;
  }
};

}  // namespace

std::unique_ptr<Dialect> fanuc_dialect(const ProbingLimits& limits, const std::string& name,
                                       bool dry_run) {
  return std::make_unique<Fanuc>(limits, name, dry_run);
}

}  // namespace trueaxis::nc
