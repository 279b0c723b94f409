// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "job/check.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

/// One way in which the axis of a diagnosed stream is not known, although its fit has one.
struct AxisDoubt {
  const char* id;
  std::span<const Threshold> thresholds;
  std::optional<Reason> (*find)(const ProbeStream&, const Diagnosis&);

  std::optional<Reason> operator()(const ProbeStream& stream, const Diagnosis& diagnosis) const {
    return find(stream, diagnosis);
  }
};

/// All that was found leaves half as much again as the noise that repeats, revolutions or a
/// standing spindle show of it.
extern const AxisDoubt left_unexplained;
extern const AxisDoubt jump_left;

/// The part leaves the wave of two undulations that its own eccentricity makes if the readings have
/// the wrong sign.
extern const AxisDoubt gauge_inverted;

/// All of them: a statement that the readings refute, a long delay of X. Or a slip that is not sure
/// or at an end, a move within a pass by more than U of the axis (Eq. 314). Also an unexplained
/// residual, a pattern or a cause that goes with the eccentricity, and angles so few that lobes
/// look like one.
std::span<const AxisDoubt* const> axis_doubts();

/// No reference has a doubt of its axis.
extern const JobCheck axis_known;

/// The measurement that a diagnosis asks for, as a remedy.
Reason measure(const NextMeasurement& next);

/// The first doubt of a diagnosed stream. Every command asks here.
std::optional<Reason> why_axis_unknown(const ProbeStream& stream, const Diagnosis& diagnosis);

/// The same of a stream without a diagnosis.
std::optional<Reason> few_angles_of(const ProbeStream& stream);
std::optional<Reason> moved_reason(const ProbeStream& stream, std::span<const double> left_mm,
                                   const FitResult& fit);

/// A sensor at the end of its range; a diagnosis leaves those readings out.
std::optional<Reason> sensor_limit_of(const ProbeStream& stream);

/// Takes the numbers of the axis out of a fit, or of all fits of a diagnosis, and leaves those of
/// its shape.
void withhold_axis(FitResult& fit, const std::string& why);
void withhold_axis(Diagnosis& diagnosis, const std::string& why);

// A slip near an end of a stream leaves too few readings next to it to be found. If it is the last
// end, the part is elsewhere now.

/// Outliers gather at an end of a pass.
extern const AxisDoubt left_out_at_an_end;

/// Several of the last eight readings lie farther off than in any other eight, and than their share
/// elsewhere makes once in a thousand streams.
extern const AxisDoubt far_off_at_the_end;

/// The most telling measurement that the diagnoses ask for; none where the part slipped, for it has
/// to be clamped again first.
const NextMeasurement* next_measurement(const JobResult& result);

}  // namespace trueaxis
