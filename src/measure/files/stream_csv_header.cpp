// SPDX-License-Identifier: Apache-2.0
#include "measure/files/stream_csv_header.hpp"

#include <algorithm>

#include "base/number.hpp"
#include "base/text.hpp"

namespace trueaxis {
namespace {

/// A name a header may use. Face and lateral streams share all but reading and position.
struct KnownColumn {
  const char* name;
  CsvRole role;
  UnitKind quantity;
  const char* unit;
};

constexpr KnownColumn known_columns[] = {
    {"X_M", CsvRole::reading, UnitKind::length, "mm"},
    {"Z_M", CsvRole::reading, UnitKind::length, "mm"},
    {"C", CsvRole::angle, UnitKind::angle, "deg"},
    {"Z", CsvRole::position, UnitKind::length, "mm"},
    {"X", CsvRole::position, UnitKind::length, "mm"},
    {"t", CsvRole::time, UnitKind::time, "s"},
    {"pass", CsvRole::pass, UnitKind::count, ""},
    {"setup", CsvRole::setup, UnitKind::count, ""},
};

bool same_name(std::string_view a, std::string_view b) { return lower_case(a) == lower_case(b); }

/// 2 of "X_M2"; 0 of any other name.
std::size_t sensor_number(std::string_view name) {
  if (name.size() <= 3 || name.size() > 5 || !same_name(name.substr(0, 3), "X_M")) return 0;
  return whole_number<std::size_t>(name.substr(3)).value_or(0);
}

/// The column of a name that is known and not refused.
std::vector<CsvColumn>::iterator named(CsvHeader& header, std::string_view name) {
  return std::ranges::find_if(header.columns, [&](const CsvColumn& column) {
    return column.role != CsvRole::unknown && column.name == name;
  });
}

class HeaderParser {
 public:
  HeaderParser(std::string_view line, CsvHeader& header, CsvDiagnostics& diagnostics)
      : line_(line), header_(header), diagnostics_(diagnostics) {}

  void column(std::string_view field) {
    CsvColumn column;
    const std::size_t bracket = field.find('[');
    const std::string_view name = trimmed(field.substr(0, bracket));
    column.character = csv_character(line_, field);
    const auto* known = std::ranges::find_if(known_columns, [&](const KnownColumn& candidate) {
      return same_name(candidate.name, name);
    });
    if (field.empty()) {
      add(column, "a column has no name: name it or remove the separator");
    } else if (const std::size_t sensor = sensor_number(name);
               sensor == 0 && known == std::end(known_columns)) {
      add(column,
          "unknown column " + csv_quoted(name) +
              ": remove it or name it one of X_M, C, Z, t, pass, setup (a face: Z_M, C, X)");
    } else {
      const KnownColumn& is = sensor > 0 ? known_columns[0] : *known;
      column.role = sensor > 1 ? CsvRole::more_reading : is.role;
      column.name = sensor > 0 ? "X_M" + std::to_string(sensor) : is.name;
      column.sensor = sensor;
      column.unit = find_unit(is.quantity, is.unit).value_or(Unit{});
      if (twice(column))
        column.role = CsvRole::unknown;
      else if (bracket != std::string_view::npos)
        unit(column, is.quantity, field.substr(bracket + 1));
    }
    header_.columns.push_back(std::move(column));
  }

 private:
  void add(const CsvColumn& column, std::string message) {
    diagnostics_.add(header_.line, column.character, std::move(message));
  }

  bool twice(const CsvColumn& column) {
    const bool found = named(header_, column.name) != header_.columns.end();
    if (found) add(column, "column " + column.name + " is named twice: keep one");
    return found;
  }

  void unit(CsvColumn& column, UnitKind quantity, std::string_view text) {
    if (text.empty() || text.back() != ']') {
      return add(column, "the unit of " + column.name + " has no closing bracket: write " +
                             column.name + "[unit]");
    }
    text = trimmed(text.substr(0, text.size() - 1));
    const std::string_view whole = text;
    const auto drop_word = [&](std::string_view word) {
      if (text.size() <= word.size() || !text.ends_with(word)) return false;
      if (!csv_is_blank(text[text.size() - word.size() - 1])) return false;
      text = trimmed(text.substr(0, text.size() - word.size()));
      return true;
    };
    if (column.name.starts_with('X')) column.diameter = drop_word("dia");
    if (column.role == CsvRole::angle) column.running = drop_word("running");
    if (quantity == UnitKind::count) {
      return add(column, column.name + " is a number without unit: write " + column.name);
    }
    if (const auto found = find_unit(quantity, text)) {
      column.unit = *found;
    } else {
      add(column, "unknown unit " + csv_quoted(whole) + " of " + column.name + ": use " +
                      known_units(quantity));
    }
  }

  std::string_view line_;
  CsvHeader& header_;
  CsvDiagnostics& diagnostics_;
};

/// X_M1, X_M2 …: numbered without a gap, of one unit, and without an X_M or Z_M.
void check_sensors(CsvHeader& header, CsvDiagnostics& diagnostics) {
  const std::size_t sensors = header.sensors();
  const CsvColumn* first = nullptr;
  for (CsvColumn& column : header.columns) {
    const auto refuse = [&](const std::string& message) {
      diagnostics.add(header.line, column.character, message);
      column.role = CsvRole::unknown;
    };
    if (sensors > 0 && (column.name == "X_M" || column.name == "Z_M"))
      refuse(column.name + " together with X_M1: number all sensors of a recording X_M1, X_M2 …" +
             (column.name == "Z_M" ? ", and give an axial sensor a stream of its own" : ""));
    if (column.sensor == 0 || column.role == CsvRole::unknown) continue;
    if (first == nullptr) first = &column;
    if (column.sensor > sensors) {
      refuse(column.name + " is one of " + std::to_string(sensors) +
             " sensors: number them X_M1 to X_M" + std::to_string(sensors));
    } else if (column.unit.factor != first->unit.factor || column.diameter != first->diameter) {
      refuse(column.name + " has another unit than " + first->name +
             ": use one unit for all sensors");
    }
  }
}

/// Columns that are missing, or that belong to the other kind of stream.
void check_kind(CsvHeader& header, CsvDiagnostics& diagnostics) {
  const auto none = header.columns.end();
  const auto lacks = [&](const char* name) { return named(header, name) == none; };
  const bool face = !lacks("Z_M") && lacks("X_M");
  header.kind = face ? StreamKind::face : StreamKind::lateral;
  const auto refuse = [&](const char* name, const char* message) {
    const auto column = named(header, name);
    if (column == none) return;
    diagnostics.add(header.line, column->character, message);
    column->role = CsvRole::unknown;
  };
  if (face) {
    refuse("Z", "Z is the reading of a face (Z_M,C,X): remove column Z");
    if (lacks("X")) diagnostics.add(header.line, 0, "no column X: a face is Z_M,C,X");
  } else {
    refuse("Z_M", "X_M and Z_M in one stream: a face is Z_M,C,X, all else X_M,C,Z");
    refuse("X", "X is a column of a face (Z_M,C,X): name the position Z or remove it");
    if (lacks("X_M") && header.sensors() == 0) {
      diagnostics.add(header.line, 0, "no column X_M: name the columns X_M,C,Z (a face: Z_M,C,X)");
    }
  }
  if (lacks("C")) {
    diagnostics.add(header.line, 0, "no column C: name the spindle angle's column C");
  }
}

}  // namespace

const CsvColumn* CsvHeader::find(CsvRole role) const {
  const auto found = std::ranges::find(columns, role, &CsvColumn::role);
  return found == columns.end() ? nullptr : &*found;
}

std::size_t CsvHeader::sensors() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(columns, [](const CsvColumn& column) { return column.sensor > 0; }));
}

CsvHeader csv_parse_header(std::string_view line, std::size_t line_number,
                           CsvDiagnostics& diagnostics) {
  CsvHeader header;
  header.line = line_number;
  header.separator = csv_separator(trimmed(line));
  const auto fields = csv_fields(line, header.separator);
  if (starts_number(fields.front())) {
    diagnostics.add(line_number, csv_character(line, fields.front()),
                    "the header is missing: name the columns in the first line, such as "
                    "X_M[mm],C[deg],Z[mm]");
    return header;
  }
  HeaderParser parser(line, header, diagnostics);
  for (const std::string_view field : fields) parser.column(field);
  check_sensors(header, diagnostics);
  check_kind(header, diagnostics);
  return header;
}

}  // namespace trueaxis
