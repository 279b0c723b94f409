// SPDX-License-Identifier: Apache-2.0
#include "study/sweep/files/sweep_json.hpp"

#include "format/json.hpp"

namespace trueaxis {
namespace {

using namespace study;

Json ends_json(const Ends& ends) { return Json::array({number(ends.low), number(ends.high)}); }

Json share_json(const Share& share) {
  return {{"value", number(share.value)}, {"interval_95", ends_json(share.ends_95)}};
}

Json axes_json(const Sweep& sweep) {
  Json axes = Json::array();
  for (const GridAxis& axis : sweep.axes) {
    Json labels = Json::array();
    for (const AxisPoint& point : axis.points) labels.push_back(point.label);
    axes.push_back({{"name", axis.name}, {"values", labels}});
  }
  return axes;
}

/// In the units inside, which the path names.
Json drawn_json(const Sweep& sweep) {
  static constexpr const char* kinds[] = {"uniform", "normal", "log-uniform"};
  Json list = Json::array();
  for (const Drawn& drawn : sweep.drawn) {
    const bool normal = drawn.kind == Drawn::Kind::normal;
    list.push_back({{"name", drawn.name},
                    {"path", drawn.path},
                    {"distribution", kinds[static_cast<std::size_t>(drawn.kind)]},
                    {normal ? "mean" : "low", drawn.first},
                    {normal ? "sd" : "high", drawn.second}});
  }
  return list;
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
  Json cells = Json::array();
  for (std::size_t cell = 0; cell < summary.cells.size(); ++cell) {
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
    Json rows = Json::array();
    for (const Row& row : summary.rows_of(cell)) rows.push_back(row_json(row));
    one["rows"] = std::move(rows);
    cells.push_back(std::move(one));
  }
  json["cells"] = std::move(cells);
  return json_text(json);
}

}  // namespace trueaxis
