// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "trueaxis/probe_stream.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {

// Ways in which a column may have been written otherwise than its name says, undone. Each leaves
// the column as it is if it does not look like that.

/// An angle that begins anew after `Period` degrees, made continuous.
template <int Period>
void unwrap_c(ProbeStream& stream) {
  double added = 0.0, before = stream.c_rad.front();
  const double period = Period * rad_per_deg;
  for (double& c : stream.c_rad) {
    const double step = c - before;
    before = c;
    added -= period * std::round(step / period);
    c += added;
  }
}

/// An angle that jumps back by the same amount once per revolution (400 gon, 6400 mils, a counter):
/// that amount is the revolution.
void begin_anew_each_turn(ProbeStream& stream);

/// An angle that runs from 0 up to 180° or 360° and back, as |angle| and arccos do.
void unfold_c(ProbeStream& stream);

/// A reading that jumps by its whole range: a dial or a counter.
void unwrap_reading(ProbeStream& stream);

/// C scaled so that the largest wave of the readings has one undulation per revolution; waves of a
/// whole number are lobes.
void turn_as_reading_does(ProbeStream& stream);

}  // namespace trueaxis
