// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "nc/probing/approach.hpp"
#include "nc/probing/probing.hpp"

namespace trueaxis::nc {

/// Touch points of a pass: each moves from the clear position to at most `stop` and back.
struct TouchRun {
  int pass = 1;
  Approach approach;
  std::size_t count = 0;
  double c_deg = 0.0, c_step_deg = 0.0;  ///< of the first, and from one to the next
  double along_mm = 0.0, along_step_mm = 0.0;
  double stop_mm = 0.0, stop_step_mm = 0.0;  ///< of the axis; of a dry run where it turns back
};

/// A place on a pass that is read while the spindle turns.
struct ScanPoint {
  double c_deg = 0.0;  ///< from the start of the run-in
  double along_mm = 0.0, met_mm = 0.0;
};

/// A pass that is read without stop: run-in, readings, run-out.
struct ScanRun {
  int pass = 1;
  Approach approach;
  double rpm = 0.0;      ///< 0: at standstill
  double seconds = 0.0;  ///< of a standing capture
  ScanPoint begin, end;
};

/// The lines of the log before its rows; import knows them.
std::vector<std::string> log_head(const ProbingPlan& plan, const ProbingLimits& limits);
inline constexpr std::string_view log_end = "END";
/// In which set-up of the log a pass is: 2 on the rear side.
int set_up_of(const ProbingPass& pass);

/// A control's words. Positions are absolute, mm and degrees, X a radius.
class Dialect {
 public:
  Dialect(const ProbingLimits& limits, std::string name, bool dry_run)
      : limits_(limits), name_(std::move(name)), dry_run_(dry_run) {}
  virtual ~Dialect() = default;
  virtual void begin(const std::vector<std::string>& remarks) = 0;
  /// What follows is logged after these lines, until close_log(). Not in a dry run.
  virtual void open_log(const std::string& name, const std::vector<std::string>& head) = 0;
  virtual void close_log() = 0;
  virtual void remark(const std::string& words) = 0;
  virtual void rapid(char axis, double mm) = 0;
  virtual void feed(char axis, double mm) = 0;  ///< at the feed towards the part
  virtual void touch(const TouchRun& run) = 0;
  virtual void scan(const ScanRun&) {}
  virtual void end() = 0;
  const std::string& text() const { return text_; }

 protected:
  void line(const std::string& words) { text_ += words + '\n'; }
  /// The number of a loop, once in a program.
  int next_label() { return ++labels_; }
  double feed_per_minute() const { return 60.0 * limits_.feed_mm_per_s; }
  const ProbingLimits& limits_;
  std::string name_;
  bool dry_run_;
  std::string text_;

 private:
  int labels_ = 0;
};

std::unique_ptr<Dialect> linuxcnc_dialect(const ProbingLimits& limits, const std::string& name,
                                          bool dry_run);

std::unique_ptr<Dialect> fanuc_dialect(const ProbingLimits& limits, const std::string& name,
                                       bool dry_run);
std::unique_ptr<Dialect> siemens_dialect(const ProbingLimits& limits, const std::string& name,
                                         bool dry_run);
std::unique_ptr<Dialect> heidenhain_dialect(const ProbingLimits& limits, const std::string& name,
                                            bool dry_run);

/// Words as any control takes them in a comment: ASCII, without the signs that end one.
std::string plain_words(std::string words);

/// A number of at most `decimals` digits after the point, without those that are 0.
std::string short_number(double value, int decimals);

}  // namespace trueaxis::nc
