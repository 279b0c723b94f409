// SPDX-License-Identifier: Apache-2.0
#include "support/report_example.hpp"

namespace trueaxis::example {

Axis true_axis() {
  const double towards = 37.0 * rad_per_deg, leans = 110.0 * rad_per_deg;
  return {0.11 * std::cos(towards), 0.11 * std::sin(towards), 1e-3 * std::cos(leans),
          1e-3 * std::sin(leans), 0.0};
}

Revolved true_cone() { return {true_axis(), 50.0, std::tan(5.0 * rad_per_deg)}; }

double contact_mm(const Revolved& cone, double c_rad, double z_mm) {
  const auto [x, y] = cone.axis.at(z_mm);
  const double along = x * std::cos(c_rad) + y * std::sin(c_rad);
  const double across = y * std::cos(c_rad) - x * std::sin(c_rad);
  const double lean = cone.axis.slope_x * std::cos(c_rad) + cone.axis.slope_y * std::sin(c_rad);
  const double level = cone.radius_mm + cone.tan_half_angle * (z_mm - cone.axis.z_ref_mm);
  const double radius = level + cone.tan_half_angle * level * lean;
  return along + std::sqrt(radius * radius - across * across);
}

FitParameter parameter(std::string name, double value, double u, std::string unit) {
  const bool angle = unit == "deg";
  const double inside = angle ? rad_per_deg : 1.0;
  return {std::move(name), {inside * value, inside * u, angle ? "rad" : std::move(unit), ""}};
}

ProbeStream helix(std::size_t readings, double length_mm) {
  ProbeStream stream;
  const double count = static_cast<double>(readings), revolutions = 50.3;
  for (std::size_t i = 0; i < readings; ++i) {
    const double share = static_cast<double>(i) / count;
    stream.c_rad.push_back(share * revolutions * two_pi);
    stream.position_mm.push_back(share * length_mm);
    stream.time_s.push_back(share * revolutions);
  }
  stream.spindle_rpm = 60.0;
  stream.source = "cone.csv";
  stream.input_hash = "xxh3-64:0123456789abcdef";
  return stream;
}

void read_surface(ProbeStream& stream, FitResult& fit, const Revolved& surface) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, noise_mm);
  for (std::size_t i = 0; i < stream.c_rad.size(); ++i) {
    double off = noise(random);
    if (i % 311 == 200) {  // a chip under the probe
      off += 0.028 + 1e-5 * static_cast<double>(i % 7);
      fit.rejected.push_back({i + 1, std::to_string(static_cast<int>(1000.0 * off)) + " µm off"});
    }
    stream.reading_mm.push_back(contact_mm(surface, stream.c_rad[i], stream.position_mm[i]) + off);
    fit.residual_mm.push_back(off);
  }
  fit.status = FitStatus::converged;
  fit.loss = Loss::tukey;
  fit.shape = surface;
  fit.axis.axis = surface.axis;
  fit.rms_mm = fit.sigma_mm = noise_mm;
  fit.sigma_source = SigmaSource::robust_residuals;
  fit.autocorrelation = 0.02;
  fit.notes = {"neighbouring residuals correlate (0.02): form or slow noise"};
  fit.points = stream.size();
  fit.iterations = 4;
  const auto [low, high] =
      std::minmax_element(stream.position_mm.begin(), stream.position_mm.end());
  fit.position_min_mm = *low;
  fit.position_max_mm = *high;
  fit.input_hash = stream.input_hash;
  fit.source = stream.source;
  for (const AxisRow i : {AxisRow::x, AxisRow::y}) fit.axis.covariance(i, i) = 1.7e-4 * 1.7e-4;
  for (const AxisRow i : {AxisRow::slope_x, AxisRow::slope_y})
    fit.axis.covariance(i, i) = 9e-6 * 9e-6;
}

FitResult cone_fit(ProbeStream& stream) {
  FitResult fit;
  fit.surface = SurfaceKind::cone;
  const Revolved cone = true_cone();
  read_surface(stream, fit, cone);
  const Axis axis = cone.axis;
  fit.parameters = {parameter("x0", axis.x_mm, 1.7e-4, "mm"),
                    parameter("y0", axis.y_mm, 1.7e-4, "mm"),
                    parameter("l", axis.slope_x, 9e-6, "1"),
                    parameter("m", axis.slope_y, 9e-6, "1"),
                    parameter("k", -50.0 / cone.tan_half_angle, 0.041, "mm"),
                    parameter("half_angle", 5.0, 3.6e-4, "deg")};
  fit.derived = {parameter("radius_mid", 50.0 + 15.0 * cone.tan_half_angle, 6e-5, "mm"),
                 parameter("offset_start", 0.11, 1.7e-4, "mm"),
                 parameter("offset_end", 0.1233, 1.9e-4, "mm"),
                 parameter("tilt", 0.0572958, 5.2e-4, "deg")};
  fit.budget = {{"noise of the readings", 'A', {1.2e-4, 1.2e-4, 8e-6, 8e-6, 0.04, 3.5e-4}},
                {"probe height", 'B', {1.1e-4, 1.1e-4, 1e-6, 1e-6, 0.002, 1e-5}},
                {"probe gain", 'B', {5e-5, 4e-5, 4e-6, 4e-6, 0.008, 7e-5}}};
  return fit;
}

Correction cylinder_correction(const AxisEstimate& axis) {
  Correction correction;
  correction.axis = axis;
  correction.target.z_start_mm = 25.0;
  correction.target.z_end_mm = 10.0;
  correction.target.radius_mm = 30.0;
  correction.tool.nose_radius_mm = 0.4;
  const Revolved cylinder{axis.axis, 30.0, 0.0};
  const double lag_rad = 1.337 * rad_per_deg;
  for (int row = 0; row < 150 * 360; ++row) {
    const double c_rad = row * rad_per_deg, z_mm = 25.0 - 0.1 * row / 360.0;
    correction.rows.revolution.push_back(row / 360);
    correction.rows.position_mm.push_back(z_mm);
    correction.rows.c_rad.push_back(c_rad);
    correction.rows.wanted_mm.push_back(contact_mm(cylinder, c_rad, z_mm) - 30.0);
    correction.rows.command_mm.push_back(contact_mm(cylinder, c_rad + lag_rad, z_mm) - 30.0);
  }
  const auto [xs, ys] = axis.axis.at(25.0);
  const auto [xe, ye] = axis.axis.at(10.0);
  const double start = std::hypot(xs, ys), end = std::hypot(xe, ye);
  correction.harmonics = {{0, start * start / 120.0, 0.0, end * end / 120.0, 0.0, 1.0, 0.0},
                          {1, start, std::atan2(ys, xs), end, std::atan2(ye, xe), 1.00001, lag_rad},
                          {2, start * start / 120.0, 2 * std::atan2(ys, xs), end * end / 120.0,
                           2 * std::atan2(ye, xe), 1.00002, 2 * lag_rad}};
  correction.margin = {2.0 * start, 0.54,   start * two_pi * 10.0,
                       200.0,       20.0,   600.0,
                       2000.0,      0.0028, 4.1e-5,
                       2.0e-5,      0.001,  true,
                       {},          2950.0, {}};
  return correction;
}

JobResult cone_job(std::size_t readings) {
  JobResult result;
  ProbeStream stream = helix(readings, 30.0);
  result.fits.push_back(cone_fit(stream));
  result.streams.push_back(std::move(stream));
  JobReference reference;
  reference.name = "taper seat";
  reference.fit.loss = Loss::tukey;
  reference.fit.influences = {{Influence::Kind::probe_height, 0.05},
                              {Influence::Kind::probe_gain, 0.001}};
  result.job.references.push_back(reference);
  result.job.name = "Spindle nose, re-cut after hardening";
  result.job.coaxiality_tolerance_mm = 0.005;
  const AxisEstimate axis = result.fits.front().axis;
  result.correction = cylinder_correction(axis);
  result.job.target = result.correction->target;
  result.job.tool = result.correction->tool;
  const auto [x, y] = axis.axis.at(25.0);
  result.target_axis = TargetAxis{axis, {{"taper seat", 0.0, 0.0, 0.0, 0.0, 2 * 2.8e-4, 1.4e-3}}};
  Verdict& verdict = result.verdict;
  verdict.decision = Decision::go;
  verdict.coaxiality_before_mm = 2.0 * std::hypot(x, y);
  verdict.coaxiality_after_mm = 8.2e-5;
  verdict.u_coaxiality_mm = 2 * 2.8e-4;
  verdict.upper_mm = 1.4e-3;
  const Reason expected{
      ReasonCode::coaxiality_expected,
      {},
      {{"at_most", verdict.upper_mm, "mm"}, {"without", verdict.coaxiality_before_mm, "mm"}},
      {},
      {{ReasonCode::with_the_table}}};
  verdict.reasons = {
      {ReasonCode::tolerance_kept, {}, {{"tolerance", 0.005, "mm"}}, {}, {expected}}};
  return result;
}

JobResult rank_deficient_job() {
  JobResult result = cone_job(600);
  FitResult& fit = result.fits.front();
  fit.status = FitStatus::rank_deficient;
  fit.message = "The readings do not tell a cone from a cylinder: probe a second height.";
  fit.not_determined = {"k and half_angle together"};
  for (FitParameter& lost : fit.parameters) {
    if (lost.name != "k" && lost.name != "half_angle") continue;
    lost.estimate.value = lost.estimate.u = std::nan("");
    lost.estimate.why_not = "one height only: every taper fits";
  }
  for (FitParameter& lost : fit.derived)
    lost.estimate = {std::nan(""), std::nan(""), "mm", "no axis"};
  fit.shape = {
      {std::nan(""), std::nan(""), std::nan(""), std::nan(""), 0.0}, std::nan(""), std::nan("")};
  fit.axis.axis = fit.shape.axis;
  fit.budget.clear();
  result.target_axis.reset();
  result.correction.reset();
  result.job.target.reset();
  result.verdict = {};
  result.verdict.reasons = {{ReasonCode::fit_failed,
                             {0},
                             {},
                             {{"message", "the axis is not determined"}, {"turns", "5 turns"}}}};
  return result;
}

JobResult section_job() {
  JobResult result = cone_job(180);
  ProbeStream& stream = result.streams.front();
  FitResult& fit = result.fits.front();
  fit.surface = SurfaceKind::section;
  const auto [x, y] = true_axis().at(12.0);
  fit.shape = {{x, y, 0.0, 0.0, 0.0}, 50.0, 0.0};
  fit.axis.axis = fit.shape.axis;
  fit.parameters = {parameter("x0", x, 2.1e-4, "mm"), parameter("y0", y, 2.1e-4, "mm"),
                    parameter("radius", 50.0, 1.5e-4, "mm")};
  fit.derived.clear();
  fit.budget = {{"noise of the readings", 'A', {2.1e-4, 2.1e-4, 1.5e-4}}};
  stream.position_mm.clear();
  for (std::size_t i = 0; i < stream.size(); ++i) {
    stream.c_rad[i] = static_cast<double>(i) * 10.0 * rad_per_deg;
    stream.reading_mm[i] = contact_mm(fit.shape, stream.c_rad[i], 0.0) + fit.residual_mm[i];
  }
  return result;
}

void add_face(JobResult& result) {
  ProbeStream stream;
  stream.kind = StreamKind::face;
  stream.source = "face.csv";
  stream.input_hash = "xxh3-64:fedcba9876543210";
  FitResult fit;
  fit.surface = SurfaceKind::plane;
  std::mt19937_64 random(seed + 1);
  std::normal_distribution<double> noise(0.0, noise_mm);
  const Axis axis{0.0, 0.0, 4e-4, -2e-4, 0.0};
  for (int i = 0; i < 720; ++i) {
    const double c_rad = i * 5.0 * rad_per_deg, x_mm = 20.0 + 25.0 * i / 720.0, off = noise(random);
    stream.c_rad.push_back(c_rad);
    stream.position_mm.push_back(x_mm);
    stream.reading_mm.push_back(
        12.0 - x_mm * (axis.slope_x * std::cos(c_rad) + axis.slope_y * std::sin(c_rad)) + off);
    fit.residual_mm.push_back(off);
  }
  fit.status = FitStatus::converged;
  fit.axis.axis = axis;
  fit.axis.covariance(AxisRow::slope_x, AxisRow::slope_x) =
      fit.axis.covariance(AxisRow::slope_y, AxisRow::slope_y) = 5e-6 * 5e-6;
  fit.parameters = {parameter("l", 4e-4, 5e-6, "1"), parameter("m", -2e-4, 5e-6, "1"),
                    parameter("d", 12.0, 7.5e-5, "mm")};
  fit.budget = {{"noise of the readings", 'A', {5e-6, 5e-6, 7.5e-5}}};
  fit.rms_mm = fit.sigma_mm = noise_mm;
  fit.sigma_source = SigmaSource::residuals;
  fit.points = stream.size();
  fit.iterations = 2;
  fit.position_min_mm = 20.0;
  fit.position_max_mm = 45.0;
  fit.input_hash = stream.input_hash;
  fit.source = stream.source;
  JobReference reference;
  reference.name = "shoulder face";
  reference.fit.surface = SurfaceKind::plane;
  reference.weight = 0.5;
  reference.face_radius_mm = 45.0;
  result.job.references.push_back(reference);
  result.streams.push_back(stream);
  result.fits.push_back(fit);
}

JobResult shaft_and_face_job() {
  JobResult result = cone_job(900);
  result.job.references.front().name = "bearing seat";
  ProbeStream& stream = result.streams.front();
  FitResult& fit = result.fits.front();
  stream.indication = Indication::relative;
  stream.nominal_radius_mm = 50.0;
  stream.time_s.clear();
  const Revolved cylinder{true_axis(), 50.0, 0.0};
  for (std::size_t i = 0; i < stream.size(); ++i) {
    stream.reading_mm[i] =
        contact_mm(cylinder, stream.c_rad[i], stream.position_mm[i]) - 49.7 + fit.residual_mm[i];
  }
  fit.surface = SurfaceKind::cylinder;
  fit.shape = cylinder;
  fit.parameters.resize(4);
  fit.parameters.push_back(
      {"radius", {50.0, std::nan(""), "mm", "a gauge reads differences: nominal"}});
  fit.budget.clear();
  add_face(result);
  result.target_axis->axis.axis.slope_x += 2e-4;
  result.target_axis->remainders = {{"bearing seat", 0.001, 0.0021, 2e-4, 0.0042, 3e-4},
                                    {"shoulder face", 0.0, 0.0, 9e-4, 0.081, 4e-4}};
  ActuatorMargin& margin = result.correction->margin;
  margin.following_mm = 0.0031;
  margin.slew_used_mm_per_s = 231.0;
  margin.follows = false;
  margin.breaks = {
      {ReasonCode::slew_exceeded, {}, {{"used", 231.0, "mm/s"}, {"available", 200.0, "mm/s"}}},
      {ReasonCode::following_error_exceeded,
       {},
       {{"used", 0.0031, "mm"}, {"available", 0.001, "mm"}}}};
  margin.max_speed_rpm = 410.0;
  result.verdict.decision = Decision::no_go;
  const Reason speed{ReasonCode::at_speed_or_less, {}, {{"speed", 410.0, "rpm"}}};
  margin.remedies = {{ReasonCode::follows_at_speed, {}, {}, {}, {speed}}};
  result.verdict.reasons = {
      {ReasonCode::actuator_cannot_follow, {}, {}, {}, margin.breaks, margin.remedies}};
  return result;
}

}  // namespace trueaxis::example
