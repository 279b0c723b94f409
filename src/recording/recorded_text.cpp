// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "measure/files/stream_csv_number.hpp"
#include "measure/files/stream_csv_text.hpp"
#include "recording/recording.hpp"

namespace trueaxis {
namespace {

void append_utf8(std::string& out, unsigned code) {
  const auto put = [&](unsigned byte) { out += static_cast<char>(byte); };
  if (code < 0x80U) return put(code);
  if (code < 0x800U) {
    put(0xC0U | (code >> 6U));
  } else {
    if (code < 0x10000U) {
      put(0xE0U | (code >> 12U));
    } else {
      put(0xF0U | (code >> 18U));
      put(0x80U | ((code >> 12U) & 0x3FU));
    }
    put(0x80U | ((code >> 6U) & 0x3FU));
  }
  put(0x80U | (code & 0x3FU));
}

/// UTF-16 behind its byte order mark, as a spreadsheet's "Unicode text" is.
std::string from_utf16(std::string_view bytes, bool little) {
  std::string out;
  const auto unit = [&](std::size_t at) {
    const auto low = static_cast<unsigned char>(bytes[at + (little ? 0 : 1)]);
    const auto high = static_cast<unsigned char>(bytes[at + (little ? 1 : 0)]);
    return static_cast<unsigned>(high) << 8U | low;
  };
  for (std::size_t at = 2; at + 1 < bytes.size(); at += 2) {
    unsigned code = unit(at);
    if (code >= 0xD800U && code < 0xDC00U && at + 3 < bytes.size()) {
      code = 0x10000U + ((code - 0xD800U) << 10U) + (unit(at + 2) - 0xDC00U);
      at += 2;
    }
    append_utf8(out, code);
  }
  return out;
}

}  // namespace

RecordedText::RecordedText(const std::string& bytes) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
    text = from_utf16(bytes, bytes.front() == '\xFF');
  } else {
    text = csv_utf8(bytes);
    if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  }
  const std::string_view all = text;
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t stop = std::min(all.find_first_of("\r\n", at), all.size());
    lines.push_back(all.substr(at, stop - at));
    at = stop + (all.substr(stop).starts_with("\r\n") ? 2 : 1);
  }
}

bool recorded_number(std::string_view cell, char decimal, double& value) {
  if (cell.empty()) return false;
  std::array<char, 64> point;
  if (decimal == ',' && cell.size() <= point.size()) {
    if (cell.find('.') != std::string_view::npos) return false;
    std::ranges::replace_copy(cell, point.begin(), ',', '.');
    cell = {point.data(), cell.size()};
  }
  std::errc error{};
  const char* end = cell.data() + cell.size();
  return csv_number(cell.data(), end, value, error) == end && error == std::errc{} &&
         std::isfinite(value);
}

RecordedColumn recorded_column(std::string_view field) {
  RecordedColumn column;
  field = csv_trimmed(field);
  column.whole = field;
  const auto split_at = [&](std::size_t name_end, std::size_t begin, std::size_t end) {
    column.name = csv_trimmed(field.substr(0, name_end));
    column.unit = csv_trimmed(field.substr(begin, end - begin));
  };
  for (const std::string_view brackets : {"[]", "()"}) {
    const std::size_t open = field.find_last_of(brackets[0]);
    if (open != std::string_view::npos && open > 0 && field.back() == brackets[1]) {
      split_at(open, open + 1, field.size() - 1);
      return column;
    }
  }
  for (const std::string_view between : {" / ", " in ", "/", " "}) {
    const std::size_t at = field.rfind(between);
    if (at == std::string_view::npos || at == 0) continue;
    const std::string_view unit = csv_trimmed(field.substr(at + between.size()));
    constexpr std::string_view plain[] = {"mm",  "um", "µm",  "μm",  "m", "inch",
                                          "deg", "°",  "rad", "rev", "s", "ms"};
    if (std::ranges::find(plain, unit) == std::end(plain)) continue;
    split_at(at, at + between.size(), field.size());
    return column;
  }
  column.name = field;
  return column;
}

}  // namespace trueaxis
