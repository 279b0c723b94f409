// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "trueaxis/probe_stream.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::virtual_lathe {

/// A correction table as the control runs it; for a face `position_mm` is X and the offsets are in
/// Z.
struct CutTable {
  bool face = false;
  std::vector<int> revolution;
  std::vector<double> position_mm;
  std::vector<double> c_rad;  ///< running, in the sense of rotation of the cut
  std::vector<double> wanted_mm, command_mm;
};

/// The part as the tool leaves it, fixed in the spindle frame.
///
/// The control feeds the nose centre along the section of the target at the tool's height, offset
/// by the nose radius, from where the nose touches the target's start to where it touches its end;
/// the actuator adds its displacement. The table is interpolated linearly in C
/// at the actuator's sampling instants and held; the second-order equation is solved exactly from
/// hold to hold. The surface is the envelope of the circular nose edge over the revolutions (with
/// nose radius 0 straight between two of them), so feed marks are there. Before the first row and
/// after the last the tool runs on along the path (CutProgram::runs_on): the table is continued
/// linearly, angle by angle.
class CutPart {
 public:
  /// @throws InputError when table and program contradict each other.
  CutPart(const CutProgram& program, const CutTable& table);
  ~CutPart();
  CutPart(CutPart&&) noexcept;
  CutPart& operator=(CutPart&&) noexcept;

  /// Radius left at polar angle theta of the spindle frame and height z; for a face the height left
  /// at (theta, distance from the axis). NaN where the tool never was.
  double surface_mm(double theta_rad, double position_mm) const;

  /// Displacement of the actuator when the spindle was at running angle c of the cut, mm.
  double displacement_mm(double c_rad) const;

  const CutProgram& program() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Probes a cut part in the same chucking, with the lathe's own numeric contact.
/// @throws InputError where the plan leaves the cut length.
ProbeStream probe_cut(const CutPart& part, const Plan& plan, const Noise& noise,
                      std::uint64_t seed);

}  // namespace trueaxis::virtual_lathe
