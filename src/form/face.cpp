// SPDX-License-Identifier: Apache-2.0
#include "form/face.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cmath>
#include <numeric>
#include <ranges>

#include "base/counted.hpp"
#include "base/threads.hpp"
#include "form/bounded.hpp"
#include "form/section_model.hpp"
#include "form/stream_checks.hpp"
#include "form/uncertainty.hpp"
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
    const std::string about = std::string(zone ? "MZ" : "LS").append(names_.suffix);
    const auto add = [&](const char* which, double value) {
      values.push_back(
          {names_.group, std::string(names_.prefix).append(which), about, upright * value});
    };
    add("t", high - low);
    add("p", std::max(0.0, high));
    add("v", std::max(0.0, -low));
    add("q", root_mean_square(off));
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

namespace {

constexpr double one_ring_mm = 0.01;
constexpr std::size_t least_of_a_ring = 8;

/// Whole turns of a spiral, which are rings but for the feed.
std::vector<std::vector<std::size_t>> turns_of(const ProbeStream& stream) {
  std::vector<std::vector<std::size_t>> turns;
  const std::vector<double>& c = stream.c_rad;
  for (std::size_t begin = 0, i = 1; i < c.size(); ++i) {
    const bool turns_back = i > begin + 1 && (c[i] - c[i - 1]) * (c[begin + 1] - c[begin]) < 0.0;
    if (!turns_back && std::abs(c[i] - c[begin]) < two_pi) continue;
    if (!turns_back && i - begin >= least_of_a_ring) {
      turns.emplace_back(i - begin);
      std::iota(turns.back().begin(), turns.back().end(), begin);
    }
    begin = i;
  }
  return turns;
}

/// Readings at one X, in order of X; of a spiral its turns.
std::vector<std::vector<std::size_t>> rings_of(const ProbeStream& stream) {
  std::vector<std::size_t> order(stream.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return stream.position_mm[i]; });
  std::vector<std::vector<std::size_t>> rings;
  double begin = -1e300;
  for (const std::size_t i : order) {
    if (rings.empty() || stream.position_mm[i] - begin > one_ring_mm) {
      rings.emplace_back();
      begin = stream.position_mm[i];
    }
    rings.back().push_back(i);
  }
  std::erase_if(rings, [](const auto& ring) { return ring.size() < least_of_a_ring; });
  return rings.empty() ? turns_of(stream) : rings;
}

std::vector<NamedValue> axial_run_out(const std::vector<std::vector<std::size_t>>& rings,
                                      std::span<const double> height_mm) {
  std::vector<NamedValue> values;
  double circular = 0.0;
  for (const auto& ring : rings) {
    const auto at = [&](std::size_t i) { return height_mm[i]; };
    const auto [low, high] = std::ranges::minmax(ring | std::views::transform(at));
    circular = std::max(circular, high - low);
  }
  if (!rings.empty()) values.push_back({"datum", "axial_runout_circular", "", circular});
  values.push_back({"datum", "axial_runout_total", "", range_of(height_mm).length()});
  return values;
}

/// Noise that neighbours in the order of the stream show.
double noise_in_order(std::span<const double> off_mm) {
  Trace trace;
  for (std::size_t i = 0; i < off_mm.size(); ++i) trace.at.push_back(static_cast<double>(i));
  trace.value_mm.assign(off_mm.begin(), off_mm.end());
  return trace.size() > 2 ? shown_noise_mm(trace) : 0.0;
}

/// Noise that readings at one C show, a turn apart: what is slow from reading to reading, such as a
/// vibration, hides from neighbours, and only form returns with C.
double noise_a_turn_apart(const ProbeStream& stream, std::span<const double> off_mm) {
  std::vector<double> apart;
  const std::vector<double>& c = stream.c_rad;
  for (std::size_t i = 0, j = 1; i < c.size(); ++i) {
    j = std::max(j, i + 1);
    while (j < c.size() && std::abs(c[j] - c[i]) < two_pi) ++j;
    if (j == c.size()) break;
    const double share = (two_pi - std::abs(c[j - 1] - c[i])) / std::abs(c[j] - c[j - 1]);
    if (!(share > 0.0 && share <= 1.0)) continue;
    const double before = 1.0 - share;
    apart.push_back((off_mm[i] - before * off_mm[j - 1] - share * off_mm[j]) /
                    std::sqrt(1.0 + before * before + share * share));
  }
  return apart.empty() ? 0.0 : mad_sigma(apart);
}

/// Heights without chips, which are on the surface of best fit instead.
std::vector<double> without_chips(std::span<const double> height_mm, std::span<const double> off_mm,
                                  FormResult& result) {
  const std::vector<bool> chips = lone_outliers(off_mm);
  std::vector<double> without(height_mm.begin(), height_mm.end());
  for (std::size_t i = 0; i < without.size(); ++i)
    if (chips[i]) without[i] -= off_mm[i];
  if (const auto count = static_cast<std::size_t>(std::ranges::count(chips, true)); count > 0)
    result.notes.push_back(fmt::format(
        "{} far off, such as on chips: U is so large that the values may be without {}. "
        "Clean the face and probe again",
        counted(count, "single reading lies", "single readings lie"), count == 1 ? "it" : "them"));
  return without;
}

}  // namespace

void assess_heights(std::span<const std::array<double, 2>> at_mm, bool plane,
                    std::span<const double> height_mm, const NoiseOf& shown,
                    const AssessHeights& more, std::span<const TakenOff> taken_off, bool ordered,
                    FormResult& result) {
  const HeightModel model(at_mm, plane,
                          plane ? HeightModel::Names{"flatness", "FLT", "PL"}
                                : HeightModel::Names{"straightness", "STR", "LI"});
  const AssessHeights assess = [&](std::span<const double> heights) {
    std::vector<NamedValue> values = model.assess(heights);
    if (more)
      for (NamedValue& one : more(heights)) values.push_back(std::move(one));
    return values;
  };
  const std::vector<double> off = model.off_mm(height_mm);
  const double noise_mm = std::max(shown(off), result.options.noise_mm.value_or(0.0));
  const auto values = assess(height_mm);
  // A chip makes a range that noise hardly changes.
  const std::vector<double> clean_mm = ordered ? without_chips(height_mm, off, result)
                                               : std::vector(height_mm.begin(), height_mm.end());
  const auto cleaned = assess(clean_mm);
  auto spread =
      spreads_of_heights(clean_mm, model.off_mm(clean_mm), noise_mm, result.options, assess);
  add_taken_off(taken_off, values, spread, [&](const TakenOff& one, std::size_t k) {
    return assess(added(height_mm, one, k));
  });
  for (std::size_t v = 0; v < values.size(); ++v)
    spread[v].u += std::abs(values[v].value - cleaned[v].value) / result.options.coverage_factor;
  const Bounded bounded(values, spread, result.options.coverage_factor);
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (result.groups.empty() || result.groups.back().name != values[v].group)
      result.groups.push_back({values[v].group, {}});
    result.groups.back().values.push_back(bounded(values[v], spread[v]));
  }
  result.notes.push_back(
      fmt::format("No filter along the surface: the values are those of the unfiltered readings, "
                  "and U is based on a noise of {:.3g} µm per reading",
                  noise_mm / mm_per_um));
}

std::vector<double> leaning(const ProbeStream& face, const std::array<double, 2>& slope) {
  std::vector<double> height_mm;
  for (std::size_t i = 0; i < face.size(); ++i)
    height_mm.push_back(face.position_mm[i] *
                        (slope[0] * std::cos(face.c_rad[i]) + slope[1] * std::sin(face.c_rad[i])));
  return height_mm;
}

void assess_face(const ProbeStream& stream, const Lean& datum, std::span<const TakenOff> taken_off,
                 FormResult& result) {
  expect_face(stream);
  std::vector<std::array<double, 2>> at;
  std::vector<double> height_mm = leaning(stream, datum.slope);  // along the axis
  for (std::size_t i = 0; i < stream.size(); ++i) {
    at.push_back({stream.position_mm[i] * std::cos(stream.c_rad[i]),
                  stream.position_mm[i] * std::sin(stream.c_rad[i])});
    height_mm[i] += stream.reading_mm[i];
  }
  const std::vector<std::vector<double>> columns_mm{leaning(stream, {datum.u[0], 0.0}),
                                                    leaning(stream, {0.0, datum.u[1]})};
  constexpr double independent[] = {1.0, 0.0, 0.0, 1.0};
  std::vector<TakenOff> uncertain(taken_off.begin(), taken_off.end());
  uncertain.push_back({columns_mm, independent});
  const auto rings = rings_of(stream);
  assess_heights(
      at, true, height_mm,
      [&](std::span<const double> off) {
        return std::max(noise_in_order(off), noise_a_turn_apart(stream, off));
      },
      [&](std::span<const double> heights) { return axial_run_out(rings, heights); }, uncertain,
      true, result);
}

}  // namespace trueaxis::form
