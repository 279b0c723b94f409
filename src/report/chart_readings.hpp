// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "format/json.hpp"
#include "trueaxis/fit.hpp"
#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// More readings than this are shown as means of cells and envelopes of bins.
inline constexpr std::size_t max_points = 20000;

/// What a chart leaves out.
inline constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

/// `value` to `decimals` places: keeps the page small and its bytes free of the last bits.
double rounded(double value, int decimals);

/// An interval cut into equal bins.
struct Bins {
  double low = 0.0, high = 1.0;
  std::size_t count = 1;

  /// The bin of `value`; values outside fall into the first or the last.
  std::size_t of(double value) const;
  double width() const { return (high - low) / static_cast<double>(count); }
  double center(std::size_t bin) const { return low + (static_cast<double>(bin) + 0.5) * width(); }
};

/// `count` bins over the range of the values; a range of 0 is made 1.
Bins bins_over(const std::vector<double>& values, std::size_t count);

/// Means of what falls into the cells of an unrolled surface (x: C, y: Z or X).
class CellMeans {
 public:
  CellMeans(Bins x, Bins y);
  void add(double x, double y, double value);
  /// Row by row from the lowest y; an empty cell is NaN.
  Json to_json(int decimals) const;

 private:
  Bins x_, y_;
  std::vector<double> sum_;
  std::vector<std::size_t> count_;
};

/// Least, greatest and mean value of each bin.
class Envelope {
 public:
  explicit Envelope(Bins x);
  void add(double x, double value);
  /// {"low", "high", "min", "max", "mean"}, one entry a bin; an empty bin is NaN.
  Json to_json(int decimals) const;

 private:
  Bins x_;
  std::vector<double> min_, max_, sum_;
  std::vector<std::size_t> count_;
};

/// Counts of `values` in equal bins over their range: {"center", "count", "width"}; the number of
/// bins is the Freedman-Diaconis one within [8, 80].
Json histogram(std::vector<double> values, int decimals);

/// `values` with each one rounded to `decimals` places.
Json column(const std::vector<double>& values, int decimals);

/// The associated surface turned true: the same radius and taper about the spindle axis, a face
/// square to it. Charts show readings against it, so that offset and tilt are what is seen. It is
/// given in terms of readings: the constant of a probe ball or of a gauge (mean of predicted
/// reading minus contact) is in it. Without usable fit it is the straight line in Z through the
/// readings.
class CoaxialNominal {
 public:
  CoaxialNominal(const ProbeStream& stream, const FitResult& fit);

  bool from_fit() const { return from_fit_; }
  /// Reading of the true-running surface at Z (a face: at X), mm.
  double reading_mm(double position_mm) const;
  /// Associated surface minus true-running surface at (C, position), mm; NaN without usable fit.
  double model_deviation_mm(double c_rad, double position_mm) const;

 private:
  double contact_mm(double c_rad, double position_mm) const;
  void take_constant(const ProbeStream& stream, const FitResult& fit);
  void take_straight_line(const ProbeStream& stream);

  bool face_ = false, from_fit_ = false;
  Revolved shape_;
  double level_mm_ = 0.0, slope_ = 0.0, position_ref_mm_ = 0.0;
};

/// Whether the numbers of a fit may be drawn: it has a residual for every reading and a finite
/// axis.
bool fit_is_usable(const ProbeStream& stream, const FitResult& fit);

/// Z (X of a face) of reading `i`; a section without Z lies at the axis' reference height.
double position_of(const ProbeStream& stream, const FitResult& fit, std::size_t i);

/// The readings of one reference in the units of the charts.
struct ChartReadings {
  bool has_model = false;            ///< a usable fit: residual_um is there
  bool has_position = false;         ///< false: one section without Z
  std::vector<double> c_deg;         ///< wrapped to [0, 360)
  std::vector<double> position_mm;   ///< Z, or X of a face
  std::vector<double> time_s;        ///< empty when the stream has no t
  std::vector<double> deviation_um;  ///< reading minus CoaxialNominal
  std::vector<double> residual_um;   ///< measured minus model
  std::vector<bool> kept;            ///< false: rejected by the fit, or not a number
  double readings_per_turn = 0.0;

  std::vector<std::size_t> rejected() const;
};

ChartReadings chart_readings(const ProbeStream& stream, const FitResult& fit,
                             const CoaxialNominal& nominal);

/// Bins of the unrolled surface over C, and over Z with no more rows than turns (rows between two
/// turns of a helix would stay blank).
inline constexpr Bins map_columns{0.0, 360.0, 120};
Bins map_rows(const ChartReadings& all);

/// C wrapped to [0, 360) degrees.
double wrapped_deg(double c_rad);

}  // namespace trueaxis
