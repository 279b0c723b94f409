// SPDX-License-Identifier: Apache-2.0
#include "form/section_model.hpp"

#include <algorithm>
#include <cmath>

#include "form/sampling.hpp"
#include "math/statistics.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::form {
namespace {

constexpr double least_lobe_mm = 1e-9;  // rounding

/// A section of more readings than this many a wave at the cut-off (and than 8192) is averaged to
/// it: an average over one of 200 places lets 0.99996 of the wave through.
constexpr double places_a_wave = 200.0;

double root_mean_square(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double largest_known(std::span<const double> values) {
  double largest = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return largest;
}

/// Distances and angles about another pole.
void move_pole(SectionReadings& readings, double x_mm, double y_mm) {
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const double x = readings.distance_mm[i] * std::cos(readings.angle_rad[i]) - x_mm;
    const double y = readings.distance_mm[i] * std::sin(readings.angle_rad[i]) - y_mm;
    readings.distance_mm[i] = std::hypot(x, y);
    readings.angle_rad[i] = std::atan2(y, x);
  }
}

}  // namespace

double shown_noise_mm(const Trace& trace) {
  std::vector<double> off;
  const std::size_t n = trace.size();
  for (std::size_t i = trace.closed() ? 0 : 1; i + (trace.closed() ? 0 : 1) < n; ++i) {
    const std::size_t before = (i + n - 1) % n, behind = (i + 1) % n;
    const double to_before = trace.step(before), all = to_before + trace.step(i);
    const double a = to_before / all;
    const double line = (1.0 - a) * trace.value_mm[before] + a * trace.value_mm[behind];
    off.push_back((trace.value_mm[i] - line) / std::sqrt(1.0 + a * a + (1.0 - a) * (1.0 - a)));
  }
  return mad_sigma(off);
}

std::string short_name(Criterion criterion, const char* suffix) {
  constexpr const char* prefix[] = {"LS", "MZ", "MC", "MI"};
  return std::string(prefix[static_cast<std::size_t>(criterion)]) + suffix;
}

SectionModel::SectionModel(const SectionReadings& given, bool radius_known,
                           const FormOptions& options)
    : z_mm_(given.z_mm), turns_(given.turns), readings_(given.size()) {
  SectionReadings readings = given;
  if (readings.size() < 4) {
    trouble_ = "fewer than 4 readings";
    return;
  }
  double mean = 0.0;
  for (const double one : readings.distance_mm) mean += one / static_cast<double>(given.size());
  plane_radius_mm_ = radius_known ? mean : 0.0;
  std::vector<double> off = readings.distance_mm;
  for (double& one : off) one -= plane_radius_mm_;
  const AssociatedCircle circle =
      associate_circle(readings.angle_rad, off, plane_radius_mm_, Criterion::gaussian);
  x_mm_ = circle.x_mm;
  y_mm_ = circle.y_mm;
  mean_mm_ = circle.radius_mm;
  if (radius_known) {
    move_pole(readings, x_mm_, y_mm_);
    for (std::size_t i = 0; i < off.size(); ++i) off[i] = readings.distance_mm[i] - mean_mm_;
    plane_radius_mm_ = mean_mm_;
  } else {
    off = circle.off_mm;
  }
  const auto most = static_cast<std::size_t>(std::max(8192.0, places_a_wave * options.high_upr));
  raw_ = sorted_trace(readings.angle_rad, off, two_pi, std::max(1.0, turns_),
                      readings.size() > most ? most : 0);
  if (raw_.size() < 4) {
    trouble_ = "fewer than 4 readings at different angles";
    return;
  }
  trouble_ = sampling_trouble(raw_, options);
  if (!trouble_.empty()) return;
  const double averaged = static_cast<double>(raw_.size()) / static_cast<double>(readings_);
  noise_mm_ = std::max(shown_noise_mm(raw_), options.noise_mm.value_or(0.0) * std::sqrt(averaged));
  make_filter(options);
  profile_mm_ = filtered(raw_.value_mm);
  orders_ = harmonics_of(
      raw_, std::max(1, std::min(highest_order(raw_), static_cast<int>(raw_.size()) / 3)));
  for (const Criterion criterion : form_criteria) {
    circles_.emplace_back(limacon_rows(raw_.at), criterion);
    circles_.back()(profile_mm_);
  }
}

void SectionModel::make_filter(const FormOptions& options) {
  cutoff_rad_ = two_pi / options.high_upr;
  low_upr_ = options.low_upr;
  high_upr_ = options.filter == ProfileFilter::none ? 1e9 : options.high_upr;
  high_ = low_pass(options.filter, raw_, cutoff_rad_);
  if (high_ && options.low_upr > 1.0)
    low_ = low_pass(options.filter, raw_, two_pi / options.low_upr);
  const double longest =
      options.filter == ProfileFilter::none ? 0.1 * two_pi : longest_step(cutoff_rad_);
  slope_ = std::make_shared<Derivative>(raw_, longest);
}

std::vector<double> SectionModel::filtered(std::span<const double> value_mm) const {
  if (!high_) return {value_mm.begin(), value_mm.end()};
  std::vector<double> out = (*high_)(value_mm);
  if (!low_) return out;
  const std::vector<double> longer = (*low_)(out);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] -= longer[i];
  return out;
}

std::vector<NamedValue> SectionModel::assess(std::span<const double> filtered_mm,
                                             bool exactly) const {
  std::vector<NamedValue> values;
  for (const Criterion criterion : form_criteria) {
    std::vector<double> off;
    if (exactly) {
      off = associate_circle(raw_.at, filtered_mm, plane_radius_mm_, criterion).off_mm;
    } else {
      const Exchange& at_optimum = circles_[static_cast<std::size_t>(criterion)];
      Exchange circle = at_optimum;
      off = circle.off(filtered_mm, circle(filtered_mm));
    }
    const auto [low, high] = range_of(off);
    const std::string about = short_name(criterion, "CI");
    values.push_back({"section", "RONt", about, high - low});
    values.push_back({"section", "RONp", about, std::max(0.0, high)});
    values.push_back({"section", "RONv", about, std::max(0.0, -low)});
    values.push_back({"section", "RONq", about, root_mean_square(off)});
  }
  values.push_back({"section", "slope", "", largest_known((*slope_)(filtered_mm)), "mm/rad"});
  return values;
}

AxisOffset SectionModel::centre(std::span<const double> filtered_mm) const {
  Exchange least = circles_.front();
  const Eigen::VectorXd q = least(filtered_mm).q;
  return {x_mm_ + q[1], y_mm_ + q[2]};
}

SectionForm SectionModel::form() const {
  SectionForm form;
  form.z_mm = z_mm_;
  form.readings = readings_;
  form.turns = turns_;
  form.noise_mm = noise_mm_;
  if (high_) {
    form.points_per_cycle = points_per_cycle(raw_, cutoff_rad_);
    for (const Gap& gap : gaps_of(raw_, longest_step(cutoff_rad_))) form.gaps_rad += gap.length;
    form.transmission = measured_transmission(raw_, *high_, cutoff_rad_);
  }
  for (const Criterion criterion : form_criteria) {
    const AssociatedCircle circle =
        associate_circle(raw_.at, profile_mm_, plane_radius_mm_, criterion);
    FormCircle& out = form.circles.emplace_back();
    out.criterion = criterion;
    out.x_mm = x_mm_ + circle.x_mm;
    out.y_mm = y_mm_ + circle.y_mm;
    out.radius_mm = circle.radius_mm + (radius_known() ? 0.0 : mean_mm_);
    out.why_not = circle.why;
    for (const Nearest::Touch& touch : circle.touches)
      out.touches.push_back({raw_.at[touch.reading], touch.multiplier});
  }
  double squares = 0.0, largest = 0.0;
  for (const Order& one : orders_) {
    if (one.order == 0) continue;
    form.harmonics.push_back(
        {one.order, one.amplitude_mm(), one.phase_rad(), noise_mm_ * one.u_per_sigma});
    if (one.order < 2 || one.order < low_upr_ || one.order > high_upr_) continue;
    const double square = one.amplitude_mm() * one.amplitude_mm();
    squares += square;
    const double noise = noise_mm_ * one.u_per_sigma;
    if (square > largest && square > shown_over_noise * noise * noise &&
        one.amplitude_mm() > least_lobe_mm) {
      largest = square;
      form.lobes = one.order;
    }
  }
  form.lobes_share = squares > 0.0 ? largest / squares : 0.0;
  const double n = static_cast<double>(raw_.size());
  const FormCircle& least = form.circles.front();
  const double u_centre = form.harmonics.empty() ? 0.0 : form.harmonics.front().u_mm;
  form.values.push_back(
      {"eccentricity", "LSCI", {std::hypot(least.x_mm, least.y_mm), u_centre, "mm", ""}, 0.0});
  if (radius_known())
    form.values.push_back(
        {"radius", "LSCI", {least.radius_mm, noise_mm_ / std::sqrt(n), "mm", ""}, 0.0});
  form.profile = {raw_.at, raw_.value_mm, profile_mm_};
  return form;
}

}  // namespace trueaxis::form
