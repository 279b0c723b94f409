// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "measure/passes.hpp"
#include "trueaxis/effect.hpp"
#include "trueaxis/fit.hpp"
#include "trueaxis/probe_stream.hpp"
#include "trueaxis/surface.hpp"

namespace trueaxis::diagnose_detail {
/// How the part is clamped, and where a fit has found it.
struct Clamping {
  int number = 1;
  Revolved shape;  ///< where the ball's centre (or the contact) runs
  Root root = Root::front;
  double reindex_rad = 0.0, z_shift_mm = 0.0, x_jog_mm = 0.0, clamp_force_ratio = 1.0;
  std::size_t axis = 0;  ///< which axis of the base it has: set-ups not moved share one
};

/// What the base of the model is: rigid motions of every axis, and the shape all share.
struct BaseKind {
  bool face = false;    ///< tilt and height of every clamping, nothing shared
  bool tilts = true;    ///< l, m are free (not of a section)
  bool tapers = false;  ///< the half angle is free
  bool offset = false;  ///< the zero of a gauge instead of the radius
  std::size_t axes = 1;

  StreamKind stream() const { return face ? StreamKind::face : StreamKind::lateral; }
  std::size_t per_axis() const { return face ? 3 : tilts ? 4 : 2; }
  std::size_t shared() const { return face ? 0 : tapers ? 2 : 1; }
  std::size_t columns() const { return axes * per_axis() + shared(); }
};

/// What a point is as a whole; mm. Of a face X below is the Z that is read, and Z the X it is read
/// at.
struct LinearisationFacts {
  BaseKind base;
  double z_mid_mm = 0.0, z_half_mm = 1.0, s_ref_mm = 0.0;
  double tan_half_angle = 0.0;
  double reference_x_mm = 0.0, range_x_mm = 1.0;  ///< middle of what is sensed, and how far it goes
  bool bore = false;
  bool has_time = false, has_position = true, reindexed = false, jogged = false, shifted = false,
       two_sided = false, reclamped = false;
  std::vector<Clamping> clampings;

  double end_mm() const { return std::abs(z_mid_mm) + z_half_mm; }  ///< outer end of a face
};

/// The geometry of every reading about the fitted surface: what terms and base columns are made of.
/// Columns of one entry a reading; mm, rad, s.
struct LinearisationPoint : LinearisationFacts {
  std::vector<double> c, z, time, speed, velocity, x, sensed, dx_dc, dx_dz, d2x_dc2, theta, chuck,
      s, clamp;
  std::vector<double> dx_dnormal;   ///< of form along the normal
  std::vector<double> dx_dy;        ///< across the probe
  std::vector<std::uint32_t> axis;  ///< of every reading
  std::vector<char> rear;           ///< of every reading
  std::vector<Pass> passes;

  std::size_t size() const { return c.size(); }
  /// What is sensed as the gauge sees it, which behind is turned round.
  std::vector<double> outward_mm() const;
  /// Views of [begin, end); `rear` is that of the first reading: ask set-up by set-up.
  TermContext context(std::size_t begin, std::size_t end) const;
  /// ∂X/∂(base parameter): x, y, slopes of each axis at mid length; radius or offset; tan of the
  /// half angle. Rigid motions of the part: exact to first order (Eqs. 55–57). Of a face slopes of
  /// the axis and height (Eq. 133).
  void fill_base(std::size_t begin, std::size_t end, std::span<double* const> columns) const;
};

/// Whether the probe line of every reading meets the surface as it is clamped then: beyond a cone's
/// apex, or beside a thin part, none does. A face is met everywhere.
bool every_line_meets(const ProbeStream& stream, const std::vector<Clamping>& clampings);

/// @param stream columns C, Z, t, set-up; its readings are not used.
LinearisationPoint linearise_at(const ProbeStream& stream, const std::vector<Clamping>& clampings,
                                const BaseKind& base, bool bore, int threads = 1);

/// Fills what follows from the surface at C and Z of every reading; passes and clampings are there.
void fill_contacts(LinearisationPoint& point, int threads);

/// A fit that ended short of a minimum, or a profile of one's own, has no point to diagnose.
bool is_diagnosable(const FitResult& fit);

/// How the part stands in every set-up of a fit, the ball's centre on its surface.
std::vector<Clamping> clampings_of(const FitResult& fit, double ball_mm);

/// What the base of a model of a surface is.
BaseKind base_of(const ProbeStream& stream, const FitResult& fit,
                 const std::vector<Clamping>& clampings);

/// Readings minus the point's surface, of a gauge less its zero, which the base takes out anyway.
std::vector<double> deviation_from(const ProbeStream& stream, const LinearisationPoint& point);

}  // namespace trueaxis::diagnose_detail
