// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/propose.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/threads.hpp"
#include "diagnose/regression/noise.hpp"
#include "diagnose/regression/size_prior.hpp"
#include "diagnose/search/causes.hpp"
#include "diagnose/search/scan_list.hpp"
#include "diagnose/search/scan_steps.hpp"
#include "math/statistics.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr std::size_t best_presets = 12, best_patterns = 3, best_orders = 2, best_refined = 6;
constexpr std::size_t most_peaks = 8, most_rivals = 20;
constexpr double far_behind = 0.3;  // share of the best gain below which nothing is a rival cause
constexpr double line_tests = 3.6;  // Rice's √(S/2) near the threshold: what a scan's choice costs
constexpr double step_shrink = 0.4;
constexpr int rounds = 4;
constexpr double finest = 1e-4;  // a slip that leads is dated to this share of the time

std::vector<Hypothesis> joined(const std::vector<Hypothesis>& a, const std::vector<Hypothesis>& b) {
  std::vector<Hypothesis> out(a);
  out.insert(out.end(), b.begin(), b.end());
  return out;
}

void erase_impossible(std::vector<Candidate>& list) {
  std::erase_if(list, [](const Candidate& c) { return !c.possible; });
}

bool better(const Candidate& a, const Candidate& b) { return a.criterion < b.criterion; }

/// Variants of a hypothesis in a round of refining.
std::vector<Hypothesis> variants(const Hypothesis& h, const Problem& problem, double step,
                                 double line_step) {
  if (!is_line(h)) return neighbours(h, problem.point, step);
  const double f = frequency_of(h);
  const Extent slow = h.effect ? slow_lines(problem, h.effect->line->in) : Extent{0.0, 0.0};
  const auto is_slow = [&](double of) { return of > slow.low && of < slow.high; };
  std::vector<Hypothesis> out;
  for (const double to : {std::max(f - line_step, 1e-6), f + line_step})
    if (is_slow(f) || !is_slow(to)) out.push_back(at_frequency(h, to));
  return out;
}

/// Half a resolution cell of a line in its own variable.
double half_cell(const Hypothesis& line, const LinearisationPoint& point) {
  const bool spatial = line.effect && line.effect->line->in == SpectralLine::In::slide;
  return 0.4 / point.range(spatial ? &PointPart::s : variable_of(line)).length();
}

/// Peaks that are not much lower than the tallest, as hypotheses.
void take_peaks(std::vector<Peak> peaks, std::size_t most, double tests,
                std::vector<Hypothesis>& list) {
  std::ranges::stable_sort(peaks, [](const Peak& a, const Peak& b) { return a.gain > b.gain; });
  for (std::size_t i = 0; i < std::min(most, peaks.size()); ++i) {
    if (peaks[i].gain < far_behind * peaks[0].gain) break;
    list.push_back(std::move(peaks[i].hypothesis));
    list.back().tests = tests;
  }
}

/// Lines that were found in all readings.
void take_fast(const std::vector<Hypothesis>& fast, bool causes, double tests,
               std::vector<Hypothesis>& list) {
  for (const Hypothesis& h : fast) {
    if ((h.effect != nullptr) != causes) continue;
    list.push_back(h);
    list.back().tests = tests;
  }
}

/// All at their first shapes, from one normal matrix; best first.
std::vector<Candidate> judged_at_once(Judge& judge, const std::vector<Hypothesis>& list) {
  std::vector<Candidate> out = judge(list);
  std::ranges::stable_sort(out, better);
  return out;
}

std::vector<Hypothesis> hypotheses_of(const std::vector<Candidate>& list, std::size_t most) {
  std::vector<Hypothesis> out;
  for (std::size_t i = 0; i < std::min(most, list.size()); ++i) out.push_back(list[i].hypothesis);
  return out;
}

/// The best of each effect and rank among those that explain nearly as much as any. All lines stay:
/// at its first shape a line looks like its mirror, such as that of a spiral probed with nearly its
/// own lead.
std::vector<Candidate> one_of_each(const std::vector<Candidate>& list) {
  double most = 0.0;
  for (const Candidate& c : list) most = std::max(most, c.gain);
  std::vector<Candidate> out;
  for (const Candidate& c : list) {
    const auto same = [&](const Candidate& e) {
      return e.hypothesis.effect == c.hypothesis.effect && e.rank == c.rank &&
             !is_line(c.hypothesis);
    };
    if (c.gain > far_behind * most && std::ranges::none_of(out, same)) out.push_back(c);
  }
  return out;
}

/// Whether a size that cannot be leaves the readings unexplained. Orders n and 2n that no jaws
/// press in are two lobes.
bool speaks_against_others(const Candidate& c) {
  return !c.possible && !has_two_orders(c.hypothesis.effect->term);
}

/// Whether it is the same step with fewer of its parameters, or with others: what no size that can
/// be makes exactly, such as two slips, one that can be makes nearly.
bool is_other_form(const Candidate& refused, const Candidate& c) {
  const Effect* effect = refused.hypothesis.effect;
  return effect && effect == c.hypothesis.effect && is_step(effect->term);
}

/// Lobes that grow along the part are those of a spindle that tilts about a bearing anywhere, until
/// re-chucking tells.
void add_tilts(const Hypothesis& named, const Problem& problem, std::vector<Hypothesis>& list) {
  const auto* lobes = std::get_if<Harmonic>(&named.effect->term);
  if (problem.point.reindexed || !lobes || !named.free.empty() ||
      lobes->angle != Harmonic::Angle::part ||
      (lobes->envelope != Harmonic::Envelope::growing &&
       lobes->envelope != Harmonic::Envelope::square))
    return;
  for (const Effect* effect : problem.effects) {
    const auto* tilt = std::get_if<Harmonic>(&effect->term);
    if (!tilt || tilt->envelope != Harmonic::Envelope::lever) continue;
    TermShape shape = named.shape;
    if (lobes->fixed_order > 0.0) shape.order = lobes->fixed_order;
    shape.lever_from_mm = effect->refinement ? problem.point.z_mid_mm
                                             : typical_shape(*effect, problem.point).lever_from_mm;
    list.push_back(of_effect(*effect, shape, {}, problem.resolution.harmonics));
  }
}

/// Spirals nearly of the lead of a single pass: none is searched there, and each may be what was
/// named for a taper or a barrel.
void add_slow_spirals(const Problem& problem, std::vector<Hypothesis>& list) {
  const Extent slow = slow_lines(problem, SpectralLine::In::spiral);
  if (!(slow.length() > 0.0)) return;
  for (const Effect* effect : problem.effects) {
    if (!effect->line || effect->line->in != SpectralLine::In::spiral) continue;
    const Hypothesis h = of_effect(*effect, typical_shape(*effect, problem.point));
    list.push_back(at_frequency(h, slow.low + 0.25 * slow.length()));
  }
}

/// Candidates refined to their own best shape, best first.
std::vector<Candidate> refined(Judge& judge, std::vector<Candidate> best,
                               double step = step_start) {
  const double first_step = step;
  const bool of_means =
      judge.problem().means != nullptr;  // so many readings tell a form from lobes
  double shrink = 1.0;
  // Between all readings a step has its date from the scan, which knows outliers from a step; one
  // that lasts is looked for about it.
  const auto dated = [&](const Hypothesis& h) {
    return !of_means && first_step == step_start && h.effect && is_step(h.effect->term) &&
           h.shape.duration_s == 0.0;
  };
  for (int round = 0; round < rounds; ++round) {
    std::vector<Hypothesis> tried;
    std::vector<std::size_t> owner;
    for (std::size_t i = 0; i < best.size(); ++i) {
      const Hypothesis& h = best[i].hypothesis;
      if (dated(h)) continue;
      const double cell = is_line(h) ? half_cell(h, judge.problem().point) : 0.0;
      for (Hypothesis& v : variants(h, judge.problem(), step, 0.5 * shrink * cell)) {
        if (!of_means && is_local(v)) keep_local(judge.problem(), v);
        tried.push_back(std::move(v));
        owner.push_back(i);
      }
    }
    if (tried.empty()) break;
    const std::vector<Candidate> judged = judge(tried);
    for (std::size_t k = 0; k < judged.size(); ++k)
      if (judged[k].gain > best[owner[k]].gain) best[owner[k]] = judged[k];
    step *= step_shrink;
    shrink *= step_shrink;
  }
  std::ranges::stable_sort(best, better);
  const Effect* leads = best.empty() ? nullptr : best.front().hypothesis.effect;
  step = first_step * std::pow(step_shrink, rounds);
  if (of_means && step > finest && leads && is_step(leads->term)) {
    Candidate dated = refined(judge, {best.front()}, step).front();
    if (dated.criterion < best.front().criterion) best.front() = std::move(dated);
  }
  return best;
}

}  // namespace

void erase_chance(const Problem& problem, const Proposal& from, const std::vector<double>& phi,
                  const std::vector<Hypothesis>& terms, std::vector<Candidate>& list) {
  constexpr double middle = 2.0 / 3.0, beside = 1.0 / 6.0;
  const auto passes = [&](double p) { return from.family.p_value(p) < problem.false_alarm; };
  std::erase_if(list, [&](const Candidate& c) {
    return !passes((phi.empty() ? 1.0 : middle) * std::exp(c.log_p));  // the rest only adds
  });
  if (phi.empty() || list.empty()) return;
  const std::vector<double> partials = partial_correlations(phi);
  const double away = std::sqrt(3.0 / std::max(from.noise_freedom, 1.0));
  std::vector<double> p;
  for (const Candidate& c : list) p.push_back(middle * std::exp(c.log_p));
  for (const double d : {-away, away}) {
    std::vector<double> other = partials;
    other[0] = std::tanh(std::atanh(other[0]) + d);
    const std::vector<Candidate> judged =
        Judge(problem, phi_of(other), terms)(hypotheses_of(list, list.size()));
    for (std::size_t i = 0; i < list.size(); ++i) p[i] += beside * std::exp(log_p_of(judged[i]));
  }
  std::size_t at = 0;
  std::erase_if(list, [&](const Candidate&) { return !passes(p[at++]); });
}

Hypothesis refine(const Problem& problem, const std::vector<double>& phi,
                  const std::vector<Hypothesis>& others, const Hypothesis& candidate, double step) {
  Judge judge(problem, phi, others);
  return refined(judge, judge({candidate}), step).front().hypothesis;
}

/// What one look after the terms gives.
struct Proposer::Step {
  std::vector<Candidate> presets, basis;  ///< best first
  Scans scans;
  std::vector<Hypothesis> bumps, steps;
  Family family;
  double line_choice = 1.0;  ///< what the choice of a line counts as
};

void Proposer::prepare(const std::vector<double>& phi) {
  if (!dictionary_ || dictionary_->phi != phi) dictionary_ = make_dictionary(problem_, phi);
  if (!local_forms_ && !bump_scanner_) bump_scanner_.emplace(problem_.point, problem_.mask);
}

Proposer::Step Proposer::step(const std::vector<Hypothesis>& terms, int threads) const {
  const Dictionary& dictionary = *dictionary_;
  const std::vector<double>& phi = dictionary.phi;
  NormalEquations equations = dictionary.equations;
  const std::vector<Hypothesis> fixed = joined(dictionary.presets, dictionary.basis);
  std::vector<Columns> places = dictionary.preset_places;
  places.insert(places.end(), dictionary.basis_places.begin(), dictionary.basis_places.end());
  const std::vector<Columns> own = equations.append(terms);
  const Solution solution = solve(equations.total(), infer::besides(equations.base(), own));
  const std::vector<Candidate> judged = judge(equations, solution, places, fixed);
  const std::vector<double> left = remainder(problem_.point, problem_.deviation_mm, terms,
                                             solution.coefficients, problem_.threads);
  Step out;
  const auto presets = static_cast<long>(dictionary.presets.size());
  out.presets.assign(judged.begin(), judged.begin() + presets);
  out.basis.assign(judged.begin() + presets, judged.end());
  std::ranges::stable_sort(out.presets, better);
  std::ranges::stable_sort(out.basis, better);
  // Three looks that know nothing of each other.
  double bumps_tested = 0.0, steps_tested = 0.0;
  for_each_index(3, threads, [&](std::size_t look) {
    if (look == 0) out.scans = scanner_(equations, left);
    if (look == 1) out.steps = scan_steps(problem_, phi, terms, steps_tested);
    if (look == 2) out.bumps = bumps(equations, left, terms, bumps_tested);
  });
  for (const Candidate& c : judged) out.family.single += c.rank > 0;
  out.family.single += bumps_tested + steps_tested;
  out.family.bandwidth = out.scans.bandwidth + problem_.fast_bandwidth;
  out.line_choice = std::max(1.0, line_tests * out.family.bandwidth);
  return out;
}

std::vector<Hypothesis> Proposer::bumps(const NormalEquations& equations,
                                        std::span<const double> left_mm,
                                        const std::vector<Hypothesis>& terms, double& tests) const {
  if (local_forms_) {
    tests = local_forms_->tests();
    return local_forms_->beside(terms, best_refined, true);
  }
  std::vector<Hypothesis> out = (*bump_scanner_)(equations, left_mm);
  tests = bump_scanner_->tests();
  for (Hypothesis& h : out) h.tests = tests;
  return out;
}

std::vector<Hypothesis> Proposer::shortlist(const Step& of, std::size_t presets) const {
  std::vector<Hypothesis> list = hypotheses_of(of.presets, presets);
  // The orders that stick out, whatever their dependence on Z.
  std::map<int, double> gain;
  for (const Candidate& c : of.basis) {
    if (c.hypothesis.pattern.order < 2.0) continue;
    double& g = gain[static_cast<int>(c.hypothesis.pattern.order)];
    g = std::max(g, -c.criterion);
  }
  std::vector<std::pair<double, int>> orders;
  for (const auto& [n, g] : gain) orders.emplace_back(g, n);
  std::ranges::sort(orders, std::greater<>());
  for (std::size_t i = 0; i < std::min(best_orders, orders.size()); ++i)
    list = joined(list, causes_of_order(problem_, orders[i].second));
  if (problem_.resolution.half_seen)
    list = joined(list, causes_of_order(problem_, problem_.resolution.half_seen));
  return list;
}

const Proposal* Proposer::answer(const std::vector<Hypothesis>& terms,
                                 const std::vector<double>& phi) const {
  const auto asked = std::ranges::find_if(
      asked_, [&](const Asked& a) { return a.phi == phi && same(a.terms, terms); });
  return asked == asked_.end() ? nullptr : &asked->proposal;
}

int Proposer::threads() const { return threads_beside(problem_.point.size(), problem_.threads); }

const Proposal& Proposer::beside(const std::vector<Hypothesis>& terms,
                                 const std::vector<double>& phi) {
  if (const Proposal* there = answer(terms, phi)) return *there;
  prepare(phi);
  asked_.push_back({terms, phi, propose(terms, threads())});
  return asked_.back().proposal;
}

void Proposer::ask(std::vector<std::vector<Hypothesis>> lists, const std::vector<double>& phi) {
  std::erase_if(lists, [&](const auto& terms) { return answer(terms, phi) != nullptr; });
  if (lists.size() < 2 || threads() == 1) return;
  prepare(phi);
  std::vector<Proposal> proposals(lists.size());
  for_each_index(lists.size(), threads(),
                 [&](std::size_t k) { proposals[k] = propose(lists[k], 1); });
  for (std::size_t k = 0; k < lists.size(); ++k)
    asked_.push_back({std::move(lists[k]), phi, std::move(proposals[k])});
}

Proposal Proposer::propose(const std::vector<Hypothesis>& terms, int threads) const {
  const std::vector<double>& phi = dictionary_->phi;
  Step now = step(terms, threads);
  std::vector<Hypothesis> causes = joined(shortlist(now, best_presets), now.steps);
  take_peaks(std::move(now.scans.causes), most_peaks, now.line_choice, causes);
  take_fast(problem_.fast, true, now.line_choice, causes);
  std::erase_if(causes, [&](const Hypothesis& cause) {
    return is_linearised_at_its_size(cause) &&
           std::ranges::find(terms, cause.effect, &Hypothesis::effect) != terms.end();
  });
  std::vector<Hypothesis> patterns = hypotheses_of(now.basis, best_patterns);
  take_peaks(std::move(now.scans.patterns), best_patterns, now.line_choice, patterns);
  take_fast(problem_.fast, false, now.line_choice, patterns);
  patterns = joined(patterns, now.bumps);
  // Only the best at their first shapes are refined; causes and patterns at the same time.
  const Judge beside_terms(problem_, phi, terms);
  Proposal out;
  const auto refine_some = [&](const std::vector<Hypothesis>& list, std::vector<Candidate>& to) {
    Judge judge = beside_terms;
    std::vector<Candidate> best = judged_at_once(judge, list);
    erase_other_durations(best);
    best.resize(std::min(best.size(), best_refined));
    to = refined(judge, std::move(best));
    for (Candidate& c : to) c.log_p = log_p_of(c);
  };
  for_each_index(2, threads, [&](std::size_t k) {
    k == 0 ? refine_some(causes, out.causes) : refine_some(patterns, out.patterns);
  });
  const auto refused = std::ranges::find_if(out.causes, speaks_against_others);
  const auto explains_it = [&](const Candidate& c) {
    return c.possible && (c.gain >= refused->gain || is_other_form(*refused, c));
  };
  if (refused != out.causes.end() && std::ranges::none_of(out.causes, explains_it))
    out.impossible = {*refused};
  erase_impossible(out.causes);
  out.family = now.family;
  out.noise_freedom = dictionary_->noise_freedom;
  return out;
}

std::vector<Candidate> Proposer::rivals(const Hypothesis& named,
                                        const std::vector<Hypothesis>& others, int threads) const {
  const std::vector<double>& phi = dictionary_->phi;
  Step now = step(others, threads);
  std::vector<Hypothesis> list = hypotheses_of(now.presets, now.presets.size());
  list.push_back(named);
  add_tilts(named, problem_, list);
  add_slow_spirals(problem_, list);
  list = joined(joined(list, shortlist(now, 0)), now.steps);
  take_peaks(std::move(now.scans.causes), most_peaks, now.line_choice, list);
  take_fast(problem_.fast, true, now.line_choice, list);
  Judge judge(problem_, phi, others);
  std::vector<Candidate> each = one_of_each(judged_at_once(judge, list));
  each.resize(std::min(each.size(), most_rivals));
  std::vector<Candidate> out = refined(judge, std::move(each));
  erase_impossible(out);
  return out;
}

}  // namespace trueaxis::diagnose_detail
