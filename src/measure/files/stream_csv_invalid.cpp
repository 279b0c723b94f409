// SPDX-License-Identifier: Apache-2.0
#include "measure/files/stream_csv_invalid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <span>

#include "base/counted.hpp"
#include "base/text.hpp"
#include "format/csv_text.hpp"
#include "format/shell.hpp"

namespace trueaxis {

bool csv_is_no_value(std::string_view field) {
  std::string small = lower_case(field);
  if (small.starts_with('-') || small.starts_with('+')) small.erase(0, 1);
  return small.starts_with("nan") || small.find('#') != std::string::npos ||
         small.find_first_of("0123456789") == std::string::npos;
}

bool csv_is_row_of_no_value(const std::vector<std::string_view>& fields, std::size_t columns) {
  if (columns < 2 || fields.size() != columns || fields.front().size() < 3) return false;
  return std::ranges::all_of(fields.front().substr(1), [](char c) {
    return std::isupper(static_cast<unsigned char>(c)) != 0 || c == '/' || c == '!' || c == '0' ||
           c == '?';
  });
}

void CsvInvalidRows::add(std::size_t line, std::string_view field) {
  lines_.push_back(line);
  const std::string what = field.empty() ? "empty" : csv_quoted(field);
  if (std::ranges::find(what_, what) == what_.end()) what_.push_back(what);
}

std::string CsvInvalidRows::left_out(const std::function<std::size_t(std::size_t)>& line_of) const {
  constexpr std::size_t most = 6;
  std::vector<std::size_t> lines = lines_;
  if (line_of) std::ranges::transform(lines, lines.begin(), line_of);
  const std::string what = word_list(std::span(what_).first(std::min(most, what_.size())));
  return fmt::format("{} excluded (--drop-invalid), in line{} {}: {}{}",
                     counted(lines.size(), "row is", "rows are"), lines.size() == 1 ? "" : "s",
                     ranges_text(lines), what, what_.size() > most ? " …" : "");
}

std::string CsvInvalidRows::remedy(const std::string& file, const StreamReadOptions& options,
                                   const std::vector<std::string>& words, std::size_t good) const {
  if (!any() || !csv_too_many_invalid(count(), good).empty()) return "";
  const std::string rows = counted(count(), "row has", "rows have");
  const char* const them = count() == 1 ? "it" : "them";
  if (file.empty()) return fmt::format("{} no value: --drop-invalid excludes {}", rows, them);
  std::vector<std::string> line = options.typed;
  const bool none = line.empty();
  if (none) line = {"trueaxis", "import", file};
  for (const std::string& word : words) line.push_back(word);
  for (const std::string& word : words_of(options)) line.push_back(word);
  line.emplace_back("--drop-invalid");
  if (none) {
    line.emplace_back("-o");
    line.push_back((file == "-" ? "my" : std::filesystem::path(file).stem().string()) +
                   "_clean.csv");
  }
  const char* const again = file == "-" ? ", with the data sent again" : "";
  return fmt::format("{} no value: the command that excludes {}{}: {}", rows, them, again,
                     shell_line(line));
}

std::string csv_too_many_invalid(std::size_t invalid, std::size_t good) {
  if (invalid < good) return "";
  return fmt::format("{} no value and {}: too many to exclude them; look for the reason",
                     counted(invalid, "row has", "rows have"),
                     counted(good, "other has one", "others have one"));
}

std::vector<std::string> words_of(const StreamReadOptions& options) {
  std::vector<std::string> words;
  if (options.diameter) words.emplace_back(*options.diameter ? "--diameter" : "--radius");
  if (options.indication == Indication::relative) words.emplace_back("--relative");
  if (options.nominal_radius_mm) {
    words.emplace_back("--nominal-radius-mm");
    words.push_back(fmt::format("{}", *options.nominal_radius_mm));
  }
  return words;
}

}  // namespace trueaxis
