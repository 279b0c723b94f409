// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/scan.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <utility>

#include "base/threads.hpp"
#include "diagnose/search/line_norms.hpp"
#include "diagnose/search/scan_fringes.hpp"
#include "diagnose/search/scan_list.hpp"
#include "math/fourier_sums.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

using Column = std::vector<double>;

constexpr double oversampling = 2.5;  // bins a resolution cell: at most 5 % of a peak is missed
constexpr std::size_t peaks_kept = 2, fringes_kept = 5;
constexpr std::size_t near_bins = 5;  // two cells: a peak's own
constexpr double finer = 4.0;
constexpr std::size_t most_bins = std::size_t{1} << 20;        // whose sums are made at a time,
constexpr std::size_t most_bins_of_fewer = 3 * most_bins / 2;  // of less than very many readings

double variance(const LinearisationPoint& point, PointColumn column, int threads) {
  const std::vector<double> all = point.column(column, threads);
  double mean = 0.0, sum = 0.0;
  for (const double v : all) mean += v;
  mean /= static_cast<double>(all.size());
  for (const double v : all) sum += (v - mean) * (v - mean);
  return sum / static_cast<double>(all.size());
}

/// Of a single pass at constant feed a line of C is also one of an order along Z.
void pattern_of_line(const LinearisationPoint& point, const Resolution& resolution,
                     const Peak& line, Scans& out) {
  const Pass& pass =
      *std::ranges::max_element(point.passes, {}, [](const Pass& p) { return p.end - p.begin; });
  const double turns = (point.c[pass.end - 1] - point.c[pass.begin]) / two_pi;
  const double lead =
      (point.at(&PointPart::s, pass.end - 1) - point.at(&PointPart::s, pass.begin)) /
      turns;  // a turn of +C
  const double order = std::round(line.frequency * two_pi);
  const double frequency = (order - line.frequency * two_pi) / lead;
  if (order < 1.0 || order > resolution.harmonics || !(std::abs(frequency * lead * turns) > 0.75))
    return;
  out.patterns.push_back({pattern_line(order, false, frequency), line.gain,
                          line.step * two_pi / std::abs(lead), std::abs(frequency)});
}

/// The highest of a band, none next to another.
std::vector<Top> highest(Column& gain, std::size_t first_bin, std::size_t most) {
  std::vector<Top> out;
  while (out.size() < most) {
    const auto top = std::ranges::max_element(gain);
    if (top == gain.end() || !(*top > 0.0)) break;
    const auto k = static_cast<std::size_t>(top - gain.begin());
    out.push_back({first_bin + k, *top});
    std::fill(gain.begin() + static_cast<long>(k - std::min(k, near_bins)),
              gain.begin() + static_cast<long>(std::min(gain.size(), k + near_bins + 1)), 0.0);
  }
  return out;
}

/// What lies in `within` outside some intervals of it.
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

/// Norms of the lines of a band in noise of one kind, scan by scan.
struct LineScanner::Norms {
  std::vector<double> phi;
  std::vector<Column> of_scan;
};

/// A range of frequencies of a scan, and its sums.
struct LineScanner::Band {
  double low = 0.0, df = 0.0;
  std::size_t bins = 0, first_bin = 0;                ///< the latter counted through all bands
  bool kept = true;                                   ///< the plan, of few readings
  mutable std::shared_ptr<const FourierSums> plan{};  ///< made where it is wanted
  mutable std::shared_ptr<const Norms> norms{};       ///< likewise
};

/// Scans of one variable and one set of bands.
struct LineScanner::Job {
  std::vector<Scan> scans;
  std::vector<Band> bands;
  std::vector<Extent> counted;  ///< frequencies that are looked at
  double middle = 0.0;          ///< of the variable
  bool fringes = false;
  bool sieved = false;  ///< more lie in the bands than are counted

  std::size_t kept() const { return fringes ? fringes_kept : peaks_kept; }
  std::size_t bins() const {
    return bands.empty() ? 0 : bands.back().first_bin + bands.back().bins;
  }
  /// Leaves of a band what is looked at.
  void sieve(const Band& band, Column& gain) const {
    auto interval = counted.begin();
    for (std::size_t k = 0; k < gain.size(); ++k) {
      const double f = band.low + band.df * static_cast<double>(k);
      while (interval != counted.end() && interval->high < f) ++interval;
      if (interval == counted.end() || interval->low > f) gain[k] = 0.0;
    }
  }
  /// The place of a bin, counted through all bands.
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
      counted = means->kept(whole, scan.x, scan.turns, all);
      if (problem.means)
        bands = counted;
      else
        counted = beside(counted, all);
    }
    if (scan.left_out.length() > 0.0) counted = without(counted, scan.left_out);
    double width = 0.0;
    for (const Extent& e : counted) width += e.length();
    if (!(width > 0.0)) continue;
    if (scan.counts)
      bandwidth_ += width * std::sqrt(2.0 * two_pi * variance(point, scan.x, problem.threads));
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
    job.fringes = scan.x == &PointPart::sensed && point.two_sided;
    const Extent range = point.range(scan.x);
    job.middle = 0.5 * range.low + 0.5 * range.high;
    const double df = 1.0 / ((job.fringes ? finer : 1.0) * oversampling * range.length());
    for (const Extent& band : bands) {
      const std::size_t bins = static_cast<std::size_t>((band.high - band.low) / df) + 1;
      const std::size_t most = point.size() < very_many ? most_bins_of_fewer : most_bins;
      for (std::size_t from = 0; from < bins; from += most)
        job.bands.push_back({band.low + df * static_cast<double>(from), df,
                             std::min(most, bins - from), job.bins(), !is_condensed(point)});
    }
    jobs_.push_back(std::move(job));
  }
}

Scans LineScanner::operator()(const NormalEquations& equations,
                              std::vector<double> remainder_mm) const {
  const LinearisationPoint& point = problem_.point;
  const std::vector<double> left = weighted(equations, std::move(remainder_mm));
  std::vector<std::vector<Tops>> tops(jobs_.size());  // of every band of every job
  std::vector<std::pair<std::size_t, std::size_t>> bands;
  for (std::size_t j = 0; j < jobs_.size(); ++j) {
    tops[j].resize(jobs_[j].bands.size());
    for (std::size_t b = 0; b < tops[j].size(); ++b) bands.emplace_back(j, b);
  }
  const std::vector<double> counts = readings_that_count(equations);
  const int threads = point.size() < 10'000 ? 1 : problem_.threads;  // one costs more than it saves
  for_each_index(bands.size(), threads, [&](std::size_t k) {
    const auto [j, b] = bands[k];
    const Job& job = jobs_[j];
    const LineNorms norms(equations, counts, job.scans.front().x, problem_.means);
    tops[j][b] = job.fringes ? tops_of_fringes(job, job.bands[b], norms, left)
                             : tops_of(job, job.bands[b], norms, left);
  });
  Scans out;
  for (std::size_t j = 0; j < jobs_.size(); ++j) add_peaks(jobs_[j], tops[j], out);
  out.bandwidth = bandwidth_;
  return out;
}

LineScanner::Tops LineScanner::tops_of_fringes(const Job& job, const Band& band,
                                               const LineNorms& norms, const Column& left) const {
  const std::vector<FringeCell> cells =
      job.scans.size() > 1
          ? std::vector<FringeCell>{}
          : fringe_cells(norms, problem_.point, job.scans[0], left, band.low, band.df, band.bins);
  if (cells.empty()) return tops_of(job, band, norms, left);
  Tops tops(1);
  std::vector<Top>& best = tops.front();
  for (const FringeCell& cell : cells) {
    if (best.size() >= job.kept() && cell.most < best[job.kept() - 1].gain) break;
    const Band part{band.low + band.df * static_cast<double>(cell.first), band.df, cell.bins,
                    band.first_bin + cell.first, false};
    const Tops more = tops_of(job, part, norms, left);
    best.insert(best.end(), more.front().begin(), more.front().end());
    std::ranges::stable_sort(best, std::greater<>(), &Top::gain);
  }
  return tops;
}

std::shared_ptr<const FourierSums> LineScanner::plan_of(const Job& job, const Band& band) const {
  if (band.kept) {
    const std::lock_guard lock(plans_);
    if (band.plan) return band.plan;
  }
  const LinearisationPoint& point = problem_.point;
  auto made = std::make_shared<const FourierSums>(source_of(point, job.scans.front().x),
                                                  point.size(), job.middle, two_pi * band.low,
                                                  two_pi * band.df, band.bins);
  if (band.kept) {
    const std::lock_guard lock(plans_);
    band.plan = made;
  }
  return made;
}

std::shared_ptr<const LineScanner::Norms> LineScanner::norms_of(const Job& job, const Band& band,
                                                                const LineNorms& norms) const {
  if (!band.kept) return nullptr;
  {
    const std::lock_guard lock(plans_);
    if (band.norms && band.norms->phi == norms.autoregression()) return band.norms;
  }
  auto made = std::make_shared<Norms>();
  made->phi = norms.autoregression();
  for (const Scan& scan : job.scans)
    made->of_scan.push_back(norms.of(scan, band.low, band.df, band.bins));
  const std::lock_guard lock(plans_);
  band.norms = made;
  return made;
}

LineScanner::Tops LineScanner::tops_of(const Job& job, const Band& band, const LineNorms& norms,
                                       const Column& left) const {
  const LinearisationPoint& point = problem_.point;
  const std::shared_ptr<const FourierSums> plan = plan_of(job, band);
  const std::shared_ptr<const Norms> kept = norms_of(job, band, norms);
  TurnedSums turned;
  Tops tops;
  for (const Scan& scan : job.scans) {
    if (!turned.serves(scan, point)) turned = turned_sums(*plan, point, scan, left);
    // Σ g exp(−i(2πfx − turns θ))
    const double turn = scan.turns > 0.0 ? 1.0 : -1.0;
    Column gain = kept ? kept->of_scan[tops.size()] : norms.of(scan, band.low, band.df, band.bins);
    for (std::size_t k = 0; k < band.bins; ++k) {
      std::complex<double> sum = turned.cosine[k];
      if (!turned.sine.empty())
        sum += std::complex(-turn * turned.sine[k].imag(), turn * turned.sine[k].real());
      gain[k] = std::norm(sum) / gain[k];  // of cos and of sin: norm2 each
    }
    if (job.sieved) job.sieve(band, gain);
    tops.push_back(highest(gain, band.first_bin, job.kept()));
  }
  return tops;
}

void LineScanner::add_peaks(const Job& job, const std::vector<Tops>& of_bands, Scans& out) const {
  for (std::size_t s = 0; s < job.scans.size(); ++s) {
    const Scan& scan = job.scans[s];
    std::vector<Top> all;
    for (const Tops& of_band : of_bands)
      all.insert(all.end(), of_band[s].begin(), of_band[s].end());
    std::ranges::stable_sort(all, std::greater<>(), &Top::gain);
    std::vector<Top> taken;
    for (const Top& top : all) {
      const auto is_near = [&](const Top& other) {
        return std::max(top.bin, other.bin) - std::min(top.bin, other.bin) <= near_bins;
      };
      if (taken.size() == job.kept()) break;
      if (std::ranges::any_of(taken, is_near)) continue;
      taken.push_back(top);
      const double f = job.frequency(top.bin);
      Peak peak{scan.make(f), top.gain, job.bands.front().df, f};
      if (problem_.resolution.one_variable && scan.x == &PointPart::c)
        pattern_of_line(problem_.point, problem_.resolution, peak, out);
      (scan.pattern ? out.patterns : out.causes).push_back(std::move(peak));
    }
  }
}

std::vector<double> weighted(const NormalEquations& equations, std::vector<double> remainder_mm) {
  const auto& phi = equations.autoregression();
  const ObservationMask& mask = equations.mask();
  std::vector<double>& e = remainder_mm;  // in place: W from the last on, then Wᵀ from the first
  const std::size_t n = e.size(), p = phi.size();
  for (std::size_t i = n; i-- > 0;) {
    const bool counts = mask.used[i] && mask.run[i] >= p;
    if (!counts) e[i] = 0.0;
    for (std::size_t j = 0; counts && j < p; ++j) e[i] -= phi[j] * e[i - j - 1];
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < p && i + j + 1 < n; ++j) e[i] -= phi[j] * e[i + j + 1];
  return remainder_mm;
}

bool is_line(const Hypothesis& h) {
  return h.effect ? h.effect->line.has_value() : h.pattern.kind == Pattern::Kind::line;
}

PointColumn variable_of(const Hypothesis& line) {
  if (!line.effect) return line.pattern.in_time ? &PointPart::time : &PointPart::s;
  return column_of(line.effect->line->in);
}

Hypothesis at_frequency(const Hypothesis& hypothesis, double frequency) {
  Hypothesis h = hypothesis;
  if (!h.effect) {
    h.pattern.frequency = std::copysign(frequency, h.pattern.frequency);
  } else if (h.effect->line->in == SpectralLine::In::angle) {
    h.shape.order = frequency * two_pi;
  } else if (h.effect->line->in == SpectralLine::In::time) {
    h.shape.frequency_hz = frequency;
  } else {
    h.shape.period_mm = 1.0 / frequency;
  }
  return h;
}

double frequency_of(const Hypothesis& h) {
  if (!h.effect) return std::abs(h.pattern.frequency);
  if (h.effect->line->in == SpectralLine::In::angle) return h.shape.order / two_pi;
  if (h.effect->line->in == SpectralLine::In::time) return h.shape.frequency_hz;
  return 1.0 / h.shape.period_mm;
}

}  // namespace trueaxis::diagnose_detail
