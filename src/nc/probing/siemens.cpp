// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "nc/probing/dialect.hpp"

namespace trueaxis::nc {
namespace {

std::string number(double value, int decimals = 4) { return short_number(value, decimals); }

/// SINUMERIK: MEAS=1 and WRITE. DIAMOF makes X a radius, its words and its measured position.
class Siemens final : public Dialect {
 public:
  using Dialect::Dialect;

  void begin(const std::vector<std::string>& remarks) override {
    remark("schema: trueaxis.probing_program/1");
    for (const std::string& one : remarks) remark(one);
    remark("X is a radius; call the probe, its offset and the C axis before");
    line("DEF INT K, ERR");
    line("DEF REAL CR, CW, ZP, XS");
    line("G710 G18 G40 G60 G90 G94 DIAMOF " + limits_.offset());
    line(fmt::format("IF ($AA_IW[X] < {}) AND ($AA_IW[Z] < {})", number(limits_.clear_x_mm()),
                     number(limits_.clear_z_mm())));
    remark("the probe is not clear of the part");
    line("SETAL(65000)");
    line("M30");
    line("ENDIF");
  }

  void open_log(const std::string& name, const std::vector<std::string>& head) override {
    log_ = name;
    for (const std::string& one : head) write(fmt::format("\"{}\"", one));
  }
  void close_log() override { write(fmt::format("\"{}\"", log_end)); }

  void remark(const std::string& words) override { line("; " + words); }
  void rapid(char axis, double to_mm) override {
    line(fmt::format("G0 {}{}", axis, number(to_mm)));
  }
  void feed(char axis, double to_mm) override {
    line(fmt::format("G1 {}{} F{}", axis, number(to_mm), number(feed_per_minute())));
  }

  void touch(const TouchRun& run) override {
    line(fmt::format("FOR K=0 TO {}", run.count - 1));
    line("CR=" + along(run.c_deg, run.c_step_deg));
    line("CW=CR-360*TRUNC(CR/360)");
    line("IF CW < 0");
    line("CW=CW+360");
    line("ENDIF");
    line("ZP=" + along(run.along_mm, run.along_step_mm));
    line("XS=" + along(run.stop_mm, run.stop_step_mm));
    line(fmt::format("G0 {}=ZP C=DC(CW)", run.approach.along()));
    line(fmt::format("{}G1 {}=XS F{}", dry_run_ ? "" : "MEAS=1 ", run.approach.axis,
                     number(feed_per_minute())));
    if (!dry_run_) {
      line("STOPRE");
      line("IF $AC_MEA[1] == 0");
      remark("no contact");
      line("SETAL(65001)");
      line("M30");
      line("ENDIF");
      const auto value = [&](char axis) {
        return run.approach.axis == axis ? "$AA_MW[" + std::string(1, axis) + "]" : "ZP";
      };
      write(fmt::format("\"X \"<<{}<<\" C \"<<CR<<\" Z \"<<{}<<\" P {}\"", value('X'), value('Z'),
                        run.pass));
    }
    rapid(run.approach.axis, run.approach.clear_mm);
    line("ENDFOR");
  }

  void end() override { line("M30"); }

 private:
  /// WRITE appends: a log of an earlier run must be moved away, or import refuses the two.
  void write(const std::string& words) {
    line(fmt::format("WRITE(ERR,\"{}_LOG\",{})", log_, words));
  }
  static std::string along(double first, double each) {
    if (each == 0.0) return number(first, 5);
    return fmt::format("{}+({})*K", number(first, 5), number(each, 9));
  }

  std::string log_;
};

}  // namespace

std::unique_ptr<Dialect> siemens_dialect(const ProbingLimits& limits, const std::string& name,
                                         bool dry_run) {
  return std::make_unique<Siemens>(limits, name, dry_run);
}

}  // namespace trueaxis::nc
