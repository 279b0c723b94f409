// SPDX-License-Identifier: Apache-2.0
#include "effect/entries.hpp"

namespace trueaxis::entries {

std::vector<Effect> probe_geometry() {
  return {
      {.id = "probe.height",
       .title = "the probe line passes the spindle axis by",
       .slot = Slot::probe_line,
       .frame = Frame::machine,
       .term = ProbeLine{ProbeLine::Of::height},
       .formula = "line Y = h, intersected exactly: phase asin(h/R), mean -h^2/(2R)",
       .parameters = {{"height", "mm", 0.05, 1, "h: probe minus tool"}},
       .signature = "the phase turns by asin(h/R), the radius shrinks by h^2/(2R)",
       .confounders = {"encoder.offset", "probe.latency"},
       .absorbed_by = "direction of x0, y0, l, m; radius",
       .separations = {{"RE", "from the rear the phase turns the other way"}},
       .axis_bias = AxisBias{0.005, "mm/mm", "5 um per mm"},
       .source = "exact intersection of a line at Y = h with the surface"},
      {.id = "probe.tilt",
       .title = "the probe line is tilted in X-Z",
       .slot = Slot::probe_line,
       .frame = Frame::machine,
       .term = ProbeLine{ProbeLine::Of::tilt},
       .formula = "line along (cos gamma, 0, sin gamma): gain sec gamma and a shear X sin gamma "
                  "in Z",
       .parameters = {{"tilt", "rad", 1e-4, 2e-3, "gamma"}},
       .signature = "gain sec gamma, Z moved by X sin gamma",
       .confounders = {"slide.xz_parallelism", "part.taper", "probe.gain"},
       .absorbed_by = "half angle, radius",
       .separations = {{"RE", "from the rear, with two radii, the shear has the opposite sign"},
                       {"MS", "a master of known angle and radius shows it"}},
       .source = "exact intersection of a tilted line with the surface"},
      {.id = "probe.ball_radius",
       .title = "a ball radius that nobody took off",
       .slot = Slot::probe_line,
       .frame = Frame::probe,
       .term = ProbeLine{ProbeLine::Of::ball},
       .formula = "r0 -> r0 + r_b/cos alpha, exactly (a bore: minus)",
       .parameters = {{"radius", "mm", 1e-3, 3, "r_b"}},
       .signature = "none but a larger radius",
       .confounders = {"probe.pretravel"},
       .absorbed_by = "radius",
       .separations = {{"MS", "a master of known radius shows it"}},
       .axis_bias = AxisBias{0.0, "mm/mm", "nothing"},
       .source = "parallel surface of a cone"},
      {.id = "probe.pretravel",
       .title = "trigger path of a switching probe",
       .slot = Slot::sensor,
       .frame = Frame::probe,
       .term = Response{Response::Of::pretravel},
       .formula = "X + (a + b sin i cos(n psi - phi)) into the material; i, psi: angle of the "
                  "normal to X and its direction from Z towards Y",
       .parameters = {{"amplitude", "mm", 1e-3, 0.01, "a, common to all directions"},
                      {"lobing", "mm", 1e-3, 0.01, "b, of the directions"},
                      {"order", "1", 3, 3, "n: three seats"},
                      {"phase", "rad", 0, 0, "phi"}},
       .signature = "constant when all contacts are approached alike",
       .confounders = {"probe.ball_radius"},
       .absorbed_by = "radius",
       .separations = {{"MS", "a master of known radius shows it"}},
       .source = "trigger path of a switching probe; two approach speeds split it too"},
  };
}

}  // namespace trueaxis::entries
