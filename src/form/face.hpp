// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "form/exchange.hpp"
#include "form/uncertainty.hpp"
#include "form/values.hpp"
#include "trueaxis/form.hpp"

namespace trueaxis::form {

/// Heights over a plane or along a line, about those of least squares and of the minimum zone:
/// FLTt, FLTp, FLTv, FLTq (ISO 12781) and STRt … (ISO 12780). Distances are at right angles.
class HeightModel {
 public:
  struct Names {
    const char *group, *prefix, *suffix;  ///< "flatness", "FLT", "PL"
  };
  /// @param at_mm coordinates of each height: two of a plane, one of a line (the second is 0)
  HeightModel(std::span<const std::array<double, 2>> at_mm, bool plane, const Names& names);

  std::vector<NamedValue> assess(std::span<const double> height_mm) const;
  /// The residual of the least-squares plane or line.
  std::vector<double> off_mm(std::span<const double> height_mm) const;

 private:
  Exchange least_, zone_;
  Names names_;
  double scale_mm_;
};

/// Rows 1, u, v of Eq. 274, u and v over `scale_mm`.
Exchange::Rows height_rows(std::span<const std::array<double, 2>> at_mm, bool plane,
                           double scale_mm);

using AssessHeights = std::function<std::vector<NamedValue>(std::span<const double> height_mm)>;

/// `spreads` of heights with white noise, which no filter takes off.
/// @param off_mm about the least-squares criterion, by which the noise is judged (Eq. 271)
std::vector<Spread> spreads_of_heights(std::span<const double> height_mm,
                                       std::span<const double> off_mm, double noise_mm,
                                       const FormOptions& options, const AssessHeights& assess);

/// How the axis leans that axial run-out is about: slopes along x and y, and u of each. That of the
/// spindle does not.
struct Lean {
  std::array<double, 2> slope{}, u{};
};

/// What the slopes of an axis add to the heights of a face about it.
std::vector<double> leaning(const ProbeStream& face, const std::array<double, 2>& slope);

/// Flatness, and axial run-out about an axis, of a face stream (Z_M, C, X).
void assess_face(const ProbeStream& stream, const Lean& datum, std::span<const TakenOff> taken_off,
                 FormResult& result);

/// The noise of heights that their residuals show, mm.
using NoiseOf = std::function<double(std::span<const double> off_mm)>;

/// Flatness or straightness of heights, with U, as a group of the result.
/// @param ordered by time: a chip, far off between neighbours that are not, is in the values and
/// may not be of the part, so the lower ends are without it
void assess_heights(std::span<const std::array<double, 2>> at_mm, bool plane,
                    std::span<const double> height_mm, const NoiseOf& shown,
                    const AssessHeights& more, std::span<const TakenOff> taken_off, bool ordered,
                    FormResult& result);

}  // namespace trueaxis::form
