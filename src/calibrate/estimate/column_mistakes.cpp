// SPDX-License-Identifier: Apache-2.0
#include "calibrate/estimate/column_mistakes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace trueaxis::calibrate_detail {
namespace {

std::string d(std::size_t i) { return std::string("d") + "XYZ"[i]; }

Mistake exchanged_axes(AxisName a, AxisName b) {
  const std::string both = std::string(1, letter_of(a)) + " and " + std::string(1, letter_of(b));
  return {"the columns " + both + " are exchanged", "exchange them", [=](MachineMeasurement& file) {
            for (AxisPositions& at : file.axes) std::swap(at[index_of(a)], at[index_of(b)]);
          }};
}

Mistake scaled_axis(AxisName axis, double factor, const std::string& what,
                    const std::string& mend) {
  const std::string letter(1, letter_of(axis));
  return {fmt::format(fmt::runtime(what), letter), fmt::format(fmt::runtime(mend), letter),
          [=](MachineMeasurement& file) {
            for (AxisPositions& at : file.axes) at[index_of(axis)] *= factor;
          }};
}

/// Deviations in another unit than their header says.
Mistake scaled_deviations(double factor, const std::string& is, const std::string& said) {
  return {"the deviations are in " + is + " and the header says " + said,
          "write [" + is + "] after their names",
          [=](MachineMeasurement& file) {
            for (Vector3& one : file.deviation_mm)
              for (double& size : one) size *= factor;
          },
          std::min(1.0, factor)};
}

void add_deviations(std::vector<Mistake>& list) {
  list.push_back(scaled_deviations(1.0 / mm_per_um, "mm", "um"));
  list.push_back(scaled_deviations(mm_per_um, "um", "mm"));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i + 1; j < 3; ++j)
      list.push_back({"the columns " + d(i) + " and " + d(j) + " are exchanged", "exchange them",
                      [=](MachineMeasurement& file) {
                        for (Vector3& one : file.deviation_mm) std::swap(one[i], one[j]);
                      }});
  for (std::size_t i = 0; i < 3; ++i)
    list.push_back({"the column " + d(i) + " has the wrong sign",
                    "it is ball's centre - tip: turn its sign", [=](MachineMeasurement& file) {
                      for (Vector3& one : file.deviation_mm) one[i] = -one[i];
                    }});
  list.push_back({"dX, dY and dZ have the wrong sign",
                  "they are ball's centre - tip: turn their signs", [](MachineMeasurement& file) {
                    for (Vector3& one : file.deviation_mm)
                      for (double& size : one) size = -size;
                  }});
}

}  // namespace

std::vector<Mistake> column_mistakes(const Machine& machine,
                                     std::span<const MachineMeasurement> data) {
  std::vector<Mistake> list;
  const bool deviations = std::ranges::any_of(
      data, [](const MachineMeasurement& file) { return !file.deviation_mm.empty(); });
  if (deviations) add_deviations(list);
  const auto& axes = machine.axes;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    for (std::size_t j = i + 1; j < axes.size(); ++j)
      if (is_rotary(axes[i].name) == is_rotary(axes[j].name))
        list.push_back(exchanged_axes(axes[i].name, axes[j].name));
    list.push_back(scaled_axis(axes[i].name, -1.0, "the column {} runs the other way",
                               "turn its sign, or axes.{}.direction of the machine"));
    if (!is_rotary(axes[i].name)) {
      list.push_back(
          scaled_axis(axes[i].name, mm_per_inch, "the column {} is in inch", "write {}[in]"));
      list.push_back(
          scaled_axis(axes[i].name, 1.0 / mm_per_inch, "the column {} is in mm", "write {}[mm]"));
      continue;
    }
    list.push_back(scaled_axis(axes[i].name, 1.0 / rad_per_deg, "the column {} is in radians",
                               "write {}[rad]"));
    list.push_back(
        scaled_axis(axes[i].name, rad_per_deg, "the column {} is in degrees", "write {}[deg]"));
  }
  for (const bool inch : {true, false})
    list.push_back({std::string("X, Y and Z are in ") + (inch ? "inch" : "mm"),
                    std::string("write [") + (inch ? "in]" : "mm]") + " after their names",
                    [=](MachineMeasurement& file) {
                      for (AxisPositions& at : file.axes)
                        for (std::size_t k = 0; k < 3; ++k)
                          at[k] *= inch ? mm_per_inch : 1.0 / mm_per_inch;
                    }});
  return list;
}

std::vector<double> tool_lengths(const Machine& machine, std::span<const MachineMeasurement> data) {
  std::set<double> stated, all;
  for (const MachineMeasurement& file : data) {
    if (file.kind == MeasurementKind::axis) continue;
    if (file.tool_length_mm.empty()) all.insert(machine.tool.length_mm);
    stated.insert(file.tool_length_mm.begin(), file.tool_length_mm.end());
  }
  all.insert(stated.begin(), stated.end());
  if (all.size() < 2) return {};
  if (stated.size() == 2 && all.size() == 2) stated.erase(stated.begin());
  return {stated.begin(), stated.end()};
}

Mistake longer_tool(double stated_mm, double more_mm) {
  return {fmt::format("the tool of {:.7g} mm is {:.3g} µm {} against the others", stated_mm,
                      std::abs(more_mm) / mm_per_um, more_mm > 0.0 ? "longer" : "shorter"),
          "measure the lengths of both again", [=](MachineMeasurement& file) {
            for (double& length : file.tool_length_mm)
              if (length == stated_mm) length += more_mm;
          }};
}

}  // namespace trueaxis::calibrate_detail
