// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <iterator>
#include <set>

#include "calibrate/files/machine_diagnosis_files.hpp"

namespace trueaxis {

std::string measurement_plan_csv(const MachineDiagnosis& diagnosis, const Machine& machine) {
  const MachinePlan* plan = diagnosis.next();
  if (plan == nullptr) return "";
  std::string text =
      fmt::format("# schema: trueaxis.measurement_plan/1\n# plan {}, {}\n# kind: {}\n", plan->code,
                  plan->what, to_string(plan->kind));
  if (plan->axis) {
    const double unit = is_rotary(*plan->axis) ? rad_per_deg : 1.0;
    const char* const name = is_rotary(*plan->axis) ? "deg" : "mm";
    text += fmt::format(
        "# axis: {}\n# add a column t[s], the time of every reading, where it is known\n"
        "command[{}],actual[{}]\n",
        letter_of(*plan->axis), name, name);
    for (const PlannedVisit& visit : plan->visits)
      text += fmt::format("{:.9g},\n", visit.axes[index_of(*plan->axis)] / unit);
    return text;
  }
  std::set<std::pair<int, int>> placed;
  for (const PlannedVisit& visit : plan->visits) {
    if (!placed.insert({visit.setup, visit.ball}).second) continue;
    const Vector3& c = visit.ball_mm;
    text += fmt::format(
        "# ball {} of set-up {} about {:.3f} {:.3f} {:.3f} mm (on the table, all axes at 0)\n",
        visit.ball, visit.setup, c[0], c[1], c[2]);
  }
  text +=
      "# X Y Z put the tip of the tool on the ball there: shift them with the place of the ball\n";
  text += "# add a column t[s], the time of every reading, where it is known\n";
  const bool bar = plan->kind == MeasurementKind::bar;
  text += "setup,ball";
  for (std::size_t k = 0; k < axis_count; ++k)
    if (machine.find(static_cast<AxisName>(k)) != nullptr)
      text += fmt::format(",{}[{}]", "XYZABC"[k], k < 3 ? "mm" : "deg");
  text += bar ? ",tool_length[mm],L[mm]\n" : ",tool_length[mm],dX[um],dY[um],dZ[um]\n";
  const auto out = std::back_inserter(text);
  for (const PlannedVisit& visit : plan->visits) {
    fmt::format_to(out, "{},{}", visit.setup, visit.ball);
    for (std::size_t k = 0; k < axis_count; ++k)
      if (machine.find(static_cast<AxisName>(k)) != nullptr)
        fmt::format_to(out, ",{:.4f}", visit.axes[k] / (k < 3 ? 1.0 : rad_per_deg) + 0.0);
    fmt::format_to(out, ",{:.9g}{}\n", visit.tool_length_mm, bar ? "," : ",,,");
  }
  return text;
}

}  // namespace trueaxis
