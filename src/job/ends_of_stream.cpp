// SPDX-License-Identifier: Apache-2.0
#include "job/ends_of_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <iterator>
#include <vector>

#include "math/statistics.hpp"
#include "measure/passes.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t least_end = 8;  // readings: of fewer, all must have been left out
constexpr double mostly = 0.5, gathered = 3.0, hardly = 1e-4;

/// The longest run of readings at an end of a stream of which most were left out, and three times
/// the share of all others; 0: outliers lie anywhere. A short one is a run where all of it was left
/// out, which the share of all others makes of it once in 10 000 streams. `left_out(k)`: of the
/// k-th from that end.
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
                            ? here >= mostly * run && here / run >= gathered * elsewhere
                            : here == run && std::pow(elsewhere, run) < hardly;
    if (is_run) longest = i + 1;
  }
  return longest;
}

constexpr double limits[] = {3.0, 4.0};  // σ
constexpr double off_by_chance = 1e-3;   // of streams, of both limits together

/// How many of the last eight lie beyond a limit, if that many do in no other eight and by chance
/// hardly ever do (Eq. 275); 0: no more than elsewhere. `far`: of each reading, in time.
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
  return p * static_cast<double>(std::size(limits)) < off_by_chance ? here : 0;
}

}  // namespace

std::string left_out_at_an_end(const ProbeStream& stream, const Diagnosis& diagnosis) {
  if (stream.size() == 0) return "";
  std::vector<bool> left_out(stream.size(), false);
  for (const auto* rows : {&diagnosis.baseline.rejected, &diagnosis.noise.masked})
    for (const Rejected& r : *rows)
      if (r.row >= 1 && r.row <= stream.size()) left_out[r.row - 1] = true;
  for (const Pass& pass : find_passes(stream)) {
    const std::size_t size = pass.end - pass.begin;
    const std::size_t last =
        left_out_end(size, [&](std::size_t k) { return left_out[pass.end - 1 - k]; });
    const std::size_t first =
        left_out_end(size, [&](std::size_t k) { return left_out[pass.begin + k]; });
    if (first + last == 0) continue;
    return fmt::format(
        "most of the {} {} readings of a pass were left out, because they do not lie where the "
        "others do: the part may have slipped there, and stands elsewhere now. Clamp it again "
        "and probe again, or take that end out of the stream if the surface ends there",
        last > 0 ? "last" : "first", last > 0 ? last : first);
  }
  return "";
}

std::string far_off_at_the_end(const Diagnosis& diagnosis) {
  const std::vector<double>& left_mm = diagnosis.residual_after_mm;
  if (left_mm.size() < 4 * least_end) return "";
  std::vector<double> there;
  std::ranges::copy_if(left_mm, std::back_inserter(there),
                       [](double r) { return std::isfinite(r); });
  const double sigma_mm = mad_sigma(there);
  for (const double limit : limits) {
    std::vector<bool> far(left_mm.size());
    for (std::size_t k = 0; k < left_mm.size(); ++k)
      far[k] = !std::isfinite(left_mm[k]) || std::abs(left_mm[k]) > limit * sigma_mm;
    const std::size_t count = far_in_last(far);
    if (count == 0) continue;
    return fmt::format(
        "{} of the last {} readings lie more than {:.0f} σ off, as no other {} do: the part may "
        "have slipped there, and stands elsewhere now. Clamp it again and probe again, or take "
        "that end out of the stream if the surface ends there",
        count, least_end, limit, least_end);
  }
  return "";
}

}  // namespace trueaxis
