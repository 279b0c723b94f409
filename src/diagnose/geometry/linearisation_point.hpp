// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "diagnose/geometry/point_part.hpp"
#include "math/column_source.hpp"
#include "math/statistics.hpp"
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
  double touches_mm = 0.0;  ///< along the axis, from the ball's centre to where it touches
  double reindex_rad = 0.0, z_shift_mm = 0.0, x_jog_mm = 0.0, clamp_force_ratio = 1.0;
  std::size_t axis = 0;  ///< which axis of the base it has: set-ups not moved share one
  std::size_t until = std::numeric_limits<std::size_t>::max();  ///< the reading it ends before
  double slips_by_rad = 0.0;  ///< the part turns in the sense of C until the last clamping
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

/// What a point is as a whole; mm. For a face, X below is the Z that is read, and Z the X it is
/// read at.
struct LinearisationFacts {
  BaseKind base;
  double z_mid_mm = 0.0, z_half_mm = 1.0, s_ref_mm = 0.0;
  double tan_half_angle = 0.0;
  double reference_x_mm = 0.0, range_x_mm = 1.0;  ///< middle of what is sensed, and how far it goes
  Extent x_mm{0.0, 0.0};
  Extent outward_mm{
      0.0, 0.0};  ///< of what is sensed as the gauge sees it, turned round on the rear side
  bool bore = false;
  bool has_time = false, has_position = true, reindexed = false, jogged = false, shifted = false,
       two_sided = false, reclamped = false;
  std::vector<Clamping> clampings;
  std::vector<Clamping> before;  ///< of a part that slipped: where it was, until when
  double height_mm = 0.0;        ///< of the probe; 0 for a face
  bool as_read = false;          ///< TermContext
  double ball_radius_mm = 0.0;   ///< 0: unknown

  double end_mm() const { return std::abs(z_mid_mm) + z_half_mm; }  ///< outer end of a face
};

/// Readings from which on memory counts more than time.
inline constexpr std::size_t very_many = 4'000'000;

/// Threads for work side by side that takes memory for every reading.
constexpr int threads_beside(std::size_t readings, int threads) {
  return readings < very_many ? threads : 1;
}

/// Readings about the fitted surface. C, Z and time are at hand; all else is kept of few readings,
/// and of many made anew, part by part, where it is asked for.
struct LinearisationPoint : LinearisationFacts {
  SharedColumn c, z, time;
  SharedColumn play_side;  ///< TermContext
  std::vector<Pass> passes;
  std::vector<double> velocity;  ///< of every pass, mm/s along Z
  double swing_mm = 0.0;  ///< of what is sensed, on the side where it is larger: from side to side
                          ///< nothing is read
  Extent s_mm{0.0, 0.0}, sensed_mm{0.0, 0.0};  ///< how far they go

  std::size_t size() const { return c.size(); }
  /// Readings [begin, end), made in `room` where they are not kept; valid as long as both.
  PointPart part(std::size_t begin, std::size_t end, PointRoom& room) const;
  PointPart all(PointRoom& room) const { return part(0, size(), room); }
  /// Calls work(part) for all readings, some thousands at a time and in order.
  template <typename Work>
  void for_each_part(const Work& work, std::size_t begin, std::size_t end) const {
    PointRoom room;
    for (; begin < end; begin += part_rows)
      work(part(begin, std::min(begin + part_rows, end), room));
  }
  template <typename Work>
  void for_each_part(const Work& work) const {
    for_each_part(work, 0, size());
  }
  /// The same on threads and in any order.
  template <typename Work>
  void for_each_part_on(int threads, const Work& work) const {
    constexpr std::size_t rows = 4 * part_rows;
    for_each_index((size() + rows - 1) / rows, threads, [&](std::size_t k) {
      for_each_part(work, k * rows, std::min((k + 1) * rows, size()));
    });
  }
  /// For C, Z or time; null: it is made part by part.
  const SharedColumn* at_hand(PointColumn column) const;
  double at(PointColumn column, std::size_t reading) const;
  Extent range(PointColumn column) const;
  std::vector<double> column(PointColumn which, int threads = 1) const;  ///< all of it

  /// What terms get of a part; its `rear` is that of the first reading: ask set-up by set-up.
  TermContext context(const PointPart& part) const;
  /// ∂X/∂(base parameter): x, y, slopes of each axis at mid length; radius or offset; tan of the
  /// half angle. Rigid motions of the part: exact to first order (Eqs. 55–57). Of a face slopes of
  /// the axis and height (Eq. 133).
  void fill_base(const PointPart& part, std::span<double* const> columns) const;

  static constexpr std::size_t part_rows = 4096, few_readings = 40000;
  std::shared_ptr<const PointRoom> kept;  ///< of all readings, of which there are few
};

/// A column made part by part: what a sum over all readings takes it from. The point outlives it.
ColumnSource source_of(const LinearisationPoint& point, PointColumn column);

/// Whether the probe line of every reading meets the surface as it is clamped then: beyond a cone's
/// apex, or next to a thin part, none does. A face is met everywhere.
bool every_line_meets(const ProbeStream& stream, const std::vector<Clamping>& clampings,
                      const std::vector<Clamping>& before = {}, double height_mm = 0.0);

/// @param stream columns C, Z, t, set-up, which outlive the point; its readings are not used.
/// @param before, height_mm LinearisationFacts @param passes empty: those of the stream
LinearisationPoint linearise_at(const ProbeStream& stream, const std::vector<Clamping>& clampings,
                                const BaseKind& base, bool bore, int threads = 1,
                                std::vector<Clamping> before = {}, double height_mm = 0.0,
                                std::vector<Pass> passes = {});
/// The same of a stream whose columns the point takes.
LinearisationPoint linearise_at(ProbeStream&& stream, const std::vector<Clamping>& clampings,
                                const BaseKind& base, bool bore, int threads = 1);

/// A fit that ended short of a minimum, or a profile of one's own, has no point to diagnose.
bool is_diagnosable(const FitResult& fit);

/// The part as it is in every set-up of a fit, the ball's centre on its surface.
std::vector<Clamping> clampings_of(const FitResult& fit, double ball_mm);

/// What the base of a model of a surface is.
BaseKind base_of(const ProbeStream& stream, const FitResult& fit,
                 const std::vector<Clamping>& clampings);

/// Readings minus the point's surface, of a gauge less its zero, which the base takes out anyway.
std::vector<double> deviation_from(const ProbeStream& stream, const LinearisationPoint& point,
                                   int threads = 1);

}  // namespace trueaxis::diagnose_detail
