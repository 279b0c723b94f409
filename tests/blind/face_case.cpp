// SPDX-License-Identifier: Apache-2.0
#include "blind/face_case.hpp"

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <map>

#include "support/dense.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::blind {
namespace {

using virtual_lathe::Scenario;
using Random = std::mt19937_64;

constexpr double inner_mm = 8.0, outer_mm = 40.0, per_turn = 23.7;
constexpr double least_lambda = 60.0, most_lambda = 400.0;

double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
double log_uniform(Random& random, double low, double high) {
  return std::exp(between(random, std::log(low), std::log(high)));
}

/// Tilted by up to 1 mrad; the axis is where the spindle's pierces the face.
Scenario ideal_face(Random& random, bool back) {
  Scenario scenario;
  virtual_lathe::Part& part = scenario.part;
  part.kind = virtual_lathe::PartKind::face;
  const double tilt = between(random, 0.0, 1e-3), towards = between(random, 0.0, two_pi);
  part.l = tilt * std::cos(towards), part.m = tilt * std::sin(towards);
  part.d_mm = between(random, -20.0, 20.0);
  part.x0_mm = -part.l * part.d_mm, part.y0_mm = -part.m * part.d_mm;
  virtual_lathe::PlannedPass pass;
  pass.start_mm = inner_mm, pass.end_mm = outer_mm;
  pass.feed_mm_per_rev = 0.64, pass.readings_per_revolution = per_turn;
  scenario.plan.passes = {pass};
  if (back) {
    std::swap(pass.start_mm, pass.end_mm);
    pass.speed_rpm = 151.0;
    scenario.plan.passes.push_back(pass);
  }
  scenario.noise.sigma_mm = log_uniform(random, 0.5e-3, 2e-3);
  return scenario;
}

/// The parameters except the size.
std::map<std::string, double> shape_of(const std::string& id, Random& random) {
  std::map<std::string, double> shape;
  const auto kind = virtual_lathe::find_effect_kind(id);
  const double middle = 0.5 * (inner_mm + outer_mm), half = 0.5 * (outer_mm - inner_mm);
  const std::map<std::string_view, std::function<double()>> draws{
      {"phase_rad", [&] { return between(random, 0.0, two_pi); }},
      {"radius_mm", [] { return outer_mm; }},
      {"dish_mean", [&] { return (middle * middle + half * half / 3.0) / outer_mm / outer_mm; }},
      {"middle_mm", [&] { return middle; }},
      {"feed_mm_per_rev", [&] { return between(random, 0.1, 0.3); }},
      {"wavelength_mm", [&] { return between(random, 1.5, 10.0); }},
      {"frequency_hz", [&] { return between(random, 2.0, 9.0); }},
      {"degree", [&] { return static_cast<double>(2 + random() % 2); }},
      {"time_s", [&] { return between(random, 8.0, 42.0); }},
      {"ends", [] { return 1.0; }},  // the part is that after the slip
      {"order", [&] {
         return id == "spindle.axial_asynchronous" ? between(random, 1.2, 9.8)
                                                   : static_cast<double>(2 + random() % 7);
       }}};
  for (const virtual_lathe::LatheParameter& p : kind.parameters) {
    if (const auto draw = draws.find(p.name); draw != draws.end())
      shape[std::string(p.name)] = draw->second();
  }
  return shape;
}

/// What of a change of the readings tilt and height of the face do not take in, its square.
double left2(const ProbeStream& stream, const std::vector<double>& other) {
  const auto n = static_cast<Eigen::Index>(stream.size());
  Eigen::MatrixXd base(n, 3);
  Eigen::VectorXd change(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double x = stream.position_mm[k];
    base.row(i) << 1.0, x * std::cos(stream.c_rad[k]), x * std::sin(stream.c_rad[k]);
    change(i) = other[k] - stream.reading_mm[k];
  }
  return dense::residuals(base, change).squaredNorm();
}

}  // namespace

const std::vector<FaceFamily>& face_families() {
  static const std::vector<FaceFamily> list{
      {"part.face_saddle", "amplitude_mm"},
      {"part.face_lobes", "amplitude_mm"},
      {"part.face_cone", "amplitude_mm", 1e-3, FaceHarm::none, true},
      {"part.face_crown", "dish_mm", 1e-3, FaceHarm::none, true},
      {"part.face_spiral", "amplitude_mm"},
      {"part.feed_marks", "amplitude_mm"},
      {"part.waviness", "amplitude_mm"},
      {"part.seat_slip", "dz_mm", 1e-3, FaceHarm::biases},
      {"part.seat_slip", "tilt_x_rad", 1e-5, FaceHarm::biases},
      {"slide.xz_squareness", "slope_rad", 1e-5, FaceHarm::none, true},
      {"slide.x_straightness", "amplitude_mm", 1e-3, FaceHarm::none, true},
      {"spindle.axial_fundamental", "amplitude_mm", 1e-3, FaceHarm::biases},
      {"spindle.axial_synchronous", "amplitude_mm"},
      {"spindle.axial_asynchronous", "amplitude_mm"},
      {"spindle.face_tilt", "amplitude_rad", 1e-5},
      {"thermal.drift", "rate_mm_per_s", 1e-4, FaceHarm::biases, true},
      {"environment.vibration", "amplitude_mm"},
  };
  return list;
}

FaceCase draw_face(const FaceFamily* family, std::uint64_t seed) {
  Random random(seed);
  const bool back = random() % 3 != 0 || (family && family->back);
  FaceCase out;
  out.scenario = ideal_face(random, back);
  out.scenario.seed = seed;
  if (!family) return out;
  out.effect = family->id;
  std::map<std::string, double> parameters = shape_of(family->id, random);
  Scenario clean = out.scenario;
  clean.noise = {};
  const ProbeStream ideal = virtual_lathe::simulate(clean);
  parameters[family->size] = family->unit;
  clean.effects = {{family->id, parameters}};
  const double left = left2(ideal, virtual_lathe::simulate(clean).reading_mm);
  out.lambda = log_uniform(random, least_lambda, most_lambda);
  parameters[family->size] =
      family->unit * out.scenario.noise.sigma_mm * std::sqrt(out.lambda / left);
  out.scenario.effects = {{family->id, parameters}};
  return out;
}

FaceCase draw_section(bool with_effect, std::uint64_t seed) {
  Random random(seed);
  FaceCase out;
  Scenario& scenario = out.scenario;
  scenario.seed = seed;
  scenario.part.kind = virtual_lathe::PartKind::cylinder;
  scenario.part.radius_mm = between(random, 10.0, 60.0);
  scenario.part.x0_mm = between(random, -0.1, 0.1);
  scenario.part.y0_mm = between(random, -0.1, 0.1);
  virtual_lathe::PlannedPass pass;
  pass.start_mm = pass.end_mm = 20.0;
  pass.revolutions = 30.0, pass.readings_per_revolution = 36.7;
  scenario.plan.passes = {pass};
  scenario.noise.sigma_mm = log_uniform(random, 0.5e-3, 2e-3);
  if (!with_effect) return out;
  out.effect = random() % 2 == 0 ? "part.roundness" : "spindle.radial_synchronous";
  out.lambda = log_uniform(random, least_lambda, most_lambda);
  const double readings = 30.0 * 36.7;
  scenario.effects = {
      {out.effect,
       {{"order", static_cast<double>(2 + random() % 8)},
        {"amplitude_mm", scenario.noise.sigma_mm * std::sqrt(2.0 * out.lambda / readings)},
        {"phase_rad", between(random, 0.0, two_pi)}}}};
  return out;
}

}  // namespace trueaxis::blind
