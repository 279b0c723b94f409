// SPDX-License-Identifier: Apache-2.0
#include "diagnose/regression/outliers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnose/regression/noise.hpp"
#include "math/statistics.hpp"
#include "measure/sideways.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double far_out = 8.0;        // MAD σ; a real local form peaks at 4.5 σ
constexpr double clings = 3.0;         // next to a reading far out
constexpr std::size_t most_alone = 3;  // readings in a row; more are a dent or an edge
constexpr std::size_t few_rows = 200;
constexpr int looks = 6;

/// Which residuals are not far out, nor next to one that is.
std::vector<char> near_of(const std::vector<double>& left, double sigma) {
  const auto outside = [&](std::size_t i, double times) {
    return std::abs(left[i]) > times * sigma;
  };
  std::vector<char> used(left.size(), 1);
  for (std::size_t i = 0; i < used.size(); ++i) used[i] = !outside(i, far_out);
  for (std::size_t i = 1; i < used.size(); ++i)
    if (!used[i - 1] && outside(i, clings)) used[i] = 0;
  for (std::size_t i = used.size() - 1; i-- > 0;)
    if (!used[i + 1] && outside(i, clings)) used[i] = 0;
  return used;
}

/// Too many are not outliers: the surface is another one.
bool too_many(const std::vector<char>& used) {
  return static_cast<std::size_t>(std::ranges::count(used, 0)) * 3 > used.size();
}

Rejected rejected(std::size_t i, double left_mm, double sigma_mm) {
  return {i + 1, fmt::format("{:.3g} µm off, {:.1f} σ", left_mm / mm_per_um,
                             std::abs(left_mm) / sigma_mm)};
}

/// What the surface may deviate by, fitted to the readings that count.
class Smooth {
 public:
  Smooth(const LinearisationPoint& point, std::span<const Hypothesis> basis,
         std::span<const double> deviation_mm, int threads)
      : point_(point), basis_(basis), deviation_mm_(deviation_mm), threads_(threads) {}

  /// What it leaves of all readings.
  std::vector<double> left_by(const ObservationMask& mask) const {
    NormalEquations equations(point_, mask, deviation_mm_, {}, threads_);
    Columns all = equations.base();
    for (const Columns& own : equations.append(basis_))
      all.insert(all.end(), own.begin(), own.end());
    return remainder(point_, deviation_mm_, basis_, solve(equations.total(), all).coefficients,
                     threads_);
  }

 private:
  const LinearisationPoint& point_;
  std::span<const Hypothesis> basis_;
  std::span<const double> deviation_mm_;
  int threads_;
};

struct Masked {
  ObservationMask mask;
  std::vector<double> left_mm;
  double sigma_mm = 0.0;
  std::size_t count = 0;
};

/// @param left_mm of the readings to begin with
Masked masked_from(std::vector<double> left_mm, const ObservationMask& all,
                   const LinearisationPoint& point, const Smooth& smooth) {
  Masked out{all, std::move(left_mm), 0.0, 0};
  for (int round = 0; round < looks; ++round) {
    out.sigma_mm = mad_sigma(out.left_mm);
    std::vector<char> used = near_of(out.left_mm, out.sigma_mm);
    if (too_many(used)) break;
    const bool same = round > 0 && used == out.mask.used;
    out.mask.used = std::move(used);
    out.count = static_cast<std::size_t>(std::ranges::count(out.mask.used, 0));
    if (same || (round == 0 && out.count == 0 && point.size() < few_rows)) break;
    out.mask.find_runs(point);
    out.left_mm = smooth.left_by(out.mask);
  }
  out.mask.find_runs(point);
  return out;
}

/// Whether a reading is farther from the one before than any noise, however slow, takes it.
/// @param moves_s when the part moves
bool jumps(const std::vector<double>& left_mm, const ObservationMask& mask,
           std::span<const double> time_s, double moves_s) {
  std::vector<double> connected;  // runs of readings that count, parted by NaN
  const auto part = [&] { connected.push_back(std::numeric_limits<double>::quiet_NaN()); };
  for (std::size_t i = 0; i < left_mm.size(); ++i) {
    const bool moves = i > 0 && time_s[i - 1] < moves_s && moves_s <= time_s[i];
    if (mask.run[i] == 0 || moves) part();
    if (mask.used[i]) connected.push_back(left_mm[i]);
  }
  return largest_jump(connected, far_out).has_value();
}

/// The two thirds that fit best, by steps of concentration.
ObservationMask concentrated(std::vector<double> left_mm, const ObservationMask& all,
                             const LinearisationPoint& point, const Smooth& smooth) {
  ObservationMask most = all;
  for (int round = 0; round < 2 * looks; ++round) {
    std::vector<double> size;
    for (const double left : left_mm) size.push_back(std::abs(left));
    std::vector<double> sorted = size;
    const auto at = sorted.begin() + static_cast<long>(2 * size.size() / 3);
    std::ranges::nth_element(sorted, at);
    const double cut = *at;
    std::vector<char> used(size.size());
    for (std::size_t i = 0; i < size.size(); ++i) used[i] = size[i] <= cut;
    if (used == most.used) break;
    most.used = std::move(used);
    most.find_runs(point);
    left_mm = smooth.left_by(most);
  }
  return most;
}

/// Whether the part is at the end of the stream where most of its readings have it: else it
/// slipped, and it is what lies far off that counts. Most of the last revolution lies there, and no
/// more in a row is far off at the end than before; or what is off there has another diameter, or
/// is off in another pass as well.
bool ends_in_place(const Masked& of, const LinearisationPoint& point) {
  const std::size_t end = point.size();
  std::size_t in_row = 0, longest = 0, used = 0, counted = 0;
  for (std::size_t i = 0; i < end; ++i) {
    longest = of.mask.used[i] ? std::max(longest, in_row) : longest;
    in_row = of.mask.used[i] ? 0 : in_row + 1;
  }
  for (std::size_t i = end; i-- > 0 && std::abs(point.c[i] - point.c[end - 1]) < two_pi; ++counted)
    used += of.mask.used[i] ? 1 : 0;
  if (2 * used >= counted && in_row <= longest) return true;
  const std::size_t begin = end - std::max(in_row, counted);
  std::vector<char> excluded(end);
  for (std::size_t i = 0; i < end; ++i) excluded[i] = of.mask.used[i] ? 0 : 1;
  if (met_again(std::span(point.passes), point.z, excluded, begin, end) != nullptr) return true;
  if (point.base.face || point.base.tapers) return false;  // off all round if it moves along Z
  std::vector<double> c_rad, z_mm, off_mm;
  for (std::size_t i = begin; i < end; ++i) {
    if (of.mask.used[i]) continue;
    c_rad.push_back(point.c[i]), z_mm.push_back(point.z[i]), off_mm.push_back(of.left_mm[i]);
  }
  return sideways_of(c_rad, z_mm, off_mm).stays(0.0, far_out * of.sigma_mm);
}

}  // namespace

Outliers find_outliers(const LinearisationPoint& point, std::span<const Hypothesis> basis,
                       std::span<const double> deviation_mm, const ObservationMask& all,
                       int threads, double moves_s) {
  const Smooth smooth(point, basis, deviation_mm, threads);
  const std::vector<double> ideal(deviation_mm.begin(), deviation_mm.end());
  Masked found = masked_from(ideal, all, point, smooth);
  const auto jumps_in = [&](const Masked& of) {  // edges that recur are nearly a form of the part
    return point.size() >= few_rows && (jumps(of.left_mm, of.mask, point.time, moves_s) ||
                                        jumps(ideal, of.mask, point.time, moves_s));
  };
  const bool jumped = jumps_in(found);
  bool still = jumped;
  if (jumped) {
    Masked about =
        masked_from(smooth.left_by(concentrated(ideal, all, point, smooth)), all, point, smooth);
    if (about.count > 0 && !jumps_in(about) && ends_in_place(about, point)) {
      found = std::move(about);
      still = false;
    }
  }
  Outliers out{std::move(found.mask), {}, jumped, still};
  for (std::size_t i = 0; i < point.size() && found.count > 0; ++i)
    if (!out.mask.used[i]) out.list.push_back(rejected(i, found.left_mm[i], found.sigma_mm));
  return out;
}

ObservationMask nearest_two_thirds(const LinearisationPoint& point,
                                   std::span<const Hypothesis> basis,
                                   std::span<const double> deviation_mm, const ObservationMask& all,
                                   int threads) {
  const Smooth smooth(point, basis, deviation_mm, threads);
  return concentrated(smooth.left_by(all), all, point, smooth);
}

std::vector<Rejected> mask_far_from(const LinearisationPoint& point,
                                    const std::vector<double>& left_mm, ObservationMask& mask) {
  std::vector<double> counting;
  for (std::size_t i = 0; i < left_mm.size(); ++i)
    if (mask.used[i]) counting.push_back(left_mm[i]);
  const double sigma = mad_sigma(counting);
  const std::vector<char> near = near_of(left_mm, sigma);
  std::vector<char> used = mask.used;
  std::vector<Rejected> list;
  const auto out = [&](std::size_t i) { return !near[i] || !mask.used[i]; };
  for (std::size_t i = 0, end = 0; i < near.size(); i = end + 1) {
    for (end = i; end < near.size() && out(end); ++end) continue;
    const bool known =
        std::any_of(mask.used.begin() + static_cast<long>(i),
                    mask.used.begin() + static_cast<long>(end), [](char one) { return !one; });
    if (end == i || end - i > most_alone || known) continue;
    for (std::size_t k = i; k < end; ++k) {
      used[k] = 0;
      list.push_back(rejected(k, left_mm[k], sigma));
    }
  }
  if (list.empty() || too_many(used)) return {};
  mask.used = std::move(used);
  mask.find_runs(point);
  return list;
}

}  // namespace trueaxis::diagnose_detail
