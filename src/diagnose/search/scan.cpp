// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/scan.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>

#include "base/threads.hpp"
#include "diagnose/search/scan_list.hpp"
#include "math/fourier_sums.hpp"
#include "math/sincos.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

using Column = std::vector<double>;

constexpr double oversampling = 2.5;  // bins a resolution cell: at most 5 % of a peak is missed
constexpr std::size_t peaks_kept = 2, fringes_kept = 5;
constexpr double finer = 4.0;
constexpr std::size_t most_bins = std::size_t{1} << 20;  // whose sums are made at a time

double variance(const Column& x) {
  double mean = 0.0, sum = 0.0;
  for (const double v : x) mean += v;
  mean /= static_cast<double>(x.size());
  for (const double v : x) sum += (v - mean) * (v - mean);
  return sum / static_cast<double>(x.size());
}

/// ½ Σ |A|² over the passes: the square of a whitened line's columns, A the transfer of the filter
/// at the line's angle from reading to reading.
double line_norm2(const NormalEquations& equations, const std::vector<double>& used_of_pass,
                  const std::vector<double>& x_step, const std::vector<double>& turn_step,
                  double frequency, double turns) {
  const auto& phi = equations.autoregression();
  double sum = 0.0;
  for (std::size_t p = 0; p < used_of_pass.size(); ++p) {
    const double angle = two_pi * frequency * x_step[p] - turns * turn_step[p];
    std::complex<double> transfer = 1.0;
    const std::complex<double> step = std::polar(1.0, -angle);
    std::complex<double> turned = 1.0;
    for (const double factor : phi) transfer -= factor * (turned *= step);
    sum += 0.5 * used_of_pass[p] * std::norm(transfer);
  }
  return sum;
}

/// The same of lines cos(2π f x − turns θ), f = low, low + df …, where x goes by another step from
/// reading to reading, as the part's own length and what is sensed do of a part that is tilted or
/// off centre: |A|² is a sum of the cosines of one step and of two, summed over the readings.
Column norm2_by_step(const NormalEquations& equations, const Column& x, const Column& angle,
                     double turns, double low, double df, std::size_t bins) {
  const auto& phi = equations.autoregression();
  const ObservationMask& mask = equations.mask();
  Column factor{1.0};
  for (const double p : phi) factor.push_back(-p);
  const double flat = std::inner_product(factor.begin(), factor.end(), factor.begin(), 0.0);
  Column norm2(bins, 0.5 * static_cast<double>(equations.count()) * flat);
  for (std::size_t lag = 1; lag < factor.size(); ++lag) {
    const double both = std::inner_product(factor.begin() + static_cast<long>(lag), factor.end(),
                                           factor.begin(), 0.0);
    Column step, turned;
    for (std::size_t i = lag; i < x.size(); ++i) {
      if (!mask.used[i] || mask.run[i] < phi.size()) continue;
      step.push_back(x[i] - x[i - lag]);
      turned.push_back(turns * (angle[i] - angle[i - lag]));
    }
    Column sine(step.size()), cosine(step.size());
    sincos(turned, sine, cosine);
    for (std::size_t i = 0; i < step.size(); ++i) sine[i] *= both, cosine[i] *= both;
    const std::span<const double> parts[] = {cosine, sine};
    const auto sums = FourierSums(step, two_pi * low, two_pi * df, bins).of(parts);
    for (std::size_t k = 0; k < bins; ++k) norm2[k] += sums[0][k].real() - sums[1][k].imag();
  }
  return norm2;
}

/// Sums of one scan over g cos nθ and g sin nθ, from which those of +n and −n are made.
struct TurnedSums {
  const FourierSums* plan = nullptr;
  double order = 0.0;
  FourierSums::Sums cosine, sine;
};

TurnedSums turned_sums(const FourierSums& plan, double order, const Column& angle,
                       const Column& g) {
  Column phase(g.size()), sine(g.size()), cosine(g.size());
  for (std::size_t i = 0; i < g.size(); ++i) phase[i] = order * angle[i];
  sincos(phase, sine, cosine);
  for (std::size_t i = 0; i < g.size(); ++i) cosine[i] *= g[i], sine[i] *= g[i];
  const std::span<const double> both[] = {cosine, sine};
  std::vector<FourierSums::Sums> sums = plan.of(both);
  return {&plan, order, std::move(sums[0]), std::move(sums[1])};
}

/// Of a single pass at constant feed a line of C is also one of an order along Z.
void pattern_of_line(const LinearisationPoint& point, const Resolution& resolution,
                     const Peak& line, Scans& out) {
  const Pass& pass =
      *std::ranges::max_element(point.passes, {}, [](const Pass& p) { return p.end - p.begin; });
  const double turns = (point.c[pass.end - 1] - point.c[pass.begin]) / two_pi;
  const double lead = (point.s[pass.end - 1] - point.s[pass.begin]) / turns;  // a turn of +C
  const double order = std::round(line.frequency * two_pi);
  const double frequency = (order - line.frequency * two_pi) / lead;
  if (order < 1.0 || order > resolution.harmonics || !(std::abs(frequency * lead * turns) > 0.75))
    return;
  out.patterns.push_back({pattern_line(order, false, frequency), line.gain,
                          line.step * two_pi / std::abs(lead), std::abs(frequency)});
}

/// What lies in `within` beside some intervals of it.
std::vector<Extent> beside(const std::vector<Extent>& intervals, Extent within) {
  std::vector<Extent> out;
  for (const Extent& interval : intervals) {
    if (interval.low > within.low) out.push_back({within.low, interval.low});
    within.low = std::max(within.low, interval.high);
  }
  if (within.high > within.low) out.push_back(within);
  return out;
}

std::vector<Extent> without(const std::vector<Extent>& intervals, const Extent& left_out) {
  std::vector<Extent> out;
  for (const Extent& e : intervals) {
    const double below = std::min(e.high, left_out.low), above = std::max(e.low, left_out.high);
    if (below > e.low) out.push_back({e.low, below});
    if (e.high > above) out.push_back({above, e.high});
  }
  return out;
}

}  // namespace

/// A range of frequencies of a scan, at most most_bins of them, and its sums.
struct LineScanner::Band {
  double low = 0.0, df = 0.0;
  std::size_t bins = 0;
  std::shared_ptr<const FourierSums> plan;  ///< made where it is wanted, and kept of few readings
};

/// Scans of one variable and one set of bands.
struct LineScanner::Job {
  std::vector<Scan> scans;
  std::vector<Band> bands;
  std::vector<Extent> counted;  ///< frequencies that are looked at
  bool fringes = false;
  bool sieved = false;  ///< more lie in the bands than are counted

  /// Of a bin, counted through all bands.
  double frequency(std::size_t bin) const {
    auto band = bands.begin();
    while (bin >= band->bins) bin -= (band++)->bins;
    return band->low + band->df * static_cast<double>(bin);
  }
};

LineScanner::~LineScanner() = default;

LineScanner::LineScanner(const Problem& problem, const Means* fast) : problem_(problem) {
  const LinearisationPoint& point = problem.point;
  const LinearisationPoint& whole = problem.whole ? problem.whole->point : point;
  const Scan* last = nullptr;
  std::vector<Scan> list = scans_of(problem);
  for (const Scan& scan : list) {
    const Extent all{scan.low, scan.high};
    std::vector<Extent> bands{all}, counted{all};
    if (const Means* means = problem.means ? problem.means : fast) {
      counted = means->kept(whole, whole.*scan.x, scan.turns, all);
      if (problem.means)
        bands = counted;
      else
        counted = beside(counted, all);
    }
    if (scan.left_out.length() > 0.0) counted = without(counted, scan.left_out);
    double width = 0.0;
    for (const Extent& e : counted) width += e.length();
    if (!(width > 0.0)) continue;
    if (scan.counts) bandwidth_ += width * std::sqrt(2.0 * two_pi * variance(point.*scan.x));
    const bool same = last && last->x == scan.x && last->low == scan.low &&
                      last->high == scan.high && !jobs_.empty() &&
                      std::ranges::equal(jobs_.back().counted, counted, [](auto a, auto b) {
                        return a.low == b.low && a.high == b.high;
                      });
    last = &scan;
    if (same) {
      jobs_.back().scans.push_back(scan);
      continue;
    }
    Job job{{scan}, {}, counted};
    job.sieved = bands.size() != counted.size() || bands[0].low != counted[0].low ||
                 bands.back().high != counted.back().high;
    // From both sides a period of the scale makes fringes, told apart only by a fine scan.
    job.fringes = scan.x == &LinearisationPoint::sensed && point.two_sided;
    const double df =
        1.0 / ((job.fringes ? finer : 1.0) * oversampling * range_of(point.*scan.x).length());
    for (const Extent& band : bands) {
      const std::size_t bins = static_cast<std::size_t>((band.high - band.low) / df) + 1;
      for (std::size_t from = 0; from < bins; from += most_bins)
        job.bands.push_back({band.low + df * static_cast<double>(from), df,
                             std::min(most_bins, bins - from), nullptr});
    }
    jobs_.push_back(std::move(job));
  }
}

Scans LineScanner::operator()(const NormalEquations& equations,
                              std::span<const double> remainder_mm) {
  const LinearisationPoint& point = problem_.point;
  const std::vector<double> plain = weighted(equations, remainder_mm);
  std::vector<double> outward = plain;  // of what lies along the normal
  for (std::size_t i = 0; i < outward.size(); ++i)
    if (point.rear[i]) outward[i] = -outward[i];
  std::vector<std::vector<Gains>> gains(jobs_.size());  // of every band of every job
  std::vector<std::pair<std::size_t, std::size_t>> bands;
  for (std::size_t j = 0; j < jobs_.size(); ++j) {
    gains[j].resize(jobs_[j].bands.size());
    for (std::size_t b = 0; b < gains[j].size(); ++b) bands.emplace_back(j, b);
  }
  const int threads = point.size() < 10'000 ? 1 : problem_.threads;  // one costs more than it saves
  for_each_index(bands.size(), threads, [&](std::size_t k) {
    const auto [j, b] = bands[k];
    gains[j][b] = gains_of(jobs_[j], jobs_[j].bands[b], equations, plain, outward);
  });
  std::vector<Scans> found(jobs_.size());
  for_each_index(jobs_.size(), threads,
                 [&](std::size_t j) { found[j] = peaks_of(jobs_[j], std::move(gains[j])); });
  Scans out;
  for (Scans& one : found) {
    std::ranges::move(one.causes, std::back_inserter(out.causes));
    std::ranges::move(one.patterns, std::back_inserter(out.patterns));
  }
  out.bandwidth = bandwidth_;
  return out;
}

/// Of every reading that counts, pass by pass.
struct LineScanner::Steps {
  std::vector<double> used, c, x;

  Steps(const NormalEquations& equations, const Column& along, const Means* means) {
    const LinearisationPoint& point = equations.point();
    const ObservationMask& mask = equations.mask();
    for (std::size_t p = 0; p < point.passes.size(); ++p) {
      const Pass& pass = point.passes[p];
      double count = 0.0;
      for (std::size_t i = pass.begin; i < pass.end; ++i)
        count += mask.used[i] && mask.run[i] >= equations.autoregression().size();
      used.push_back(count);
      // Means follow each other within a turn, and then leave some turns out.
      std::size_t last = pass.end - 1;
      if (means && means->of_pass[p].turns > 0.0)
        last = std::min(last, pass.begin + static_cast<std::size_t>(means->of_pass[p].sectors) - 1);
      const auto step = [&](const Column& of) {
        return last > pass.begin
                   ? (of[last] - of[pass.begin]) / static_cast<double>(last - pass.begin)
                   : 0.0;
      };
      c.push_back(step(point.c)), x.push_back(step(along));
    }
  }
};

LineScanner::Gains LineScanner::gains_of(const Job& job, Band& band,
                                         const NormalEquations& equations, const Column& plain,
                                         const Column& outward) const {
  const LinearisationPoint& point = problem_.point;
  const Column& x = point.*job.scans.front().x;
  const Steps steps(equations, x, problem_.means);
  const bool white = equations.autoregression().empty();
  const bool swings = !white && (job.scans.front().x == &LinearisationPoint::sensed ||
                                 job.scans.front().x == &LinearisationPoint::s);
  std::shared_ptr<const FourierSums> plan = band.plan;
  if (!plan)
    plan = std::make_shared<FourierSums>(x, two_pi * band.low, two_pi * band.df, band.bins);
  if (!is_condensed(point)) band.plan = plan;
  TurnedSums turned;
  Gains gains(job.scans.size());
  for (std::size_t s = 0; s < job.scans.size(); ++s) {
    const Scan& scan = job.scans[s];
    const std::vector<double>& g = scan.form ? outward : plain;
    const Column& angle = scan.spindle ? point.c : point.theta;
    std::vector<std::complex<double>> sums;
    if (scan.turns == 0.0) {
      sums = plan->of(g);
    } else {
      const double n = std::abs(scan.turns);
      if (turned.plan == nullptr || turned.order != n) turned = turned_sums(*plan, n, angle, g);
      // Σ g exp(−i(2πfx − turns θ))
      sums = turned.cosine;
      const std::complex<double> turn(0.0, scan.turns > 0.0 ? 1.0 : -1.0);
      for (std::size_t k = 0; k < band.bins; ++k) sums[k] += turn * turned.sine[k];
    }
    const double flat = line_norm2(equations, steps.used, steps.x, steps.c, band.low, scan.turns);
    Column by_step;
    if (swings && !scan.pattern)  // a pattern is of few cycles
      by_step = norm2_by_step(equations, x, angle, scan.turns, band.low, band.df, band.bins);
    for (std::size_t k = 0; k < band.bins; ++k) {
      const double f = band.low + band.df * static_cast<double>(k);
      const double norm2 = white ? flat
                           : !by_step.empty()
                               ? by_step[k]
                               : line_norm2(equations, steps.used, steps.x, steps.c, f, scan.turns);
      gains[s].push_back(std::norm(sums[k]) / norm2);  // of cos and of sin: norm2 each
    }
  }
  return gains;
}

Scans LineScanner::peaks_of(const Job& job, std::vector<Gains> of_bands) const {
  const LinearisationPoint& point = problem_.point;
  Scans out;
  for (std::size_t s = 0; s < job.scans.size(); ++s) {
    std::vector<double> gain = std::move(of_bands.front()[s]);
    for (std::size_t b = 1; b < of_bands.size(); ++b)
      gain.insert(gain.end(), of_bands[b][s].begin(), of_bands[b][s].end());
    std::size_t interval = 0;
    for (std::size_t k = 0; job.sieved && k < gain.size(); ++k) {
      const double f = job.frequency(k);
      while (interval < job.counted.size() && job.counted[interval].high < f) ++interval;
      if (interval == job.counted.size() || job.counted[interval].low > f) gain[k] = 0.0;
    }
    const Scan& scan = job.scans[s];
    for (std::size_t taken = 0; taken < (job.fringes ? fringes_kept : peaks_kept); ++taken) {
      const auto top = std::ranges::max_element(gain);
      if (top == gain.end() || !(*top > 0.0)) break;
      const auto k = static_cast<std::size_t>(top - gain.begin());
      const double f = job.frequency(k);
      Peak peak{scan.make(f), *top, job.bands.front().df, f};
      if (problem_.resolution.one_variable && scan.x == &LinearisationPoint::c)
        pattern_of_line(point, problem_.resolution, peak, out);
      (scan.pattern ? out.patterns : out.causes).push_back(std::move(peak));
      const std::size_t near = static_cast<std::size_t>(2.0 * oversampling);
      std::fill(gain.begin() + static_cast<long>(k - std::min(k, near)),
                gain.begin() + static_cast<long>(std::min(gain.size(), k + near + 1)), 0.0);
    }
  }
  return out;
}

std::vector<double> weighted(const NormalEquations& equations,
                             std::span<const double> remainder_mm) {
  const auto& phi = equations.autoregression();
  const ObservationMask& mask = equations.mask();
  const std::size_t n = remainder_mm.size(), p = phi.size();
  std::vector<double> white(n, 0.0), out(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    if (!mask.used[i] || mask.run[i] < p) continue;
    white[i] = remainder_mm[i];
    for (std::size_t j = 0; j < p; ++j) white[i] -= phi[j] * remainder_mm[i - j - 1];
  }
  for (std::size_t i = 0; i < n; ++i) {
    out[i] += white[i];
    for (std::size_t j = 0; j < p; ++j)
      if (white[i] != 0.0) out[i - j - 1] -= phi[j] * white[i];
  }
  return out;
}

bool is_line(const Hypothesis& h) {
  return h.effect ? h.effect->line.has_value() : h.pattern.kind == Pattern::Kind::line;
}

const std::vector<double>& variable_of(const Hypothesis& line, const LinearisationPoint& point) {
  if (!line.effect) return line.pattern.in_time ? point.time : point.s;
  return point.*column_of(line.effect->line->in);
}

Hypothesis at_frequency(const Hypothesis& hypothesis, double frequency) {
  Hypothesis h = hypothesis;
  if (!h.effect) {
    h.pattern.frequency = std::copysign(frequency, h.pattern.frequency);
  } else if (h.effect->line->in == Line::In::angle) {
    h.shape.order = frequency * two_pi;
  } else if (h.effect->line->in == Line::In::time) {
    h.shape.frequency_hz = frequency;
  } else {
    h.shape.period_mm = 1.0 / frequency;
  }
  return h;
}

double frequency_of(const Hypothesis& h) {
  if (!h.effect) return std::abs(h.pattern.frequency);
  if (h.effect->line->in == Line::In::angle) return h.shape.order / two_pi;
  if (h.effect->line->in == Line::In::time) return h.shape.frequency_hz;
  return 1.0 / h.shape.period_mm;
}

}  // namespace trueaxis::diagnose_detail
