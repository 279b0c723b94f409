// SPDX-License-Identifier: Apache-2.0
#include "effect/entries.hpp"

namespace trueaxis::entries {

std::vector<Effect> part_profile() {
  return {
      {.id = "part.barrel",
       .title = "barrel or saddle: the generator is curved",
       .slot = Slot::part,
       .frame = Frame::part,
       .term = PolynomialInZ{2, 3, Port::normal},
       .formula = "rho = a P2(u) + b P3(u)",
       .parameters = {{"amplitude", "mm", 2e-3, 0.03, "a"}, {"cubic", "mm", 0, 0.01, "b"}},
       .signature = "no undulation around, even in Z",
       .confounders = {"slide.z_straightness", "thermal.drift", "probe.nonlinearity"},
       .absorbed_by = "radius and half angle, where the length is probed unevenly",
       .separations = {{"RE",
                        "from the rear a barrel has the same sign in radius, a bent guide "
                        "the opposite one"},
                       {"OZ", "the barrel moves with the part"}},
       .axis_bias = AxisBias{0.022, "mm/mm", "P2: 0.022 of the amplitude"},
       .source = "ISO 12180-1 (cylindricity: generatrix)"},
      {.id = "part.taper",
       .title = "taper of a cylinder",
       .slot = Slot::part,
       .frame = Frame::part,
       .term = PolynomialInZ{1, 1, Port::normal},
       .formula = "rho = a u (on a cone it is the angle)",
       .parameters = {{"amplitude", "mm", 1e-3, 0.02, "a: change of radius over half the length"}},
       .signature = "no undulation around, linear in Z",
       .confounders = {"slide.xz_parallelism", "thermal.drift", "probe.tilt"},
       .absorbed_by = "half angle of a cone",
       .separations = {{"RE", "from the rear a taper has the same sign in radius"},
                       {"MS", "a master shows the slide's part"},
                       {"RZ", "a drift goes on, a taper comes back"}},
       .source = "ISO 12180-1 (cylindricity)"},
      {.id = "part.waviness",
       .title = "waviness along the part",
       .slot = Slot::part,
       .frame = Frame::part,
       .term = PeriodicInZ{Port::normal, 0.0},
       .formula = "rho = a cos(2 pi s/lambda + phi)",
       .parameters = {{"amplitude", "mm", 1e-3, 5e-3, "a"},
                      {"wavelength", "mm", 0.5, 20, "lambda"},
                      {"phase", "rad", 0, 0, "phi"}},
       .signature = "a line in the spectrum along Z, no undulation around",
       .confounders = {"slide.leadscrew_periodic", "spindle.asynchronous", "environment.vibration",
                       "part.feed_marks", "probe.cyclic"},
       .separations = {{"OZ",
                        "shifted by lambda/2 the waviness turns its sign, a screw error "
                        "does not"},
                       {"2W", "another speed leaves its wavelength, a vibration's changes"}},
       .axis_bias = AxisBias{0.024, "mm/mm", "0.024 of the amplitude"},
       .source = "ISO 21920-2 (profile, waviness)"},
  };
}

}  // namespace trueaxis::entries
