// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "form/circle.hpp"
#include "form/harmonics.hpp"
#include "form/low_pass.hpp"
#include "form/section_trace.hpp"
#include "form/trace.hpp"
#include "form/values.hpp"

namespace trueaxis::form {

/// dr/dθ of values at the places of a trace: that of the polynomial of fourth degree through five
/// neighbours, none of them across a gap. Exact to (2π/points a wave)⁴/30 of a wave's own.
class Derivative {
 public:
  Derivative(const Trace& trace, double longest_step);
  std::vector<double> operator()(std::span<const double> value) const;

 private:
  struct Stencil {
    std::array<std::size_t, 5> reading;
    std::array<double, 5> weight;
  };
  std::vector<Stencil> stencils_;  ///< none for a stretch of fewer than five readings
  std::vector<bool> known_;
};

/// A place across the axis.
struct AxisOffset {
  double x_mm, y_mm;
};

/// An order's square over the variance of its coefficients, from which on it is not noise: 5 % of
/// orders without form are above, as exp(−6/2).
inline constexpr double shown_over_noise = 6.0;

/// A section read off a surface (`SurfaceModel`): all that `SectionModel` is of.
struct StationOfSurface {
  double z_mm = 0.0, x_mm = 0.0, y_mm = 0.0, mean_mm = 0.0;  ///< its least-squares circle
  Trace raw{};                                               ///< about it
  std::vector<double> profile_mm{};                          ///< that, filtered
  std::vector<Order> orders{};
  double noise_mm = 0.0, turns = 1.0, gaps_rad = 0.0, points_per_cycle = 0.0;
  std::size_t readings = 0;
};

/// One section ready to be filtered and assessed, as often as a Monte Carlo asks.
class SectionModel {
 public:
  SectionModel(const SectionReadings& readings, bool radius_known, const FormOptions& options);
  SectionModel(StationOfSurface station, bool radius_known, const FormOptions& options);

  /// Standard deviation of single readings that this section alone shows. Eq. 270.
  double shown_noise_of_reading_mm() const { return shown_mm_ / std::sqrt(averaged_); }
  /// The noise of the stream: that which its sections show together, or the stated one if larger.
  void set_noise_of_reading(double noise_mm) { noise_mm_ = noise_mm * std::sqrt(averaged_); }
  std::size_t readings() const { return readings_; }

  const std::string& trouble() const { return trouble_; }  ///< why there is no section

  /// The band of the filter of values at the places of `raw()`. Linear.
  std::vector<double> filtered(std::span<const double> value_mm) const;

  /// The part of the circumference that each place of the trace stands for, rad.
  const std::vector<double>& shares() const { return shares_; }
  /// The filtered profile of readings at the same angles, little changed.
  std::vector<double> changed(const SectionReadings& readings) const;

  /// RONt, RONp, RONv, RONq about each circle in the plane, and the slope, of `profile_mm()`.
  std::vector<NamedValue> measured() const;

  /// The same of a filtered profile near that one, by Eq. 265 about the pole of `raw()`.
  std::vector<NamedValue> near(std::span<const double> filtered_mm) const;

  /// Centre of the least-squares circle of a filtered profile, in the part frame.
  AxisOffset centre(std::span<const double> filtered_mm) const;

  /// Everything of the section but the uncertainty of `values`.
  /// @param taper of the part's radius along Z: a ball's centre is further from a cone; Eq. 10
  SectionForm form(double taper) const;

  /// Orders of the readings before the filter, as far as these carry.
  const std::vector<Order>& orders() const { return orders_; }
  const Trace& raw() const { return trace_.trace(); }  ///< about the least-squares circle
  const std::vector<double>& profile_mm() const { return profile_mm_; }  ///< that, filtered
  double noise_mm() const { return noise_mm_; }  ///< standard deviation at a place of `raw()`
  std::optional<double> z_mm() const { return z_mm_; }
  double x_mm() const { return trace_.x_mm(); }  ///< pole of `raw()` in the part frame
  double y_mm() const { return trace_.y_mm(); }
  double radius_mm() const { return trace_.mean_mm(); }  ///< of the ball's centre
  bool bore() const { return bore_; }
  double surface_radius_mm() const { return radius_mm() - from_surface_mm_; }
  bool radius_known() const { return trace_.radius_mm() > 0.0; }

 private:
  void make_filter(const FormOptions& options);
  void associate_circles(bool all_references);
  void make_slope(const FormOptions& options);

  std::vector<NamedValue> values_of(const std::vector<std::vector<double>>& off_mm,
                                    std::span<const double> filtered_mm) const;

  SectionTrace trace_;
  std::optional<double> z_mm_;
  bool bore_ = false;
  double from_surface_mm_ = 0.0;  ///< the ball's centre, outwards
  double noise_mm_ = 0.0, shown_mm_ = 0.0, averaged_ = 1.0;
  double cutoff_rad_ = 0.0, low_upr_ = 1.0, high_upr_ = 0.0, turns_ = 1.0;
  std::size_t readings_ = 0;
  std::optional<StationOfSurface> station_;
  std::shared_ptr<const LowPass> high_, low_;
  std::shared_ptr<const Derivative> slope_;
  double longest_step_ = 0.0;  ///< between readings that are not a gap, rad
  std::vector<double> profile_mm_, shares_;
  std::vector<Order> orders_;
  std::vector<AssociatedCircle> circles_;  ///< of form_criteria, in the plane
  std::vector<Exchange> near_;             ///< the same of Eq. 265, at their optimum
  std::string trouble_;
};

/// Standard deviation of the readings of a trace that neighbours show: the median distance of a
/// reading from the line through both. White noise only, with what roughness adds. Eq. 270.
double shown_noise_mm(const Trace& trace);

/// "LSCI" … of a circle, "LSCY" … of a cylinder by the `suffix` "CY".
std::string short_name(Criterion criterion, const char* suffix);

}  // namespace trueaxis::form
