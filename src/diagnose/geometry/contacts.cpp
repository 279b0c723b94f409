// SPDX-License-Identifier: Apache-2.0
#include "diagnose/geometry/contacts.hpp"

#include <cmath>

#include "base/threads.hpp"
#include "diagnose/geometry/contact_kernel.hpp"
#include "math/sincos.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::diagnose_detail {
namespace {

/// Of a face the plane through the axis' point at z_ref (Eqs. 131, 132).
void meet_face(const Axis& axis, const ProbeLines& lines, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    const double along = -axis.slope_x * lines.cosine[k] - axis.slope_y * lines.sine[k],
                 across = axis.slope_x * lines.sine[k] - axis.slope_y * lines.cosine[k];
    lines.x[k] = axis.z_ref_mm + lines.z[k] * along;
    lines.dx_dc[k] = lines.z[k] * across;
    lines.dx_dz[k] = along;
  }
}

/// `count` readings of one clamping, entries from `to` on.
void fill_contacts(const Clamping& now, const LinearisationFacts& facts, std::size_t to,
                   std::size_t count, PointRoom& out) {
  const Axis& axis = now.shape.axis;
  const bool face = facts.base.face;
  const double height_mm = facts.height_mm;
  const auto at = [&](std::vector<double>& column) { return column.data() + to; };
  const double *sine = at(out.sine), *cosine = at(out.cosine), *z = at(out.z);
  double *x = at(out.x), *dx_dc = at(out.dx_dc), *dx_dz = at(out.dx_dz), *theta = at(out.theta),
         *s = at(out.s), *from = at(out.from);
  const ProbeLines lines{sine, cosine, z, x, dx_dc, dx_dz, height_mm};
  if (face)
    meet_face(axis, lines, count);
  else
    expects(meet(now.shape, now.root, lines, count), "every probe line meets the fitted surface");
  const bool behind = now.root == Root::rear;
  to_part_frame(axis, {face ? z : x, face ? x : z, sine, cosine, theta, s, from, height_mm}, count);
  double *sensed = at(out.sensed), *chuck = at(out.chuck), *d2x_dc2 = at(out.d2x_dc2),
         *dx_dy = at(out.dx_dy), *dx_dnormal = at(out.dx_dnormal);
  for (std::size_t k = 0; k < count; ++k) {
    sensed[k] = x[k] - now.x_jog_mm;
    chuck[k] = theta[k];
    theta[k] += now.reindex_rad + now.slips_by_rad;
    s[k] = face ? from[k] : s[k] + now.touches_mm - now.z_shift_mm;
    const auto centre = axis.at(z[k]);
    d2x_dc2[k] = face ? -z[k] * dx_dz[k] : -(centre[0] * cosine[k] + centre[1] * sine[k]);
    dx_dy[k] =
        face ? axis.slope_x * sine[k] - axis.slope_y * cosine[k] : (dx_dc[k] - height_mm) / x[k];
    const double secant = std::sqrt(1.0 + dx_dy[k] * dx_dy[k] + dx_dz[k] * dx_dz[k]);
    dx_dnormal[k] = behind ? -secant : secant;
  }
  std::fill_n(at(out.clamp), count, now.clamp_force_ratio);
  std::fill_n(out.axis.begin() + static_cast<long>(to), count,
              static_cast<std::uint32_t>(now.axis));
  std::fill_n(out.rear.begin() + static_cast<long>(to), count, behind);
}

}  // namespace

const Clamping& clamping_of(const std::vector<Clamping>& clampings, int number) {
  if (clampings.size() == 1) return clampings.front();
  const auto found = std::ranges::find(clampings, number, &Clamping::number);
  expects(found != clampings.end(), "a clamping for every set-up");
  return *found;
}

const Clamping& clamping_at(const std::vector<Clamping>& clampings,
                            const std::vector<Clamping>& before, int number, std::size_t reading) {
  const auto at = std::ranges::find_if(before, [&](const Clamping& c) {
    return reading < c.until && (clampings.size() == 1 || c.number == number);
  });
  return at != before.end() ? *at : clamping_of(clampings, number);
}

/// Pass by pass, and place by place of a part that slipped.
void make_part(const LinearisationPoint& point, std::size_t begin, std::size_t end,
               PointRoom& out) {
  const std::size_t size = end - begin;
  out.resize(size + kernel_room);
  std::ranges::copy(std::span<const double>(point.z).subspan(begin, size), out.z.begin());
  sincos(std::span<const double>(point.c).subspan(begin, size), std::span(out.sine).first(size),
         std::span(out.cosine).first(size));
  auto pass = std::ranges::upper_bound(point.passes, begin, {}, &Pass::end);
  for (std::size_t from = begin; from < end; pass += from == pass->end) {
    const Clamping& now = clamping_at(point.clampings, point.before, pass->setup, from);
    const std::size_t to = std::min({end, pass->end, now.until}), at = from - begin,
                      count = to - from;
    const auto number = static_cast<std::size_t>(pass - point.passes.begin());
    std::fill_n(out.speed.begin() + static_cast<long>(at), count, pass->speed_rad_per_s);
    std::fill_n(out.velocity.begin() + static_cast<long>(at), count, point.velocity[number]);
    fill_contacts(now, point, at, count, out);
    from = to;
  }
}

void Reach::add(const PointPart& at) {
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double sensed = at.sensed[i];
    widen(side[at.rear[i] != 0], {sensed, sensed});
  }
  widen(x, range_of(at.x)), widen(s, range_of(at.s));
}
void Reach::add(const Reach& other) {
  widen(x, other.x), widen(s, other.s);
  for (const std::size_t k : {0u, 1u}) widen(side[k], other.side[k]);
}

namespace {

Reach reach_of(const LinearisationPoint& point, int threads) {
  constexpr std::size_t rows = 4 * LinearisationPoint::part_rows;
  std::vector<Reach> parts((point.size() + rows - 1) / rows);
  for_each_index(parts.size(), threads, [&](std::size_t k) {
    point.for_each_part([&](const PointPart& at) { parts[k].add(at); }, k * rows,
                        std::min((k + 1) * rows, point.size()));
  });
  Reach out;
  for (const Reach& part : parts) out.add(part);
  return out;
}

}  // namespace

Reach fill_contacts(LinearisationPoint& point, int threads) {
  if (point.size() < LinearisationPoint::few_readings) {
    const auto all = std::make_shared<PointRoom>();
    make_part(point, 0, point.size(), *all);
    point.kept = all;
  }
  const Reach reach = reach_of(point, threads);
  point.swing_mm = std::max({0.0, reach.side[0].length(), reach.side[1].length()});
  point.s_mm = reach.s, point.sensed_mm = reach.side[0];
  widen(point.sensed_mm, reach.side[1]);
  return reach;
}

}  // namespace trueaxis::diagnose_detail
