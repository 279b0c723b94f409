// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include "diagnose/regression/noise.hpp"
#include "diagnose/search/causes.hpp"
#include "diagnose/search/search.hpp"
#include "math/statistics.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr std::size_t best_presets = 12, best_patterns = 3, best_orders = 2, best_refined = 6;
constexpr std::size_t most_rivals = 16;
constexpr double far_behind = 0.3;  // share of the best gain below which nothing is a rival
constexpr double line_tests = 3.6;  // Rice's √(S/2) near the threshold: what a scan's choice costs
constexpr double step_shrink = 0.4;
constexpr int rounds = 4;
constexpr double finest = 1e-4;  // a slip that leads is dated to this share of the time

void append_columns(Columns& to, const std::vector<Columns>& from) {
  for (const Columns& own : from) to.insert(to.end(), own.begin(), own.end());
}

std::vector<Hypothesis> joined(const std::vector<Hypothesis>& a, const std::vector<Hypothesis>& b) {
  std::vector<Hypothesis> out(a);
  out.insert(out.end(), b.begin(), b.end());
  return out;
}

/// Scores of hypotheses beside terms from one equations over [terms, list].
std::vector<Candidate> judge(const NormalEquations& equations, const std::vector<Columns>& places,
                             const std::vector<Hypothesis>& list, std::size_t terms) {
  Columns taken = equations.base();
  for (std::size_t t = 0; t < terms; ++t)
    taken.insert(taken.end(), places[t].begin(), places[t].end());
  const Projection projection = project(equations.total(), taken);
  const auto freedom = static_cast<double>(equations.count() - projection.rank);
  std::vector<Candidate> out;
  for (std::size_t h = 0; h < list.size(); ++h) {
    const Columns& own = places[terms + h];
    const Score s = score(projection, own);
    Candidate c{list[h], s.gain, s.rank, 0.0, 0.0};
    c.log_p = log_p_value(s.gain, static_cast<double>(s.rank), projection.rss, freedom);
    Eigen::VectorXd size = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(own.size()));
    if (s.rank == own.size()) {
      Eigen::MatrixXd part(size.size() + 1, size.size() + 1);
      Columns all{0};
      all.insert(all.end(), own.begin(), own.end());
      for (Eigen::Index i = 0; i < part.rows(); ++i) {
        for (Eigen::Index j = 0; j < part.cols(); ++j)
          part(i, j) = projection.gram(static_cast<Eigen::Index>(all[static_cast<std::size_t>(i)]),
                                       static_cast<Eigen::Index>(all[static_cast<std::size_t>(j)]));
      }
      Columns local(own.size());
      for (std::size_t j = 0; j < local.size(); ++j) local[j] = j + 1;
      size = solve(part, local).coefficients;
    }
    c.criterion = freedom * std::log(std::max(1.0 - s.gain / projection.rss, 1e-12)) +
                  penalty(list[h], s.rank, equations.count(), size);
    if (s.rank == 0) c.criterion = 0.0;
    out.push_back(std::move(c));
  }
  return out;
}

bool better(const Candidate& a, const Candidate& b) { return a.criterion < b.criterion; }

/// Variants of a hypothesis in a round of refining.
std::vector<Hypothesis> variants(const Hypothesis& h, const LinearisationPoint& point, double step,
                                 double line_step) {
  if (!is_line(h)) return neighbours(h, point, step);
  const double f = frequency_of(h);
  return {at_frequency(h, std::max(f - line_step, 1e-6)), at_frequency(h, f + line_step)};
}

/// Half a resolution cell of a line in its own variable.
double line_cell(const Hypothesis& h, const LinearisationPoint& point) {
  if (!h.effect) return 0.4 / range_of(h.pattern.in_time ? point.time : point.s).length();
  if (h.effect->id == "spindle.asynchronous") return 0.4 / range_of(point.c).length();
  if (h.effect->id == "environment.vibration") return 0.4 / range_of(point.time).length();
  if (h.effect->id == "probe.cyclic") return 0.4 / range_of(point.sensed).length();
  return 0.4 / range_of(point.s).length();
}

}  // namespace

std::vector<Candidate> refine(const Problem& problem, const std::vector<double>& phi,
                              const std::vector<Hypothesis>& others,
                              std::vector<Hypothesis> candidates, double step) {
  double shrink = 1.0;
  std::vector<double> cell;
  for (const Hypothesis& h : candidates)
    cell.push_back(is_line(h) ? line_cell(h, problem.point) : 0.0);
  std::vector<Candidate> best;
  for (int round = 0; round <= rounds; ++round) {
    std::vector<Hypothesis> tried;
    std::vector<std::size_t> owner;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      tried.push_back(candidates[i]);
      owner.push_back(i);
      if (round == rounds) continue;
      for (Hypothesis& v : variants(candidates[i], problem.point, step, 0.5 * shrink * cell[i])) {
        tried.push_back(std::move(v));
        owner.push_back(i);
      }
    }
    if (round > 0 && round < rounds && tried.size() == candidates.size()) continue;
    NormalEquations equations(problem.point, problem.mask, problem.deviation_mm, phi,
                              problem.threads);
    const auto places = equations.append(joined(others, tried));
    const std::vector<Candidate> judged = judge(equations, places, tried, others.size());
    best.assign(candidates.size(), {});
    std::vector<char> seen(candidates.size(), 0);
    for (std::size_t k = 0; k < judged.size(); ++k) {
      Candidate& b = best[owner[k]];
      if (!seen[owner[k]] || judged[k].gain > b.gain) b = judged[k];
      seen[owner[k]] = 1;
    }
    for (std::size_t i = 0; i < candidates.size(); ++i) candidates[i] = best[i].hypothesis;
    step *= step_shrink;
    shrink *= step_shrink;
  }
  std::ranges::stable_sort(best, better);
  if (step > finest && !best.empty() && best.front().hypothesis.id() == "part.slip") {
    Candidate dated =
        refine(problem, phi, others, {best.front().hypothesis}, step / step_shrink).front();
    if (dated.criterion < best.front().criterion) best.front() = std::move(dated);
  }
  return best;
}

Proposal propose(const Problem& problem, const std::vector<double>& phi,
                 const std::vector<Hypothesis>& terms, const Hypothesis* named) {
  const LinearisationPoint& point = problem.point;
  const Resolution& resolution = problem.resolution;
  Proposal out;

  std::unique_ptr<Dictionary>& kept = *problem.dictionary;
  if (!kept || kept->phi != phi)
    kept = make_dictionary(point, problem.mask, resolution, problem.deviation_mm, phi,
                           problem.threads);
  NormalEquations& equations = kept->equations;
  const std::vector<Hypothesis>& presets = kept->presets;
  const std::vector<Hypothesis> fixed = joined(presets, kept->basis);
  std::vector<Columns> places = equations.append(terms);
  Columns taken = equations.base();
  append_columns(taken, places);
  places.insert(places.end(), kept->preset_places.begin(), kept->preset_places.end());
  places.insert(places.end(), kept->basis_places.begin(), kept->basis_places.end());
  const std::vector<Candidate> judged = judge(equations, places, fixed, terms.size());
  for (const Candidate& c : judged) out.family.single += c.rank > 0;
  const Eigen::VectorXd solution = solve(equations.total(), taken).coefficients;
  equations.shrink(kept->columns);
  const std::vector<double> left = remainder(point, problem.deviation_mm, terms, solution);
  Scans scans = scan_lines(equations, resolution, left);
  double bumps_tested = 0.0;
  std::vector<Hypothesis> bumps = scan_bumps(equations, left, bumps_tested);
  for (Hypothesis& h : bumps) h.tests = bumps_tested;
  out.family.single += bumps_tested;
  out.family.bandwidth = scans.bandwidth;
  const double line_choice = std::max(1.0, line_tests * scans.bandwidth);

  // The orders that stick out, whatever their dependence on Z.
  std::map<int, double> order_gain;
  for (const Candidate& c : judged) {
    const double n = c.hypothesis.effect ? 0.0 : c.hypothesis.pattern.order;
    if (n >= 2.0) {
      double& g = order_gain[static_cast<int>(n)];
      g = std::max(g, -c.criterion);
    }
  }
  std::vector<std::pair<double, int>> orders;
  for (const auto& [n, g] : order_gain) orders.emplace_back(g, n);
  std::ranges::sort(orders, std::greater<>());

  std::vector<Candidate> causes(judged.begin(), judged.begin() + static_cast<long>(presets.size()));
  std::vector<Candidate> patterns(judged.begin() + static_cast<long>(presets.size()), judged.end());
  std::ranges::stable_sort(causes, better);
  std::ranges::stable_sort(patterns, better);
  std::vector<Hypothesis> shortlist;
  const std::size_t presets_kept = named ? causes.size() : best_presets;
  for (std::size_t i = 0; i < std::min(presets_kept, causes.size()); ++i)
    shortlist.push_back(causes[i].hypothesis);
  if (named) {
    shortlist.push_back(*named);
    if (named->effect->id == "part.roundness" && named->columns() == 4 && !point.reindexed) {
      TermShape shape = named->shape;
      shape.lever_from_mm = -250.0;
      shortlist.push_back(of_effect("spindle.tilt_synchronous", shape, {}, resolution.harmonics));
      shortlist.back().with_radial = true;
    }
  }
  for (std::size_t i = 0; i < std::min(best_orders, orders.size()); ++i) {
    for (Hypothesis& h : causes_of_order(point, resolution, orders[i].second))
      if (h.effect->id != "part.roundness") shortlist.push_back(std::move(h));
  }
  std::vector<Hypothesis> odd;
  for (std::size_t i = 0; i < std::min(best_patterns, patterns.size()); ++i)
    odd.push_back(patterns[i].hypothesis);
  const auto take_peaks = [&](std::vector<Peak>& peaks, std::vector<Hypothesis>& list,
                              std::size_t most) {
    std::ranges::stable_sort(peaks, [](const Peak& a, const Peak& b) { return a.gain > b.gain; });
    for (std::size_t i = 0; i < std::min(most, peaks.size()); ++i) {
      if (peaks[i].gain < 0.3 * peaks[0].gain) break;
      list.push_back(peaks[i].hypothesis);
      list.back().tests = line_choice;
    }
  };
  take_peaks(scans.causes, shortlist, 8);
  take_peaks(scans.patterns, odd, 3);
  for (Hypothesis& h : bumps) odd.push_back(std::move(h));

  // One equations for the shortlist at its first shapes; only the best of it is refined.
  const auto sift = [&](std::vector<Hypothesis>& list, bool one_of_each) {
    NormalEquations light(point, problem.mask, problem.deviation_mm, phi, problem.threads);
    const auto at = light.append(joined(terms, list));
    std::vector<Candidate> first = judge(light, at, list, terms.size());
    std::ranges::stable_sort(first, better);
    if (one_of_each) {
      std::vector<Candidate> each;
      double most = 0.0;
      for (const Candidate& c : first) most = std::max(most, c.gain);
      for (Candidate& c : first) {
        const auto same = [&](const Candidate& e) {
          return e.hypothesis.effect == c.hypothesis.effect && e.rank == c.rank;
        };
        if (c.gain > far_behind * most && std::ranges::none_of(each, same))
          each.push_back(std::move(c));
      }
      first = std::move(each);
    }
    first.resize(std::min(first.size(), one_of_each ? most_rivals : best_refined));
    list.clear();
    for (Candidate& c : first) list.push_back(std::move(c.hypothesis));
    return refine(problem, phi, terms, list);
  };
  out.causes = sift(shortlist, named != nullptr);
  if (!named) out.patterns = sift(odd, false);
  return out;
}

}  // namespace trueaxis::diagnose_detail
