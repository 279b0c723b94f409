// SPDX-License-Identifier: Apache-2.0
#include "study/sweep/files/sweep_csv.hpp"

#include <fmt/format.h>

#include <cmath>

namespace trueaxis {
namespace {

using namespace study;

/// A line of fields, quoted where a separator or quote asks for it.
class Line {
 public:
  Line& add(const std::string& text) {
    if (!text_.empty()) text_ += ',';
    if (text.find_first_of(",\"\n\r") == std::string::npos) {
      text_ += text;
      return *this;
    }
    text_ += '"';
    for (const char c : text) text_ += c == '"' ? std::string("\"\"") : std::string(1, c);
    text_ += '"';
    return *this;
  }
  Line& add(std::size_t count) { return add(std::to_string(count)); }
  /// Ten digits; an empty field for a number that is not there.
  template <class... Numbers>
  Line& add_numbers(Numbers... values) {
    (add(std::isfinite(values) ? fmt::format("{:.10g}", values) : ""), ...);
    return *this;
  }
  Line& add(const Share& share) {
    return add_numbers(share.value, share.ends_95.low, share.ends_95.high);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// The cell's number, point and method.
Line cell_fields(const Sweep& sweep, std::size_t cell) {
  const Cell at = cell_at(sweep, cell);
  Line line;
  line.add(cell);
  for (const std::string& label : labels_of(sweep, at)) line.add(label);
  return line.add(to_string(at.method));
}

std::string head(const Sweep& sweep, const char* further) {
  Line line;
  line.add("cell");
  for (const GridAxis& axis : sweep.axes) line.add(axis.name);
  return line.add("method").text() + further;
}

}  // namespace

std::string sweep_csv(const Sweep& sweep, const Summary& summary) {
  std::string out = fmt::format(
      "# schema: trueaxis.sweep/1\n# version: {}\n# input_hash: {}\n# seed: {}\n{}\n",
      TRUEAXIS_VERSION, sweep.input_hash, sweep.seed,
      head(sweep,
           ",readings,parameter,unit,true,repeats,failures,bias,u_bias,sd,rmse,q05,q50,q95,bound,"
           "bound_kind,ratio,ratio_low,ratio_high,at_bound,coverage,coverage_low,coverage_high,"
           "mean_u,found,found_low,found_high,named,named_low,named_high"));
  for (const Row& row : summary.rows) {
    const CellSummary& cell = summary.cells[row.cell];
    Line line = cell_fields(sweep, row.cell);
    line.add(cell.readings).add(row.quantity).add(row.unit).add_numbers(row.truth);
    line.add(sweep.repeats).add(sweep.repeats - row.estimates);
    line.add_numbers(row.bias, row.u_bias, row.sd, row.rmse, row.q05, row.q50, row.q95, row.bound);
    line.add(to_string(cell.bound.kind));
    line.add_numbers(row.ratio, row.ratio_95.low, row.ratio_95.high);
    line.add(!row.at_bound ? "" : *row.at_bound ? "yes" : "no");
    line.add(row.coverage).add_numbers(row.mean_u).add(cell.found).add(cell.named);
    out += line.text() + '\n';
  }
  return out;
}

std::string sweep_timing_csv(const Sweep& sweep, const Summary& summary) {
  std::string out = "# schema: trueaxis.sweep_timing/1\n" +
                    head(sweep, ",readings,repeats,thread_seconds,repeats_per_thread_second") +
                    '\n';
  for (std::size_t cell = 0; cell < summary.cells.size(); ++cell) {
    const double seconds = summary.cells[cell].seconds;
    Line line = cell_fields(sweep, cell);
    line.add(summary.cells[cell].readings).add(sweep.repeats);
    line.add_numbers(seconds, static_cast<double>(sweep.repeats) / seconds);
    out += line.text() + '\n';
  }
  return out;
}

}  // namespace trueaxis
