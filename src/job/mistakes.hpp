// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "job/check.hpp"
#include "trueaxis/fit.hpp"
#include "trueaxis/job.hpp"
#include "trueaxis/probe_stream.hpp"
#include "trueaxis/reason.hpp"

namespace trueaxis {

/// The axis of a reference as it is compared with the others.
struct HeldAxis {
  AxisEstimate estimate;
  double z_mid_mm = 0.0;  ///< middle of the probed length
  bool plane = false;     ///< only its direction counts
  bool diameter = false;  ///< X was read as a diameter
};

/// A number that a mistake leaves open, by what it does to an axis.
enum class OpenNumber { c_zero, z_zero };
struct OpenMistake {
  std::size_t reference = 0;
  OpenNumber number = OpenNumber::c_zero;
  double value = 0.0;  ///< rad or mm
};

HeldAxis held_axis(const FitResult& fit);

/// How far two axes are apart half-way between their lengths, and how probable that is (Eq. 131).
Disagreement difference_of(const HeldAxis& first, const HeldAxis& second, double coverage_factor);

/// ln of the likelihood of the axes as those of one part, whose surfaces are as far out of a common
/// axis as parts are: 1 to 64 µm and, apart from that, 0.01 to 0.64 mrad, each scale as probable
/// (Eqs. 152, 153). Up to a constant of the references.
/// @param open what a mistake leaves open, taken at its best value: its width is paid for
double log_likelihood(std::span<const HeldAxis> axes, std::optional<OpenMistake> open = {});

/// The same of axes of which each is of another clamping: 1 mm and 10 mrad apart.
double log_likelihood_clamped_anew(std::span<const HeldAxis> axes);

/// A way in which a stream is read wrongly: what its columns have to be multiplied by, or turned
/// by, to be right.
struct Mistake {
  ReasonCode what, mend;
  std::vector<ReasonName> of{};  ///< the column, the unit or the convention that both are about
  double x = 1.0, z = 1.0, c = 1.0;
  double turn_rad = 0.0;
  std::optional<OpenNumber> open{};  ///< a number that only the data can tell
};

/// All that are tried on a disagreement of axes.
std::span<const Mistake> mistakes();

/// The stream as it should have been read.
/// @param number that a mistake leaves open: rad or mm that are added
ProbeStream mended(ProbeStream stream, const Mistake& mistake, double number = 0.0);

/// The same of an axis.
HeldAxis mended(HeldAxis axis, const Mistake& mistake, double number = 0.0);

/// ln of the density of a right axis over that of the axis as it was read, where that is smaller: a
/// mistake that shrinks everything would make all axes agree.
double log_shrinkage(const Mistake& mistake, bool plane);

inline constexpr Threshold exchanged_better{"left", 1.0 / 3.0, "of the RMS as given",
                                            "for one of the two"};
inline constexpr Threshold exchanged_as_good{"left", 1.2, "of the RMS as given", "for both"};

/// That two references have each other's stream: each stream is fitted better, or as well, with the
/// surface of the other.
std::optional<Reason> exchanged_streams(const IdentifiedJob& job);

}  // namespace trueaxis
