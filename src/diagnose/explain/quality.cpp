// SPDX-License-Identifier: Apache-2.0
#include "diagnose/explain/quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/angle.hpp"
#include "base/counted.hpp"
#include "base/number.hpp"
#include "diagnose/search/causes.hpp"
#include "fit/uncertainty.hpp"
#include "math/autoregression.hpp"
#include "math/statistics.hpp"
#include "measure/column_checks.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr std::size_t enough = 20;

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
/// Eq. 67.
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
        same = apart_rad(point.c[p.begin + k], point.c[q.begin + k]) < 0.01 &&
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
  point.for_each_part([&](const PointPart& at) {
    for (std::size_t j = 0; j < at.size(); ++j) {
      double turn = at.theta[j] / two_pi;
      turn -= std::floor(turn);
      const auto k = std::min(sectors - 1, static_cast<std::size_t>(turn * sectors));
      const std::size_t i = at.begin + j;
      used[k] += mask.used[i] != 0;
      if (all[k]++ == 0 || (!mask.used[i] && mask.used[first[k]])) first[k] = i;
    }
  });
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
           out.interruptions.push_back(
               {first[from] + 1, "most readings from " + describe(from, count) +
                                     " are far off in every revolution: excluded"});
         });
}

/// Where on the circumference excluded readings lie: "100 readings at C 80-98°", the largest
/// groups.
std::string sectors_text(const ProbeStream& stream, const std::vector<Rejected>& masked) {
  constexpr double apart_deg = 10.0;
  constexpr std::size_t most = 3;
  std::vector<double> c_deg;
  for (const Rejected& one : masked) {
    const double turns = stream.c_rad[one.row - 1] / two_pi;
    c_deg.push_back(360.0 * (turns - std::floor(turns)));
  }
  std::ranges::sort(c_deg);
  struct Sector {
    double from, to;
    std::size_t count;
  };
  std::vector<Sector> sectors;
  for (const double c : c_deg) {
    if (sectors.empty() || c - sectors.back().to > apart_deg) sectors.push_back({c, c, 0});
    sectors.back().to = c;
    ++sectors.back().count;
  }
  if (sectors.size() > 1 && 360.0 - sectors.back().to + sectors.front().from <= apart_deg) {
    sectors.front().from = sectors.back().from;  // across 0°
    sectors.front().count += sectors.back().count;
    sectors.pop_back();
  }
  std::ranges::stable_sort(sectors, std::greater{}, &Sector::count);
  std::string text;
  for (std::size_t i = 0; i < std::min(most, sectors.size()); ++i)
    text += fmt::format("{}{} at C {:.0f}-{:.0f}°", i == 0 ? "" : ", ",
                        counted(sectors[i].count, "reading"), sectors[i].from, sectors[i].to);
  return text + (sectors.size() > most ? " …" : "");
}

/// "3 outliers excluded, up to 31 µm off: rows 778, 800-801".
std::string rows_text(const std::vector<Rejected>& masked, const std::vector<double>& residual_mm) {
  constexpr std::size_t most = 3;
  if (masked.empty()) return "no outliers excluded";
  std::vector<std::size_t> rows;
  double farthest_mm = 0.0;
  for (const Rejected& one : masked) {
    rows.push_back(one.row);
    const double off_mm = std::abs(residual_mm[one.row - 1]);
    if (std::isfinite(off_mm)) farthest_mm = std::max(farthest_mm, off_mm);
  }
  return fmt::format(
      "{} excluded{}: row{} {}", counted(rows.size(), "outlier"),
      farthest_mm > 0.0 ? fmt::format(", up to {:.3g} µm off", farthest_mm / mm_per_um) : "",
      rows.size() == 1 ? "" : "s", ranges_text(rows, most));
}

QualityCheck result(DataCheck check, bool found, std::string text) {
  return {std::string(entry_of(check).id), found, std::move(text)};
}

QualityCheck saturation(const ProbeStream& stream) {
  const LimitsMet met = limits_met(stream);
  return result(
      DataCheck::saturation, met.saturates,
      fmt::format("{} readings at the largest value, {} at the smallest", met.at_high, met.at_low));
}

/// The step of a rounded indication, and whether its error was found as a period of the reading.
QualityCheck quantisation(double step, const Joint& joint, double sigma) {
  std::string text =
      fmt::format("smallest step {:.3g} µm, σ {:.3g} µm", step / mm_per_um, sigma / mm_per_um);
  const bool taken = std::ranges::any_of(joint.terms, [&](const Hypothesis& h) {
    return is_rounding(h, joint.equations.point(), step);
  });
  if (taken) text += ": TrueAxis subtracts its error, of that period in X";
  return result(DataCheck::quantisation, step > 0.5 * sigma, std::move(text));
}

/// The stated σ against that which the data show; what it means for u.
QualityCheck stated_noise(const NoiseReport& noise, double redundancy) {
  if (!noise.stated_mm) return result(DataCheck::stated_noise, false, "no noise is stated");
  const double stated = *noise.stated_mm, shown = noise.sigma_mm;
  const bool found = noise_disagrees(stated, shown, redundancy);
  std::string text = fmt::format("stated {:.3g} µm, from {} {:.3g} µm", stated / mm_per_um,
                                 to_string(noise.source), shown / mm_per_um);
  if (found) {
    text +=
        shown > stated
            ? fmt::format(
                  ": TrueAxis computes u from the data, {} times the stated noise; the "
                  "readings contain more than the sensor's noise, or the stated noise is too small",
                  significant(shown / stated, 2))
            : fmt::format(
                  ": u of the causes comes from the data, but u of the ideal fit from the stated "
                  "noise; if that is wrong (a unit?), it is up to {} times too large",
                  significant(stated / shown, 2));
  }
  return result(DataCheck::stated_noise, found, std::move(text));
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
  const double residual = joint.sigma_mm * std::sqrt(variance_over_innovation(out.autoregression));
  out.sigma_mm = residual;
  out.source = NoiseSource::extended_model;
  double independent = freedom;
  if (out.stationary_mm) {
    out.sigma_mm = *out.stationary_mm, out.source = NoiseSource::stationary_capture;
    independent = 0.0;
    for (const Pass& pass : point.passes)
      if (pass.c_sign == 0 && pass.feed_sign == 0)
        independent += static_cast<double>(pass.end - pass.begin);
  } else if (out.repeated_mm) {
    out.sigma_mm = *out.repeated_mm, out.source = NoiseSource::repeated_passes;
    independent *= 0.5;
  } else if (out.revolutions_mm) {
    out.sigma_mm = *out.revolutions_mm, out.source = NoiseSource::revolution_differences;
    independent *= 0.5;
  } else {
    out.note =
        "the data do not show the noise on their own (no repeats, no stationary capture, no second "
        "revolution at one place): it is estimated from the residuals and is valid only if the "
        "model is";
  }
  out.u_sigma_mm = out.sigma_mm / std::sqrt(2.0 * std::max(independent, 1.0));
  const bool measured = out.stationary_mm || out.repeated_mm || out.revolutions_mm;
  if (measured && residual > 1.25 * out.sigma_mm) {
    out.note = fmt::format(
        "the final fit leaves {:.3g} µm, while the {} shows {:.3g} µm: part of the deviation has "
        "no named cause",
        residual / mm_per_um, to_string(out.source), out.sigma_mm / mm_per_um);
  }
  find_gaps(point, mask, out);
  return out;
}

std::vector<QualityCheck> check_quality(const IdealModel& ideal, const Joint& joint,
                                        const std::vector<double>& residual_mm,
                                        const NoiseReport& noise) {
  const LinearisationPoint& point = joint.equations.point();
  const ObservationMask& mask = joint.equations.mask();
  const ProbeStream& stream = ideal.stream;
  std::vector<QualityCheck> list{saturation(stream),
                                 quantisation(ideal.indication.step, joint, noise.sigma_mm)};
  list.push_back(result(DataCheck::outliers, !noise.masked.empty() && noise.interruptions.empty(),
                        rows_text(noise.masked, residual_mm)));
  list.push_back(result(DataCheck::interruption, !noise.interruptions.empty(),
                        sectors_text(stream, noise.masked) +
                            " excluded, which are far off on every revolution (a keyway, a hole)"));
  // Variance against tan² of the angle between probe and normal, in units of the mean variance.
  double sum_t = 0.0, sum_v = 0.0, sum_tt = 0.0, sum_tv = 0.0, n = 0.0;
  point.for_each_part([&](const PointPart& at) {
    for (std::size_t k = 0; k < at.size(); ++k) {
      const std::size_t i = at.begin + k;
      if (!mask.used[i]) continue;
      const double t = at.dx_dy[k] * at.dx_dy[k] + at.dx_dz[k] * at.dx_dz[k],
                   v = residual_mm[i] * residual_mm[i];
      sum_t += t, sum_v += v, sum_tt += t * t, sum_tv += t * v, n += 1.0;
    }
  });
  const double mean = sum_v / n, spread = sum_tt - sum_t * sum_t / n;
  const double slope = spread > 0.0 ? (sum_tv - sum_t * sum_v / n) / spread / mean : 0.0;
  const double u = spread > 0.0 ? std::sqrt(2.0 / spread) : 0.0;  // Gaussian: var(v) = 2 mean²
  list.push_back(result(
      DataCheck::incidence_noise, u > 0.0 && slope > 4.0 * u && slope * sum_t / n > 0.05,
      fmt::format("variance grows by {:.3g} ± {:.2g} per tan² of the incidence", slope, 2.0 * u)));
  const auto& phi = noise.autoregression;
  list.push_back(result(
      DataCheck::correlated_noise, !phi.empty(),
      phi.empty()
          ? "neighbouring readings are not correlated"
          : fmt::format("autoregression of order {}, φ1 = {:.3f}: TrueAxis whitens the readings",
                        phi.size(), phi[0])));
  list.push_back(
      stated_noise(noise, static_cast<double>(joint.equations.count() - joint.solution.rank)));
  return list;
}

std::vector<std::string> off_centre_remark(const Problem& problem, const Model& model) {
  const LinearisationPoint& point = problem.point;
  if (point.base.face) return {};
  double e2 = 0.0, radius = 0.0;
  point.for_each_part([&](const PointPart& at) {
    for (std::size_t k = 0; k < at.size(); ++k) {
      e2 += 2.0 * at.d2x_dc2[k] * at.d2x_dc2[k];
      radius += std::abs(at.x[k]);
    }
  });
  const double second = e2 / (4.0 * radius);
  for (const Hypothesis& h : model.terms) {
    const auto* harmonic = h.effect ? std::get_if<Harmonic>(&h.effect->term) : nullptr;
    const double order = !h.effect  ? h.pattern.order
                         : harmonic ? std::max(harmonic->fixed_order, h.shape.order)
                                    : 0.0;
    if (order == 2.0) return {};
  }
  std::vector<Hypothesis> terms = model.terms;
  terms.emplace_back();
  terms.back().pattern.order = 2.0;
  const Joint joint(problem, model.phi, terms, terms.size());
  const Eigen::Index at = joint.solution.coefficients.size() - 2;
  const double left = joint.solution.coefficients.tail(2).norm();
  const double u =
      joint.sigma_mm *
      std::sqrt(0.5 * joint.solution.inverse.block(at, at, 2, 2).trace());  // of either component
  if (!(second > 3.0 * u)) return {};
  return {
      fmt::format("X has a second harmonic of {:.2g} µm because the circle is off centre (e²/4R, "
                  "in the geometry of the surface). In addition, {:.2g} ± {:.2g} µm (U, k = 2) of "
                  "two undulations remain: this is not an ovality",
                  second / mm_per_um, left / mm_per_um, 2.0 * u / mm_per_um)};
}

}  // namespace trueaxis::diagnose_detail
