// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "fit/moved.hpp"
#include "job/doubts.hpp"
#include "math/statistics.hpp"
#include "measure/passes.hpp"
#include "measure/sideways.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t least_end = 8;  // readings: with fewer, all must be excluded
constexpr Threshold mostly{"left_out", 0.5, "of a run", "most of it"};
constexpr Threshold gathered{"gathered", 3.0, "times elsewhere", "outliers alone lie anywhere"};
constexpr Threshold hardly{"by_chance", 1e-4, "of streams",
                           "that a short run is excluded as a whole"};
constexpr Threshold least_slip{"slip", 0.01, "mm", "the smallest that is typical, which must show"};
constexpr double no_edges = 0.9;  // of the readings of an undercut lie away from its edges
constexpr Threshold alike{"alike", 4.0, "σ", "nine of ten differences of readings are within 2.6"};
constexpr double limits[] = {3.0, 4.0};  // σ
constexpr Threshold off_by_chance{"by_chance", 1e-3, "of streams",
                                  "for both limits together, Eq. 275"};

/// The longest run of readings at an end of a stream of which most were excluded, and three times
/// the share of all others; 0: outliers lie anywhere. A short run counts if all of it was excluded;
/// the share of all others gives that once in 10 000 streams. `left_out(k)`: of the k-th from that
/// end.
template <typename LeftOut>
std::size_t left_out_end(std::size_t count, LeftOut left_out) {
  double total = 0.0, here = 0.0;
  for (std::size_t i = 0; i < count; ++i) total += left_out(i) ? 1.0 : 0.0;
  std::size_t longest = 0;
  for (std::size_t i = 0; i < count / 2; ++i) {
    here += left_out(i) ? 1.0 : 0.0;
    const auto run = static_cast<double>(i + 1), rest = static_cast<double>(count) - run;
    const double elsewhere = (total - here + 1.0) / rest;
    const bool is_run = i + 1 >= least_end
                            ? here >= mostly.value * run && here / run >= gathered.value * elsewhere
                            : here == run && std::pow(elsewhere, run) < hardly.value;
    if (is_run) longest = i + 1;
  }
  return longest;
}

/// How many of the last eight lie beyond a limit, if that many do in no other eight and noise
/// hardly ever does it (Eq. 275); 0: no more than elsewhere. `far`: for each reading, in time.
std::size_t far_in_last(const std::vector<bool>& far) {
  const std::size_t rest = far.size() - least_end;
  std::size_t elsewhere = 0, here = 0, window = 0, most = 0;
  for (std::size_t i = 0; i < far.size(); ++i) {
    (i < rest ? elsewhere : here) += far[i] ? 1 : 0;
    window += far[i] ? 1 : 0;
    if (i >= least_end) window -= far[i - least_end] ? 1 : 0;
    if (i < rest) most = std::max(most, window);
  }
  if (here <= std::max<std::size_t>(most, 1)) return 0;
  const double share = (static_cast<double>(elsewhere) + 1.0) / (static_cast<double>(rest) + 1.0);
  const boost::math::binomial_distribution<double> law(static_cast<double>(least_end), share);
  const double p = cdf(complement(law, static_cast<double>(here) - 1.0));
  return p * static_cast<double>(std::size(limits)) < off_by_chance.value ? here : 0;
}

/// What was excluded at an end of a pass.
struct LeftOut {
  const ProbeStream& stream;
  const Diagnosis& diagnosis;
  std::vector<Pass> passes;
  std::vector<char> excluded;

  LeftOut(const ProbeStream& read, const Diagnosis& of)
      : stream(read), diagnosis(of), passes(find_passes(read)), excluded(read.size(), 0) {
    for (const auto* rows : {&of.baseline.rejected, &of.noise.masked})
      for (const Rejected& r : *rows)
        if (r.row >= 1 && r.row <= read.size()) excluded[r.row - 1] = 1;
  }

  /// Whether it has another diameter, as an undercut has: a slip would show there sideways.
  bool has_other_diameter(std::size_t begin, std::size_t end) const {
    std::vector<double> c_rad, z_mm, off_mm;
    for (std::size_t i = begin; i < end; ++i) {
      if (!excluded[i]) continue;
      c_rad.push_back(stream.c_rad[i]), z_mm.push_back(stream.position_mm[i]);
      off_mm.push_back(diagnosis.residual_after_mm[i]);
    }
    const bool known = diagnosis.extended.axis_known();
    return sideways_of(c_rad, z_mm, off_mm)
        .stays(known ? U_of_axis_mm(diagnosis.extended) : 0.0, least_slip.value);
  }

  /// Whether it lies where another pass has what was excluded there, but for noise and edges.
  bool lies_as_in(const Pass& other, std::size_t begin, std::size_t end) const {
    std::vector<std::pair<double, double>> there;  // Z and residual
    for (std::size_t i = other.begin; i < other.end; ++i)
      if (excluded[i]) there.emplace_back(stream.position_mm[i], diagnosis.residual_after_mm[i]);
    std::ranges::sort(there);
    std::vector<double> apart_mm;
    for (std::size_t i = begin; i < end; ++i)
      if (excluded[i])
        apart_mm.push_back(
            std::abs(diagnosis.residual_after_mm[i] - between(there, stream.position_mm[i])));
    const auto ninth =
        apart_mm.begin() + static_cast<long>(no_edges * static_cast<double>(apart_mm.size() - 1));
    std::ranges::nth_element(apart_mm, ninth);
    return *ninth < alike.value * diagnosis.noise.sigma_mm;
  }

  /// Between the two next to Z.
  static double between(const std::vector<std::pair<double, double>>& there, double z_mm) {
    const auto above = std::ranges::lower_bound(there, z_mm, {}, &std::pair<double, double>::first);
    if (above == there.begin()) return above->second;
    const auto& [low, at_low] = *(above - 1);
    if (above == there.end() || !(above->first > low)) return at_low;
    return std::lerp(at_low, above->second, (z_mm - low) / (above->first - low));
  }
};

std::optional<Reason> left_out_at_end(const ProbeStream& stream, const Diagnosis& diagnosis) {
  if (stream.size() == 0) return {};
  const LeftOut of(stream, diagnosis);
  const bool round = diagnosis.baseline.surface == SurfaceKind::cylinder;
  std::vector<Pass> runs = of.passes;
  runs.push_back({.begin = 0, .end = stream.size()});  // a last pass may be excluded as a whole
  for (const Pass& pass : runs) {
    const std::size_t size = pass.end - pass.begin;
    const auto unproven = [&](std::size_t begin, std::size_t end) {
      if (begin == end) return false;
      if (!stream.has_position() || diagnosis.residual_after_mm.size() != stream.size())
        return true;
      const Pass* other =
          met_again(std::span(of.passes), stream.position_mm, of.excluded, begin, end);
      if (other != nullptr && of.lies_as_in(*other, begin, end)) return false;
      // A cone or a face that moves along its axis at the last lies off alike all round.
      return (!round && end == stream.size()) || !of.has_other_diameter(begin, end);
    };
    const std::size_t last =
        left_out_end(size, [&](std::size_t k) { return of.excluded[pass.end - 1 - k] != 0; });
    const std::size_t first =
        left_out_end(size, [&](std::size_t k) { return of.excluded[pass.begin + k] != 0; });
    const bool at_last = unproven(pass.end - last, pass.end);
    if (at_last || unproven(pass.begin, pass.begin + first))
      return Reason{ReasonCode::left_out_at_an_end,
                    {},
                    {{"count", static_cast<double>(at_last ? last : first)}},
                    {{"end", at_last ? "last" : "first"}}};
  }
  return {};
}

std::optional<Reason> far_off_at_end(const ProbeStream&, const Diagnosis& diagnosis) {
  const std::vector<double>& left_mm = diagnosis.residual_after_mm;
  if (left_mm.size() < 4 * least_end) return {};
  std::vector<double> there;
  std::ranges::copy_if(left_mm, std::back_inserter(there),
                       [](double r) { return std::isfinite(r); });
  const double sigma_mm = mad_sigma(there);
  for (const double limit : limits) {
    std::vector<bool> far(left_mm.size());
    for (std::size_t k = 0; k < left_mm.size(); ++k)
      far[k] = !std::isfinite(left_mm[k]) || std::abs(left_mm[k]) > limit * sigma_mm;
    if (const std::size_t count = far_in_last(far); count > 0)
      return Reason{ReasonCode::far_off_at_the_end,
                    {},
                    {{"count", static_cast<double>(count)},
                     {"last", static_cast<double>(least_end)},
                     {"limit", limit}}};
  }
  return {};
}

constexpr Threshold of_left_out[] = {mostly, gathered, hardly, least_slip, alike};
constexpr Threshold of_far_off[] = {off_by_chance};

}  // namespace

constinit const AxisDoubt left_out_at_an_end{"left_out_at_an_end", of_left_out, left_out_at_end};
constinit const AxisDoubt far_off_at_the_end{"far_off_at_the_end", of_far_off, far_off_at_end};

}  // namespace trueaxis
