// SPDX-License-Identifier: Apache-2.0
#include "diagnose/geometry/linearisation_point.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "diagnose/geometry/contacts.hpp"
#include "math/statistics.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double least_range_mm = 1e-3;

// Without a clock the spindle's stated speed gives one, while C runs one way; else the number of
// the reading is all that is known of the time: enough for an instant. The spindle then turns once
// a second: enough for the sense in which X moves.
void fill_time(const std::optional<double>& spindle_rpm, LinearisationPoint& point) {
  point.has_time = point.time.size() > 0;
  if (point.has_time) return;
  std::vector<double> time(point.size());
  if (spindle_rpm && point.passes.size() == 1 && point.passes[0].c_sign != 0) {
    const double speed = std::abs(*spindle_rpm) * two_pi / 60.0;
    for (std::size_t i = 0; i < time.size(); ++i)
      time[i] = std::abs(point.c[i] - point.c[0]) / speed;
    point.passes[0].speed_rad_per_s = speed * point.passes[0].c_sign;
    point.has_time = true;
  } else {
    std::iota(time.begin(), time.end(), 0.0);
    for (Pass& pass : point.passes) pass.speed_rad_per_s = two_pi * pass.c_sign;
  }
  point.time = SharedColumn(std::move(time));
}

void fill_motion(LinearisationPoint& point) {
  for (const Pass& pass : point.passes) {
    double velocity = pass.feed_mm_per_rev * std::abs(pass.speed_rad_per_s) / two_pi;
    const double lasted = point.has_time && pass.end > pass.begin + 1
                              ? point.time[pass.end - 1] - point.time[pass.begin]
                              : 0.0;
    if (pass.c_sign == 0 && lasted > 0.0)
      velocity = (point.z[pass.end - 1] - point.z[pass.begin]) / lasted;
    point.velocity.push_back(velocity);
  }
}

LinearisationPoint linearised(const ProbeStream& stream, LinearisationPoint point,
                              const std::vector<Clamping>& clampings, const BaseKind& base,
                              bool bore, int threads) {
  expects((stream.kind == StreamKind::face) == base.face && point.size() > 0,
          "a stream of the surface");
  point.base = base;
  point.bore = bore;
  point.has_position = stream.has_position() && (base.tilts || base.face);  // a section has none
  if (!point.has_position) point.z = SharedColumn(std::vector<double>(point.size(), 0.0));
  point.tan_half_angle = clampings.front().shape.tan_half_angle;
  fill_time(stream.spindle_rpm, point);
  fill_motion(point);
  point.clampings = clampings;
  const Reach reach = fill_contacts(point, threads);
  const auto [low, high] = base.face ? range_of(point.z) : reach.s;
  point.z_mid_mm = 0.5 * (low + high);
  point.z_half_mm = std::max(0.5 * (high - low), 1e-9);
  if (!point.has_position || point.z_half_mm < 1e-3) point.z_half_mm = 1.0;
  point.s_ref_mm = point.z_mid_mm;
  point.x_mm = reach.x;
  point.outward_mm = reach.side[0];
  widen(point.outward_mm, {-reach.side[1].high, -reach.side[1].low});
  point.reference_x_mm = 0.5 * (point.outward_mm.low + point.outward_mm.high);
  point.range_x_mm = std::max(0.5 * point.outward_mm.length(), least_range_mm);
  for (const Clamping& c : clampings) {
    point.reindexed |= c.reindex_rad != clampings.front().reindex_rad;
    point.jogged |= c.x_jog_mm != clampings.front().x_jog_mm;
    point.shifted |= c.z_shift_mm != clampings.front().z_shift_mm;
    point.two_sided |= c.root != clampings.front().root;
    point.reclamped |= c.clamp_force_ratio != clampings.front().clamp_force_ratio;
  }
  if (base.face) point.two_sided = low < 0.0 && high > 0.0;
  return point;
}

}  // namespace

PointPart LinearisationPoint::part(std::size_t begin, std::size_t end, PointRoom& room) const {
  if (!kept) make_part(*this, begin, end, room);
  const PointRoom& from = kept ? *kept : room;
  const std::size_t at = kept ? begin : 0, count = end - begin;
  const auto view = [&](const auto& column) { return std::span(column).subspan(at, count); };
  const auto own = [&](std::span<const double> column) { return column.subspan(begin, count); };
  PointPart out;
  out.begin = begin;
  out.c = own(c), out.z = own(z), out.time = own(time);
  out.sine = view(from.sine), out.cosine = view(from.cosine);
  out.speed = view(from.speed), out.velocity = view(from.velocity);
  out.x = view(from.x), out.sensed = view(from.sensed);
  out.dx_dc = view(from.dx_dc), out.dx_dz = view(from.dx_dz), out.d2x_dc2 = view(from.d2x_dc2);
  out.theta = view(from.theta), out.chuck = view(from.chuck), out.s = view(from.s);
  out.clamp = view(from.clamp), out.axis = view(from.axis), out.rear = view(from.rear);
  out.dx_dnormal = view(from.dx_dnormal), out.dx_dy = view(from.dx_dy);
  return out;
}

const SharedColumn* LinearisationPoint::at_hand(PointColumn column) const {
  return column == &PointPart::c      ? &c
         : column == &PointPart::z    ? &z
         : column == &PointPart::time ? &time
                                      : nullptr;
}

double LinearisationPoint::at(PointColumn column, std::size_t reading) const {
  if (const SharedColumn* own = at_hand(column)) return (*own)[reading];
  PointRoom room;
  return (part(reading, reading + 1, room).*column)[0];
}

Extent LinearisationPoint::range(PointColumn column) const {
  if (const SharedColumn* own = at_hand(column)) return range_of(*own);
  if (column == &PointPart::s) return s_mm;
  if (column == &PointPart::sensed) return sensed_mm;
  Extent out = nowhere;
  for_each_part([&](const PointPart& at) { widen(out, range_of(at.*column)); });
  return out;
}

std::vector<double> LinearisationPoint::column(PointColumn which, int threads) const {
  if (const SharedColumn* own = at_hand(which)) return {own->begin(), own->end()};
  std::vector<double> out(size());
  const auto copy = [&](const PointPart& at) {
    std::ranges::copy(at.*which, out.begin() + static_cast<long>(at.begin));
  };
  for_each_part_on(threads, copy);
  return out;
}

ColumnSource source_of(const LinearisationPoint& point, PointColumn column) {
  return [&point, column](std::size_t begin, std::size_t size, std::span<double* const> out) {
    if (const SharedColumn* own = point.at_hand(column))
      return void(std::copy_n(own->begin() + static_cast<long>(begin), size, out[0]));
    PointRoom room;
    std::ranges::copy(point.part(begin, begin + size, room).*column, out[0]);
  };
}

bool every_line_meets(const ProbeStream& stream, const std::vector<Clamping>& clampings,
                      const std::vector<Clamping>& before, double height_mm) {
  for (std::size_t i = 0; i < stream.size() && stream.kind == StreamKind::lateral; ++i) {
    const Clamping& now =
        clamping_at(clampings, before, stream.setup.empty() ? 1 : stream.setup[i], i);
    const double z_mm = stream.has_position() ? stream.position_mm[i] : 0.0;
    if (!intersect(now.shape, stream.c_rad[i], z_mm, height_mm, now.root).hit) return false;
  }
  return true;
}

LinearisationPoint linearise_at(const ProbeStream& stream, const std::vector<Clamping>& clampings,
                                const BaseKind& base, bool bore, int threads,
                                std::vector<Clamping> before, double height_mm,
                                std::vector<Pass> passes) {
  LinearisationPoint point;
  point.height_mm = height_mm;
  point.before = std::move(before);
  point.passes = passes.empty() ? find_passes(stream) : std::move(passes);
  point.c = SharedColumn::of(stream.c_rad);
  point.z = SharedColumn::of(stream.position_mm);
  point.time = SharedColumn::of(stream.time_s);
  return linearised(stream, std::move(point), clampings, base, bore, threads);
}

LinearisationPoint linearise_at(ProbeStream&& stream, const std::vector<Clamping>& clampings,
                                const BaseKind& base, bool bore, int threads) {
  LinearisationPoint point;
  point.passes = find_passes(stream);
  point.c = SharedColumn(stream.c_rad);
  point.z = SharedColumn(stream.position_mm);
  point.time = SharedColumn(stream.time_s);
  return linearised(stream, std::move(point), clampings, base, bore, threads);
}

TermContext LinearisationPoint::context(const PointPart& part) const {
  TermContext at;
  at.c_rad = part.c, at.z_mm = part.z, at.time_s = part.time;
  at.speed_rad_per_s = part.speed, at.velocity_mm_per_s = part.velocity;
  at.x_mm = part.x, at.sensed_mm = part.sensed;
  at.dx_dc = part.dx_dc, at.dx_dz = part.dx_dz, at.d2x_dc2 = part.d2x_dc2;
  at.theta_rad = part.theta, at.theta_chuck_rad = part.chuck, at.s_mm = part.s;
  at.clamp_force_ratio = part.clamp;
  if (base.face) at.face = true, at.dx_dy = part.dx_dy;
  at.z_mid_mm = z_mid_mm, at.z_half_mm = z_half_mm;
  at.height_mm = height_mm;
  at.tan_half_angle = tan_half_angle;
  at.bore = bore, at.rear = part.rear[0] != 0;
  at.as_read = as_read;
  if (play_side.size() > 0)
    at.play_side = std::span<const double>(play_side).subspan(part.begin, part.size());
  return at;
}

void LinearisationPoint::fill_base(const PointPart& at, std::span<double* const> columns) const {
  const std::size_t per_axis = base.per_axis(), shared = base.axes * per_axis;
  const double cos_half = 1.0 / std::hypot(1.0, tan_half_angle);
  if (base.axes > 1)
    for (double* column : columns) std::fill_n(column, at.size(), 0.0);
  for (std::size_t k = 0; k < at.size() && base.face; ++k) {
    const std::size_t own = at.axis[k] * per_axis;
    columns[own][k] = -at.z[k] * at.cosine[k];
    columns[own + 1][k] = -at.z[k] * at.sine[k];
    columns[own + 2][k] = 1.0;
  }
  if (base.face) return;
  auto slipped = before.begin();
  double turn_cosine = 1.0, turn_sine = 0.0;
  for (std::size_t k = 0, until = at.begin; k < at.size(); ++k) {
    if (at.begin + k == until) {  // another place of a part that slipped
      while (slipped != before.end() && slipped->until <= until) ++slipped;
      const double turn = slipped == before.end() ? 0.0 : slipped->slips_by_rad;
      turn_cosine = std::cos(turn), turn_sine = std::sin(turn);
      until = slipped == before.end() ? size() : slipped->until;
    }
    const std::size_t own = at.axis[k] * per_axis;
    // Those of the part where it is in the end, turned back to where it was.
    const double cosine = turn_cosine * at.cosine[k] - turn_sine * at.sine[k],
                 sine = turn_sine * at.cosine[k] + turn_cosine * at.sine[k];
    const double dx_dy = at.dx_dy[k], normal = at.dx_dnormal[k];
    const double along_x = cosine + sine * dx_dy, along_y = sine - cosine * dx_dy;
    columns[own][k] = along_x;
    columns[own + 1][k] = along_y;
    if (base.tilts) {
      const double lever = at.z[k] - z_mid_mm, x = at.x[k];
      columns[own + 2][k] = lever * along_x + at.dx_dz[k] * (x * cosine - height_mm * sine);
      columns[own + 3][k] = lever * along_y + at.dx_dz[k] * (x * sine + height_mm * cosine);
    }
    columns[shared][k] = base.offset ? 1.0 : normal * cos_half;
    if (base.tapers) columns[shared + 1][k] = normal * cos_half * (at.s[k] - s_ref_mm);
  }
}

bool is_diagnosable(const FitResult& fit) {
  return is_diagnosed(fit.surface) && !fit.set_ups.empty() && fit.points > fit.parameters.size() &&
         (fit.status == FitStatus::converged || fit.status == FitStatus::rank_deficient) &&
         std::ranges::all_of(fit.residual_mm, [](double r) { return std::isfinite(r); });
}

std::vector<Clamping> clampings_of(const FitResult& fit, double ball_mm) {
  std::vector<Clamping> out;
  const SetUp* before = nullptr;
  for (const SetUpFit& s : fit.set_ups) {
    Clamping c;
    c.number = s.set_up.number;
    c.shape = s.shape;
    const double secant = std::hypot(1.0, s.shape.tan_half_angle);
    c.shape.radius_mm += (fit.bore ? -ball_mm : ball_mm) * secant;
    c.touches_mm = (fit.bore ? -ball_mm : ball_mm) * s.shape.tan_half_angle / secant;
    c.root = s.side;
    c.reindex_rad = s.set_up.reindex_rad;
    c.z_shift_mm = s.set_up.z_shift_mm;
    c.x_jog_mm = s.set_up.x_jog_mm;
    c.clamp_force_ratio = s.set_up.clamp_force_ratio;
    c.axis = out.empty() ? 0 : out.back().axis + (s.set_up.clamped_as(*before) ? 0 : 1);
    before = &s.set_up;
    out.push_back(c);
  }
  return out;
}

BaseKind base_of(const ProbeStream& stream, const FitResult& fit,
                 const std::vector<Clamping>& clampings) {
  BaseKind base;
  base.face = fit.surface == SurfaceKind::plane;
  base.tilts = fit.surface != SurfaceKind::section;
  base.tapers = fit.surface == SurfaceKind::cone;
  base.offset = !base.face && stream.indication == Indication::relative;
  base.axes = clampings.back().axis + 1;
  return base;
}

std::vector<double> deviation_from(const ProbeStream& stream, const LinearisationPoint& point,
                                   int threads) {
  std::vector<double> out(point.size());
  point.for_each_part_on(threads, [&](const PointPart& at) {
    for (std::size_t k = 0; k < at.size(); ++k)
      out[at.begin + k] = stream.reading_mm[at.begin + k] - at.x[k];
  });
  if (!point.base.offset) return out;
  const double zero = median(out);
  for (double& d : out) d -= zero;
  return out;
}

}  // namespace trueaxis::diagnose_detail
