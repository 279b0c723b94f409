// SPDX-License-Identifier: Apache-2.0
#include "form/heights.hpp"

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cmath>

#include "base/threads.hpp"
#include "math/statistics.hpp"

namespace trueaxis::form {
namespace {

double scale_of(std::span<const std::array<double, 2>> at_mm) {
  double scale = 1e-9;
  for (const auto& [u, v] : at_mm) scale = std::max({scale, std::abs(u), std::abs(v)});
  return scale;
}

}  // namespace

Exchange::Rows height_rows(std::span<const std::array<double, 2>> at_mm, bool plane,
                           double scale_mm) {
  Exchange::Rows rows(static_cast<Eigen::Index>(at_mm.size()), plane ? 3 : 2);
  Eigen::Index row = 0;
  for (const auto& [u, v] : at_mm) {
    if (plane)
      rows.row(row++) << 1.0, u / scale_mm, v / scale_mm;
    else
      rows.row(row++) << 1.0, u / scale_mm;
  }
  return rows;
}

HeightModel::HeightModel(std::span<const std::array<double, 2>> at_mm, bool plane,
                         const Names& names)
    : least_(height_rows(at_mm, plane, scale_of(at_mm)), Criterion::gaussian),
      zone_(height_rows(at_mm, plane, scale_of(at_mm)), Criterion::minimum_zone),
      names_(names),
      scale_mm_(scale_of(at_mm)) {}

std::vector<double> HeightModel::off_mm(std::span<const double> height_mm) const {
  Exchange fit = least_;
  return fit.off(height_mm, fit(height_mm));
}

std::vector<NamedValue> HeightModel::assess(std::span<const double> height_mm) const {
  std::vector<NamedValue> values;
  for (const bool zone : {false, true}) {
    Exchange fit = zone ? zone_ : least_;
    const Nearest nearest = fit(height_mm);
    const std::vector<double> off = fit.off(height_mm, nearest);
    const double slope = nearest.q.tail(nearest.q.size() - 1).norm() / scale_mm_;
    const double upright = 1.0 / std::sqrt(1.0 + slope * slope);
    const auto [low, high] = range_of(off);
    double squares = 0.0;
    for (const double one : off) squares += one * one;
    const std::string about = std::string(zone ? "MZ" : "LS").append(names_.suffix);
    const auto add = [&](const char* which, double value) {
      values.push_back(
          {names_.group, std::string(names_.prefix).append(which), about, upright * value});
    };
    add("t", high - low);
    add("p", std::max(0.0, high));
    add("v", std::max(0.0, -low));
    add("q", std::sqrt(squares / static_cast<double>(off.size())));
  }
  return values;
}

std::vector<Spread> spreads_of_heights(std::span<const double> height_mm,
                                       std::span<const double> off_mm, double noise_mm,
                                       const FormOptions& options, const AssessHeights& assess) {
  double variance = 0.0;
  for (const double one : off_mm) variance += one * one / static_cast<double>(off_mm.size());
  const double noise = noise_mm * noise_mm;
  const double lost = variance > noise ? 1.0 - std::sqrt(1.0 - noise / variance) : 1.0;
  std::vector<double> base(height_mm.begin(), height_mm.end());
  for (std::size_t i = 0; i < base.size(); ++i) base[i] -= lost * off_mm[i];
  const std::vector<NamedValue> values = assess(base);
  const auto trials = static_cast<std::size_t>(options.trials);
  std::vector<std::vector<double>> drawn(trials);
  for_each_index(trials, options.threads, [&](std::size_t trial) {
    boost::random::mt19937_64 engine(options.seed + 0x9E3779B97F4A7C15ULL * (trial + 1));
    boost::random::normal_distribution<double> normal;
    std::vector<double> heights = base;
    for (double& one : heights) one += noise_mm * normal(engine);
    for (const NamedValue& one : assess(heights)) drawn[trial].push_back(one.value);
  });
  std::vector<Spread> out(values.size(), {0.0, 0.0});
  for (std::size_t v = 0; v < values.size(); ++v) {
    for (const auto& trial : drawn) {
      const double off = trial[v] - values[v].value;
      out[v].bias += off / static_cast<double>(trials);
      out[v].u += off * off / static_cast<double>(trials);
    }
    out[v].u = std::sqrt(out[v].u);
  }
  return out;
}

}  // namespace trueaxis::form
