// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nc/probing/dialect.hpp"

namespace trueaxis::nc {
namespace {

constexpr double y_tolerance_mm = 0.01;  // R 30 mm: 1.7 nm of X

std::string with_sign(double value, int decimals = 4) {
  const std::string text = short_number(value, decimals);
  return text[0] == '-' ? text : '+' + text;
}

/// Klartext: touch probe cycle 3 and FN 16. Q10 counts, Q11 is C, Q12 its word, Q13 where the
/// pass is, Q14 the way of the probe; Q31 to Q34 are what the cycle measured. QS1 is a line of the
/// log.
class Heidenhain final : public Dialect {
 public:
  using Dialect::Dialect;

  void begin(const std::vector<std::string>& remarks) override {
    block(fmt::format("BEGIN PGM {} MM", name_));
    remark("schema: trueaxis.probing_program/1");
    for (const std::string& one : remarks) remark(one);
    remark("X is a radius from the spindle axis; call the probe, preset and C axis before");
    block("FUNCTION MODE MILL");  // in turning mode X words are diameters
    block("M126");                // C on the shorter way
    block("FN 20: WAIT FOR SYNC");
    for (int axis = 1; axis <= 3; ++axis)
      block(fmt::format("FN 18: SYSREAD Q2{} = ID270 NR1 IDX{}", axis, axis));
    block(fmt::format("FN 11: IF +Q22 GT {} GOTO LBL {}", with_sign(y_tolerance_mm), not_clear));
    block(fmt::format("FN 12: IF +Q22 LT {} GOTO LBL {}", with_sign(-y_tolerance_mm), not_clear));
    block(
        fmt::format("FN 12: IF +Q21 LT {} GOTO LBL {}", with_sign(limits_.clear_x_mm()), in_front));
    block(fmt::format("FN 9: IF +0 EQU +0 GOTO LBL {}", clear));
    block(fmt::format("LBL {}", in_front));
    block(fmt::format("FN 12: IF +Q23 LT {} GOTO LBL {}", with_sign(limits_.clear_z_mm()),
                      not_clear));
    block(fmt::format("LBL {}", clear));
  }

  void open_log(const std::string& name, const std::vector<std::string>& head) override {
    log_ = name;
    for (const std::string& one : head) print(one);
  }
  void close_log() override { print(std::string(log_end)); }

  void remark(const std::string& words) override { block("; " + words); }
  void rapid(char axis, double to_mm) override {
    block(fmt::format("L {}{} R0 FMAX", axis, with_sign(to_mm)));
  }
  void feed(char axis, double to_mm) override {
    block(fmt::format("L {}{} R0 F{}", axis, with_sign(to_mm), speed()));
  }

  void touch(const TouchRun& run) override {
    const int label = before_loops + next_label();
    const Approach& way = run.approach;
    block("Q10 = 0");
    block(fmt::format("LBL {}", label));
    block("Q11 = " + each(run.c_deg, run.c_step_deg, run));
    const double lowest =
        std::min(run.c_deg, run.c_deg + run.c_step_deg * static_cast<double>(run.count));
    block(fmt::format("Q12 = Q11 + {}",
                      short_number(std::max(0.0, -360.0 * std::floor(lowest / 360.0)), 0)));
    block("Q12 = Q12 - 360 * INT ( Q12 / 360 )");
    block("Q13 = " + each(run.along_mm, run.along_step_mm, run));
    block("Q14 = " +
          each(way.sense * (run.stop_mm - way.clear_mm), way.sense * run.stop_step_mm, run));
    block(fmt::format("L {}+Q13 C+Q12 R0 FMAX", way.along()));
    if (dry_run_) {
      block(fmt::format("L {}{} R0 F{}", way.axis, with_sign(run.stop_mm), speed()));
    } else {
      block("Q34 = - 1");
      block("TCH PROBE 3.0 MEASURING");
      block("TCH PROBE 3.1 Q31");
      block(fmt::format("TCH PROBE 3.2 {} ANGLE: {}", way.axis, way.sense > 0.0 ? "+0" : "+180"));
      block(fmt::format("TCH PROBE 3.3 ABST +Q14 F{} MB{} REFERENCE SYSTEM: 0", speed(),
                        short_number(limits_.clearance_mm, 4)));
      block("TCH PROBE 3.4 ERRORMODE0");
      block(fmt::format("FN 12: IF +Q34 LT +0 GOTO LBL {}", no_contact));
      row(run);
    }
    rapid(way.axis, way.clear_mm);
    block("Q10 = Q10 + 1");
    block(fmt::format("FN 12: IF +Q10 LT +{} GOTO LBL {}", run.count, label));
  }

  void end() override {
    block("M30");
    stop(not_clear, "the probe is not clear of the part, or Y is not 0", 1005);
    stop(no_contact, "no contact", 1014);
    block(fmt::format("END PGM {} MM", name_));
  }

 private:
  enum : int { not_clear = 1, no_contact, in_front, clear, before_loops = 10 };

  std::string speed() const { return short_number(feed_per_minute(), 3); }
  void block(const std::string& words) { line(fmt::format("{} {}", blocks_++, words)); }

  void stop(int label, const std::string& why, int error) {
    block(fmt::format("LBL {}", label));
    remark(why);
    block(fmt::format("FN 14: ERROR = {}", error));
    block("M30");
  }

  /// The mask appends: a log of an earlier run must be moved away, or import refuses the two.
  void append() {
    block(fmt::format(R"(FN 16: F-PRINT TNC:\trueaxis_line.a / TNC:\{}_log.txt)", log_));
  }
  void print(const std::string& words) {
    block(fmt::format("DECLARE STRING QS1 = \"{}\"", words));
    append();
  }
  void row(const TouchRun& run) {
    const bool x = run.approach.axis == 'X';
    block("DECLARE STRING QS2 = \"X \"");
    block(fmt::format("QS3 = TOCHAR ( DAT+Q{} DECIMALS5 )", x ? 31 : 13));
    block("DECLARE STRING QS4 = \" C \"");
    block("QS5 = TOCHAR ( DAT+Q11 DECIMALS5 )");
    block("DECLARE STRING QS6 = \" Z \"");
    block(fmt::format("QS7 = TOCHAR ( DAT+Q{} DECIMALS5 )", x ? 13 : 33));
    block(fmt::format("DECLARE STRING QS8 = \" P {}\"", run.pass));
    block("QS1 = QS2 || QS3 || QS4 || QS5 || QS6 || QS7 || QS8");
    append();
  }

  /// The way of the whole run over its steps: a step alone needs more digits than a control takes.
  static std::string each(double first, double more, const TouchRun& run) {
    const std::size_t steps = std::max<std::size_t>(run.count, 2) - 1;
    const double whole = more * static_cast<double>(steps);
    std::string text = (first < 0.0 ? "- " : "") + short_number(std::abs(first), 5);
    if (more != 0.0)
      text += fmt::format(" {} {} * Q10 / {}", whole < 0.0 ? '-' : '+',
                          short_number(std::abs(whole), 5), steps);
    return text;
  }

  std::string log_;
  std::size_t blocks_ = 0;
};

}  // namespace

std::unique_ptr<Dialect> heidenhain_dialect(const ProbingLimits& limits, const std::string& name,
                                            bool dry_run) {
  return std::make_unique<Heidenhain>(limits, name, dry_run);
}

}  // namespace trueaxis::nc
