// SPDX-License-Identifier: Apache-2.0
#include "study/sweep/files/sweep_csv.hpp"

#include <cmath>
#include <cstdio>

namespace trueaxis {
namespace {

using namespace study;

/// Ten digits; an empty cell for a number that is not there.
std::string number_text(double value) {
  if (!std::isfinite(value)) return "";
  char text[40];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

/// Quoted where a separator or quote asks for it.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

class Line {
 public:
  void add(const std::string& text) {
    if (!text_.empty()) text_ += ',';
    text_ += text;
  }
  void add(double value) { add(number_text(value)); }
  void add(std::size_t count) { add(std::to_string(count)); }
  std::string end() const { return text_ + '\n'; }

 private:
  std::string text_;
};

void add_axes(const Sweep& sweep, std::size_t cell, Line& line) {
  const Cell at = cell_at(sweep, cell);
  for (std::size_t a = 0; a < sweep.axes.size(); ++a)
    line.add(field(sweep.axes[a].points[at.point[a]].label));
  line.add(to_string(at.method));
}

Line axes_head(const Sweep& sweep) {
  Line head;
  head.add("cell");
  for (const GridAxis& axis : sweep.axes) head.add(field(axis.name));
  head.add("method");
  return head;
}

void add_share(const Share& share, Line& line) {
  for (const double value : {share.value, share.ends_95.low, share.ends_95.high}) line.add(value);
}

}  // namespace

std::string sweep_csv(const Sweep& sweep, const Summary& summary) {
  std::string out = "# schema: trueaxis.sweep/1\n# version: " TRUEAXIS_VERSION "\n# input_hash: " +
                    sweep.input_hash + "\n# seed: " + std::to_string(sweep.seed) + '\n';
  Line head = axes_head(sweep);
  for (const char* column :
       {"readings",  "parameter",  "unit",         "true",          "repeats",   "failures",
        "bias",      "u_bias",     "sd",           "rmse",          "q05",       "q50",
        "q95",       "bound",      "bound_kind",   "ratio",         "ratio_low", "ratio_high",
        "at_bound",  "coverage",   "coverage_low", "coverage_high", "mean_u",    "found",
        "found_low", "found_high", "named",        "named_low",     "named_high"})
    head.add(std::string(column));
  out += head.end();
  for (const Row& row : summary.rows) {
    const CellSummary& cell = summary.cells[row.cell];
    Line line;
    line.add(row.cell);
    add_axes(sweep, row.cell, line);
    line.add(cell.readings);
    line.add(row.quantity);
    line.add(row.unit);
    line.add(row.truth);
    line.add(sweep.repeats);
    line.add(sweep.repeats - row.estimates);
    for (const double value :
         {row.bias, row.u_bias, row.sd, row.rmse, row.q05, row.q50, row.q95, row.bound})
      line.add(value);
    line.add(to_string(cell.bound.kind));
    for (const double value : {row.ratio, row.ratio_95.low, row.ratio_95.high}) line.add(value);
    line.add(std::string(!row.at_bound ? "" : *row.at_bound ? "yes" : "no"));
    add_share(row.coverage, line);
    line.add(row.mean_u);
    add_share(cell.found, line);
    add_share(cell.named, line);
    out += line.end();
  }
  return out;
}

std::string sweep_timing_csv(const Sweep& sweep, const Summary& summary) {
  Line head = axes_head(sweep);
  for (const char* column : {"readings", "repeats", "thread_seconds", "repeats_per_thread_second"})
    head.add(std::string(column));
  std::string out = head.end();
  for (std::size_t cell = 0; cell < summary.cells.size(); ++cell) {
    Line line;
    line.add(cell);
    add_axes(sweep, cell, line);
    line.add(summary.cells[cell].readings);
    line.add(sweep.repeats);
    line.add(summary.cells[cell].seconds);
    line.add(static_cast<double>(sweep.repeats) / summary.cells[cell].seconds);
    out += line.end();
  }
  return out;
}

}  // namespace trueaxis
