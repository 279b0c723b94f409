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

  void begin(const std::vector<std::string>& remarks) override {
    remark("schema: trueaxis.probing_program/1");
    for (const std::string& text : remarks) remark(text);
    remark("X is a radius from the spindle axis; call the probe and its offset before");
    // G61: G64 would round the corners of rapid moves, by more than their clearance.
    line("G21 G18 G90 G94 G8 G40 G80 G61 " + limits_.offset());
    const std::string x = mm(limits_.clear_x_mm()), z = mm(limits_.clear_z_mm());
    line(fmt::format("o100 if [[#5420 LT {}] AND [#5422 LT {}]]", x, z));
    line(fmt::format("  (ABORT,the probe is not clear of the part: jog it beyond X {} or Z {})", x,
                     z));
    line("o100 endif");
  }

  void open_log(const std::string& name, const std::vector<std::string>& head) override {
    line(fmt::format("(LOGOPEN,{}.log)", name));
    for (const std::string& text : head) line(fmt::format("(LOG,{})", text));
  }
  void close_log() override {
    line("M66 E0 L0 ( what follows waits for the moves before )");
    line(fmt::format("(LOG,{})", log_end));
    line("(LOGCLOSE)");
  }

  void remark(const std::string& words) override { line(fmt::format("( {} )", words)); }
  void rapid(char axis, double to_mm) override { line(fmt::format("G0 {}{}", axis, mm(to_mm))); }
  void feed(char axis, double to_mm) override {
    line(fmt::format("G1 {}{} F{}", axis, mm(to_mm), speed()));
  }

  void touch(const TouchRun& run) override {
    const int label = 100 + next_label();
    start_of_turn();
    line("#<k> = 0");
    line(fmt::format("o{} while [#<k> LT {}]", label, run.count));
    line(fmt::format("  G0 {}{} C[#<turn> + {} + {} * #<k>]", run.approach.along(),
                     each(run.along_mm, run.along_step_mm), deg(run.c_deg), step(run.c_step_deg)));
    line(fmt::format("  {} {}{} F{}", dry_run_ ? "G1" : "G38.2", run.approach.axis,
                     each(run.stop_mm, run.stop_step_mm), speed()));
    if (!dry_run_) line(fmt::format("  (LOG,X #5061 C #5066 Z #5063 P {})", run.pass));
    line(fmt::format("  G0 {}{}", run.approach.axis, mm(run.approach.clear_mm)));
    line("  #<k> = [#<k> + 1]");
    line(fmt::format("o{} endwhile", label));
  }

  void scan(const ScanRun& run) override {
    const char axis = run.approach.axis, along = run.approach.along();
    start_of_turn();
    line(fmt::format("G0 {}{} C#<turn>", along, mm(run.begin.along_mm)));
    feed(axis, run.begin.met_mm);
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
    line(fmt::format("G1 {}{} {}{} C[#<turn> + {}] F{}", axis, mm(run.end.met_mm), along,
                     mm(run.end.along_mm), deg(run.end.c_deg),
                     short_number(run.rpm / std::abs(turns), 6)));
    reading(0, "M67");
    line("G94");
  }

  void end() override { line("M2"); }

 private:
  void start_of_turn() { line("#<turn> = [360 * FIX[#5425 / 360]]"); }

  /// What the sampler's pin motion.analog-out-00 says: the pass that is read, 0 for none.
  void reading(int pass, const char* code) {
    if (!dry_run_) line(fmt::format("{} E0 Q{}", code, pass));
  }

  std::string speed() const { return short_number(feed_per_minute(), 3); }
  static std::string step(double value) { return short_number(value, 9); }
  /// Of touch point k.
  static std::string each(double first, double more) {
    if (more == 0.0) return mm(first);
    return fmt::format("[{} + {} * #<k>]", mm(first), step(more));
  }
};

}  // namespace

std::unique_ptr<Dialect> linuxcnc_dialect(const ProbingLimits& limits, const std::string& name,
                                          bool dry_run) {
  return std::make_unique<LinuxCnc>(limits, name, dry_run);
}

}  // namespace trueaxis::nc
