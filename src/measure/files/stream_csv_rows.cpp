// SPDX-License-Identifier: Apache-2.0
#include "measure/files/stream_csv_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "base/number.hpp"
#include "format/csv_text.hpp"

namespace trueaxis {
namespace {

// Numbers stay clear of the ends of the double range, so that no unit takes them out of it.
constexpr double largest = 1e300;

bool fits_int(double value) {
  return value == std::floor(value) && std::abs(value) <= std::numeric_limits<int>::max();
}

/// "12,5" with the comma made a point, where that is a number; else empty.
std::string with_point(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return {};
  std::string point(text);
  point[comma] = '.';
  double value = 0.0;
  std::errc error{};
  const char* end = point.data() + point.size();
  return read_number(point.data(), end, value, error) == end ? point : std::string{};
}

/// A message without what it quotes and counts: the same for every row with the same mistake.
std::string kind_of(std::string_view message) {
  std::string kind;
  bool quoted = false;
  for (const char c : message) {
    if (c == '\'') quoted = !quoted;
    if (!quoted && (c < '0' || c > '9') && c != '.' && c != '-') kind += c;
  }
  return kind;
}

}  // namespace

CsvRows::CsvRows(const CsvHeader& header, ProbeStream& stream, CsvDiagnostics& diagnostics,
                 bool drop_invalid)
    : header_(header),
      diagnostics_(diagnostics),
      row_(header.columns.size()),
      time_at_(header.columns.size()),
      first_time_(std::numeric_limits<double>::infinity()),
      last_time_(-first_time_),
      all_known_(true),
      drop_invalid_(drop_invalid) {
  if (header.sensors() > 1) stream.more_reading_mm.resize(header.sensors() - 1);
  // In the order of the roles.
  std::vector<double>* const numbers[] = {&stream.reading_mm, nullptr, &stream.c_rad,
                                          &stream.position_mm, &stream.time_s};
  for (const CsvColumn& column : header.columns) {
    Target target{nullptr, nullptr, &column};
    if (column.role == CsvRole::more_reading)
      target.numbers = &stream.more_reading_mm[column.sensor - 2];
    else if (column.role < CsvRole::pass)
      target.numbers = numbers[static_cast<std::size_t>(column.role)];
    else if (column.role != CsvRole::unknown)
      target.whole = column.role == CsvRole::pass ? &stream.pass : &stream.setup;
    if (column.role == CsvRole::time) time_at_ = targets_.size();
    if (column.role == CsvRole::unknown) all_known_ = false;
    targets_.push_back(target);
  }
}

void CsvRows::reserve(std::size_t rows) {
  for (const Target& target : targets_) {
    if (target.numbers != nullptr) target.numbers->reserve(rows);
    if (target.whole != nullptr) target.whole->reserve(rows);
  }
}

void CsvRows::append() {
  for (std::size_t k = 0; k < targets_.size(); ++k) {
    if (targets_[k].numbers != nullptr) targets_[k].numbers->push_back(row_[k]);
    if (targets_[k].whole != nullptr) targets_[k].whole->push_back(static_cast<int>(row_[k]));
  }
}

const char* CsvRows::fast_row(const char* p, const char* end) {
  if (!all_known_) return nullptr;
  const char separator = header_.separator;
  const std::size_t count = targets_.size();
  const auto skip_blanks = [&] {
    while (*p == ' ' || (*p == '\t' && separator != '\t')) ++p;
  };
  for (std::size_t k = 0; k < count; ++k) {
    skip_blanks();
    std::errc error{};
    const char* stop = read_number(p, end, row_[k], error);
    if (stop == p || error != std::errc{} || !(std::abs(row_[k]) < largest)) return nullptr;
    if (targets_[k].whole != nullptr && !fits_int(row_[k])) return nullptr;
    p = stop;
    skip_blanks();
    if (k + 1 == count) break;
    if (separator == ' ') {
      if (p == stop) return nullptr;
    } else if (*p++ != separator) {
      return nullptr;
    }
  }
  if (*p == '\r') ++p;
  return *p == '\n' && accept() ? p + 1 : nullptr;
}

bool CsvRows::take(std::span<const double> row) {
  if (!all_known_) return false;
  for (std::size_t k = 0; k < row.size(); ++k) {
    if (!(std::abs(row[k]) < largest)) return false;
    if (targets_[k].whole != nullptr && !fits_int(row[k])) return false;
  }
  row_.assign(row.begin(), row.end());
  return accept();
}

bool CsvRows::take_columns(std::span<const std::span<const double>> columns) {
  if (!all_known_ || columns.size() != targets_.size()) return false;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    bool usual = true;
    for (const double value : columns[k]) usual &= std::abs(value) < largest;  // no NaN is
    if (!usual) return false;
    if (targets_[k].whole != nullptr && !std::ranges::all_of(columns[k], fits_int)) return false;
    if (k == time_at_ && !std::ranges::is_sorted(columns[k])) return false;
  }
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto [first, last] = std::pair(columns[k].begin(), columns[k].end());
    if (targets_[k].numbers != nullptr) targets_[k].numbers->assign(first, last);
    if (targets_[k].whole != nullptr) targets_[k].whole->assign(first, last);
  }
  return true;
}

bool CsvRows::accept() {
  if (time_at_ < row_.size()) {
    if (row_[time_at_] < last_time_) return false;
    time_is(row_[time_at_]);
  }
  append();
  return true;
}

bool CsvRows::field(const Target& target, std::string_view text, double& value,
                    std::string& why) const {
  const std::string& name = target.column->name;
  if (text.empty()) {
    why = name + " is empty: write a number or remove the row";
    return false;
  }
  std::errc error{};
  const char* end = text.data() + text.size();
  const char* stop = read_number(text.data(), end, value, error);
  if (stop != end) {
    const std::string point = with_point(text);
    why = point.empty() ? name + ": " + csv_quoted(text) + " is not a number"
                        : name + ": decimal comma in " + csv_quoted(text) + ": write " + point;
  } else if (error == std::errc::result_out_of_range ||
             (std::isfinite(value) && !(std::abs(value) < largest))) {
    why = name + ": " + csv_quoted(text) + " is out of range: a reading is below 1e300";
  } else if (!std::isfinite(value)) {
    why = name + ": " + csv_quoted(text) + " is not finite: remove the row or measure it again";
  } else if (target.whole != nullptr && !fits_int(value)) {
    why = name + ": " + csv_quoted(text) + " is not a whole number: number them 1, 2, 3";
  } else {
    return true;
  }
  return false;
}

bool CsvRows::begins_pass() const {
  for (std::size_t k = 0; k < targets_.size(); ++k)
    if (targets_[k].column->role == CsvRole::pass)
      return !targets_[k].whole->empty() && row_[k] != targets_[k].whole->back();
  return false;
}

void CsvRows::any_row(std::string_view line, std::size_t line_number) {
  csv_split(line, header_.separator, fields_);
  const std::size_t count = targets_.size();
  if (fields_.size() != count) {
    const bool more = fields_.size() > count;
    const std::string_view where =
        more ? fields_[count] : line.substr(line.find_last_not_of(" \t") + 1);
    diagnostics_.add(line_number, csv_character(line, where),
                     "the row has " + std::to_string(fields_.size()) +
                         " fields, the header names " + std::to_string(count) +
                         (fields_.size() == 2 * count && header_.separator == ','
                              ? ": write decimal points, no decimal commas"
                              : ": write one field per column"),
                     "fields");
    return;
  }
  struct Mistake {
    std::string_view where;
    std::string why;
  };
  std::vector<Mistake> mistakes;
  std::string_view no_value;
  bool no_values_alone = true;
  std::optional<std::size_t> falls;  // the mistake that t falls
  for (std::size_t k = 0; k < count; ++k) {
    if (targets_[k].column->role == CsvRole::unknown) continue;
    std::string why;
    bool fine = field(targets_[k], fields_[k], row_[k], why);
    if (!fine) {
      const bool none = csv_is_no_value(fields_[k]);
      if (none && mistakes.empty()) no_value = fields_[k];
      no_values_alone = no_values_alone && none;
    }
    if (fine && k == time_at_) {
      if (row_[k] < last_time_) {
        fine = no_values_alone = false;
        falls = mistakes.size();
        why = "t falls from " + exact_text(last_time_) + " to " + exact_text(row_[k]) +
              (row_[k] == first_time_ ? ": another recording begins here, so give it its own file"
                                      : ": sort the rows by time");
      }
      time_is(row_[k]);
    }
    if (!fine) mistakes.push_back({fields_[k], std::move(why)});
  }
  if (falls && begins_pass())
    mistakes[*falls].why =
        "t begins anew with a pass: let t go on over all passes, or remove column t";
  if (mistakes.empty()) {
    if (all_known_) append();
    return;
  }
  if (no_values_alone) invalid_.add(diagnostics_.line_of(line_number), no_value);
  if (no_values_alone && drop_invalid_) return;
  for (Mistake& mistake : mistakes) {
    const std::string kind = kind_of(mistake.why);
    diagnostics_.add(line_number, csv_character(line, mistake.where), std::move(mistake.why), kind);
  }
}

bool CsvRows::is_row_of_no_value(std::string_view line) {
  csv_split(line, header_.separator, fields_);
  return csv_is_row_of_no_value(fields_, targets_.size());
}

}  // namespace trueaxis
