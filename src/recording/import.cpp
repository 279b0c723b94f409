// SPDX-License-Identifier: Apache-2.0
#include "recording/import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <optional>

#include "base/text.hpp"
#include "format/csv_text.hpp"
#include "format/file.hpp"
#include "format/outputs.hpp"
#include "format/shell.hpp"
#include "interchange/number_file.hpp"
#include "measure/files/stream_csv_header.hpp"
#include "recording/column_names.hpp"
#include "recording/columns.hpp"
#include "recording/recording.hpp"
#include "recording/stream_rows.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

/// What is not clear: in sentences, and what the command that would read the file must say for it.
struct Unclear {
  std::vector<std::string> why;
  bool columns = false;                    ///< which column is which
  bool convention = false;                 ///< radius or diameter
  std::optional<bool> diameter_by_file{};  ///< what the file says of that, against the caller
  bool decimal = false;                    ///< a decimal mark that may part thousands as well
};

/// What a recording's own options are as words of a command.
std::vector<std::string> recording_words(const std::string& columns, std::size_t skip) {
  std::vector<std::string> words;
  if (!columns.empty()) words.insert(words.end(), {"--columns", columns});
  if (skip > 0) words.insert(words.end(), {"--skip", std::to_string(skip)});
  return words;
}

/// The columns of `--columns`, and what the file needs, as far as it is clear.
std::string columns_to_say(const Recording& recording, const RecordingOptions& options,
                           const Unclear& unclear) {
  std::string columns =
      unclear.columns || options.columns.empty() ? columns_suggested(recording) : options.columns;
  if (unclear.decimal) columns += recording.decimal == ',' ? ",decimal=comma" : ",decimal=point";
  return columns;
}

/// The command that would read the file: the one that was typed with what is asked.
std::string command_suggested(const std::string& path, const Recording& recording,
                              const RecordingOptions& options, const Unclear& unclear) {
  std::vector<std::string> words = options.read.typed;
  const bool typed = !words.empty();
  if (!typed) words = {"trueaxis", "import", path};
  const auto add = [&](const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
  };
  add(recording_words(columns_to_say(recording, options, unclear), options.skip));
  StreamReadOptions read = options.read;
  if (unclear.convention) read.diameter.reset();
  add(words_of(read));
  const bool either = unclear.convention && !unclear.diameter_by_file && !is_probe_log(recording);
  if (unclear.convention && !either)
    add({unclear.diameter_by_file.value_or(false) ? "--diameter" : "--radius"});
  if (!typed)
    add({"-o", (path == "-" ? "my" : std::filesystem::path(path).stem().string()) + "_stream.csv"});
  if (either) add({"--diameter"});
  return shell_line(words) + (either ? " (or --radius)" : "");
}

/// The same as the lines of a job's [[reference]].
std::string lines_suggested(const Recording& recording, const RecordingOptions& options,
                            const Unclear& unclear) {
  std::string text = "columns = '" + columns_to_say(recording, options, unclear) + "'";
  if (options.skip > 0) text += fmt::format(", skip_lines = {}", options.skip);
  if (unclear.convention)
    text += unclear.diameter_by_file == true ? ", x_convention = \"diameter\""
            : unclear.diameter_by_file == false || is_probe_log(recording)
                ? ", x_convention = \"radius\""
                : ", x_convention = \"diameter\" (or \"radius\")";
  return text;
}

[[noreturn]] void refuse(const std::string& path, const Recording& recording,
                         const RecordingOptions& options, const Unclear& unclear) {
  std::vector<Diagnostic> diagnostics;
  const auto say = [&](std::string what) { diagnostics.push_back({path, 0, 0, std::move(what)}); };
  for (const std::string& why : unclear.why) say(why);
  say("was read as " + recording.producer + " with the columns " + columns_listed(recording));
  if (options.read.diameter_said_by == SaidBy::job)
    say("the lines of its [[reference]] that would read it: " +
        lines_suggested(recording, options, unclear));
  else
    say("the command that would read it: " + command_suggested(path, recording, options, unclear));
  throw InputError(std::move(diagnostics));
}

/// Numbers in columns after the last name: commas that cut numbers in two. A column in front
/// without a name, as pandas writes its index, is another matter.
void expect_named(const Recording& recording, const std::string& path) {
  std::size_t named = recording.columns.size();
  while (named > 0 && recording.columns[named - 1].whole.empty()) --named;
  const auto nameless = std::ranges::find_if(
      recording.columns.begin() + static_cast<std::ptrdiff_t>(named), recording.columns.end(),
      [](const RecordedColumn& column) { return column.is_number; });
  if (named == 0 || nameless == recording.columns.end()) return;
  throw InputError(
      path, fmt::format("the rows have {} numbers and the header {} names: where commas are both "
                        "decimal marks and separators, save the table with semicolons",
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

/// Whether X is a diameter, as its name, a comment of the file or the caller says; a contradiction
/// of the file with itself is thrown, one with the caller is in `unclear`.
std::optional<bool> convention_of(const std::optional<bool>& by_name,
                                  const std::optional<bool>& by_comment, const std::string& path,
                                  const StreamReadOptions& read, Unclear& unclear) {
  const auto word = [](bool diameter) { return diameter ? "a diameter" : "a radius"; };
  if (by_name && by_comment && by_name != by_comment)
    throw InputError(path, fmt::format("X is {} by its name, but {} by the comment x_convention: "
                                       "correct one of them",
                                       word(*by_name), word(*by_comment)));
  const std::optional<bool> by_file = by_name ? by_name : by_comment;
  if (by_file && read.diameter && by_file != read.diameter) {
    unclear.why.push_back(fmt::format(
        "X is {} by {}, but {} says {}: correct one of them", word(*by_file),
        by_name ? "its name" : "the comment x_convention", read.caller(), word(*read.diameter)));
    unclear.convention = true;
    unclear.diameter_by_file = by_file;
  }
  return by_file ? by_file : read.diameter;
}

/// How the columns were read, in words.
void describe(const Recording& recording, const std::vector<TakenColumn>& taken, bool diameter,
              std::vector<std::string>& notes) {
  std::string text, supposed;
  for (const TakenColumn& column : taken) {
    const std::string& whole = recording.columns[column.column].whole;
    add_to_list(text, std::string(word_of(column.role)) + " = column " +
                          std::to_string(column.column + 1) +
                          (whole.empty() ? "" : " (" + whole + ")"));
    if (column.unit_typed && !column.unit.empty()) text += " in " + column.unit;
    if (column.role == RecordedRole::x) text += diameter ? ", a diameter" : ", a radius";
    if (!column.unit_said && !column.unit.empty() && recording.columns[column.column].is_number)
      add_to_list(supposed, std::string(word_of(column.role)) + " in " + column.unit);
  }
  notes.insert(notes.begin(), "read as " + recording.producer + ": " + text);
  if (!supposed.empty()) notes.push_back("the file states no unit; assumed: " + supposed);
  std::string left;
  for (std::size_t k = 0; k < recording.columns.size(); ++k) {
    if (std::ranges::find(taken, k, &TakenColumn::column) != taken.end()) continue;
    const std::string& whole = recording.columns[k].whole;
    add_to_list(left, whole.empty() ? std::to_string(k + 1) : whole);
  }
  if (!left.empty()) notes.push_back("columns that are not used: " + left);
}

template <class Reading>
std::vector<Diagnostic> thrown_by(Reading&& reading) {
  try {
    reading();
  } catch (const InputError& error) {
    return error.diagnostics();
  }
  return {};
}

/// The first bytes of a file that can be read again; "" of any other.
std::string head_of_file(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};
  std::string head(16, '\0');
  head.resize(ByteSource(path).read(head.data(), head.size()));
  return head;
}

/// Whether the first line that is not a comment names columns as a stream of TrueAxis does.
bool is_own_header(const RecordedText& text) {
  for (const std::string_view line : text.lines) {
    const std::string_view content = trimmed(csv_without_comment(line));
    if (content.empty()) continue;
    CsvDiagnostics ignored("", 0);
    const CsvHeader header = csv_parse_header(content, 1, ignored);
    if (std::ranges::any_of(recorded_columns(csv_fields(content, header.separator)),
                            [](const RecordedColumn& column) {
                              return column.unit == "m" && column.whole.ends_with("_m");
                            }))
      return false;  // "X_m" in metres
    return std::ranges::any_of(header.columns, [](const CsvColumn& column) {
      return column.name.starts_with("X_M") || column.name == "Z_M";
    });
  }
  return true;
}

ImportedRecording import_text(const std::string& bytes, const std::string& path,
                              const RecordingOptions& options, bool with_text = false) {
  const bool numbers = is_number_file(bytes);
  if (bytes.starts_with("PK\x03\x04") && !numbers)
    throw InputError(path, "is a workbook or another packed file: save its sheet as CSV");
  if (numbers && options.skip > 0)
    throw InputError(path, "is a binary file, which has no lines to skip: leave out --skip");
  const RecordedText text(numbers ? "" : bytes);
  const ColumnsSaid said =
      options.columns.empty() ? ColumnsSaid{} : read_columns_said(options.columns);
  const Recording recording =
      numbers ? recorded_numbers(path, bytes) : recognise_recording(text, path, options.skip, said);
  Unclear unclear;
  if (said.items.empty()) {
    unclear.why = recording.unclear;
    expect_named(recording, path);
  }
  std::vector<TakenColumn> taken = take_columns(recording, said, unclear.why);
  unclear.columns = !unclear.why.empty();
  const auto x = std::ranges::find(taken, RecordedRole::x, &TakenColumn::role);
  const bool points = std::ranges::find(taken, RecordedRole::y, &TakenColumn::role) != taken.end();
  const TakenColumn none{RecordedRole::x};
  std::optional<bool> diameter =
      convention_of(x == taken.end() ? none.diameter : x->diameter,
                    convention_in(recording.metadata), path, options.read, unclear);
  if (!diameter && points) diameter = false;
  unclear.convention = unclear.convention || !diameter;
  if (!diameter && x != taken.end())
    unclear.why.emplace_back(
        "X may be a radius or a diameter, and nothing in the file tells: say --radius or "
        "--diameter");
  unclear.decimal = recording.in_thousands;
  if (unclear.decimal)
    unclear.why.push_back(
        fmt::format("every {} in its numbers comes before three digits and may separate thousands: "
                    "say how it is meant, or save the numbers without it",
                    recording.decimal == ',' ? "comma" : "point"));
  if (!unclear.why.empty()) refuse(path, recording, options, unclear);

  CsvDiagnostics diagnostics(path, options.read.max_diagnostics);
  for (const Diagnostic& wrong : recording.wrong)
    diagnostics.add(wrong.line, wrong.column, wrong.message, "row");
  csv_refuse_keys_between(recording.keys, recording.rows(), diagnostics);
  const StreamRows rows =
      stream_rows(recording, text, taken, *diameter, options.read.drop_invalid, diagnostics);

  ImportedRecording out;
  out.producer = recording.producer;
  out.notes = recording.notes;
  out.notes.insert(out.notes.end(), rows.notes.begin(), rows.notes.end());
  describe(recording, taken, *diameter, out.notes);
  std::string head = "## schema: trueaxis.stream/1\n";
  for (const std::string& note : out.notes) head += "## " + note + "\n";
  const bool convention_stated = std::ranges::any_of(
      recording.metadata,
      [](const std::string& line) { return line.find("x_convention") != std::string::npos; });
  if (!*diameter && !convention_stated) head += "# x_convention: radius\n";
  if (options.read.indication == Indication::relative) head += "# reading: relative\n";
  if (options.read.nominal_radius_mm)
    head += fmt::format("# nominal_radius: {} mm\n", *options.read.nominal_radius_mm);
  for (const std::string& line : recording.metadata)
    if (line.find("schema:") == std::string::npos) head += line + "\n";
  head += rows.header + "\n";
  const auto head_lines = static_cast<std::size_t>(std::ranges::count(head, '\n'));
  const auto text_of = [&](std::size_t k) { return row_text(recording, rows, k); };
  StreamReadOptions read = options.read;
  read.diameter.reset();
  // Wrong rows are excluded here, so that mistakes between the others are reported too.
  std::vector<Diagnostic> wrong = thrown_by([&] { diagnostics.throw_if_any(); });
  const auto line_of = [&](std::size_t line) {
    const std::size_t row = line - head_lines;
    return line > head_lines && row <= rows.lines.size() ? rows.lines[row - 1] : 0;
  };
  if (wrong.empty() || 2 * rows.rows.size() > recording.rows())
    std::ranges::copy(thrown_by([&] {
                        out.stream =
                            read_stream_rows(head, rows.numbers, text_of, path, read, line_of);
                      }),
                      std::back_inserter(wrong));
  std::ranges::stable_sort(wrong, {}, &Diagnostic::line);
  if (!wrong.empty()) {
    const std::string remedy =
        options.read.drop_invalid
            ? ""
            : rows.invalid.remedy(path, options.read,
                                  recording_words(options.columns, options.skip), rows.rows.size());
    if (!remedy.empty()) wrong.push_back({path, 0, 0, remedy});
    throw InputError(std::move(wrong));
  }
  if (with_text) {
    out.text = std::move(head);
    for (std::size_t k = 0; k < rows.rows.size(); ++k) out.text += text_of(k) + "\n";
  }
  out.stream.read_as = out.notes;
  out.stream.input_hash = content_hash(bytes);
  return out;
}

/// What can be read once only: standard input, a pipe.
bool is_read_once(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  return path == "-" || (std::filesystem::exists(status) && std::filesystem::is_other(status));
}

}  // namespace

ImportedRecording import_recording(const std::string& path, const RecordingOptions& options) {
  return import_text(read_file(path), path, options, true);
}

ProbeStream read_recording(const std::string& path, const RecordingOptions& options) {
  const bool once = is_read_once(path), said = options.says_anything();
  std::string bytes = once || said ? read_file(path) : "";
  if (said) return import_text(bytes, path, options).stream;
  if (may_be_number_file(once ? bytes : head_of_file(path)))
    return import_text(once ? bytes : read_file(path), path, options).stream;
  try {
    return once ? read_stream_csv_text(bytes, path, options.read)
                : read_stream_csv(path, options.read);
  } catch (const InputError&) {
    std::error_code error;
    if (!once && !std::filesystem::is_regular_file(path, error)) throw;
    if (!once) bytes = read_file(path);
    const RecordedText text(bytes);
    Recording table;  // of our own names with decimal commas, as a spreadsheet saves a stream
    const bool commas = read_table(text, 0, {}, table) && table.decimal == ',';
    if (!schema_in(bytes.substr(0, 200)).empty() || (is_own_header(text) && !commas)) throw;
  }
  return import_text(bytes, path, options).stream;
}

Recording recognise_recording(const RecordedText& text, const std::string& path, std::size_t skip,
                              const ColumnsSaid& said) {
  const std::optional<char> decimal = said.decimal;
  const auto camonitor = [&](const RecordedText& of, Recording& out) {
    return read_camonitor(of, said, out);
  };
  using Reader = std::function<bool(const RecordedText&, Recording&)>;
  for (const Reader& read : {Reader(read_probe_log), Reader(read_twincat_scope), Reader(camonitor),
                             Reader(read_words)}) {
    Recording recording;
    if (skip == 0 && !decimal && read(text, recording)) return recording;
  }
  Recording recording;
  if (read_table(text, skip, decimal, recording)) return recording;
  const char* marks = !decimal          ? ""
                      : *decimal == ',' ? " with decimal commas"
                                        : " with decimal points";
  throw InputError(path, std::string("holds no table of numbers") + marks +
                             ": two rows of two numbers are the least");
}

std::string columns_listed(const Recording& recording) {
  std::string text;
  for (std::size_t k = 0; k < recording.columns.size(); ++k) {
    const std::string& whole = recording.columns[k].whole;
    text += (k == 0 ? "" : ", ") + std::to_string(k + 1) + " " +
            (whole.empty() ? csv_quoted(recording.of_numbers ? recording.written(0, k)
                                                             : recording.cell(0, k)) +
                                 " …"
                           : whole);
  }
  return text;
}

}  // namespace trueaxis
