// SPDX-License-Identifier: Apache-2.0
#include "effect/entries.hpp"

namespace trueaxis::entries {

using Angle = Harmonic::Angle;
using Envelope = Harmonic::Envelope;

std::vector<Effect> part_roundness() {
  return {
      {.id = "part.chuck_lobing",
       .title = "lobes pressed in by the jaws of the chuck",
       .slot = Slot::part,
       .frame = Frame::chuck,
       .term = Harmonic{Angle::chuck, Envelope::jaws, Port::normal},
       .formula = "rho = sum over n = j, 2j of A_n cos n(theta - theta_jaw) exp(-|s - s_jaw|/L), "
                  "A_2j/A_j near ((j^2 - 1)/(4 j^2 - 1))^2",
       .parameters = {{"amplitude", "mm", 1e-3, 0.1, "A_j at the jaws"},
                      {"order", "1", 2, 6, "number of jaws j"},
                      {"jaw_angle", "rad", 0, 0, "theta of a jaw"},
                      {"jaw_position", "mm", 0, 0, "s of the jaws' ends"},
                      {"decay_length", "mm", 10, 200, "L"}},
       .signature = "j and 2j undulations per revolution that decay from the jaws, in phase with "
                    "them",
       .confounders = {"part.roundness", "spindle.radial_synchronous"},
       .separations = {{"RC", "the lobes stay with the jaws when the part is re-indexed"},
                       {"RM", "the lobes shrink with the clamping force"},
                       {"OZ", "the decay starts at the jaws and not at a place of the part"}},
       .axis_bias = AxisBias{0.008, "mm/mm", "three lobes: 0.008 of the amplitude"},
       .source = "thin-ring theory: under j radial forces harmonic n goes as 1/(n^2 - 1)^2"},
      {.id = "part.roundness",
       .title = "roundness of the part: ovality, lobes, and their growth along it",
       .slot = Slot::part,
       .frame = Frame::part,
       .term = Harmonic{Angle::part, Envelope::growing, Port::normal},
       .formula = "rho = (A + B u) cos(n theta - phi), n >= 2; one phase for A and one for B when "
                  "fitted",
       .parameters = {{"amplitude", "mm", 1e-3, 0.02, "A at mid length (a thin tube: 0.2)"},
                      {"growth", "mm", 0, 0.02, "B: change from mid length to the end"},
                      {"order", "1", 2, 12, "n, undulations per revolution"},
                      {"phase", "rad", 0, 0, "phi"}},
       .signature = "n undulations per revolution, fixed to the part",
       .confounders = {"spindle.radial_synchronous", "spindle.tilt_synchronous",
                       "part.chuck_lobing", "spindle.axial_synchronous", "encoder.eccentricity",
                       "probe.nonlinearity"},
       .separations = {{"RC", "the lobes turn with the part, those of the spindle do not"}},
       .axis_bias = AxisBias{0.017, "mm/mm", "ovality: 0.017 of the amplitude; three lobes 0.008"},
       .source = "ISO 12181-1 (roundness, UPR)"},
      {.id = "part.feed_marks",
       .title = "the spiral left by turning",
       .slot = Slot::part,
       .frame = Frame::part,
       .term = PeriodicInZ{Port::normal, 1.0},
       .formula = "rho = a cos(2 pi s/f - theta + phi), a near f^2/(16 r_nose) (height "
                  "f^2/(8 r_nose))",
       .parameters = {{"amplitude", "mm", 1e-4, 5e-3, "a"},
                      {"feed", "mm", 0.05, 0.5, "f, per revolution of the cut"},
                      {"phase", "rad", 0, 0, "phi"}},
       .signature = "a spiral: probed with a lead p it has the order p/f - 1",
       .confounders = {"spindle.asynchronous", "environment.vibration", "part.waviness",
                       "slide.leadscrew_periodic"},
       .absorbed_by = "eccentricity, when the probe's lead is 2f or in a dwell",
       .separations = {{"OZ", "the spiral moves with the part"},
                       {"RC", "the spiral turns with the part"},
                       {"RZ", "on the way back its order is -p/f - 1"}},
       .source = "ISO 21920-2 (surface texture, profile); kinematic roughness f^2/(8 r)"},
      {.id = "part.bow",
       .title = "a bent part",
       .slot = Slot::part,
       .frame = Frame::part,
       .term = Harmonic{Angle::part, Envelope::parabola, Port::normal, 1.0},
       .formula =
           "axis at a u^2 towards phi (kappa s^2 with its vertex at mid length); rho = a u^2 "
           "cos alpha cos(theta - phi)",
       .parameters = {{"amplitude", "mm", 1e-3, 0.05, "a: sagitta over the probed length"},
                      {"phase", "rad", 0, 0, "phi, direction in the part"}},
       .signature = "1 undulation per revolution that grows as the square of Z",
       .confounders = {"part.slip", "spindle.tilt_synchronous"},
       .absorbed_by = "the axis line: 2.8 % of its square is left",
       .separations = {{"OZ", "another length of the part: the sagitta goes as its square"},
                       {"RC", "the direction turns with the part"}},
       .axis_bias = AxisBias{0.76, "mm/mm", "0.76 of the amplitude"},
       .source = "ISO 1101 (straightness of a derived median line)"},
      {.id = "part.slip",
       .title = "the part slipped in the chuck",
       .slot = Slot::part,
       .frame = Frame::time,
       .term = PartStep{},
       .formula = "from t0 on: axis point + (dx, dy), or theta - turn",
       .parameters = {{"dx", "mm", 0.01, 0.2, "step along x of the spindle frame"},
                      {"dy", "mm", 0.01, 0.2, "step along y"},
                      {"turn", "rad", 1e-3, 0.1, "turn in the sense of C"},
                      {"onset", "s", 0, 0, "t0"}},
       .signature = "the vector of 1 undulation per revolution steps at an instant",
       .confounders = {"part.bow", "encoder.offset"},
       .separations = {{"RZ", "probed again, the first part of the length shows the new axis"},
                       {"DW", "a dwell after the slip shows the new vector at one Z"}},
       .axis_bias = AxisBias{0.90, "mm/mm", "radial: 0.90 of the step"},
       .source = "kinematics of a step; a radial and a rotational slip part by a feature with an "
                 "angle mark"},
  };
}

}  // namespace trueaxis::entries
