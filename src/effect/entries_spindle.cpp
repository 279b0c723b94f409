// SPDX-License-Identifier: Apache-2.0
#include "effect/entries.hpp"

namespace trueaxis::entries {

using Angle = Harmonic::Angle;
using Envelope = Harmonic::Envelope;

std::vector<Effect> spindle() {
  return {
      {.id = "spindle.radial_synchronous",
       .title = "synchronous radial error motion of the spindle",
       .slot = Slot::machine,
       .frame = Frame::spindle,
       .term = Harmonic{Angle::spindle, Envelope::constant, Port::x},
       .formula = "X + sum over n >= 2 of a cos(n C - phi)",
       .parameters = {{"amplitude", "mm", 1e-4, 0.01, "a"},
                      {"order", "1", 2, 12, "n"},
                      {"phase", "rad", 0, 0, "phi"}},
       .signature = "n undulations per revolution in the spindle's frame, constant in Z",
       .confounders = {"part.roundness", "part.chuck_lobing", "spindle.tilt_synchronous",
                       "spindle.axial_synchronous", "encoder.eccentricity", "probe.nonlinearity",
                       "environment.vibration"},
       .separations = {{"RC", "re-indexed, the motion stays with C and roundness turns"}},
       .source = "ISO 230-7 (synchronous radial error motion)"},
      {.id = "spindle.tilt_synchronous",
       .title = "synchronous tilt error motion of the spindle",
       .slot = Slot::machine,
       .frame = Frame::spindle,
       .term = Harmonic{Angle::spindle, Envelope::lever, Port::x},
       .formula = "X + a cos(n C - phi) (Z - Z_bearing)",
       .parameters = {{"amplitude", "rad", 1e-6, 5e-5, "a; more on worn machines"},
                      {"order", "1", 1, 12, "n"},
                      {"bearing", "mm", -500, 0, "Z_bearing"},
                      {"phase", "rad", 0, 0, "phi"}},
       .signature = "n undulations per revolution that grow with Z; with a far bearing it looks "
                    "constant",
       .confounders = {"part.roundness", "spindle.radial_synchronous", "part.bow"},
       .absorbed_by = "the axis direction, for n = 1",
       .separations = {{"RC", "re-indexed, the motion stays with C"},
                       {"OZ", "its lever is the distance from the bearing, not from the part"}},
       .source = "ISO 230-7 (tilt error motion)"},
      {.id = "spindle.axial_synchronous",
       .title = "synchronous axial error motion of the spindle",
       .slot = Slot::arguments,
       .frame = Frame::spindle,
       .term = Harmonic{Angle::spindle, Envelope::constant, Port::z},
       .formula = "Z' = Z + a cos(n C - phi): X changes by tan alpha times it",
       .parameters = {{"amplitude", "mm", 1e-3, 0.015, "a"},
                      {"order", "1", 1, 12, "n"},
                      {"phase", "rad", 0, 0, "phi"}},
       .signature = "proportional to tan alpha: none on a cylinder",
       .confounders = {"part.roundness", "spindle.radial_synchronous"},
       .absorbed_by = "the axis point, for n = 1 on a cone",
       .separations = {{"RC", "re-indexed, the motion stays with C"},
                       {"MS", "a master cylinder does not show it, a face shows it in full"}},
       .source = "ISO 230-7 (axial error motion)"},
      {.id = "spindle.asynchronous",
       .title = "asynchronous error motion, as of a bearing's cage",
       .slot = Slot::machine,
       .frame = Frame::spindle,
       .term = Harmonic{Angle::spindle, Envelope::constant, Port::x},
       .formula = "X + a cos(kappa C + phi), kappa no whole number (0.40-0.45 for a cage)",
       .parameters = {{"amplitude", "mm", 5e-4, 5e-3, "a"},
                      {"order", "1", 0.35, 15, "kappa"},
                      {"phase", "rad", 0, 0, "phi"}},
       .signature = "a fractional order that stays the same at another speed",
       .confounders = {"environment.vibration", "part.waviness", "slide.leadscrew_periodic",
                       "part.feed_marks"},
       .separations = {{"2W", "the order stays at another speed, a vibration keeps its Hz"},
                       {"RZ", "on the way back a form's order changes its sign"}},
       .source = "ISO 230-7 (asynchronous error motion)"},
  };
}

}  // namespace trueaxis::entries
