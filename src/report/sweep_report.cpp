// SPDX-License-Identifier: Apache-2.0
#include "report/sweep_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "base/number.hpp"
#include "report/page.hpp"
#include "study/bound/quantities.hpp"

namespace trueaxis {
namespace {

using namespace study;
using nlohmann::json;

/// The number that a label is, NaN for a word.
double number_of(const std::string& label) {
  double value = 0.0;
  return parse_number(label, value) ? value : std::numeric_limits<double>::quiet_NaN();
}

json axes_data(const Sweep& sweep) {
  json axes = json::array();
  for (const GridAxis& axis : sweep.axes) {
    json labels = json::array(), values = json::array();
    for (const AxisPoint& point : axis.points) {
      labels.push_back(point.label);
      values.push_back(number_of(point.label));
    }
    axes.push_back({{"name", axis.name}, {"labels", labels}, {"values", values}});
  }
  return axes;
}

json drawn_data(const Sweep& sweep) {
  json list = json::array();
  for (const Drawn& drawn : sweep.drawn) list.push_back(drawn.name);
  return list;
}

/// Low end, value, high end; null where there is none.
json share_data(const Share& share) {
  if (!std::isfinite(share.value)) return nullptr;
  return {to_six_digits(share.ends_95.low), to_six_digits(share.value),
          to_six_digits(share.ends_95.high)};
}

json row_data(const Row& row) {
  json data;
  const std::pair<const char*, double> numbers[] = {{"truth", row.truth},
                                                    {"bias", row.bias},
                                                    {"u_bias", row.u_bias},
                                                    {"sd", row.sd},
                                                    {"rmse", row.rmse},
                                                    {"q05", row.q05},
                                                    {"q50", row.q50},
                                                    {"q95", row.q95},
                                                    {"bound", row.bound},
                                                    {"ratio", row.ratio},
                                                    {"ratio_low", row.ratio_95.low},
                                                    {"ratio_high", row.ratio_95.high},
                                                    {"coverage", row.coverage.value},
                                                    {"coverage_low", row.coverage.ends_95.low},
                                                    {"coverage_high", row.coverage.ends_95.high}};
  for (const auto& [name, value] : numbers) data[name] = to_six_digits(value);
  data["estimates"] = row.estimates;
  data["at_bound"] = row.at_bound ? json(*row.at_bound) : json(nullptr);
  return data;
}

json cells_data(const Sweep& sweep, const Summary& summary) {
  json cells = json::array();
  for (std::size_t cell = 0; cell < summary.cells.size(); ++cell) {
    const Cell at = cell_at(sweep, cell);
    const CellSummary& of = summary.cells[cell];
    json rows = json::array();
    for (const Row& row : summary.rows_of(cell)) rows.push_back(row_data(row));
    cells.push_back({{"at", at.point},
                     {"method", to_string(at.method)},
                     {"readings", of.readings},
                     {"failures", of.failures},
                     {"why", of.why},
                     {"why_no_bound", to_string(of.bound.missing)},
                     {"linear", of.bound.kind == Bound::Kind::gauss_markov},
                     {"found", share_data(of.found)},
                     {"named", share_data(of.named)},
                     {"rows", std::move(rows)}});
  }
  return cells;
}

/// The name of the sweep, or what it is.
std::string sweep_title(const Sweep& sweep) { return sweep.name.empty() ? "Sweep" : sweep.name; }

/// Everything the page of a sweep shows (schema trueaxis.sweep_report/1): columns of edge units,
/// one entry a cell; a number that does not exist is NaN, which JSON writes as null.
json sweep_data(const Sweep& sweep, const Summary& summary) {
  json quantity_list = json::array(), methods = json::array();
  for (const Quantity& quantity : compared_quantities(sweep))
    quantity_list.push_back({{"name", quantity.name}, {"unit", quantity.unit}});
  for (const Method method : sweep.methods) methods.push_back(to_string(method));
  return {{"schema", "trueaxis.sweep_report/1"},
          {"version", TRUEAXIS_VERSION},
          {"title", sweep_title(sweep)},
          {"input_hash", sweep.input_hash},
          {"seed", std::to_string(sweep.seed)},
          {"repeats", sweep.repeats},
          {"surface", to_string(fitted_surface(sweep))},
          {"axes", axes_data(sweep)},
          {"drawn", drawn_data(sweep)},
          {"methods", methods},
          {"quantities", quantity_list},
          {"cells", cells_data(sweep, summary)}};
}

}  // namespace

double to_six_digits(double value) {
  parse_number(fmt::format("{:.6g}", value), value);  // what is not finite stays
  return value;
}

std::string render_sweep_report(const study::Sweep& sweep, const study::Summary& summary,
                                const std::vector<SweepReportAddition>& additions) {
  json data = sweep_data(sweep, summary);
  std::string script = "const studies = [];\n";
  for (const SweepReportAddition& addition : additions) {
    data[addition.key] = addition.data;
    script += addition.script;
  }
  script += sweep_script();
  return page_of("TrueAxis sweep: " + sweep_title(sweep),
                 fmt::format("{} cells of {} repeats", summary.cells.size(), sweep.repeats), data,
                 script);
}

}  // namespace trueaxis
