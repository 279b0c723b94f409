// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "nc/probing/dialect.hpp"

namespace trueaxis::nc {
namespace {

/// Custom macro B: G31 and DPRNT. #101 counts, #102 is C, #103 its word, #104 Z, #105 where X
/// stops.
class Fanuc final : public Dialect {
 public:
  using Dialect::Dialect;

  void begin(const std::vector<std::string>& remarks,
             const std::vector<std::string>& log) override {
    line("%");
    line("O8001");
    remark("schema: trueaxis.probing_program/1");
    for (const std::string& one : remarks) remark(one);
    remark(limits_.x_diameter ? "X is a diameter" : "X is a radius");
    remark("axis 1 is X; call the probe, its offset and the C axis before");
    line("G21 G18 G40 G80 " + limits_.offset());
    line(limits_.gcode_system == 'A' ? "G98" : "G90 G94");
    line(fmt::format("IF[#5041GE{}]GOTO10", x(limits_.clear_x_mm())));
    line(fmt::format("IF[#5042GE{}]GOTO10", number(limits_.clear_z_mm())));
    line("#3000=1(THE PROBE IS NOT CLEAR)");
    line("N10");
    if (dry_run_) return;
    line("POPEN");
    for (const std::string& one : log) line(fmt::format("DPRNT[{}]", starred(one)));
  }

  void remark(const std::string& words) override { line(fmt::format("( {} )", words)); }
  void rapid_x(double x_mm) override { line("G0 X" + x(x_mm)); }
  void rapid_z(double z_mm) override { line("G0 Z" + number(z_mm)); }

  void touch(const TouchRun& run) override {
    line("#101=0");
    line(fmt::format("WHILE[#101LT{}]DO1", run.count));
    line("#102=" + along(run.c_deg, run.c_step_deg));
    line("#103=#102-FIX[#102/360.]*360.");
    line("IF[#103LT0]THEN #103=#103+360.");
    line("#104=" + along(run.z_mm, run.z_step_mm));
    const double scale = limits_.x_diameter ? 2.0 : 1.0;
    line("#105=" + along(scale * run.stop_mm, scale * run.stop_step_mm));
    line("G0 Z#104 C#103");
    line(
        fmt::format("{} X#105 F{}", dry_run_ ? "G1" : "G31", number(60.0 * limits_.feed_mm_per_s)));
    if (!dry_run_) {
      line("IF[ABS[#5061-#105]LT0.001]THEN #3000=2(NO CONTACT)");
      line(fmt::format("DPRNT[X#5061[44]*C#102[64]*Z#104[44]*P{}]", run.pass));
    }
    line("G0 X" + x(run.rear ? -limits_.clear_x_mm() : limits_.clear_x_mm()));
    line("#101=#101+1");
    line("END1");
  }

  void end() override {
    if (!dry_run_) {
      line(fmt::format("DPRNT[{}]", log_end));
      line("PCLOS");
    }
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
  std::string x(double value) const { return number(limits_.x_diameter ? 2.0 * value : value); }
  static std::string along(double first, double each) {
    if (each == 0.0) return number(first, 5);
    return fmt::format("{}+[{}]*#101", number(first, 5), number(each, 8));
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
