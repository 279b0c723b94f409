// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "base/counted.hpp"
#include "base/number.hpp"
#include "format/csv_text.hpp"
#include "recording/recording.hpp"

namespace trueaxis {
namespace {

using Tokens = std::vector<std::string_view>;

Tokens tokens_of(std::string_view line) {
  Tokens tokens;
  for (std::size_t at = 0; at < line.size();) {
    while (at < line.size() && (csv_is_blank(line[at]) || line[at] == '*')) ++at;
    const std::size_t begin = at;
    while (at < line.size() && !csv_is_blank(line[at]) && line[at] != '*') ++at;
    if (at > begin) tokens.push_back(line.substr(begin, at - begin));
  }
  return tokens;
}

struct LoggedPass {
  std::size_t setup = 1, count = 0, every = 1;
  std::size_t lead = 0;  ///< samples at either end, before and after the spindle has its speed
  std::size_t seen = 0;  ///< rows or samples so far
};

/// What the program says of its rows before they come.
struct Head {
  bool samples = false, started = false, ended = false, diameter = false;
  bool face = false;  ///< read along Z
  std::size_t period_ns = 0;
  std::map<std::size_t, LoggedPass> passes;
};

class LogReader {
 public:
  LogReader(const RecordedText& text, Recording& out) : text_(text), out_(out) {}

  void read(std::size_t first) {
    for (std::size_t i = first; i < text_.lines.size(); ++i) {
      const Tokens tokens = tokens_of(text_.lines[i]);
      if (tokens.empty()) continue;
      const bool good = !head_.started       ? take_head(tokens)
                        : tokens[0] == "END" ? end()
                        : head_.samples      ? take_sample(tokens, i + 1)
                                             : take_touch(text_.lines[i], i + 1);
      if (!good)
        wrong(i + 1,
              "does not belong in the log of a probing program: take the file as the "
              "control wrote it");
    }
    finish();
  }

 private:
  void wrong(std::size_t line, std::string why) {
    out_.wrong.push_back({"", line, 0, std::move(why)});
  }

  bool end() { return !std::exchange(head_.ended, true); }

  bool take_head(const Tokens& tokens) {
    const std::string_view key = tokens[0];
    if (key == "START") return head_.started = true;
    if (tokens.size() == 2 && key == "ROWS") {
      head_.samples = tokens[1] == "SAMPLES";
      return head_.samples || tokens[1] == "TOUCH";
    }
    if (tokens.size() == 2 && key == "UNIT") return tokens[1] == "MM";
    if (tokens.size() == 2 && key == "X") {
      head_.diameter = tokens[1] == "DIAMETER";
      out_.metadata.emplace_back(head_.diameter ? "# x_convention: diameter"
                                                : "# x_convention: radius");
      return head_.diameter || tokens[1] == "RADIUS";
    }
    if (tokens.size() == 3 && key == "BALL" && tokens[1] == "NM") {
      const auto ball = whole_number<std::size_t>(tokens[2]);
      if (ball && *ball > 0)
        out_.metadata.push_back(
            fmt::format("# ball_radius: {} mm", 1e-6 * static_cast<double>(*ball)));
      return ball.has_value();
    }
    if (tokens == Tokens{"FEATURE", "BORE"}) {
      out_.metadata.emplace_back("# feature: bore");
      return true;
    }
    if (tokens == Tokens{"READS", "Z"}) return head_.face = true;
    if (tokens.size() == 3 && key == "PERIOD" && tokens[1] == "NS") {
      const auto period = whole_number<std::size_t>(tokens[2]);
      head_.period_ns = period.value_or(0);
      return head_.period_ns > 0;
    }
    return key == "PASS" && take_pass(tokens);
  }

  bool take_pass(const Tokens& tokens) {
    if (tokens.size() < 7 || tokens[2] != "SETUP") return false;
    const auto pass = whole_number<std::size_t>(tokens[1]);
    const auto setup = whole_number<std::size_t>(tokens[3]);
    const auto number = whole_number<std::size_t>(tokens[6]);
    if (!pass || !setup || !number || *number == 0 || *pass == 0) return false;
    const bool rear = tokens[4] == "REAR", every = tokens[5] == "EVERY";
    if ((!rear && tokens[4] != "FRONT") || (!every && tokens[5] != "COUNT")) return false;
    const std::string side = fmt::format("# setup.{}.side: rear", *setup);
    if (rear && std::ranges::find(out_.metadata, side) == out_.metadata.end())
      out_.metadata.push_back(side);
    LoggedPass one{*setup};
    (every ? one.every : one.count) = *number;
    if (tokens.size() != (every ? 9U : 7U)) return false;
    if (every) {
      const auto lead = whole_number<std::size_t>(tokens[8]);
      if (tokens[7] != "LEAD" || !lead) return false;
      one.lead = *lead;
    }
    return head_.passes.emplace(*pass, one).second;
  }

  void add(std::string_view x, std::string_view c, std::string_view z, std::size_t pass,
           std::size_t line) {
    const auto made = [&](std::string cell) -> std::string_view {
      return out_.made.emplace_back(std::move(cell));
    };
    out_.lines.push_back(line);
    out_.cells.insert(out_.cells.end(), {x, c, z, made(std::to_string(pass)),
                                         made(std::to_string(head_.passes[pass].setup))});
  }

  /// "X   10.0012 C   30.0000 Z  -12.5000 P 1", in any order.
  bool take_touch(std::string_view line, std::size_t number) {
    std::map<char, std::string_view> words;
    for (const RecordedWord& word : recorded_words(line)) words[word.letter] = word.number;
    double pass = 0.0;
    if (words.size() != 4 || !words.contains('X') || !words.contains('C') || !words.contains('Z') ||
        !words.contains('P') || !parse_number(words['P'], pass))
      return false;
    const auto found = head_.passes.find(static_cast<std::size_t>(pass));
    if (pass < 1.0 || found == head_.passes.end()) return false;
    ++found->second.seen;
    add(words['X'], words['C'], words['Z'], found->first, number);
    return true;
  }

  /// A row of halsampler -t: number of the sample, X, C, Z, pass (0: none).
  bool take_sample(const Tokens& tokens, std::size_t line) {
    if (tokens.size() == 1 && tokens[0] == "overrun") return ++overruns_ > 0;
    double pass = 0.0;
    const auto index =
        tokens.size() == 5 ? whole_number<std::size_t>(tokens[0]) : std::optional<std::size_t>();
    // The last row of a sampler that is stopped may be cut off.
    if (!index || !parse_number(tokens[4], pass)) return line == text_.lines.size();
    if (pass == 0.0) return true;
    const auto found = head_.passes.find(static_cast<std::size_t>(pass));
    if (pass < 1.0 || found == head_.passes.end()) return false;
    if (!samples_.empty() && samples_.back().pass != found->first) take_pass_of_samples();
    samples_.push_back({found->first, *index, line, tokens[1], tokens[2], tokens[3]});
    return true;
  }

  /// The samples of a pass while the spindle has its speed.
  void take_pass_of_samples() {
    if (samples_.empty()) return;
    LoggedPass& pass = head_.passes[samples_.front().pass];
    for (std::size_t i = pass.lead; i + pass.lead < samples_.size(); i += pass.every) {
      const Sample& one = samples_[i];
      add(one.x, one.c, one.z, one.pass, one.line);
      const double seconds =
          1e-9 * static_cast<double>(head_.period_ns) * static_cast<double>(one.index);
      out_.cells.push_back(out_.made.emplace_back(fmt::format("{:.9g}", seconds)));
      ++pass.seen;
    }
    samples_.clear();
  }

  void finish() {
    take_pass_of_samples();
    if (!head_.ended)
      wrong(0, "the log ends before its program did: let it run to its end, or measure again");
    for (const auto& [number, pass] : head_.passes) {
      if (head_.samples && pass.seen == 0)
        wrong(0, fmt::format("pass {} has no samples: append the file of halsampler -t to the log "
                             "(cat LOG SAMPLES)",
                             number));
      if (!head_.samples && pass.seen != pass.count)
        wrong(0, fmt::format("pass {} has {} of {}", number, pass.seen,
                             counted(pass.count, "touch point")));
    }
    if (head_.samples && head_.period_ns == 0)
      wrong(0, "the log does not say the PERIOD of samples");
    if (overruns_ > 0)
      out_.notes.push_back(counted(overruns_, "gap") + " in the samples (overrun)");
    const auto column = [&](const char* name, const char* unit) {
      out_.columns.push_back({name, unit, name, true});
    };
    column("X", "mm"), column("C", "deg"), column(head_.face ? "Z_M" : "Z", "mm"),
        column("pass", ""), column("setup", "");
    if (head_.samples) column("t", "s");
    out_.producer = "the log of a probing program of TrueAxis";
  }

  const RecordedText& text_;
  Recording& out_;
  Head head_;
  struct Sample {
    std::size_t pass, index, line;
    std::string_view x, c, z;
  };
  std::vector<Sample> samples_;  ///< of the pass that is read
  std::size_t overruns_ = 0;
};

}  // namespace

bool read_probe_log(const RecordedText& text, Recording& out) {
  for (std::size_t i = 0; i < text.lines.size(); ++i) {
    const Tokens tokens = tokens_of(text.lines[i]);
    if (tokens.empty() || tokens[0] == "%") continue;
    if (tokens != Tokens{"TRUEAXIS", "PROBE", "LOG", "1"}) return false;
    LogReader(text, out).read(i + 1);
    return true;
  }
  return false;
}

}  // namespace trueaxis
