// SPDX-License-Identifier: Apache-2.0
#include "report/chart_readings.hpp"

#include <algorithm>
#include <cmath>

#include "resimulate/diagnosed_scenarios.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

bool finite(const Axis& axis) {
  return std::isfinite(axis.x_mm + axis.y_mm + axis.slope_x + axis.slope_y + axis.z_ref_mm);
}

std::vector<bool> kept_readings(const ProbeStream& stream, const FitResult& fit) {
  std::vector<bool> kept = marked(fit.rejected, stream.size());
  kept.flip();
  return kept;
}

double readings_per_turn(const ProbeStream& stream) {
  double travel_rad = 0.0;
  for (std::size_t i = 1; i < stream.size(); ++i) {
    travel_rad += std::abs(stream.c_rad[i] - stream.c_rad[i - 1]);
  }
  const double count = static_cast<double>(stream.size());
  return travel_rad > two_pi ? count * two_pi / travel_rad : count;
}

}  // namespace

bool fit_is_usable(const ProbeStream& stream, const FitResult& fit) {
  const bool solved = fit.status == FitStatus::converged || fit.status == FitStatus::max_iterations;
  if (!solved || fit.residual_mm.size() != stream.size() || stream.size() == 0) return false;
  if (!finite(fit.axis.axis)) return false;
  if (stream.kind == StreamKind::face) return true;
  return finite(fit.shape.axis) && std::isfinite(fit.shape.radius_mm + fit.shape.tan_half_angle);
}

double position_of(const ProbeStream& stream, const FitResult& fit, std::size_t i) {
  if (stream.has_position()) return stream.position_mm[i];
  return std::isfinite(fit.shape.axis.z_ref_mm) ? fit.shape.axis.z_ref_mm : 0.0;
}

CoaxialNominal::CoaxialNominal(const ProbeStream& stream, const FitResult& fit)
    : face_(stream.kind == StreamKind::face),
      from_fit_(fit_is_usable(stream, fit)),
      shape_(face_ ? Revolved{fit.axis.axis} : fit.shape) {
  if (from_fit_) {
    position_ref_mm_ = face_ ? 0.0 : shape_.axis.z_ref_mm;
    level_mm_ = face_ ? 0.0 : shape_.radius_mm;
    slope_ = face_ ? 0.0 : shape_.tan_half_angle;
    take_constant(stream, fit);
  } else {
    take_straight_line(stream);
  }
}

double CoaxialNominal::reading_mm(double position_mm) const {
  return level_mm_ + slope_ * (position_mm - position_ref_mm_);
}

double CoaxialNominal::contact_mm(double c_rad, double position_mm) const {
  if (face_) {  // the plane l x + m y + n z = 0 with x = X cos C, y = X sin C
    return -position_mm *
           (shape_.axis.slope_x * std::cos(c_rad) + shape_.axis.slope_y * std::sin(c_rad));
  }
  const Intersection contact = intersect(shape_, c_rad, position_mm);
  return contact.hit ? contact.x_mm : not_there;
}

double CoaxialNominal::model_deviation_mm(double c_rad, double position_mm) const {
  if (!from_fit_) return not_there;
  const double true_running =
      face_ ? 0.0 : shape_.radius_mm + shape_.tan_half_angle * (position_mm - position_ref_mm_);
  return contact_mm(c_rad, position_mm) - true_running;
}

void CoaxialNominal::take_constant(const ProbeStream& stream, const FitResult& fit) {
  const std::size_t step = std::max<std::size_t>(1, stream.size() / 2000);
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < stream.size(); i += step) {
    const double predicted = stream.reading_mm[i] - fit.residual_mm[i];
    const double gap = predicted - contact_mm(stream.c_rad[i], position_of(stream, fit, i));
    if (!std::isfinite(gap)) continue;
    sum += gap;
    ++count;
  }
  if (count != 0) level_mm_ += sum / static_cast<double>(count);
}

void CoaxialNominal::take_straight_line(const ProbeStream& stream) {
  const double count = static_cast<double>(std::max<std::size_t>(1, stream.size()));
  double mean = 0.0, mean_position = 0.0, covariance = 0.0, variance = 0.0;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    mean += stream.reading_mm[i] / count;
    if (stream.has_position()) mean_position += stream.position_mm[i] / count;
  }
  for (std::size_t i = 0; i < stream.size() && stream.has_position(); ++i) {
    const double from_mean = stream.position_mm[i] - mean_position;
    covariance += from_mean * (stream.reading_mm[i] - mean);
    variance += from_mean * from_mean;
  }
  level_mm_ = mean;
  position_ref_mm_ = mean_position;
  slope_ = variance > 0.0 ? covariance / variance : 0.0;
}

std::vector<std::size_t> ChartReadings::rejected() const {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i]) rows.push_back(i);
  }
  return rows;
}

double wrapped_deg(double c_rad) {
  const double turns = c_rad / two_pi;
  const double degrees = rounded(360.0 * (turns - std::floor(turns)), 3);
  return degrees >= 360.0 ? 0.0 : degrees;
}

Bins map_rows(const ChartReadings& all) {
  constexpr double most = 80.0;
  const double turns = static_cast<double>(all.kept.size()) / all.readings_per_turn;
  const double count = std::clamp(std::floor(turns), 1.0, most);
  return bins_over(all.position_mm, static_cast<std::size_t>(count));
}

ChartReadings chart_readings(const ProbeStream& stream, const FitResult& fit,
                             const CoaxialNominal& nominal) {
  ChartReadings all;
  all.has_model = nominal.from_fit();
  all.has_position = stream.has_position();
  all.time_s = stream.time_s;
  all.kept = kept_readings(stream, fit);
  all.readings_per_turn = readings_per_turn(stream);
  for (std::size_t i = 0; i < stream.size(); ++i) {
    const double position = position_of(stream, fit, i);
    all.c_deg.push_back(wrapped_deg(stream.c_rad[i]));
    all.position_mm.push_back(position);
    all.deviation_um.push_back((stream.reading_mm[i] - nominal.reading_mm(position)) / mm_per_um);
    if (all.has_model) all.residual_um.push_back(fit.residual_mm[i] / mm_per_um);
    if (all.has_model && !std::isfinite(fit.residual_mm[i])) all.kept[i] = false;
  }
  return all;
}

}  // namespace trueaxis
