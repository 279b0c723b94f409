// SPDX-License-Identifier: Apache-2.0
#include "spindle/values.hpp"

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>
#include <cmath>
#include <limits>

#include "math/fast_fourier.hpp"
#include "math/statistics.hpp"
#include "spindle/resolved.hpp"

namespace trueaxis {

double value_at(const Series& series, double angle_rad) {
  const std::complex<double> step = std::polar(1.0, angle_rad);
  std::complex<double> sum = 0.0;
  for (std::size_t n = series.size(); n-- > 0;) sum = sum * step + series[n];
  return sum.real();
}

Series second_order(const RunReadings& run, std::size_t sensor, double sensitive_rad,
                    const PartInRun& part, int order_max) {
  const double R = run.radius_mm, theta = run.angles_rad[sensor];
  const double cosine = std::cos(theta - sensitive_rad), sine = std::sin(theta - sensitive_rad);
  // Products of two series reach twice their order: four points an undulation of those.
  const auto points = static_cast<std::size_t>(8 * order_max);
  Series out(static_cast<std::size_t>(order_max) + 1, 0.0);
  for (std::size_t i = 0; i < points; ++i) {
    const double C = two_pi * static_cast<double>(i) / static_cast<double>(points);
    const double psi = C + theta, on_part = psi + run.set_up.reindex_rad;
    const double a = value_at(part.along, C), b = value_at(part.across, C);
    // The part's centre across the sensor's line, to the left of it.
    const double q = b * cosine - a * sine - (part.eccentricity * std::polar(1.0, psi)).imag();
    const double met = R + value_at(part.form, on_part - std::asin(q / R));
    const double left = std::sqrt(met * met - q * q) - R - value_at(part.form, on_part);
    const std::complex<double> step = std::polar(1.0, -C);
    std::complex<double> turned = 2.0 * left / static_cast<double>(points);
    for (std::complex<double>& one : out) {
      one += turned;
      turned *= step;
    }
  }
  out.front() *= 0.5;
  return out;
}

namespace {

using Complex = std::complex<double>;

constexpr std::size_t curve_points = 2048;  // a peak of order 100 to 1.2 % of its own
const double factor = bound_factor(2.0);    // of u in a bound, which holds 95 % whatever k is
constexpr double confidence = 0.95;
// u to 7 % (long recordings: 14 %)
constexpr std::size_t most_surrogates = 100, least_surrogates = 25;
constexpr std::size_t most_surrogate_readings = 4'000'000;
constexpr std::size_t seed = 230'7;

double spread_of(double value, const std::vector<double>& drawn) {
  double sum = 0.0;
  for (const double one : drawn) sum += (one - value) * (one - value);
  return std::sqrt(sum / static_cast<double>(drawn.size()));
}

double deviation_of(const std::vector<double>& drawn) {
  double mean = 0.0;
  for (const double one : drawn) mean += one / static_cast<double>(drawn.size());
  return spread_of(mean, drawn);
}

/// Curves of harmonics over one turn.
class CurveSource {
 public:
  CurveSource() : fourier_(curve_points), workspace_(fourier_.workspace()) {}

  std::vector<double> operator()(const Series& harmonics) {
    std::vector<double> real(curve_points), imaginary(curve_points);
    for (std::size_t n = 0; n < harmonics.size(); ++n) {
      real[n] = harmonics[n].real();
      imaginary[n] = -harmonics[n].imag();
    }
    std::vector<double> out;
    for (const Complex& at : fourier_(real, imaginary, workspace_)) out.push_back(at.real());
    return out;
  }

 private:
  FastFourier fourier_;
  FastFourier::Workspace workspace_;
};

/// Series of one spectrum with other phases. What is beyond the last smooth length is left off.
class Surrogates {
 public:
  explicit Surrogates(const std::vector<double>& series)
      : fourier_(smooth_length(series.size())), workspace_(fourier_.workspace()) {
    const std::size_t n = fourier_.size();
    const std::vector<double> none(n, 0.0);
    for (const Complex& one : fourier_(std::span(series).first(n), none, workspace_))
      size_.push_back(std::abs(one) / static_cast<double>(n));
  }

  std::vector<double> draw(boost::random::mt19937_64& engine) {
    const std::size_t n = fourier_.size();
    std::vector<double> real(n, 0.0), imaginary(n, 0.0), out(n);
    boost::random::uniform_01<double> uniform;
    for (std::size_t k = 1; k < n / 2; ++k) {
      const Complex one = 2.0 * size_[k] * std::polar(1.0, two_pi * uniform(engine));
      real[k] = one.real();
      imaginary[k] = one.imag();
    }
    const auto result = fourier_(real, imaginary, workspace_);
    std::ranges::transform(result, out.begin(), [](const Complex& one) { return one.real(); });
    return out;
  }

 private:
  static std::size_t smooth_length(std::size_t most) {
    std::size_t length = most - most % 2;
    while (smooth_even_size(length) != length) length -= 2;
    return length;
  }
  FastFourier fourier_;
  FastFourier::Workspace workspace_;
  std::vector<double> size_;
};

/// The readings' extents in each of some places of the turn.
class Bands {
 public:
  explicit Bands(std::size_t places)
      : low_(places, std::numeric_limits<double>::infinity()),
        high_(places, -std::numeric_limits<double>::infinity()) {}
  void add(double c_rad, double value) {
    const std::size_t at = place_in_turn(c_rad, low_.size());
    low_[at] = std::min(low_[at], value);
    high_[at] = std::max(high_[at], value);
  }
  /// At an angle, 0 included: the motion that repeats is within the total.
  double low(double c_rad) const { return std::min(0.0, low_[place_in_turn(c_rad, low_.size())]); }
  double high(double c_rad) const {
    return std::max(0.0, high_[place_in_turn(c_rad, high_.size())]);
  }
  double widest() const {
    double out = 0.0;
    for (std::size_t i = 0; i < low_.size(); ++i) out = std::max(out, high_[i] - low_[i]);
    return out;
  }

 private:
  std::vector<double> low_, high_;
};

Bands bands_of(std::span<const AsynchronousMotion> runs,
               const std::vector<std::vector<double>>& motions, std::size_t places) {
  Bands bands(places);
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (std::size_t i = 0; i < motions[r].size(); ++i) bands.add(runs[r].c_rad[i], motions[r][i]);
  return bands;
}

/// The curve also between the places where it is read, each with the band of the nearest.
double total_of(const std::vector<double>& curve, const Bands& bands) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const double c_rad = two_pi * static_cast<double>(i) / static_cast<double>(curve.size());
    low = std::min(low, curve[i] + bands.low(c_rad));
    high = std::max(high, curve[i] + bands.high(c_rad));
  }
  return high - low;
}

}  // namespace

std::size_t place_in_turn(double c_rad, std::size_t places) {
  const double turns = c_rad / two_pi;
  return static_cast<std::size_t>((turns - std::floor(turns)) * static_cast<double>(places) + 0.5) %
         places;
}

Estimate range_estimate(const ResolvedSeries& series) {
  CurveSource curve;
  const double value = range_of(curve(series.mean)).length();
  std::vector<double> drawn;
  for (const Series& one : series.drawn) drawn.push_back(range_of(curve(one)).length());
  const double u = spread_of(value, drawn);
  if (value > factor * u || u == 0.0) return {value, u, "mm", ""};
  // An order that is absent in most draws bounds nothing.
  std::erase_if(drawn, [](double one) { return !(one > 0.0); });
  const auto rank = static_cast<std::ptrdiff_t>(confidence * static_cast<double>(drawn.size()));
  std::ranges::nth_element(drawn, drawn.begin() + rank);
  const double most = std::max(value + factor * u, drawn[static_cast<std::size_t>(rank)]);
  return {.unit = "mm", .why_not = "not beyond its uncertainty", .interval = std::array{0.0, most}};
}

std::pair<Estimate, Estimate> asynchronous_and_total(const ResolvedSeries& series,
                                                     std::span<const AsynchronousMotion> runs,
                                                     double per_turn) {
  CurveSource curve;
  const auto places = static_cast<std::size_t>(std::max(8.0, std::round(per_turn)));
  std::vector<std::vector<double>> motions;
  std::vector<Surrogates> surrogates;
  std::size_t readings = 0;
  for (const AsynchronousMotion& run : runs) {
    motions.push_back(run.motion_mm);
    surrogates.emplace_back(run.motion_mm);
    readings += run.motion_mm.size();
  }
  const Bands found = bands_of(runs, motions, places);
  const double band = found.widest(), total = total_of(curve(series.mean), found);
  boost::random::mt19937_64 engine(seed);
  std::vector<double> bands, totals;
  const std::size_t draws =
      std::clamp(most_surrogate_readings / readings, least_surrogates, most_surrogates);
  for (std::size_t k = 0; k < draws; ++k) {
    for (std::size_t r = 0; r < runs.size(); ++r) motions[r] = surrogates[r].draw(engine);
    const Bands drawn = bands_of(runs, motions, places);
    bands.push_back(drawn.widest());
    totals.push_back(total_of(curve(series.drawn[k]), drawn));
  }
  return {{band, deviation_of(bands), "mm", ""}, {total, deviation_of(totals), "mm", ""}};
}

std::vector<double> u_of_curve(const ResolvedSeries& series, std::span<const double> angle_rad) {
  std::vector<double> out;
  for (const double angle : angle_rad) {
    std::vector<double> drawn;
    for (const Series& one : series.drawn) drawn.push_back(value_at(one, angle));
    out.push_back(spread_of(value_at(series.mean, angle), drawn));
  }
  return out;
}

std::vector<double> outside_usual(std::span<const double> c_rad, std::span<const double> value,
                                  double per_turn) {
  const auto places = static_cast<std::size_t>(std::max(1.0, std::round(per_turn)));
  std::vector<std::vector<std::size_t>> at(places);
  for (std::size_t i = 0; i < value.size(); ++i) at[place_in_turn(c_rad[i], places)].push_back(i);
  std::vector<double> out(value.size(), 0.0);
  for (const std::vector<std::size_t>& rows : at) {
    if (rows.empty()) continue;
    std::vector<double> here;
    for (const std::size_t i : rows) here.push_back(value[i]);
    std::ranges::sort(here);
    const std::size_t quarter = (here.size() + 1) / 4;
    const double low = here[quarter], high = here[here.size() - 1 - quarter];
    for (const std::size_t i : rows) out[i] = std::max({0.0, low - value[i], value[i] - high});
  }
  return out;
}

}  // namespace trueaxis
