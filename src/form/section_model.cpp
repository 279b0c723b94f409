// SPDX-License-Identifier: Apache-2.0
#include "form/section_model.hpp"

#include <algorithm>
#include <limits>

#include "form/sampling.hpp"
#include "math/statistics.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::form {
namespace {

/// d/dx of the Lagrange polynomials through `at` at its entry `here`.
std::array<double, 5> lagrange_slopes(const std::array<double, 5>& at, std::size_t here) {
  std::array<double, 5> weight{};
  for (std::size_t j = 0; j < 5; ++j) {
    if (j == here) {
      for (std::size_t m = 0; m < 5; ++m)
        if (m != here) weight[j] += 1.0 / (at[here] - at[m]);
      continue;
    }
    double product = 1.0 / (at[j] - at[here]);
    for (std::size_t m = 0; m < 5; ++m)
      if (m != j && m != here) product *= (at[here] - at[m]) / (at[j] - at[m]);
    weight[j] = product;
  }
  return weight;
}

double from_surface_mm(const FormOptions& options) {
  return options.bore ? -options.ball_radius_mm : options.ball_radius_mm;
}

}  // namespace

Derivative::Derivative(const Trace& trace, double longest_step)
    : stencils_(trace.size()), known_(trace.size(), false) {
  const auto n = static_cast<std::ptrdiff_t>(trace.size());
  const auto wrapped = [&](std::ptrdiff_t i) {
    return static_cast<std::size_t>(((i % n) + n) % n);
  };
  const auto joined = [&](std::ptrdiff_t i) {  // reading i with the next one
    if (!trace.closed() && (i < 0 || i + 1 >= n)) return false;
    return trace.step(wrapped(i)) <= longest_step;
  };
  if (n < 5) return;
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    for (const std::ptrdiff_t left : {2, 1, 3, 0, 4}) {  // as much to the left; the middle first
      bool whole = true;
      for (std::ptrdiff_t j = i - left; j < i - left + 4; ++j) whole = whole && joined(j);
      if (!whole) continue;
      std::array<double, 5> at{};
      Stencil& stencil = stencils_[static_cast<std::size_t>(i)];
      for (std::size_t k = 0; k < 5; ++k) {
        const std::ptrdiff_t j = i - left + static_cast<std::ptrdiff_t>(k);
        stencil.reading[k] = wrapped(j);
        at[k] = trace.at[wrapped(j)] + (j < 0 ? -trace.period : j >= n ? trace.period : 0.0);
      }
      stencil.weight = lagrange_slopes(at, static_cast<std::size_t>(left));
      known_[static_cast<std::size_t>(i)] = true;
      break;
    }
  }
}

std::vector<double> Derivative::operator()(std::span<const double> value) const {
  expects(value.size() == stencils_.size(), "a value for every place");
  std::vector<double> out(value.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!known_[i]) continue;
    double sum = 0.0;
    for (std::size_t k = 0; k < 5; ++k)
      sum += stencils_[i].weight[k] * value[stencils_[i].reading[k]];
    out[i] = sum;
  }
  return out;
}

namespace {

constexpr double least_lobe_mm = 1e-9;  // rounding

double largest_known(std::span<const double> values) {
  double largest = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return largest;
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

SectionModel::SectionModel(const SectionReadings& readings, bool radius_known,
                           const FormOptions& options)
    : trace_(readings, radius_known, options.high_upr),
      z_mm_(readings.z_mm),
      bore_(options.bore),
      from_surface_mm_(from_surface_mm(options)),
      turns_(readings.turns),
      readings_(readings.size()),
      trouble_(trace_.trouble()) {
  if (trouble_.empty()) trouble_ = sampling_trouble(raw(), options);
  if (!trouble_.empty()) return;
  averaged_ = static_cast<double>(raw().size()) / static_cast<double>(readings_);
  noise_mm_ = shown_mm_ = shown_noise_mm(raw());
  make_filter(options);
  profile_mm_ = filtered(raw().value_mm);
  orders_ = harmonics_of(
      raw(), std::max(1, std::min(highest_order(raw()), static_cast<int>(raw().size()) / 3)));
  associate_circles(options.all_references);
}

SectionModel::SectionModel(StationOfSurface station, bool radius_known, const FormOptions& options)
    : trace_(station.raw, {station.x_mm, station.y_mm, station.mean_mm}, radius_known),
      z_mm_(station.z_mm),
      bore_(options.bore),
      from_surface_mm_(from_surface_mm(options)),
      noise_mm_(station.noise_mm),
      shown_mm_(station.noise_mm),
      low_upr_(options.low_upr),
      high_upr_(options.high_upr),
      turns_(station.turns),
      readings_(station.readings),
      profile_mm_(station.profile_mm),
      orders_(station.orders) {
  make_slope(options);
  associate_circles(options.all_references);
  station_ = std::move(station);
}

void SectionModel::associate_circles(bool all_references) {
  const Exchange::Rows rows = limacon_rows(raw().at);
  shares_ = shares_of(raw(), longest_step_);
  for (const Criterion criterion : criteria_of(all_references)) {
    near_.emplace_back(rows, criterion, shares_);
    const Nearest nearest = near_.back()(profile_mm_);
    circles_.push_back(
        all_references
            ? associate_circle(raw().at, profile_mm_, trace_.radius_mm(), criterion, shares_)
            : circle_near(near_.back().off(profile_mm_, nearest), nearest, trace_.radius_mm()));
  }
}

std::vector<double> SectionModel::changed(const SectionReadings& readings) const {
  return filtered(trace_.changed(readings));
}

void SectionModel::make_filter(const FormOptions& options) {
  cutoff_rad_ = two_pi / options.high_upr;
  low_upr_ = options.low_upr;
  high_upr_ = options.filter == ProfileFilter::none ? 1e9 : options.high_upr;
  high_ = low_pass(options.filter, raw(), cutoff_rad_);
  if (high_ && options.low_upr > 1.0)
    low_ = low_pass(options.filter, raw(), two_pi / options.low_upr);
  make_slope(options);
}

void SectionModel::make_slope(const FormOptions& options) {
  longest_step_ = options.filter == ProfileFilter::none ? 0.1 * two_pi
                                                        : longest_step(two_pi / options.high_upr);
  slope_ = std::make_shared<Derivative>(raw(), longest_step_);
}

std::vector<double> SectionModel::filtered(std::span<const double> value_mm) const {
  if (!high_) return {value_mm.begin(), value_mm.end()};
  std::vector<double> out = (*high_)(value_mm);
  if (!low_) return out;
  const std::vector<double> longer = (*low_)(out);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] -= longer[i];
  return out;
}

std::vector<NamedValue> SectionModel::measured() const {
  std::vector<std::vector<double>> off_mm;
  for (const AssociatedCircle& circle : circles_) off_mm.push_back(circle.off_mm);
  return values_of(off_mm, profile_mm_);
}

std::vector<NamedValue> SectionModel::near(std::span<const double> filtered_mm) const {
  std::vector<std::vector<double>> off_mm;
  for (const Exchange& at_optimum : near_) {
    Exchange circle = at_optimum;
    off_mm.push_back(circle.off(filtered_mm, circle(filtered_mm)));
  }
  return values_of(off_mm, filtered_mm);
}

std::vector<NamedValue> SectionModel::values_of(const std::vector<std::vector<double>>& off_mm,
                                                std::span<const double> filtered_mm) const {
  std::vector<NamedValue> values;
  for (std::size_t c = 0; c < off_mm.size(); ++c) {
    const Criterion criterion = form_criteria[c];
    const std::vector<double>& off = off_mm[c];
    const auto [low, high] = range_of(off);
    const std::string about = short_name(criterion, "CI");
    values.push_back({"section", "RONt", about, high - low});
    const PeakAndValley of(low, high, bore_);
    values.push_back({"section", "RONp", about, of.peak});
    values.push_back({"section", "RONv", about, of.valley});
    double squares = 0.0, all = 0.0;
    for (std::size_t i = 0; i < off.size(); ++i)
      squares += shares_[i] * off[i] * off[i], all += shares_[i];
    values.push_back({"section", "RONq", about, std::sqrt(squares / all)});
  }
  values.push_back({"section", "slope", "", largest_known((*slope_)(filtered_mm)), "mm/rad"});
  return values;
}

AxisOffset SectionModel::centre(std::span<const double> filtered_mm) const {
  const Eigen::VectorXd q = near_.front().least_squares(filtered_mm).q;
  return {x_mm() + q[1], y_mm() + q[2]};
}

SectionForm SectionModel::form(double taper) const {
  SectionForm form;
  form.z_mm = z_mm_;
  form.readings = readings_;
  form.turns = turns_;
  form.noise_mm = noise_mm_;
  if (high_) {
    form.points_per_cycle = points_per_cycle(raw(), cutoff_rad_);
    for (const Gap& gap : gaps_of(raw(), longest_step(cutoff_rad_))) form.gaps_rad += gap.length;
    form.transmission = measured_transmission(raw(), *high_, cutoff_rad_);
  }
  if (station_) {
    form.points_per_cycle = station_->points_per_cycle;
    form.gaps_rad = station_->gaps_rad;
  }
  const double from_surface = from_surface_mm_ * std::hypot(1.0, taper);
  for (std::size_t c = 0; c < circles_.size(); ++c) {
    const AssociatedCircle& circle = circles_[c];
    FormCircle& out = form.circles.emplace_back();
    out.criterion = form_criteria[c];
    out.x_mm = x_mm() + circle.x_mm;
    out.y_mm = y_mm() + circle.y_mm;
    out.radius_mm = circle.radius_mm + (radius_known() ? -from_surface : radius_mm());
    out.why_not = circle.why;
    for (const Nearest::Touch& touch : circle.touches)
      out.touches.push_back({raw().at[touch.reading], touch.multiplier});
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
  const double n = static_cast<double>(raw().size());
  const FormCircle& least = form.circles.front();
  const double u_centre = form.harmonics.empty() ? 0.0 : form.harmonics.front().u_mm;
  form.values.push_back(
      {"eccentricity", "LSCI", {std::hypot(least.x_mm, least.y_mm), u_centre, "mm", ""}, 0.0});
  const double u_radius =
      station_ ? noise_mm_ * orders_.front().u_per_sigma : noise_mm_ / std::sqrt(n);
  if (radius_known())
    form.values.push_back({"radius", "LSCI", {least.radius_mm, u_radius, "mm", ""}, 0.0});
  form.profile = {raw().at, raw().value_mm, profile_mm_};
  return form;
}

}  // namespace trueaxis::form
