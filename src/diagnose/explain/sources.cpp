// SPDX-License-Identifier: Apache-2.0
#include "diagnose/explain/sources.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr std::size_t enough = 20;

/// Variance of an AR process over that of its innovations, by its impulse response.
double gain_of(const std::vector<double>& phi) {
  std::vector<double> response{1.0};
  double sum = 1.0;
  for (std::size_t k = 1; k < 4000; ++k) {
    double next = 0.0;
    for (std::size_t j = 1; j <= phi.size() && j <= k; ++j) next += phi[j - 1] * response[k - j];
    response.push_back(next);
    sum += next * next;
    if (!(sum < 1e9)) break;
  }
  return sum;
}

std::optional<double> stationary_sigma(const LinearisationPoint& point, const ObservationMask& mask,
                                       const std::vector<double>& left) {
  double sum = 0.0, freedom = 0.0;
  for (const Pass& pass : point.passes) {
    if (pass.c_sign != 0 || pass.feed_sign != 0) continue;
    double mean = 0.0, count = 0.0, square = 0.0;
    for (std::size_t i = pass.begin; i < pass.end; ++i)
      if (mask.used[i]) mean += left[i], ++count;
    if (count < static_cast<double>(enough)) continue;
    mean /= count;
    for (std::size_t i = pass.begin; i < pass.end; ++i)
      if (mask.used[i]) square += (left[i] - mean) * (left[i] - mean);
    sum += square, freedom += count - 1.0;
  }
  if (freedom < static_cast<double>(enough)) return std::nullopt;
  return std::sqrt(sum / freedom);
}

/// Differences between a reading and the next revolution at the same angle, interpolated there.
std::optional<double> revolution_sigma(const LinearisationPoint& point, const ObservationMask& mask,
                                       const std::vector<double>& left) {
  double sum = 0.0, count = 0.0;
  for (const Pass& pass : point.passes) {
    if (pass.c_sign == 0) continue;
    std::size_t j = pass.begin;
    for (std::size_t i = pass.begin; i < pass.end; ++i) {
      const double wanted = point.c[i] + two_pi * pass.c_sign;
      const auto before = [&](std::size_t k) {
        return pass.c_sign > 0 ? point.c[k] < wanted : point.c[k] > wanted;
      };
      j = std::max(j, i + 1);
      while (j < pass.end && before(j)) ++j;
      if (j >= pass.end || j == i + 1) continue;
      if (!mask.used[i] || !mask.used[j] || !mask.used[j - 1]) continue;
      const double w = (wanted - point.c[j - 1]) / (point.c[j] - point.c[j - 1]);
      const double d = left[i] - ((1.0 - w) * left[j - 1] + w * left[j]);
      sum += d * d / (1.0 + w * w + (1.0 - w) * (1.0 - w));
      count += 1.0;
    }
  }
  if (count < static_cast<double>(enough)) return std::nullopt;
  return std::sqrt(sum / count);
}

/// Passes that read the same places again.
std::optional<double> repeated_sigma(const LinearisationPoint& point, const ObservationMask& mask,
                                     const std::vector<double>& left) {
  double sum = 0.0, count = 0.0;
  for (std::size_t a = 0; a < point.passes.size(); ++a) {
    for (std::size_t b = a + 1; b < point.passes.size(); ++b) {
      const Pass &p = point.passes[a], &q = point.passes[b];
      if (p.end - p.begin != q.end - q.begin || p.c_sign != q.c_sign || p.setup != q.setup ||
          p.c_sign == 0)
        continue;
      bool same = true;
      for (std::size_t k = 0; k < p.end - p.begin && same; ++k) {
        same =
            std::abs(std::remainder(point.c[p.begin + k] - point.c[q.begin + k], two_pi)) < 0.01 &&
            std::abs(point.z[p.begin + k] - point.z[q.begin + k]) < 0.01;
      }
      if (!same) continue;
      for (std::size_t k = 0; k < p.end - p.begin; ++k) {
        if (!mask.used[p.begin + k] || !mask.used[q.begin + k]) continue;
        const double d = left[p.begin + k] - left[q.begin + k];
        sum += 0.5 * d * d, count += 1.0;
      }
    }
  }
  if (count < static_cast<double>(enough)) return std::nullopt;
  return std::sqrt(sum / count);
}

/// Sectors of the part without a reading that counts, where there are readings enough to miss one.
void find_gaps(const LinearisationPoint& point, const ObservationMask& mask, NoiseReport& out) {
  constexpr std::size_t sectors = 36;
  std::size_t used[sectors] = {}, all[sectors] = {};
  std::size_t first[sectors] = {};
  for (std::size_t i = 0; i < point.size(); ++i) {
    double turn = point.theta[i] / two_pi;
    turn -= std::floor(turn);
    const auto k = std::min(sectors - 1, static_cast<std::size_t>(turn * sectors));
    used[k] += mask.used[i] != 0;
    if (all[k]++ == 0 || (!mask.used[i] && mask.used[first[k]])) first[k] = i;
  }
  if (point.size() < 8 * sectors) return;
  const auto describe = [&](std::size_t from, std::size_t count) {
    return fmt::format("{}° to {}° of the part", from * 10, (from + count) * 10);
  };
  const auto run_of = [&](auto missing, auto report) {
    std::size_t start = 0;
    while (start < sectors && missing(start)) ++start;
    if (start == sectors) return;
    for (std::size_t k = 0; k < sectors;) {
      std::size_t count = 0;
      while (count < sectors && missing((start + k + count) % sectors)) ++count;
      if (count > 0) report((start + k) % sectors, count);
      k += count + 1;
    }
  };
  run_of([&](std::size_t k) { return all[k] == 0; },
         [&](std::size_t from, std::size_t count) {
           out.gaps.push_back("no reading from " + describe(from, count));
         });
  run_of([&](std::size_t k) { return all[k] > 3 && used[k] * 2 < all[k]; },
         [&](std::size_t from, std::size_t count) {
           out.interruptions.push_back({first[from] + 1, "most readings from " +
                                                             describe(from, count) +
                                                             " are far off on every turn: masked"});
         });
}

}  // namespace

NoiseReport report_noise(const ProbeStream& stream, const Joint& joint,
                         const std::vector<double>& residual_mm, std::vector<Rejected> masked,
                         const std::optional<double>& stated_mm) {
  const LinearisationPoint& point = joint.equations.point();
  const ObservationMask& mask = joint.equations.mask();
  NoiseReport out;
  out.masked = std::move(masked);
  out.stated_mm = stated_mm ? stated_mm : stream.sensor_noise_mm;
  out.autoregression = joint.equations.autoregression();
  out.stationary_mm = stationary_sigma(point, mask, residual_mm);
  out.revolutions_mm = revolution_sigma(point, mask, residual_mm);
  out.repeated_mm = repeated_sigma(point, mask, residual_mm);
  const double freedom =
      std::max(1.0, static_cast<double>(joint.equations.count() - joint.solution.rank));
  const double residual = joint.sigma_mm * std::sqrt(gain_of(out.autoregression));
  out.sigma_mm = residual;
  out.source = "residuals of the extended model";
  double independent = freedom;
  if (out.stationary_mm) {
    out.sigma_mm = *out.stationary_mm, out.source = "stationary capture";
    independent = 0.0;
    for (const Pass& pass : point.passes)
      if (pass.c_sign == 0 && pass.feed_sign == 0)
        independent += static_cast<double>(pass.end - pass.begin);
  } else if (out.repeated_mm) {
    out.sigma_mm = *out.repeated_mm, out.source = "repeated passes";
    independent *= 0.5;
  } else if (out.revolutions_mm) {
    out.sigma_mm = *out.revolutions_mm, out.source = "revolution differences";
    independent *= 0.5;
  } else {
    out.note =
        "the data have no source of their own for the noise (no repeats, no stationary "
        "capture, no second turn at one place): it is what the model leaves, and holds as "
        "far as the model does";
  }
  out.u_sigma_mm = out.sigma_mm / std::sqrt(2.0 * std::max(independent, 1.0));
  if (out.source != "residuals of the extended model" && residual > 1.25 * out.sigma_mm) {
    out.note = fmt::format(
        "the extended model leaves {:.3g} µm where the {} shows {:.3g} µm: something is left that "
        "no hypothesis has named",
        residual / mm_per_um, out.source, out.sigma_mm / mm_per_um);
  }
  find_gaps(point, mask, out);
  return out;
}

}  // namespace trueaxis::diagnose_detail
