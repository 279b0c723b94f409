// SPDX-License-Identifier: Apache-2.0
#include "simulate/files/cut_table_csv.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "format/file.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr std::string_view lateral_header = "rev,Z[mm],C[deg],X_fts[mm],X_command[mm]";
constexpr std::string_view face_header = "rev,X[mm],C[deg],Z_fts[mm],Z_command[mm]";
constexpr std::size_t most_diagnostics = 100;

/// Five finite numbers between commas; or the 1-based column that is wrong.
struct Row {
  std::array<double, 5> values{};
  std::size_t wrong_column = 0;
};

Row parse_row(std::string_view line) {
  Row row;
  const char* at = line.data();
  const char* const end = line.data() + line.size();
  for (std::size_t i = 0; i < row.values.size(); ++i) {
    const auto [stop, error] = std::from_chars(at, end, row.values[i]);
    const bool last = i + 1 == row.values.size();
    const bool closed = last ? stop == end : stop != end && *stop == ',';
    if (error != std::errc{} || !closed || !std::isfinite(row.values[i])) {
      row.wrong_column = static_cast<std::size_t>(at - line.data()) + 1;
      return row;
    }
    at = last ? end : stop + 1;
  }
  return row;
}

/// Running angle next to `before`, in the sense of the cut; a running column stays as it is.
double unwrapped(double c_rad, double before, int sense) {
  const double ahead = std::fmod(sense * (c_rad - before), two_pi);
  constexpr double backwards = -1e-9;  // rounding of equal angles is no turn
  return before + sense * (ahead < backwards ? ahead + two_pi : ahead);
}

class TableParser {
 public:
  TableParser(const std::string& path, int sense) : path_(path), sense_(sense) {}

  void line(std::string_view text, std::size_t number) {
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
    if (text.empty() || text.front() == '#') return;
    if (!header_) {
      header(text, number);
      return;
    }
    const Row row = parse_row(text);
    if (row.wrong_column != 0) {
      complain(number, row.wrong_column, "is no number, or the row has not five columns");
      return;
    }
    append(row);
  }

  virtual_lathe::CutTable take() {
    if (!header_ && diagnostics_.empty())
      complain(0, 0, "has no header line " + text(lateral_header));
    if (header_ && table_.c_rad.size() < 2 && diagnostics_.empty()) {
      complain(0, 0, "has fewer than two rows");
    }
    if (!diagnostics_.empty()) throw InputError(std::move(diagnostics_));
    return std::move(table_);
  }

 private:
  static std::string text(std::string_view view) { return std::string(view); }

  void header(std::string_view line, std::size_t number) {
    header_ = true;
    table_.face = line == face_header;
    if (table_.face || line == lateral_header) return;
    complain(number, 1,
             "is no header of a correction table: write " + text(lateral_header) + " or " +
                 text(face_header));
  }

  void append(const Row& row) {
    const double c = row.values[2] * rad_per_deg;
    table_.revolution.push_back(static_cast<int>(row.values[0]));
    table_.position_mm.push_back(row.values[1]);
    table_.c_rad.push_back(table_.c_rad.empty() ? c : unwrapped(c, table_.c_rad.back(), sense_));
    table_.wanted_mm.push_back(row.values[3]);
    table_.command_mm.push_back(row.values[4]);
  }

  void complain(std::size_t line, std::size_t column, std::string message) {
    if (diagnostics_.size() >= most_diagnostics) return;
    diagnostics_.push_back({path_, line, column, std::move(message)});
  }

  const std::string& path_;
  int sense_;
  bool header_ = false;
  virtual_lathe::CutTable table_;
  std::vector<Diagnostic> diagnostics_;
};

}  // namespace

virtual_lathe::CutTable parse_cut_table(std::string_view content, const std::string& path,
                                        int sense) {
  expects(sense == 1 || sense == -1, "sense of rotation +1 or -1");
  TableParser parser(path, sense);
  std::size_t number = 0;
  while (!content.empty()) {
    const std::size_t end = content.find('\n');
    parser.line(content.substr(0, end), ++number);
    content.remove_prefix(end == std::string_view::npos ? content.size() : end + 1);
  }
  return parser.take();
}

virtual_lathe::CutTable read_cut_table(const std::string& path, int sense) {
  return parse_cut_table(read_file(path), path, sense);
}

}  // namespace trueaxis
