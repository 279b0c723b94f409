// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "form/section_model.hpp"
#include "form/surface_model.hpp"

namespace trueaxis::form {

/// A part, or its datum: sections, each by itself or read off one surface.
struct PartModel {
  std::vector<SectionModel> sections;
  std::optional<SurfaceModel> surface{};
};

/// Filtered profiles of all sections of the part, and of those of its datum.
struct Profiles {
  std::vector<std::vector<double>> part_mm, datum_mm;
};

using Assess = std::function<std::vector<NamedValue>(const Profiles& profiles)>;

/// Root mean square of what the trials of a Monte Carlo (JCGM 101) are off, and its mean.
struct Spread {
  double u, bias;
  double bound = 0.0;  ///< 95 % of the trials in which it is not 0 are below
};

/// For every value that `assess` gives, by readings with noise, with the uncertainty of a spindle's
/// motion, and with what the ball may hide. The profile that noise is added to is the measured one,
/// less the part of its variance that is noise already (Eqs. 271, 272). The trials of a surface are
/// its draws. The same numbers on any number of threads.
std::vector<Spread> spreads(const PartModel& part, const PartModel& datum,
                            const FormOptions& options, const Assess& assess);

/// What a ball has touched where its centre runs along a trace: the trace eroded by the ball's
/// parabola. Eq. 269. @param radius_mm of the section, @param ball_mm of the ball
std::vector<double> touched_by_ball(const Trace& trace, std::span<const double> centre_mm,
                                    double radius_mm, double ball_mm, bool bore);

/// The values after one u of an amplitude more.
using Changed = std::function<std::vector<NamedValue>(const TakenOff& one, std::size_t column)>;

/// Adds to u the uncertainty of the amplitudes that were subtracted; Eq. 291.
/// @param values without any change
void add_taken_off(std::span<const TakenOff> taken_off, const std::vector<NamedValue>& values,
                   std::vector<Spread>& spread, const Changed& changed);

/// Readings with one u more of an amplitude.
std::vector<double> added(std::span<const double> reading_mm, const TakenOff& one,
                          std::size_t column);

}  // namespace trueaxis::form
