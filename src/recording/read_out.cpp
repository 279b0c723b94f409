// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "base/text.hpp"
#include "format/csv_text.hpp"
#include "format/file.hpp"
#include "format/folded.hpp"
#include "format/shell.hpp"
#include "format/units.hpp"
#include "interchange/number_file.hpp"
#include "recording/columns.hpp"
#include "recording/import.hpp"
#include "recording/recording.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

enum ReadOutRole : std::size_t { role_command, role_actual, role_error, role_position, no_role };
constexpr std::size_t most_listed = 50;

struct Words {
  ReadOutRole role;
  std::string_view words;
};

/// The stronger word of a name counts: "Position deviation" is an error.
constexpr Words role_words[] = {
    {role_error,
     "error errors deviation dev abweichung positionsabweichung fehler positionsfehler écart "
     "erreur errore scostamento desviación erro desvio odchyłka odchylka 偏差 誤差"},
    {role_command,
     "command commanded target nominal setpoint soll sollposition sollwert consigne cible comando "
     "consigna objetivo nominale 指令 目標"},
    {role_actual,
     "actual measured ist istposition istwert messwert gemessen mesuré mesurée réel réelle "
     "misurato misurata reale medido medida real 実測 測定"},
    {role_position, "position pos posizione posición posição poloha pozycja 位置"}};
constexpr std::array<const char*, 4> role_names{"command", "actual", "error", "position"};

ReadOutRole role_of(std::string_view name) {
  std::set<std::string> tokens;
  std::string token;
  for (const char c : folded(name) + " ") {
    const bool letter = static_cast<unsigned char>(c) >= 0x80U || (c >= 'a' && c <= 'z');
    if (letter) token += c;
    if (!letter && !token.empty()) tokens.insert(std::exchange(token, ""));
  }
  for (const Words& line : role_words) {
    std::vector<std::string_view> words;
    csv_split(line.words, ' ', words);
    if (std::ranges::any_of(words, [&](auto word) { return tokens.contains(folded(word)); }))
      return line.role;
  }
  return no_role;
}

/// Which column is which, with its unit as a measurement writes it.
struct Taken {
  std::size_t column = 0;
  std::string unit;
};

class Columns {
 public:
  Columns(const Recording& recording, char axis, const ColumnsSaid& said)
      : recording_(recording), kind_(axis < 'X' ? UnitKind::angle : UnitKind::length) {
    if (said.items.empty())
      by_names();
    else
      as_said(said);
    if (!met_[role_command]) unclear.emplace_back("no column is the commanded position");
    if (!met_[role_actual] && !met_[role_error])
      unclear.emplace_back("no column is the actual position or the error");
    if (taken[role_error]) taken[role_actual].reset();  // the same with fewer digits
  }

  std::array<std::optional<Taken>, 3> taken;
  std::vector<std::string> unclear;

 private:
  void by_names() {
    std::array<std::optional<std::size_t>, 4> found;
    for (std::size_t k = 0; k < recording_.columns.size(); ++k) {
      const ReadOutRole role = role_of(recording_.columns[k].name);
      if (role == no_role) continue;
      if (found[role])
        unclear.push_back(fmt::format("columns {} and {} could both be the {}", *found[role] + 1,
                                      k + 1, role_names[role]));
      found[role] = met_[role] ? std::nullopt : std::optional(k);
      met_[role] = true;
    }
    if (!met_[role_command]) {
      found[role_command] = found[role_position];
      met_[role_command] = met_[role_position];
    }
    for (const ReadOutRole role : {role_command, role_actual, role_error})
      if (found[role]) take(role, *found[role], recording_.columns[*found[role]].unit);
  }

  void as_said(const ColumnsSaid& said) {
    for (const ColumnsSaid::Item& item : said.items) {
      const ReadOutRole role = role_of(item.role);
      if (role == no_role) {
        unclear.push_back("--columns names " + csv_quoted(item.role) +
                          ": an axis takes command, actual, error and decimal");
        continue;
      }
      const auto column = find_column(recording_, item.column);
      if (!column)
        unclear.push_back("there is no column " + csv_quoted(item.column));
      else
        take(role == role_position ? role_command : role, *column,
             item.unit.value_or(recording_.columns[*column].unit));
    }
  }

  void take(ReadOutRole role, std::size_t column, const std::string& unit) {
    const auto known = unit_of_word(unit, "*");
    const bool usable = known && find_unit(kind_, *known);
    met_[role] = true;
    taken[role] = Taken{column, usable ? *known : "…"};
    if (!usable)
      unclear.push_back(fmt::format(
          "column {} ({}) has {}: say its unit in --columns, as in {}={}[{}]", column + 1,
          role_names[role], unit.empty() ? "no unit" : "the unit " + csv_quoted(unit),
          role_names[role], column + 1, kind_ == UnitKind::angle ? "deg" : "mm"));
  }

  const Recording& recording_;
  UnitKind kind_;
  std::array<bool, 4> met_{};  ///< a column of this role is there, clear or not
};

[[noreturn]] void refuse(const std::string& path, const Recording& recording,
                         const Columns& columns, const RecordingOptions& options, UnitKind kind) {
  std::vector<Diagnostic> all;
  for (const std::string& why : columns.unclear) all.push_back({path, 0, 0, why});
  all.push_back(
      {path, 0, 0,
       "was read as " + recording.producer + " with the columns " + columns_listed(recording)});
  std::string say;
  for (const ReadOutRole role : {role_command, role_actual, role_error})
    if (columns.taken[role])
      add_to_list(say, fmt::format("{}={}[{}]", role_names[role], columns.taken[role]->column + 1,
                                   columns.taken[role]->unit));
  std::erase(say, ' ');
  const char* const unit = kind == UnitKind::angle ? "deg" : "mm";
  if (!columns.taken[role_command])
    say += fmt::format("{}command=…[{}]", say.empty() ? "" : ",", unit);
  if (!columns.taken[role_actual] && !columns.taken[role_error])
    say += fmt::format(",error=…[{}]", unit);
  std::vector<std::string> words = options.read.typed;
  words.insert(words.end(), {"--columns", say});
  all.push_back({path, 0, 0, "the command that would read it: " + shell_line(words)});
  throw InputError(std::move(all));
}

}  // namespace

ImportedReadOut import_read_out(const std::string& path, char axis,
                                const RecordingOptions& options) {
  const std::string bytes = read_file(path);
  const bool numbers = is_number_file(bytes);
  const RecordedText text(numbers ? "" : bytes);
  const ColumnsSaid said =
      options.columns.empty() ? ColumnsSaid{} : read_columns_said(options.columns);
  const Recording recording =
      numbers ? recorded_numbers(path, bytes) : recognise_recording(text, path, options.skip, said);
  Columns columns(recording, axis, said);
  if (recording.in_thousands && !said.decimal)
    columns.unclear.emplace_back(
        "every decimal mark is before three digits and may separate thousands: say decimal=point "
        "or decimal=comma in --columns");
  if (!columns.unclear.empty())
    refuse(path, recording, columns, options, axis < 'X' ? UnitKind::angle : UnitKind::length);

  const ReadOutRole second = columns.taken[role_error] ? role_error : role_actual;
  const Taken first = *columns.taken[role_command], other = *columns.taken[second];
  ImportedReadOut out;
  out.notes = recording.notes;
  out.notes.insert(
      out.notes.begin(),
      fmt::format("read as {}: command = column {}, {} = column {}{}", recording.producer,
                  first.column + 1, role_names[second], other.column + 1,
                  second == role_error ? " (actual less commanded position)" : ""));
  out.text = "# schema: trueaxis.measurement/1\n";
  for (const std::string& note : out.notes) out.text += "## " + note + "\n";
  out.text += fmt::format("# kind: axis\n# axis: {}\ncommand[{}],{}[{}]\n", axis, first.unit,
                          role_names[second], other.unit);
  CsvDiagnostics diagnostics(path, most_listed);
  for (const Diagnostic& wrong : recording.wrong)
    diagnostics.add(wrong.line, wrong.column, wrong.message);
  for (std::size_t row = 0; row < recording.rows(); ++row) {
    double ignored = 0.0;
    for (const Taken& one : {first, other})
      if (!recording.number(row, one.column, ignored))
        diagnostics.add(recording.lines[row], 0,
                        csv_quoted(recording.cell(row, one.column)) +
                            " is not a number: correct it, or remove the row");
    out.text +=
        recording.written(row, first.column) + "," + recording.written(row, other.column) + "\n";
    ++out.rows;
  }
  diagnostics.throw_if_any();
  return out;
}

}  // namespace trueaxis
