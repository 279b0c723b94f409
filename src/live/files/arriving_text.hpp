// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "live/live_state.hpp"
#include "measure/files/stream_csv.hpp"

namespace trueaxis {

enum class TextForm {
  csv,         ///< a stream as docs/reference/stream.md has it
  halsampler,  ///< blank-separated X_M, C, Z in mm and degrees, `overrun` where some were lost
};

/// The text of a stream while it arrives, read in pieces: the head, and the whole lines since the
/// last time.
class ArrivingText {
 public:
  /// @param keeps all of the text, as `all` needs it
  ArrivingText(std::string source, TextForm form, bool keeps)
      : source_(std::move(source)), form_(form), keeps_(keeps) {}

  void add(std::string_view bytes);

  /// The readings of the lines that are whole; none: no line since the last time.
  /// @throws InputError; the lines are then tried again with those that follow
  std::optional<ProbeStream> take(const StreamReadOptions& options);

  /// With a line that says the schema of a stream.
  const std::string& all() const { return all_; }
  void forget();  ///< `all` is not needed
  std::size_t lost() const { return lost_; }
  /// Of a line that has not ended: a number in it may lack digits.
  const std::string& torn() const { return rest_; }

 private:
  void add_line(std::string_view line);

  std::string source_;
  TextForm form_;
  bool keeps_, has_head_ = false;
  std::string head_, lines_, rest_, all_;
  std::size_t lost_ = 0, tried_ = 0;  ///< of `lines_`, bytes that no stream could be read of
};

/// A picture of 20 lines: axis, U and the residuals over C.
std::string live_picture(const LiveState& state, std::optional<double> wanted_U_mm);

/// The same for a program: one line of JSON, schema trueaxis.watch/1.
std::string live_json_line(const LiveState& state, std::optional<double> wanted_U_mm);

/// The part slipped, or the probe is deaf; empty: neither.
std::string live_alarm(const LiveState& state);

/// The U that was asked for is reached.
bool is_enough(const LiveState& state, std::optional<double> wanted_U_mm);

}  // namespace trueaxis
