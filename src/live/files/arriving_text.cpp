// SPDX-License-Identifier: Apache-2.0
#include "live/files/arriving_text.hpp"

#include <utility>

namespace trueaxis {
namespace {

constexpr std::string_view schema_line = "## schema: trueaxis.stream/1\n";
constexpr std::string_view hal_head = "X_M[mm],C[deg],Z[mm]\n";

/// A comment or an empty line, as a head has them before the names of its columns.
bool is_remark(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos || line[first] == '#';
}

/// "1.0 2.0 3.0 " as "1.0,2.0,3.0\n".
std::string with_commas(std::string_view line) {
  std::string out;
  for (const char c : line) {
    const bool blank = c == ' ' || c == '\t' || c == '\r' || c == '\n';
    if (!blank)
      out += c;
    else if (!out.empty() && out.back() != ',')
      out += ',';
  }
  if (!out.empty() && out.back() == ',') out.pop_back();
  return out + '\n';
}

}  // namespace

void ArrivingText::add_line(std::string_view line) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (!has_head_ && head_.empty() && line.starts_with(byte_order_mark))
    line.remove_prefix(byte_order_mark.size());
  if (keeps_ && all_.empty() && !line.starts_with("## schema: ")) all_ = schema_line;
  if (form_ == TextForm::csv) {
    if (!has_head_) {
      has_head_ = !is_remark(line);
      head_ += line;
    } else {
      lines_ += line;
    }
    if (keeps_) all_ += line;
    return;
  }
  if (!has_head_) {
    has_head_ = true;
    head_ = hal_head;
    if (keeps_) all_ += hal_head;
  }
  if (line.starts_with("overrun")) {
    ++lost_;
    return;
  }
  const std::string row = with_commas(line);
  if (row.size() < 2) return;
  lines_ += row;
  if (keeps_) all_ += row;
}

void ArrivingText::add(std::string_view bytes) {
  while (true) {
    const std::size_t end = bytes.find('\n');
    if (end == std::string_view::npos) break;
    rest_ += bytes.substr(0, end + 1);
    add_line(rest_);
    rest_.clear();
    bytes.remove_prefix(end + 1);
  }
  rest_ += bytes;
}

void ArrivingText::forget() {
  keeps_ = false;
  all_ = {};
}

std::optional<ProbeStream> ArrivingText::take(const StreamReadOptions& options) {
  if (lines_.size() == tried_) return {};
  tried_ = lines_.size();
  ProbeStream next = read_stream_csv_text(head_ + lines_, source_, options);
  lines_.clear();
  tried_ = 0;
  return next;
}

}  // namespace trueaxis
