// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulate/contact.hpp"
#include "simulate/recorder.hpp"
#include "simulate/tool_path.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::virtual_lathe {

struct CutPart::Impl {
  CutProgram program;
  ToolPath path;
  bool face = false;
  double inward = 1.0;  // from the nose's centre to its edge along the depth: −1, in a bore +1

  Impl(const CutProgram& cut, const CutTable& table)
      : program(cut),
        path(cut, table),
        face(cut.target.kind == CutKind::face),
        inward(cut.target.bore ? 1.0 : -1.0) {}

  double turn_of(double spindle_angle_rad) const {
    return program.tool.sense * (spindle_angle_rad - program.tool.c_start_rad) / two_pi;
  }
  /// Depth of the nose's edge over a position along the feed; NaN where the nose does not reach.
  double edge_depth(double turn, double position_mm) const {
    const double nose = program.tool.nose_radius_mm;
    const double off = position_mm - path.position_mm(turn);
    const double rest = nose * nose - off * off;
    if (rest < 0.0) return std::numeric_limits<double>::quiet_NaN();
    return path.depth_mm(turn) + inward * std::sqrt(rest);
  }

  /// Machine X of the cutting point in the tool's frame; its Y is the tool's height.
  double edge_radius(double turn, double position_mm) const {
    const double h = program.tool.height_mm;
    if (face) return std::sqrt(std::max(0.0, position_mm * position_mm - h * h));
    const double edge = edge_depth(turn, position_mm);
    return std::isnan(edge) ? path.depth_mm(turn) : edge;
  }

  /// The turn near `whole_turn` whose cutting point lies at theta of the spindle frame: the tool's
  /// frame is at C + angle, the point above its X by the height.
  double turn_through(double theta_rad, double whole_turn, double position_mm) const {
    const double h = program.tool.height_mm;
    double turn = whole_turn + turn_of(theta_rad - program.tool.angle_from_probe_rad);
    if (h == 0.0) return turn;
    const double level = turn;
    for (int i = 0; i < 6; ++i) {
      const double above = std::atan2(h, edge_radius(turn, position_mm));
      turn = level - program.tool.sense * above / two_pi;
    }
    return turn;
  }

  double envelope(double theta_rad, double position_mm) const {
    const double reach = program.tool.nose_radius_mm / program.tool.feed_mm_per_rev + 1.0;
    const double middle = path.turn_at(position_mm);
    const double start = turn_of(theta_rad - program.tool.angle_from_probe_rad);
    double left = std::numeric_limits<double>::quiet_NaN();
    const double first = std::ceil(middle - reach - start),
                 last = std::floor(middle + reach - start);
    for (double whole = first; whole <= last; ++whole) {
      const double turn = turn_through(theta_rad, whole, position_mm);
      if (turn < path.first_turn() || turn > path.last_turn()) continue;
      const double depth = edge_depth(turn, position_mm);
      if (std::isnan(depth)) continue;
      const double cut = face ? depth : std::hypot(depth, program.tool.height_mm);
      if (std::isnan(left) || inward * cut > inward * left) left = cut;
    }
    return left;
  }

  /// A sharp tool: straight from one turn's groove to the next.
  double between_turns(double theta_rad, double position_mm) const {
    const double start = turn_of(theta_rad - program.tool.angle_from_probe_rad);
    const double whole = std::floor(path.turn_at(position_mm) - start);
    double at[2], cut[2];
    for (int i = 0; i < 2; ++i) {
      const double turn = turn_through(theta_rad, whole + i, position_mm);
      if (turn < path.first_turn() || turn > path.last_turn()) {
        return std::numeric_limits<double>::quiet_NaN();
      }
      at[i] = path.position_mm(turn);
      cut[i] = face ? path.depth_mm(turn) : std::hypot(path.depth_mm(turn), program.tool.height_mm);
    }
    return cut[0] + (position_mm - at[0]) / (at[1] - at[0]) * (cut[1] - cut[0]);
  }

  double surface(double theta_rad, double position_mm) const {
    return program.tool.nose_radius_mm > 0.0 ? envelope(theta_rad, position_mm)
                                             : between_turns(theta_rad, position_mm);
  }
};

CutPart::CutPart(const CutProgram& program, const CutTable& table)
    : impl_(std::make_unique<Impl>(program, table)) {}
CutPart::~CutPart() = default;
CutPart::CutPart(CutPart&&) noexcept = default;
CutPart& CutPart::operator=(CutPart&&) noexcept = default;

double CutPart::surface_mm(double theta_rad, double position_mm) const {
  return impl_->surface(theta_rad, position_mm);
}

double CutPart::displacement_mm(double c_rad) const {
  return impl_->path.displacement_mm(impl_->turn_of(c_rad));
}

const CutProgram& CutPart::program() const { return impl_->program; }

namespace {

/// Probes the cut part; the spindle frame is the part's frame.
class CutReader {
 public:
  explicit CutReader(const CutPart& part) : part_(part) {}

  double away() const { return part_.program().target.bore ? -1.0 : 1.0; }

  CleanReading read(const Moment& moment, bool /*with_incidence*/) const {
    const CutTarget& target = part_.program().target;
    constexpr double rounding_mm = 1e-9;
    const auto [low, high] = std::minmax(target.start_mm, target.end_mm);
    if (moment.position_mm < low - rounding_mm || moment.position_mm > high + rounding_mm) {
      miss(moment);
    }
    const SpindleAngle angle(moment.c_rad);
    double reading = 0.0;
    if (target.kind == CutKind::face) {
      const Vec3 p = angle.spindle_from_machine({moment.position_mm, 0.0, 0.0});
      reading = part_.surface_mm(std::atan2(p.y, p.x), std::hypot(p.x, p.y));
    } else {
      const auto gap = [&](double x) {
        const Vec3 p = angle.spindle_from_machine({x, 0.0, moment.position_mm});
        return std::hypot(p.x, p.y) - part_.surface_mm(std::atan2(p.y, p.x), p.z);
      };
      const double guess = part_.surface_mm(moment.c_rad, moment.position_mm);
      if (std::isfinite(guess)) reading = root_near(gap, guess).value_or(missing);
      if (!std::isfinite(guess)) reading = missing;
    }
    if (std::isnan(reading)) miss(moment);
    return {reading, 0.0};
  }

 private:
  static constexpr double missing = std::numeric_limits<double>::quiet_NaN();

  [[noreturn]] static void miss(const Moment& at) {
    throw InputError("cut", fmt::format("the probe leaves the cut length at position = {:g} mm: "
                                        "probe between the ends of the cut",
                                        at.position_mm));
  }

  const CutPart& part_;
};

}  // namespace

ProbeStream probe_cut(const CutPart& part, const Plan& plan, const Noise& noise,
                      std::uint64_t seed) {
  for (const Chucking& setup : plan.setups) {
    if (setup.rear || setup.reindex_rad != 0.0 || setup.z_shift_mm != 0.0) {
      throw InputError("cut", "the cut part is probed as it was chucked: take the set-ups out");
    }
  }
  Scenario scenario;
  scenario.plan = plan;
  scenario.noise = noise;
  const CutKind kind = part.program().target.kind;
  scenario.part.kind = kind == CutKind::face ? PartKind::face : PartKind::cylinder;
  Recording how;
  how.noise = noise;
  how.seed = seed;
  how.sensor.quantisation_mm = noise.quantisation_mm;
  Simulation out =
      record(make_timeline(plan), how, [&](const Chucking&) { return CutReader(part); });
  describe(scenario, out.stream);
  return std::move(out.stream);
}

}  // namespace trueaxis::virtual_lathe
