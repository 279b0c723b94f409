// SPDX-License-Identifier: Apache-2.0
#include "diagnose/geometry/linearisation_point.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/threads.hpp"
#include "math/sincos.hpp"
#include "math/statistics.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double least_range_mm = 1e-3;
constexpr std::size_t part_rows = 16384;  // of a thread

const Clamping& clamping_of(const std::vector<Clamping>& clampings, int number) {
  if (clampings.size() == 1) return clampings.front();
  const auto found = std::ranges::find(clampings, number, &Clamping::number);
  expects(found != clampings.end(), "a clamping for every set-up");
  return *found;
}

// Without a clock the spindle's stated speed gives one, while C runs one way; else the number of
// the reading is all that is known of the time: enough for an instant.
void fill_time(const ProbeStream& stream, LinearisationPoint& point) {
  if (!stream.time_s.empty()) {
    point.time = stream.time_s;
    point.has_time = true;
  } else if (stream.spindle_rpm && point.passes.size() == 1 && point.passes[0].c_sign != 0) {
    const double speed = std::abs(*stream.spindle_rpm) * two_pi / 60.0;
    for (const double c : point.c) point.time.push_back(std::abs(c - point.c[0]) / speed);
    point.passes[0].speed_rad_per_s = speed * point.passes[0].c_sign;
    point.has_time = true;
  } else {
    point.time.resize(point.size());
    std::iota(point.time.begin(), point.time.end(), 0.0);
  }
}

void fill_motion(LinearisationPoint& point) {
  point.speed.resize(point.size());
  point.velocity.resize(point.size());
  for (const Pass& pass : point.passes) {
    double velocity = pass.feed_mm_per_rev * std::abs(pass.speed_rad_per_s) / two_pi;
    const double lasted = point.has_time && pass.end > pass.begin + 1
                              ? point.time[pass.end - 1] - point.time[pass.begin]
                              : 0.0;
    if (pass.c_sign == 0 && lasted > 0.0)
      velocity = (point.z[pass.end - 1] - point.z[pass.begin]) / lasted;
    std::fill(point.speed.begin() + static_cast<long>(pass.begin),
              point.speed.begin() + static_cast<long>(pass.end), pass.speed_rad_per_s);
    std::fill(point.velocity.begin() + static_cast<long>(pass.begin),
              point.velocity.begin() + static_cast<long>(pass.end), velocity);
  }
}

/// Coordinates of a point of the spindle frame in the frame of an axis, whose origin is the axis'
/// point at z = 0: turned back by Rodrigues' rotation about the common normal of axis and spindle.
class PartFrame {
 public:
  explicit PartFrame(const Axis& axis) {
    const double secant =
        std::sqrt(1.0 + axis.slope_x * axis.slope_x + axis.slope_y * axis.slope_y);
    const double l = axis.slope_x / secant, m = axis.slope_y / secant;
    const auto origin = axis.at(0.0);
    x0 = origin[0], y0 = origin[1], n = 1.0 / secant, sine = std::hypot(l, m);
    kx = sine > 0.0 ? m / sine : 0.0, ky = sine > 0.0 ? -l / sine : 0.0;
  }
  struct Polar {
    double theta, s, rho;  ///< about the axis, along it, from it
  };
  Polar at(double px, double py, double pz) const {
    const double qx = px - x0, qy = py - y0, along = (kx * qx + ky * qy) * (1.0 - n);
    const double l = -ky * sine, m = kx * sine;
    const double y = qy * n - sine * kx * pz + ky * along, x = qx * n + sine * ky * pz + kx * along;
    return {std::atan2(y, x), l * qx + m * qy + n * pz, std::hypot(x, y)};
  }

 private:
  double x0, y0, kx, ky, n, sine;
};

/// What is met there; of a face the plane through the axis' point at z_ref (Eqs. 131, 132).
Intersection contact_of(const Clamping& now, const BaseKind& base, double c, double position) {
  if (!base.face) return intersect(now.shape, c, position, 0.0, now.root);
  const Axis& axis = now.shape.axis;
  const double sine = std::sin(c), cosine = std::cos(c);
  const double along = -axis.slope_x * cosine - axis.slope_y * sine,
               across = axis.slope_x * sine - axis.slope_y * cosine;
  Intersection at;
  at.hit = true;
  at.x_mm = axis.z_ref_mm + position * along;
  at.dx_dc = position * across;
  at.dx_dz = along;
  return at;
}

/// Readings [begin, end) of one clamping.
void fill_contacts(const Clamping& now, std::size_t begin, std::size_t end,
                   LinearisationPoint& point) {
  const PartFrame frame(now.shape.axis);
  const Axis& axis = now.shape.axis;
  const bool face = point.base.face, behind = now.root == Root::rear;
  for (std::size_t i = begin; i < end; ++i) {
    const Intersection at = contact_of(now, point.base, point.c[i], point.z[i]);
    expects(at.hit, "every probe line meets the fitted surface");
    point.x[i] = at.x_mm;
    point.sensed[i] = at.x_mm - now.x_jog_mm;
    point.dx_dc[i] = at.dx_dc;
    point.dx_dz[i] = at.dx_dz;
    const double cosine = std::cos(point.c[i]), sine = std::sin(point.c[i]);
    const auto centre = axis.at(point.z[i]);
    point.d2x_dc2[i] = face ? -point.z[i] * at.dx_dz : -(centre[0] * cosine + centre[1] * sine);
    const double x = face ? point.z[i] : at.x_mm, z = face ? at.x_mm : point.z[i];
    const auto polar = frame.at(x * cosine, x * sine, z);
    point.chuck[i] = polar.theta;
    point.theta[i] = polar.theta + now.reindex_rad;
    point.s[i] = face ? polar.rho : polar.s - now.z_shift_mm;
    point.clamp[i] = now.clamp_force_ratio;
    point.axis[i] = static_cast<std::uint32_t>(now.axis);
    point.rear[i] = behind;
    const double dx_dy = face ? axis.slope_x * sine - axis.slope_y * cosine : at.dx_dc / at.x_mm;
    point.dx_dy[i] = dx_dy;
    const double secant = std::sqrt(1.0 + dx_dy * dx_dy + at.dx_dz * at.dx_dz);
    point.dx_dnormal[i] = behind ? -secant : secant;
  }
}

}  // namespace

void fill_contacts(LinearisationPoint& point, int threads) {
  for (auto* column :
       {&point.x, &point.sensed, &point.dx_dc, &point.dx_dz, &point.d2x_dc2, &point.chuck,
        &point.theta, &point.s, &point.clamp, &point.dx_dnormal, &point.dx_dy})
    column->resize(point.size());
  point.axis.resize(point.size()), point.rear.resize(point.size());
  for (const Pass& pass : point.passes) {
    const Clamping& now = clamping_of(point.clampings, pass.setup);
    const std::size_t parts = (pass.end - pass.begin + part_rows - 1) / part_rows;
    for_each_index(parts, threads, [&](std::size_t part) {
      const std::size_t begin = pass.begin + part * part_rows;
      fill_contacts(now, begin, std::min(begin + part_rows, pass.end), point);
    });
  }
}

bool every_line_meets(const ProbeStream& stream, const std::vector<Clamping>& clampings) {
  for (std::size_t i = 0; i < stream.size() && stream.kind == StreamKind::lateral; ++i) {
    const Clamping& now = clamping_of(clampings, stream.setup.empty() ? 1 : stream.setup[i]);
    const double z_mm = stream.has_position() ? stream.position_mm[i] : 0.0;
    if (!intersect(now.shape, stream.c_rad[i], z_mm, 0.0, now.root).hit) return false;
  }
  return true;
}

LinearisationPoint linearise_at(const ProbeStream& stream, const std::vector<Clamping>& clampings,
                                const BaseKind& base, bool bore, int threads) {
  expects((stream.kind == StreamKind::face) == base.face && !stream.c_rad.empty(),
          "a stream of the surface");
  LinearisationPoint point;
  point.base = base;
  point.bore = bore;
  point.c = stream.c_rad;
  point.has_position = stream.has_position() && (base.tilts || base.face);  // a section has none
  point.z = point.has_position ? stream.position_mm : std::vector<double>(stream.size(), 0.0);
  point.passes = find_passes(stream);
  point.tan_half_angle = clampings.front().shape.tan_half_angle;
  fill_time(stream, point);
  fill_motion(point);
  point.clampings = clampings;
  fill_contacts(point, threads);
  const auto [low, high] = range_of(base.face ? point.z : point.s);
  point.z_mid_mm = 0.5 * (low + high);
  point.z_half_mm = std::max(0.5 * (high - low), 1e-9);
  if (!point.has_position || point.z_half_mm < 1e-3) point.z_half_mm = 1.0;
  point.s_ref_mm = point.z_mid_mm;
  const std::vector<double> outward = point.outward_mm();
  const double sum = std::accumulate(outward.begin(), outward.end(), 0.0);
  point.reference_x_mm = sum / static_cast<double>(point.size());
  const auto [least, most] = range_of(outward);
  point.range_x_mm =
      std::max({most - point.reference_x_mm, point.reference_x_mm - least, least_range_mm});
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

std::vector<double> LinearisationPoint::outward_mm() const {
  std::vector<double> out(sensed);
  for (std::size_t i = 0; i < size(); ++i) {
    if (rear[i]) out[i] = -out[i];
  }
  return out;
}

TermContext LinearisationPoint::context(std::size_t begin, std::size_t end) const {
  const auto part = [&](const std::vector<double>& column) {
    return std::span<const double>(column).subspan(begin, end - begin);
  };
  TermContext at;
  at.c_rad = part(c), at.z_mm = part(z), at.time_s = part(time);
  at.speed_rad_per_s = part(speed), at.velocity_mm_per_s = part(velocity);
  at.x_mm = part(x), at.sensed_mm = part(sensed);
  at.dx_dc = part(dx_dc), at.dx_dz = part(dx_dz), at.d2x_dc2 = part(d2x_dc2);
  at.theta_rad = part(theta), at.theta_chuck_rad = part(chuck), at.s_mm = part(s);
  at.clamp_force_ratio = part(clamp);
  if (base.face) at.face = true, at.dx_dy = part(dx_dy);
  at.z_mid_mm = z_mid_mm, at.z_half_mm = z_half_mm;
  at.tan_half_angle = tan_half_angle;
  at.bore = bore, at.rear = rear[begin] != 0;
  return at;
}

void LinearisationPoint::fill_base(std::size_t begin, std::size_t end,
                                   std::span<double* const> columns) const {
  const std::size_t per_axis = base.per_axis(), shared = base.axes * per_axis;
  const double cos_half = 1.0 / std::hypot(1.0, tan_half_angle);
  for (std::size_t j = 0; j < columns.size(); ++j) std::fill_n(columns[j], end - begin, 0.0);
  std::vector<double> turn[2] = {std::vector<double>(end - begin),
                                 std::vector<double>(end - begin)};
  sincos(std::span(c).subspan(begin, end - begin), turn[0], turn[1]);
  for (std::size_t i = begin; i < end && base.face; ++i) {
    const std::size_t k = i - begin, own = axis[i] * per_axis;
    columns[own][k] = -z[i] * turn[1][k];
    columns[own + 1][k] = -z[i] * turn[0][k];
    columns[own + 2][k] = 1.0;
  }
  if (base.face) return;
  for (std::size_t i = begin; i < end; ++i) {
    const std::size_t k = i - begin, own = axis[i] * per_axis;
    const double cosine = turn[1][k], sine = turn[0][k], dx_dy = dx_dc[i] / x[i];
    const double along_x = cosine + sine * dx_dy, along_y = sine - cosine * dx_dy;
    const double normal = dx_dnormal[i];
    columns[own][k] = along_x;
    columns[own + 1][k] = along_y;
    if (base.tilts) {
      const double lever = z[i] - z_mid_mm;
      columns[own + 2][k] = lever * along_x + dx_dz[i] * x[i] * cosine;
      columns[own + 3][k] = lever * along_y + dx_dz[i] * x[i] * sine;
    }
    columns[shared][k] = base.offset ? 1.0 : normal * cos_half;
    if (base.tapers) columns[shared + 1][k] = normal * cos_half * (s[i] - s_ref_mm);
  }
}

bool is_diagnosable(const FitResult& fit) {
  const bool has_terms = fit.surface == SurfaceKind::cone || fit.surface == SurfaceKind::cylinder ||
                         fit.surface == SurfaceKind::section || fit.surface == SurfaceKind::plane;
  return has_terms && !fit.set_ups.empty() && fit.points > fit.parameters.size() &&
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

std::vector<double> deviation_from(const ProbeStream& stream, const LinearisationPoint& point) {
  std::vector<double> out(point.size());
  for (std::size_t i = 0; i < point.size(); ++i) out[i] = stream.reading_mm[i] - point.x[i];
  if (!point.base.offset) return out;
  const double zero = median(out);
  for (double& d : out) d -= zero;
  return out;
}

}  // namespace trueaxis::diagnose_detail
