// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "nc/probing/dialect.hpp"

namespace trueaxis::nc {
namespace {

std::string mm(double value) { return short_number(value, 4); }
std::string deg(double value) { return short_number(value, 5); }

/// C continues from the revolution in which it is, so that nothing winds back.
class LinuxCnc final : public Dialect {
 public:
  using Dialect::Dialect;

  void begin(const std::vector<std::string>& remarks,
             const std::vector<std::string>& log) override {
    remark("schema: trueaxis.probing_program/1");
    for (const std::string& text : remarks) remark(text);
    remark("X is a radius from the spindle axis; call the probe and its offset before");
    line("G21 G18 G90 G94 G8 G40 G80 G64 " + limits_.offset());
    const std::string x = mm(limits_.clear_x_mm()), z = mm(limits_.clear_z_mm());
    line(fmt::format("o100 if [[#5420 LT {}] AND [#5422 LT {}]]", x, z));
    line(fmt::format("  (ABORT,the probe is not clear of the part: jog it beyond X {} or Z {})", x,
                     z));
    line("o100 endif");
    if (dry_run_) return;
    line(fmt::format("(LOGOPEN,{}.log)", name_));
    for (const std::string& text : log) line(fmt::format("(LOG,{})", text));
  }

  void remark(const std::string& words) override { line(fmt::format("( {} )", words)); }
  void rapid_x(double x_mm) override { line("G0 X" + mm(x_mm)); }
  void rapid_z(double z_mm) override { line("G0 Z" + mm(z_mm)); }

  void touch(const TouchRun& run) override {
    const int label = 100 + run.pass;
    const std::string clear = mm(run.rear ? -limits_.clear_x_mm() : limits_.clear_x_mm());
    start_of_turn();
    line("#<k> = 0");
    line(fmt::format("o{} while [#<k> LT {}]", label, run.count));
    line(fmt::format("  G0 Z{} C[#<turn> + {} + {} * #<k>]", along(run.z_mm, run.z_step_mm, mm),
                     deg(run.c_deg), step(run.c_step_deg)));
    const std::string stop = along(run.stop_mm, run.stop_step_mm, mm);
    const std::string feed = " F" + short_number(60.0 * limits_.feed_mm_per_s, 3);
    if (dry_run_) {
      line("  G1 X" + stop + feed);
    } else {
      line("  G38.2 X" + stop + feed);
      line(fmt::format("  (LOG,X #5061 C #5066 Z #5063 P {})", run.pass));
    }
    line("  G0 X" + clear);
    line("  #<k> = [#<k> + 1]");
    line(fmt::format("o{} endwhile", label));
  }

  void scan(const ScanRun& run) override {
    start_of_turn();
    line(fmt::format("G0 Z{} C#<turn>", mm(run.begin.z_mm)));
    line(fmt::format("G1 X{} F{}", mm(run.begin.x_mm),
                     short_number(60.0 * limits_.feed_mm_per_s, 3)));
    if (run.rpm == 0.0) {
      line("M66 E0 L0");
      reading(run.pass, "M68");
      line("G4 P" + short_number(run.seconds, 3));
      reading(0, "M68");
      return;
    }
    // One block, so that nothing changes the speed within the pass; in the time that C needs, so
    // that Z does not.
    reading(run.pass, "M67");
    line("G93");
    const double turns = (run.end.c_deg - run.begin.c_deg) / 360.0;
    line(fmt::format("G1 X{} Z{} C[#<turn> + {}] F{}", mm(run.end.x_mm), mm(run.end.z_mm),
                     deg(run.end.c_deg), short_number(run.rpm / std::abs(turns), 6)));
    reading(0, "M67");
    line("G94");
  }

  void end() override {
    if (!dry_run_) {
      line("M66 E0 L0 ( what follows waits for the moves before )");
      line(fmt::format("(LOG,{})", log_end));
      line("(LOGCLOSE)");
    }
    line("M2");
  }

 private:
  void start_of_turn() { line("#<turn> = [360 * FIX[#5425 / 360]]"); }

  /// What the sampler's pin motion.analog-out-00 says: the pass that is read, 0 for none.
  void reading(int pass, const char* code) {
    if (!dry_run_) line(fmt::format("{} E0 Q{}", code, pass));
  }

  static std::string step(double value) { return short_number(value, 9); }
  static std::string along(double first, double each, std::string (*number)(double)) {
    if (each == 0.0) return number(first);
    return fmt::format("[{} + {} * #<k>]", number(first), step(each));
  }
};

}  // namespace

std::unique_ptr<Dialect> linuxcnc_dialect(const ProbingLimits& limits, const std::string& name,
                                          bool dry_run) {
  return std::make_unique<LinuxCnc>(limits, name, dry_run);
}

}  // namespace trueaxis::nc
