// SPDX-License-Identifier: Apache-2.0
#include "recording/import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "format/file.hpp"
#include "format/outputs.hpp"
#include "measure/files/stream_csv_header.hpp"
#include "measure/files/stream_csv_text.hpp"
#include "recording/column_names.hpp"
#include "recording/columns.hpp"
#include "recording/recording.hpp"
#include "recording/stream_rows.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

Recording recognise(const RecordedText& text, const std::string& path, std::size_t skip) {
  for (const auto read : {&read_twincat_scope, &read_camonitor, &read_words}) {
    Recording recording;
    if (skip == 0 && read(text, recording)) return recording;
  }
  Recording recording;
  if (read_table(text, skip, recording)) return recording;
  throw InputError(path, "holds no table of numbers: two rows of two numbers are the least");
}

/// "1 Nr., 2 Angle(°), 3 X": what there is to choose from; of a column without a name its number.
std::string listed(const Recording& recording) {
  std::string text;
  for (std::size_t k = 0; k < recording.columns.size(); ++k) {
    const std::string& whole = recording.columns[k].whole;
    text += (k == 0 ? "" : ", ") + std::to_string(k + 1) + " " +
            (whole.empty() ? csv_quoted(recording.cell(0, k)) + " …" : whole);
  }
  return text;
}

std::string quoted_path(const std::string& path) {
  return path.find_first_of(" '\"()&;$") == std::string::npos ? path : "\"" + path + "\"";
}

[[noreturn]] void refuse(const std::string& path, const Recording& recording,
                         const RecordingOptions& options, std::vector<std::string> unclear,
                         bool convention_said) {
  std::vector<Diagnostic> diagnostics;
  const std::size_t unclear_count = unclear.size();
  for (std::string& why : unclear) diagnostics.push_back({path, 0, 0, std::move(why)});
  diagnostics.push_back(
      {path, 0, 0, "was read as " + recording.producer + " with the columns " + listed(recording)});
  const bool only_convention = !convention_said && unclear_count == 1;
  const std::string columns =
      only_convention && !options.columns.empty() ? options.columns : columns_suggested(recording);
  diagnostics.push_back(
      {path, 0, 0,
       fmt::format("the command that would read it: trueaxis import {} --columns \"{}\"{}{} -o "
                   "{}_stream.csv",
                   quoted_path(path), columns,
                   options.skip > 0 ? fmt::format(" --skip {}", options.skip) : "",
                   convention_said ? "" : " --diameter (or --radius)",
                   std::filesystem::path(path).stem().string())});
  throw InputError(std::move(diagnostics));
}

/// Names for more columns than the names are, or a number that is cut in two.
void expect_named(const Recording& recording, std::vector<std::string>& unclear) {
  const auto named = std::ranges::count_if(
      recording.columns, [](const RecordedColumn& column) { return !column.whole.empty(); });
  if (named == 0 || static_cast<std::size_t>(named) == recording.columns.size()) return;
  const auto nameless = std::ranges::find_if(recording.columns, [](const RecordedColumn& column) {
    return column.whole.empty() && column.is_number;
  });
  if (nameless == recording.columns.end()) return;
  unclear.push_back(
      fmt::format("the rows have {} numbers and the header {} names: where commas are both decimal "
                  "marks and separators, "
                  "export the table with semicolons",
                  recording.columns.size(), named));
}

/// What `# x_convention` of the file says, as a stream of our own has it.
std::optional<bool> convention_in(const std::vector<std::string>& metadata) {
  for (const std::string& line : metadata) {
    if (line.find("x_convention") == std::string::npos) continue;
    if (line.find("diameter") != std::string::npos) return true;
    if (line.find("radius") != std::string::npos) return false;
  }
  return {};
}

/// How the columns were read, said.
void describe(const Recording& recording, const std::vector<TakenColumn>& taken, bool diameter,
              std::vector<std::string>& notes) {
  std::string text, supposed;
  for (const TakenColumn& column : taken) {
    const std::string& whole = recording.columns[column.column].whole;
    text += (text.empty() ? "" : ", ") + std::string(word_of(column.role)) + " = column " +
            std::to_string(column.column + 1) + (whole.empty() ? "" : " (" + whole + ")");
    if (column.role == RecordedRole::x) text += diameter ? ", a diameter" : ", a radius";
    if (!column.unit_said && !column.unit.empty())
      supposed +=
          (supposed.empty() ? "" : ", ") + std::string(word_of(column.role)) + " in " + column.unit;
  }
  notes.insert(notes.begin(), "read as " + recording.producer + ": " + text);
  if (!supposed.empty()) notes.push_back("no unit is said; taken: " + supposed);
  std::string left;
  for (std::size_t k = 0; k < recording.columns.size(); ++k) {
    if (std::ranges::find(taken, k, &TakenColumn::column) != taken.end()) continue;
    const std::string& whole = recording.columns[k].whole;
    left += (left.empty() ? "" : ", ") + (whole.empty() ? std::to_string(k + 1) : whole);
  }
  if (!left.empty()) notes.push_back("columns that are not used: " + left);
}

/// The stream of `text`; what is wrong with it is said at the lines of the file it is made of.
ProbeStream parsed(const std::string& text, std::size_t head, const Recording& recording,
                   const std::string& path, const StreamReadOptions& options) {
  try {
    return read_stream_csv_text(text, path, options);
  } catch (const InputError& error) {
    std::vector<Diagnostic> diagnostics = error.diagnostics();
    for (Diagnostic& diagnostic : diagnostics) {
      const std::size_t row = diagnostic.line > head ? diagnostic.line - head - 1 : 0;
      diagnostic.line = diagnostic.line > head && row < recording.rows() ? recording.lines[row] : 0;
      diagnostic.column = 0;
    }
    throw InputError(std::move(diagnostics));
  }
}

/// Whether the first line that is no comment names columns as a stream of TrueAxis does.
bool is_own_header(const RecordedText& text) {
  for (const std::string_view line : text.lines) {
    const std::string_view content = csv_trimmed(csv_without_comment(line));
    if (content.empty()) continue;
    CsvDiagnostics ignored("", 0);
    const CsvHeader header = csv_parse_header(content, 1, ignored);
    return std::ranges::any_of(header.columns, [](const CsvColumn& column) {
      return column.name.starts_with("X_M") || column.name == "Z_M";
    });
  }
  return true;
}

}  // namespace

ImportedRecording import_recording(const std::string& path, const RecordingOptions& options) {
  const std::string bytes = read_file(path);
  if (bytes.starts_with("PK\x03\x04"))
    throw InputError(path, "is a workbook or another packed file: save its sheet as CSV");
  const RecordedText text(bytes);
  const ColumnsSaid said =
      options.columns.empty() ? ColumnsSaid{} : read_columns_said(options.columns);
  const Recording recording = recognise(text, path, options.skip);
  std::vector<std::string> unclear;
  if (said.items.empty()) {
    unclear = recording.unclear;
    expect_named(recording, unclear);
  }
  std::vector<TakenColumn> taken = take_columns(recording, said, unclear);
  const auto x = std::ranges::find(taken, RecordedRole::x, &TakenColumn::role);
  const bool points = std::ranges::find(taken, RecordedRole::y, &TakenColumn::role) != taken.end();
  std::optional<bool> diameter = x == taken.end() ? std::nullopt : x->diameter;
  if (diameter && options.read.diameter && *diameter != *options.read.diameter)
    unclear.push_back(std::string("X is a ") + (*diameter ? "diameter" : "radius") +
                      " by its name and a " + (*diameter ? "radius" : "diameter") +
                      " for the caller: correct one");
  if (!diameter) diameter = options.read.diameter;
  if (!diameter) diameter = convention_in(recording.metadata);
  if (!diameter && points) diameter = false;
  if (!diameter && x != taken.end())
    unclear.emplace_back(
        "X may be a radius or a diameter, and nothing in the file tells: say --radius or "
        "--diameter");
  if (!unclear.empty()) refuse(path, recording, options, std::move(unclear), diameter.has_value());

  CsvDiagnostics diagnostics(path, options.read.max_diagnostics);
  for (const Diagnostic& wrong : recording.wrong)
    diagnostics.add(wrong.line, wrong.column, wrong.message, "row");
  const StreamRows rows = stream_rows(recording, text, taken, *diameter, diagnostics);
  diagnostics.throw_if_any();

  ImportedRecording out;
  out.producer = recording.producer;
  out.notes = recording.notes;
  out.notes.insert(out.notes.end(), rows.notes.begin(), rows.notes.end());
  describe(recording, taken, *diameter, out.notes);
  out.text = "## schema: trueaxis.stream/1\n";
  for (const std::string& note : out.notes) out.text += "## " + note + "\n";
  const bool convention_stated = std::ranges::any_of(
      recording.metadata,
      [](const std::string& line) { return line.find("x_convention") != std::string::npos; });
  if (!*diameter && !convention_stated) out.text += "# x_convention: radius\n";
  if (options.read.indication == Indication::relative) out.text += "# reading: relative\n";
  if (options.read.nominal_radius_mm)
    out.text += fmt::format("# nominal_radius: {} mm\n", *options.read.nominal_radius_mm);
  for (const std::string& line : recording.metadata)
    if (line.find("schema:") == std::string::npos) out.text += line + "\n";
  out.text += rows.header + "\n";
  const auto head = static_cast<std::size_t>(std::ranges::count(out.text, '\n'));
  for (const std::string& row : rows.rows) out.text += row + "\n";
  StreamReadOptions read = options.read;
  read.diameter.reset();
  out.stream = parsed(out.text, head, recording, path, read);
  out.stream.read_as = out.notes;
  out.stream.input_hash = content_hash(bytes);
  return out;
}

ProbeStream read_recording(const std::string& path, const RecordingOptions& options) {
  if (options.says_anything()) return import_recording(path, options).stream;
  if (path == "-") return read_stream_csv(path, options.read);
  try {
    return read_stream_csv(path, options.read);
  } catch (const InputError&) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) throw;
    const std::string bytes = read_file(path);
    const RecordedText text(bytes);
    Recording table;  // of our own names with decimal commas, as a spreadsheet saves a stream
    const bool commas = read_table(text, 0, table) && table.decimal == ',';
    if (!schema_in(bytes.substr(0, 200)).empty() || (is_own_header(text) && !commas)) throw;
  }
  return import_recording(path, options).stream;
}

}  // namespace trueaxis
