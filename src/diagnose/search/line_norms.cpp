// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/line_norms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "math/fourier_sums.hpp"
#include "math/sincos.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

// A sum of cosines of steps goes through a cycle only once in the inverse of the longest: of 32
// places a cycle the polynomial through six leaves (2π/32)⁶ · 225/64/6! = 3e-7 of it.
constexpr double places_a_cycle = 32.0;
constexpr std::size_t taps = 6;
constexpr std::size_t rows_at_once = 4096, bins_at_once = 256;
constexpr double before = 2.0;  // of the taps, those below the interval

std::size_t stride_of(double longest, double df) {
  const double stride = 1.0 / (places_a_cycle * longest * df);
  return longest > 0.0 && stride < 1.0 ? 1 : static_cast<std::size_t>(std::min(stride, 1e6));
}

/// Adds to `fine` what is at every `stride`th place, by the polynomial through six places.
void add_between(const std::vector<double>& coarse, std::size_t stride, std::vector<double>& fine) {
  if (stride == 1) {
    std::ranges::transform(fine, coarse, fine.begin(), std::plus<>());
    return;
  }
  std::array<double, taps> weight{};
  for (std::size_t r = 0; r < std::min(stride, fine.size()); ++r) {
    const double t = before + static_cast<double>(r) / static_cast<double>(stride);
    for (std::size_t i = 0; i < taps; ++i) {
      weight[i] = 1.0;
      for (std::size_t j = 0; j < taps; ++j) {
        const auto to = static_cast<double>(i), from = static_cast<double>(j);
        if (j != i) weight[i] *= (t - from) / (to - from);
      }
    }
    for (std::size_t k = r, at = 0; k < fine.size(); k += stride, ++at)
      fine[k] += std::inner_product(weight.begin(), weight.end(),
                                    coarse.begin() + static_cast<std::ptrdiff_t>(at), 0.0);
  }
}

/// The correlation of the filter 1, −φ₁, −φ₂ … with itself, so many readings off.
std::vector<double> products_of(const std::vector<double>& phi) {
  std::vector<double> factor{1.0}, out;
  for (const double p : phi) factor.push_back(-p);
  for (std::size_t lag = 0; lag < factor.size(); ++lag)
    out.push_back(std::inner_product(factor.begin() + static_cast<long>(lag), factor.end(),
                                     factor.begin(), 0.0));
  return out;
}

}  // namespace

std::vector<double> readings_that_count(const NormalEquations& equations) {
  const ObservationMask& mask = equations.mask();
  std::vector<double> out;
  for (const Pass& pass : equations.point().passes) {
    double count = 0.0;
    for (std::size_t i = pass.begin; i < pass.end; ++i)
      count += mask.used[i] && mask.run[i] >= equations.autoregression().size();
    out.push_back(count);
  }
  return out;
}

LineNorms::LineNorms(const NormalEquations& equations, std::vector<double> counts, PointColumn x,
                     const Means* means)
    : equations_(equations), x_(x), used_(std::move(counts)) {
  const LinearisationPoint& point = equations.point();
  for (std::size_t p = 0; p < point.passes.size(); ++p) {
    const Pass& pass = point.passes[p];
    // Means follow each other within a turn, and then leave some turns out.
    std::size_t last = pass.end - 1;
    if (means && means->of_pass[p].turns > 0.0)
      last = std::min(last, pass.begin + static_cast<std::size_t>(means->of_pass[p].sectors) - 1);
    const auto step = [&](PointColumn of) {
      return last > pass.begin ? (point.at(of, last) - point.at(of, pass.begin)) /
                                     static_cast<double>(last - pass.begin)
                               : 0.0;
    };
    c_step_.push_back(step(&PointPart::c)), x_step_.push_back(step(x));
  }
}

std::vector<double> LineNorms::of(const Scan& scan, double low, double df, std::size_t bins) const {
  if (equations_.autoregression().empty()) {
    double sum = 0.0;
    for (const double used : used_) sum += 0.5 * used;
    return std::vector<double>(bins, sum);
  }
  const bool swings = x_ == &PointPart::sensed || x_ == &PointPart::s;
  if (swings && !scan.pattern) return by_every_step(scan, low, df, bins);
  return by_mean_step(scan, low, df, bins);  // a pattern is of few cycles
}

/// ½ Σ |A|² over the passes, A the transfer of the filter at the line's angle from reading to
/// reading: a sum of cosines of the angle's multiples, by Chebyshev's recurrence.
std::vector<double> LineNorms::by_mean_step(const Scan& scan, double low, double df,
                                            std::size_t bins) const {
  const std::vector<double> product = products_of(equations_.autoregression());
  std::vector<double> out(bins, 0.0);
  std::array<double, bins_at_once> angle{}, sine{}, cosine{};
  for (std::size_t p = 0; p < used_.size(); ++p) {
    for (std::size_t begin = 0; begin < bins; begin += bins_at_once) {
      const std::size_t count = std::min(bins_at_once, bins - begin);
      for (std::size_t k = 0; k < count; ++k)
        angle[k] = two_pi * (low + df * static_cast<double>(begin + k)) * x_step_[p] -
                   scan.turns * c_step_[p];
      sincos(std::span(angle).first(count), std::span(sine).first(count),
             std::span(cosine).first(count));
      for (std::size_t k = 0; k < count; ++k) {
        double sum = product[0], before = 1.0, now = cosine[k];
        for (std::size_t lag = 1; lag < product.size(); ++lag) {
          sum += 2.0 * product[lag] * now;
          before = std::exchange(now, 2.0 * cosine[k] * now - before);
        }
        out[begin + k] += 0.5 * used_[p] * sum;
      }
    }
  }
  return out;
}

/// The same if x goes by another step from reading to reading, as the part's own length and what is
/// sensed do on a tilted or eccentric part. Then |A|² is a sum of the cosines of one step and of
/// two, summed over the readings.
std::vector<double> LineNorms::by_every_step(const Scan& scan, double low, double df,
                                             std::size_t bins) const {
  const LinearisationPoint& point = equations_.point();
  const ObservationMask& mask = equations_.mask();
  const auto& phi = equations_.autoregression();
  const std::vector<double> product = products_of(phi);
  std::vector<double> norm2(bins, 0.5 * static_cast<double>(equations_.count()) * product[0]);
  for (std::size_t lag = 1; lag < product.size(); ++lag) {
    const double both = product[lag];
    const auto counts = [&](std::size_t i) {
      return i >= lag && mask.used[i] && mask.run[i] >= phi.size();
    };
    // Steps of readings from `begin` on, from the one before by the lag; 0 if one does not count.
    const auto steps_of = [&](PointColumn column, std::size_t begin, std::size_t size,
                              double* out) {
      const std::size_t start = begin - std::min(begin, lag);
      PointRoom room;
      const PointPart at = point.part(start, begin + size, room);
      const std::span<const double> x = at.*column;
      for (std::size_t i = begin; i < begin + size; ++i)
        out[i - begin] = counts(i) ? x[i - start] - x[i - start - lag] : 0.0;
    };
    std::size_t stride = 1;
    if (bins > point.size()) {  // fewer cost no more than a look at all steps
      double longest = 0.0;
      std::vector<double> some(std::min(point.size(), rows_at_once));
      for (std::size_t begin = 0; begin < point.size(); begin += some.size()) {
        const std::size_t size = std::min(some.size(), point.size() - begin);
        steps_of(x_, begin, size, some.data());
        for (std::size_t i = 0; i < size; ++i) longest = std::max(longest, std::abs(some[i]));
      }
      stride = stride_of(longest, df);
    }
    const auto steps = [&](std::size_t begin, std::size_t size, std::span<double* const> out) {
      steps_of(x_, begin, size, out[0]);
    };
    const auto waves = [&](std::size_t begin, std::size_t size, std::span<double* const> out) {
      std::vector<double> turned(size);
      steps_of(scan.spindle ? &PointPart::c : &PointPart::theta, begin, size, turned.data());
      for (double& angle : turned) angle *= scan.turns;
      sincos(turned, {out[1], size}, {out[0], size});
      for (std::size_t i = 0; i < size; ++i) {
        const double weight = counts(begin + i) ? both : 0.0;
        out[0][i] *= weight, out[1][i] *= weight;
      }
    };
    const std::size_t coarse = stride > 1 ? bins / stride + taps + 1 : bins;
    const double first = stride > 1 ? low - before * static_cast<double>(stride) * df : low;
    const auto sums = FourierSums(steps, point.size(), 0.0, two_pi * first,
                                  two_pi * df * static_cast<double>(stride), coarse)
                          .of(waves, 2);
    std::vector<double> cosines(coarse);
    for (std::size_t k = 0; k < coarse; ++k) cosines[k] = sums[0][k].real() - sums[1][k].imag();
    add_between(cosines, stride, norm2);
  }
  return norm2;
}

}  // namespace trueaxis::diagnose_detail
