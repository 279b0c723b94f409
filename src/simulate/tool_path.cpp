// SPDX-License-Identifier: Apache-2.0
#include "simulate/tool_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <complex>
#include <cstdint>

#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::virtual_lathe {
namespace {

// Linear interpolation of the motion then errs by A (π/4096)²/2: 0.1 nm of 300 µm.
constexpr double motion_per_turn = 4096.0;
constexpr double line_per_turn = 1.0;

double interpolated(const std::vector<double>& samples, double at) {
  const double last = static_cast<double>(samples.size() - 1);
  const double inside = std::clamp(at, 0.0, last);
  const std::size_t i = std::min(static_cast<std::size_t>(inside), samples.size() - 2);
  return samples[i] + (inside - static_cast<double>(i)) * (samples[i + 1] - samples[i]);
}

/// Depth of the target's section at the tool's height: what the edge has to be at for the radius.
double section_mm(const CutProgram& program, double z_mm) {
  const CutTarget& target = program.target;
  const double radius =
      target.radius_mm + std::tan(target.half_angle_rad) * (z_mm - target.start_mm);
  const double h = program.tool.height_mm;
  return std::sqrt(std::max(0.0, radius * radius - h * h));
}

/// Depth of a nose centre that touches the section and cuts into it nowhere, and where it touches.
struct Touch {
  double centre_depth_mm = 0.0, z_mm = 0.0;
};

/// The extreme of section + circle.
Touch touching(const CutProgram& program, double z_centre_mm) {
  const double nose = program.tool.nose_radius_mm;
  if (nose == 0.0) return {section_mm(program, z_centre_mm), z_centre_mm};
  const double side = program.target.bore ? -1.0 : 1.0;
  const auto negative = [&](double phi) {
    const double z = z_centre_mm + nose * std::sin(phi);
    return -(side * section_mm(program, z) + nose * std::cos(phi));
  };
  std::uintmax_t steps = 200;
  const auto [phi, least] =
      boost::math::tools::brent_find_minima(negative, -0.25 * two_pi, 0.25 * two_pi, 50, steps);
  return {-side * least, z_centre_mm + nose * std::sin(phi)};
}

/// Where the nose's centre is when it touches the section at z; the contact follows the centre. A
/// face is touched at the centre's own place.
double centre_touching_at(const CutProgram& program, double z_mm) {
  const double nose = program.tool.nose_radius_mm;
  if (nose == 0.0 || program.target.kind == CutKind::face) return z_mm;
  std::uintmax_t steps = 200;
  const auto [low, high] = boost::math::tools::bisect(
      [&](double middle) { return touching(program, middle).z_mm - z_mm; }, z_mm - nose,
      z_mm + nose, boost::math::tools::eps_tolerance<double>(), steps);
  return 0.5 * (low + high);
}

/// y'' + 2 ζ ω y' + ω² y = ω² u for a held u, solved exactly: with complex eigenvalues s1, s2 of
/// the homogeneous equation, y − u = a e^{s1 t} + b e^{s2 t}. Any damping but exactly critical,
/// which is moved by 1e-9.
class SecondOrderServo {
 public:
  explicit SecondOrderServo(const CutActuator& actuator) {
    const double w = two_pi * actuator.natural_frequency_hz;
    const double zeta = std::abs(actuator.damping - 1.0) < 1e-9 ? 1.0 + 1e-9 : actuator.damping;
    const std::complex<double> root = std::sqrt(std::complex<double>(zeta * zeta - 1.0));
    s1_ = w * (-zeta + root);
    s2_ = w * (-zeta - root);
  }

  void rest_at(double position_mm) {
    y_ = held_ = position_mm;
    v_ = 0.0;
  }
  /// Sets the held set-point from now on.
  void hold(double set_point_mm) { held_ = set_point_mm; }

  /// Position after `dt` of the present hold, without moving on.
  double position_after(double dt_s) const {
    const auto [a, b] = amplitudes();
    return held_ + (a * std::exp(s1_ * dt_s) + b * std::exp(s2_ * dt_s)).real();
  }
  void advance(double dt_s) {
    const auto [a, b] = amplitudes();
    const std::complex<double> e1 = a * std::exp(s1_ * dt_s), e2 = b * std::exp(s2_ * dt_s);
    y_ = held_ + (e1 + e2).real();
    v_ = (s1_ * e1 + s2_ * e2).real();
  }

 private:
  struct Amplitudes {
    std::complex<double> a, b;
  };
  Amplitudes amplitudes() const {
    const std::complex<double> off = y_ - held_;
    const std::complex<double> a = (v_ - s2_ * off) / (s1_ - s2_);
    return {a, off - a};
  }

  std::complex<double> s1_, s2_;
  double y_ = 0.0, v_ = 0.0, held_ = 0.0;
};

}  // namespace

ToolPath::ToolPath(const CutProgram& program, const CutTable& table)
    : start_mm_(centre_touching_at(program, program.target.start_mm)) {
  const CutTool& tool = program.tool;
  const double travel = centre_touching_at(program, program.target.end_mm) - start_mm_;
  if (travel == 0.0 || !(tool.feed_mm_per_rev > 0.0) || !(tool.speed_rpm > 0.0) ||
      (tool.sense != 1 && tool.sense != -1)) {
    throw InputError("cut", "needs two different ends, feed > 0, speed > 0 and a sense of 1 or -1");
  }
  feed_mm_ = std::copysign(tool.feed_mm_per_rev, travel);
  turns_ = std::abs(travel) / tool.feed_mm_per_rev;
  if (program.runs_on) lead_turns_ = std::ceil(tool.nose_radius_mm / tool.feed_mm_per_rev) + 2.0;
  corrected_ = program.use != CutUse::none;
  perfect_ = program.actuator.perfect;
  if (corrected_) load(program, table);
  program_line(program);
  if (corrected_ && !perfect_) run_actuator(program);
}

void ToolPath::check(const CutProgram& program, const CutTable& table) const {
  const std::size_t count = table.c_rad.size();
  const auto& column = program.use == CutUse::wanted ? table.wanted_mm : table.command_mm;
  const auto need = [](bool condition, const std::string& message) {
    if (!condition) throw InputError("cut", message);
  };
  need(count >= 2 && column.size() == count && table.position_mm.size() == count,
       "the table needs two rows or more");
  need(table.face == (program.target.kind == CutKind::face),
       "the table and the target are not both of a face: name the table of this target");
  for (std::size_t i = 0; i < count; ++i) {
    const double off = table.position_mm[i] - position_mm(row_turn_[i]);
    if (std::abs(off) <= 0.01 * std::abs(feed_mm_) + 1e-5 || stands_at_end(table, i)) continue;
    throw InputError("cut", fmt::format("row {} of the table is {:g} mm off the programmed path: "
                                        "start, feed, c_start or sense differ from the table's",
                                        i + 1, off));
  }
}

bool ToolPath::stands_at_end(const CutTable& table, std::size_t row) const {
  return row_turn_[row] > turns_ &&
         std::abs(table.position_mm[row] - position_mm(turns_)) <= 0.01 * std::abs(feed_mm_) + 1e-5;
}

void ToolPath::load(const CutProgram& program, const CutTable& table) {
  const CutTool& tool = program.tool;
  double start_rad = tool.c_start_rad;
  if (!table.c_rad.empty()) {  // whole turns do not count
    start_rad += two_pi * std::round((table.c_rad.front() - start_rad) / two_pi);
  }
  row_turn_.reserve(table.c_rad.size());
  for (const double c : table.c_rad) row_turn_.push_back(tool.sense * (c - start_rad) / two_pi);
  check(program, table);
  row_mm_ = program.use == CutUse::wanted ? table.wanted_mm : table.command_mm;
  // Past the end the feed of this path goes on: the rows of a table whose feed stops are dropped,
  // except the first.
  std::size_t rows = row_mm_.size();
  while (rows > 2 && stands_at_end(table, rows - 2)) --rows;
  row_mm_.resize(rows);
  row_turn_.resize(rows);
  if (row_turn_.back() - row_turn_.front() < 2.0 && row_turn_.back() < turns_ - 1e-6) {
    throw InputError("cut", "the table ends before the cut does: name the table of this target");
  }
}

void ToolPath::program_line(const CutProgram& program) {
  const double samples = std::ceil((turns_ + 2.0 * lead_turns_) * line_per_turn) + 2.0;
  for (double i = 0.0; i < samples; ++i) {
    const double turn = first_turn() + i / line_per_turn;
    line_mm_.push_back(program.target.kind == CutKind::face
                           ? program.target.z_face_mm + program.tool.nose_radius_mm
                           : touching(program, position_mm(turn)).centre_depth_mm);
  }
}

double ToolPath::table_mm(double turn) const {
  const auto above = std::upper_bound(row_turn_.begin() + 1, row_turn_.end() - 1, turn);
  const std::size_t i = static_cast<std::size_t>(above - row_turn_.begin());
  const double share = (turn - row_turn_[i - 1]) / (row_turn_[i] - row_turn_[i - 1]);
  return row_mm_[i - 1] + share * (row_mm_[i] - row_mm_[i - 1]);
}

// Before the first row and after the last: the same angle of the nearest two turns, continued
// linearly along the feed.
double ToolPath::continued_mm(double turn) const {
  const double first = row_turn_.front(), last = row_turn_.back();
  if (last - first < 2.0) return table_mm(std::clamp(turn, first, last));
  double missing = 0.0;
  if (turn < first) missing = std::ceil(first - turn);
  if (turn > last) missing = -std::ceil(turn - last);
  const double near = turn + missing;
  if (missing == 0.0) return table_mm(near);
  const double next = near + (missing > 0.0 ? 1.0 : -1.0);
  return table_mm(near) + std::abs(missing) * (table_mm(near) - table_mm(next));
}

double ToolPath::programmed_mm(double turn) const {
  return interpolated(line_mm_, (turn - first_turn()) * line_per_turn);
}

double ToolPath::displacement_mm(double turn) const {
  if (!corrected_) return 0.0;
  if (perfect_) return continued_mm(turn);
  return interpolated(motion_mm_, (turn - first_turn()) * motion_per_turn);
}

// Time is turns at constant speed. The set-point read at a tick acts `delay` later and is held for
// one sampling interval. The servo starts at rest one turn before the path is used.
void ToolPath::run_actuator(const CutProgram& program) {
  const CutActuator& actuator = program.actuator;
  const double turns_per_s = program.tool.speed_rpm / 60.0;
  const double tick_s = 1.0 / actuator.sampling_hz;
  const double begin_s = (first_turn() - 1.0) / turns_per_s;
  const double samples = std::ceil((turns_ + 2.0 * lead_turns_) * motion_per_turn) + 2.0;
  if (samples > 5e8) throw InputError("cut", "has more than 1e5 revolutions: raise the feed");
  SecondOrderServo servo(actuator);
  servo.rest_at(continued_mm(begin_s * turns_per_s));
  motion_mm_.reserve(static_cast<std::size_t>(samples));
  double sample = 0.0;
  for (double tick = 0.0; sample < samples; ++tick) {
    const double read_s = begin_s + tick * tick_s, acts_s = read_s + actuator.delay_s;
    servo.hold(continued_mm(read_s * turns_per_s));
    while (sample < samples) {
      const double sample_s = (first_turn() + sample / motion_per_turn) / turns_per_s;
      if (sample_s >= acts_s + tick_s) break;
      motion_mm_.push_back(servo.position_after(std::max(0.0, sample_s - acts_s)));
      ++sample;
    }
    servo.advance(tick_s);
  }
}

}  // namespace trueaxis::virtual_lathe
