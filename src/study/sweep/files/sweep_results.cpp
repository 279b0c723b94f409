// SPDX-License-Identifier: Apache-2.0
#include "study/sweep/files/sweep_results.hpp"

#include <fmt/format.h>

#include <cmath>

#include "format/json.hpp"

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

Json ends_json(const Ends& ends) { return Json::array({number(ends.low), number(ends.high)}); }

Json share_json(const Share& share) {
  return {{"value", number(share.value)}, {"interval_95", ends_json(share.ends_95)}};
}

Json axes_json(const Sweep& sweep) {
  const auto label = [](const AxisPoint& point) { return point.label; };
  return list_of(sweep.axes, [&](const GridAxis& axis) -> Json {
    return {{"name", axis.name}, {"values", list_of(axis.points, label)}};
  });
}

/// In the units inside, which the path names.
Json drawn_json(const Sweep& sweep) {
  static constexpr const char* kinds[] = {"uniform", "normal", "log-uniform"};
  return list_of(sweep.drawn, [](const Drawn& drawn) -> Json {
    const bool normal = drawn.kind == Drawn::Kind::normal;
    return {{"name", drawn.name},
            {"path", drawn.path},
            {"distribution", kinds[static_cast<std::size_t>(drawn.kind)]},
            {normal ? "mean" : "low", drawn.first},
            {normal ? "sd" : "high", drawn.second}};
  });
}

Json row_json(const Row& row) {
  Json json{{"parameter", row.quantity},
            {"unit", row.unit},
            {"true", number(row.truth)},
            {"estimates", row.estimates},
            {"bias", {{"value", number(row.bias)}, {"u", number(row.u_bias)}}},
            {"sd", number(row.sd)},
            {"rmse", number(row.rmse)},
            {"quantiles",
             {{"0.05", number(row.q05)}, {"0.5", number(row.q50)}, {"0.95", number(row.q95)}}},
            {"bound", number(row.bound)},
            {"ratio", {{"value", number(row.ratio)}, {"interval_95", ends_json(row.ratio_95)}}}};
  json["at_bound"] = row.at_bound ? Json(*row.at_bound) : Json(nullptr);
  json["coverage"] = share_json(row.coverage);
  json["mean_u"] = number(row.mean_u);
  return json;
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

std::string sweep_json(const Sweep& sweep, const Summary& summary) {
  Json json{{"schema", "trueaxis.sweep/1"},
            {"version", TRUEAXIS_VERSION},
            {"name", sweep.name},
            {"input_hash", sweep.input_hash},
            {"seed", sweep.seed},
            {"repeats", sweep.repeats},
            {"surface", to_string(fitted_surface(sweep))},
            {"axes", axes_json(sweep)},
            {"drawn", drawn_json(sweep)},
            {"coverage_factor", 2.0},
            {"bonferroni_level", bonferroni_level}};
  json["cells"] = list_of_first(summary.cells.size(), [&](std::size_t cell) {
    const Cell at = cell_at(sweep, cell);
    const CellSummary& of = summary.cells[cell];
    Json point = Json::object();
    const std::vector<std::string> labels = labels_of(sweep, at);
    for (std::size_t a = 0; a < labels.size(); ++a) point[sweep.axes[a].name] = labels[a];
    Json one{{"cell", cell},
             {"at", point},
             {"method", to_string(at.method)},
             {"readings", of.readings},
             {"failures", of.failures}};
    if (!of.why.empty()) one["why"] = of.why;
    one["bound_kind"] = to_string(of.bound.kind);
    if (of.bound.missing != Bound::Missing::nothing)
      one["why_no_bound"] = to_string(of.bound.missing);
    if (at.method == Method::diagnosis) {
      one["found"] = share_json(of.found);
      one["named"] = share_json(of.named);
    }
    one["rows"] = list_of(summary.rows_of(cell), row_json);
    return one;
  });
  return json_text(json);
}

}  // namespace trueaxis
