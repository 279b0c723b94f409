// SPDX-License-Identifier: Apache-2.0
#include "recording/stream_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/number.hpp"
#include "format/csv_text.hpp"
#include "format/units.hpp"
#include "recording/column_names.hpp"
#include "recording/recording.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

const TakenColumn* find(const std::vector<TakenColumn>& taken, RecordedRole role) {
  const auto found = std::ranges::find(taken, role, &TakenColumn::role);
  return found == taken.end() ? nullptr : &*found;
}

/// The header of a stream; a face is Z_M, C, X, everything else X_M, C, Z.
std::string header_of(const std::vector<TakenColumn>& taken, bool diameter) {
  const bool face = find(taken, RecordedRole::face) != nullptr;
  std::string header;
  for (const TakenColumn& column : taken) {
    if (column.role == RecordedRole::y) continue;
    if (!header.empty()) header += ',';
    const bool x = column.role == RecordedRole::x;
    header += x ? (face ? "X" : "X_M") : word_of(column.role);
    if (!column.unit.empty()) header += "[" + column.unit + (x && diameter ? " dia]" : "]");
  }
  return header;
}

bool is_instant(const Recording& recording, const TakenColumn& column) {
  return column.role == RecordedRole::t && !recording.columns[column.column].is_number;
}

/// Why a cell is not a number, and what to do.
std::string why_no_number(std::string_view cell, char decimal) {
  double value = 0.0;
  const std::size_t end = cell.find_first_not_of("+-0123456789.,eE");
  if (end == std::string_view::npos && cell.find('.') != std::string_view::npos &&
      (decimal == ',' || cell.find(',') != std::string_view::npos))
    return " is not a number: save numbers without a separator of thousands";
  const bool unit = end != std::string_view::npos &&
                    cell.find_first_of("0123456789", end) == std::string_view::npos;
  if (unit && recorded_number(trimmed(cell.substr(0, end)), decimal, value))
    return " is not a number alone: write its unit into the header";
  return " is not a number: correct it, or remove the row";
}

class RowMaker {
 public:
  RowMaker(const Recording& recording, const RecordedText& text,
           const std::vector<TakenColumn>& taken, bool diameter, bool drop_invalid,
           CsvDiagnostics& diagnostics)
      : recording_(recording),
        text_(text),
        taken_(taken),
        diameter_(diameter),
        drop_invalid_(drop_invalid),
        diagnostics_(diagnostics),
        points_(find(taken, RecordedRole::y) != nullptr) {}

  /// Rows without a value in a cell that is needed.
  const CsvInvalidRows& invalid() const { return invalid_; }
  bool passes_midnight() const { return midnights_ > 0; }

  /// False where a cell is wrong; the numbers of a good row are appended.
  bool row(std::size_t i, std::vector<double>& out) {
    if (const auto field = without_value(i)) {
      invalid_.add(recording_.lines[i], *field);
      if (drop_invalid_) return false;
    }
    double x = 0.0, y = 0.0, c = 0.0;
    bool good = true;
    if (points_) {
      good = number(i, *find(taken_, RecordedRole::x), x) &&
             number(i, *find(taken_, RecordedRole::y), y) &&
             number(i, *find(taken_, RecordedRole::c), c);
      if (good && x == 0.0)
        good = wrong(i, *find(taken_, RecordedRole::x),
                     "X is 0 next to Y, so the point has no side: remove the row", "zero");
    }
    const std::size_t before = out.size();
    for (const TakenColumn& column : taken_) {
      if (column.role == RecordedRole::y) continue;
      double value = 0.0;
      if (points_ && good && column.role == RecordedRole::x) {
        const double scale = diameter_ ? 2.0 : 1.0;
        value = scale * std::copysign(std::hypot(x / scale, y), x);
      } else if (points_ && good && column.role == RecordedRole::c) {
        const double turn = find_unit(UnitKind::angle, column.unit)->turn;
        value = c + std::atan(y / (diameter_ ? 0.5 * x : x)) * turn / two_pi;
      } else {
        good = number(i, column, value) && good;
      }
      out.push_back(value);
    }
    if (!good) out.resize(before);
    return good;
  }

 private:
  /// The first cell that holds no value, where all that are wrong are such.
  std::optional<std::string_view> without_value(std::size_t i) const {
    std::optional<std::string_view> first;
    for (const TakenColumn& column : taken_) {
      double value = 0.0;
      if (is_instant(recording_, column) ? instant_s(recording_.cell(i, column.column)).has_value()
                                         : recording_.number(i, column.column, value))
        continue;
      const std::string_view cell = recording_.cell(i, column.column);
      if (!csv_is_no_value(cell)) return {};
      if (!first) first = cell;
    }
    return first;
  }

  bool number(std::size_t i, const TakenColumn& column, double& value) {
    const std::string_view cell = recording_.cell(i, column.column);
    const std::string name = word_of(column.role);
    if (is_instant(recording_, column)) {
      const auto at_s = instant_s(cell);
      if (!at_s)
        return wrong(i, column,
                     "t: " + csv_quoted(cell) + " is not a time of day: write 13:55:48.325",
                     "instant");
      constexpr double day_s = 86400.0;
      if (first_s_ != first_s_) first_s_ = last_s_ = *at_s;
      double now_s = *at_s + day_s * midnights_;
      if (last_s_ - now_s > 0.5 * day_s && cell.find('-') == std::string_view::npos) {
        ++midnights_;
        now_s += day_s;
      }
      last_s_ = now_s;
      return parse_number(fmt::format("{:.9g}", now_s - first_s_), value);  // as it is written
    }
    if (recording_.number(i, column.column, value)) return true;
    if (cell.empty())
      return wrong(i, column, name + " is empty: write a number or remove the row",
                   name + " empty");
    const std::string what = why_no_number(cell, recording_.decimal);
    return wrong(i, column, name + ": " + csv_quoted(cell) + what, name + what);
  }

  bool wrong(std::size_t i, const TakenColumn& column, std::string message,
             const std::string& kind) {
    const std::size_t line = recording_.lines[i];
    if (recording_.of_numbers) {
      diagnostics_.add(line, column.column + 1, std::move(message), kind);
      return false;
    }
    const std::string_view whole = text_.lines[line - 1];
    const std::string_view cell = recording_.cell(i, column.column);
    const bool inside = cell.data() >= whole.data() && cell.data() <= whole.data() + whole.size();
    const auto byte = inside ? static_cast<std::size_t>(cell.data() - whole.data()) : whole.size();
    diagnostics_.add(line, csv_character(whole, byte), std::move(message), kind);
    return false;
  }

  const Recording& recording_;
  const RecordedText& text_;
  const std::vector<TakenColumn>& taken_;
  bool diameter_, drop_invalid_;
  CsvDiagnostics& diagnostics_;
  bool points_;
  double first_s_ = std::nan(""), last_s_ = 0.0;
  int midnights_ = 0;  ///< that a time of day without a date has passed
  CsvInvalidRows invalid_;
};

/// A column Y that is 0 throughout says nothing.
void drop_y_of_zeros(const Recording& recording, std::vector<TakenColumn>& taken) {
  const TakenColumn* y = find(taken, RecordedRole::y);
  if (y == nullptr) return;
  for (std::size_t i = 0; i < recording.rows(); ++i) {
    double value = 0.0;
    if (!recording.number(i, y->column, value) || value != 0.0) return;
  }
  std::erase_if(taken, [](const TakenColumn& column) { return column.role == RecordedRole::y; });
}

}  // namespace

StreamRows stream_rows(const Recording& recording, const RecordedText& text,
                       std::vector<TakenColumn> taken, bool diameter, bool drop_invalid,
                       CsvDiagnostics& diagnostics) {
  drop_y_of_zeros(recording, taken);
  std::ranges::stable_sort(taken, {}, &TakenColumn::role);
  StreamRows out;
  if (const TakenColumn* y = find(taken, RecordedRole::y)) {
    const TakenColumn* x = find(taken, RecordedRole::x);
    if (x->unit != y->unit) {
      diagnostics.add(0, 0, "X is in " + x->unit + " and Y in " + y->unit + ": give both one unit");
      return out;
    }
    out.notes.emplace_back(
        "X and Y are points: each reading is the distance from the spindle axis, at the angle "
        "C + arctan(Y/X)");
  }
  out.header = header_of(taken, diameter);
  RowMaker maker(recording, text, taken, diameter, drop_invalid, diagnostics);
  for (std::size_t i = 0; i < recording.rows(); ++i) {
    if (!maker.row(i, out.numbers)) continue;
    out.rows.push_back(i);
    out.lines.push_back(recording.lines[i]);
  }
  if (maker.passes_midnight())
    out.notes.emplace_back("the time of day passes midnight: t goes on with the next day");
  out.invalid = maker.invalid();
  if (drop_invalid && out.invalid.any()) {
    out.notes.push_back(out.invalid.left_out());
    if (const std::string many = csv_too_many_invalid(out.invalid.count(), out.rows.size());
        !many.empty())
      diagnostics.add(0, 0, many);
  }
  out.taken = std::move(taken);
  return out;
}

std::string row_text(const Recording& recording, const StreamRows& rows, std::size_t k) {
  const bool points = find(rows.taken, RecordedRole::y) != nullptr;
  std::string text;
  std::size_t at = k * static_cast<std::size_t>(std::ranges::count_if(rows.taken, [](auto& column) {
                     return column.role != RecordedRole::y;
                   }));
  for (const TakenColumn& column : rows.taken) {
    if (column.role == RecordedRole::y) continue;
    if (!text.empty()) text += ',';
    const double value = rows.numbers[at++];
    if (is_instant(recording, column))
      text += fmt::format("{:.9g}", value);
    else if (points && (column.role == RecordedRole::x || column.role == RecordedRole::c))
      append_exact(text, value);
    else
      text += recording.written(rows.rows[k], column.column);
  }
  return text;
}

}  // namespace trueaxis
