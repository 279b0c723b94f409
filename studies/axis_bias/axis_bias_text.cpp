// SPDX-License-Identifier: Apache-2.0
#include "studies/axis_bias/axis_bias_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "format/text_layout.hpp"

namespace trueaxis {
namespace {

using namespace study;
using fmt::format;
using layout::padded;

/// µm of axis per natural unit of the effect, from mm per edge unit.
struct Natural {
  const char* unit;
  double factor;
};

Natural natural_of(const AxisBiasCase& of) {
  if (of.effect == "probe.height") return {"um per mm", 1e3};
  if (of.unit == "deg") return {"um per deg", 1e3};
  if (of.unit == "s") return {"um per ms", 1.0};
  if (of.unit == "1") return {"um per %", 10.0};
  return {"um per um", 1.0};
}

struct Cells {
  std::string name, lathe, predicted, stated, unit, extended, cost;
};

std::string figure(double value) {
  if (std::abs(value) < 1e-6) return "0";
  return format("{:.{}g}", value, std::abs(value) < 1e-3 ? 2 : 3);
}

Cells cells_of(const AxisBiasRow& row) {
  const Natural natural = natural_of(row.of);
  Cells cells;
  cells.name = row.of.effect + (row.of.form.empty() ? "" : ", " + row.of.form);
  cells.lathe = figure(row.limit * natural.factor) + (row.agrees ? "" : " !");
  cells.predicted = figure(row.predicted * natural.factor);
  cells.stated = row.of.stated ? figure(*row.of.stated * natural.factor) : "";
  cells.unit = natural.unit;
  cells.extended = row.separable ? figure(row.extended_half * natural.factor) : "absorbed";
  cells.cost = row.separable ? format("{:.3g}", row.u_ratio) : "";
  return cells;
}

std::string cell(double value) { return std::isfinite(value) ? format("{:.9g}", value) : ""; }

}  // namespace

std::string axis_bias_text(const std::vector<AxisBiasRow>& rows) {
  std::string text =
      "Shift of the identified axis, largest over the length, per unit of an effect that the model "
      "lacks\n\n";
  const auto line = [&](const Cells& c) {
    text += padded(c.name, 58) + padded(c.lathe, 10) + padded(c.predicted, 11) +
            padded(c.stated, 11) + padded(c.unit, 12) + padded(c.extended, 11) + c.cost + '\n';
  };
  line({"effect", "lathe", "predicted", "catalogue", "", "with it", "u grows by"});
  std::size_t off = 0;
  for (const AxisBiasRow& row : rows) {
    line(cells_of(row));
    off += !row.agrees;
  }
  text += format("\n{} of {}: lathe and prediction agree within the second order of the size{}\n",
                 rows.size() - off, rows.size(), off > 0 ? " (! do not)" : "");
  return text;
}

std::string axis_bias_markdown(const std::vector<AxisBiasRow>& rows) {
  std::string text =
      "<!-- schema: trueaxis.axis_bias/2 -->\n\n"
      "| effect, form | virtual lathe | predicted | catalogue | unit | left by the surface | with "
      "the effect fitted | u(axis) grows by |\n|---|---|---|---|---|---|---|---|\n";
  for (const AxisBiasRow& row : rows) {
    const Cells c = cells_of(row);
    text += "| `" + row.of.effect + "`" + (row.of.form.empty() ? "" : ", " + row.of.form) + " | " +
            c.lathe + " | " + c.predicted + " | " + c.stated + " | " + c.unit + " | " +
            format("{:.3g} %", 100.0 * row.left) + " | " + c.extended + " | " + c.cost + " |\n";
  }
  return text;
}

std::string axis_bias_csv(const std::vector<AxisBiasRow>& rows) {
  std::string text =
      "# schema: trueaxis.axis_bias/2\n"
      "effect,form,unit,size,lathe,lathe_half,limit,predicted,second_order,off,rounding,agrees,"
      "stated,"
      "left,separable,u_ratio,extended,extended_half\n";
  for (const AxisBiasRow& row : rows) {
    text += row.of.effect + ",\"" + row.of.form + "\"," + axis_bias_unit(row);
    for (const double value : {row.of.size * row.of.edge, row.lathe, row.lathe_half, row.limit,
                               row.predicted, row.second_order, row.off, row.rounding})
      text += ',' + cell(value);
    text += row.agrees ? ",1," : ",0,";
    text += (row.of.stated ? cell(*row.of.stated) : "") + ',' + cell(row.left);
    text += row.separable ? ",1" : ",0";
    for (const double value : {row.u_ratio, row.extended, row.extended_half})
      text += row.separable ? ',' + cell(value) : ",";
    text += '\n';
  }
  return text;
}

std::string axis_bias_unit(const AxisBiasRow& row) {
  return row.of.unit == "1" ? "mm" : "mm/" + row.of.unit;
}

}  // namespace trueaxis
