// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/coarse_to_fine.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "diagnose/regression/joint.hpp"
#include "diagnose/regression/noise.hpp"
#include "diagnose/search/dictionary.hpp"
#include "diagnose/search/scan.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr int most_looks = 3;             // of search and look at all readings
constexpr double beside_the_top = 0.3;    // share of its gain from which a line is a candidate
constexpr double first_date_step = 2e-3;  // of the time: a mean's
constexpr double steps_of_line[] = {1.0, 0.25, 0.05};  // of half a resolution cell

/// Noise of all readings after terms.
std::vector<double> noise_beside(const Problem& whole, const std::vector<Hypothesis>& terms) {
  std::vector<Hypothesis> all = small_fourier_legendre_basis(whole.point, whole.resolution);
  all.insert(all.end(), terms.begin(), terms.end());
  return autoregression(whole.point, whole.mask, whole.deviation_mm, all, whole.threads).phi;
}

/// The line at the frequency where it explains most after the terms: the top of parabolas through
/// three frequencies, ever nearer.
Hypothesis sharpened(const Problem& whole, const std::vector<double>& phi,
                     const std::vector<Hypothesis>& terms, const Peak& peak) {
  Hypothesis line = peak.hypothesis;
  for (const double part : steps_of_line) {
    const double step = part * peak.step, f = frequency_of(line);
    std::vector<Hypothesis> list = terms;
    for (const double off : {-step, 0.0, step}) list.push_back(at_frequency(line, f + off));
    const Joint joint(whole, phi, list, terms.size());
    const Projection beside = project(joint.equations.total(), joint.solution.columns);
    std::array<double, 3> gain{};
    for (std::size_t k = 0; k < 3; ++k)
      gain[k] = score(beside, joint.places[terms.size() + k]).gain;
    const double bend = gain[0] - 2.0 * gain[1] + gain[2];
    const double off = bend < 0.0 ? 0.5 * (gain[0] - gain[2]) / bend : gain[2] - gain[0];
    line = at_frequency(line, f + step * std::clamp(off, -1.0, 1.0));
  }
  return line;
}

/// Adds to the terms every line that passes after them in all readings and that means would weaken;
/// and to the candidates, those lines and others like them. @returns the coefficients of the terms
std::vector<double> take_fast_lines(const Problem& whole, const Model& model, LineScanner& scanner,
                                    std::vector<Hypothesis>& terms,
                                    std::vector<Hypothesis>& candidates) {
  while (true) {
    const Joint joint(whole, model.phi, terms, terms.size());
    const Eigen::VectorXd& solution = joint.solution.coefficients;
    const auto base = static_cast<Eigen::Index>(joint.equations.base().size());
    const std::vector<double> linear(solution.data() + base, solution.data() + solution.size());
    if (terms.size() >= whole.most_terms) return linear;
    const Scans scans = scanner(joint.equations, remainder(whole.point, whole.deviation_mm, terms,
                                                           solution, whole.threads));
    const auto freedom = static_cast<double>(joint.equations.count() - joint.solution.rank);
    const auto top = std::ranges::max_element(scans.causes, {}, &Peak::gain);
    if (top == scans.causes.end() ||
        model.family.p_value(std::exp(log_p_value(top->gain, 2.0, joint.solution.rss, freedom))) >=
            whole.false_alarm)
      return linear;
    terms.push_back(sharpened(whole, model.phi, terms, *top));
    candidates.push_back(terms.back());
    for (const auto* peaks : {&scans.causes, &scans.patterns})
      for (const Peak& p : *peaks)
        if (&p != &*top && p.gain > beside_the_top * top->gain) candidates.push_back(p.hypothesis);
  }
}

/// Steps are dated in all readings.
void date_steps(const Problem& whole, Model& model) {
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    Hypothesis& term = model.terms[t];
    if (!term.effect || !is_step(term.effect->term)) continue;
    std::vector<Hypothesis> others = model.terms;
    others.erase(others.begin() + static_cast<long>(t));
    term = refine(whole, model.phi, others, term, first_date_step);
  }
}

}  // namespace

CoarseToFineSearch::CoarseToFineSearch(const Problem& whole) {
  if (is_condensed(whole.point)) {
    search_means(whole);
  } else {
    model = search(proposer_.emplace(whole));
    phi_ = model.phi;
  }
}

Proposer& CoarseToFineSearch::over_means(const Problem& whole) {
  means_ = condense(whole.point, whole.mask, whole.deviation_mm, known_, linear_,
                    whole.resolution.sections, whole.threads);
  if (!scanner_) scanner_.emplace(whole, &means_);
  problem_.emplace(Problem{means_.point, means_.mask, whole.resolution, means_.deviation_mm,
                           whole.false_alarm, whole.threads, whole.most_terms, whole.effects, 0.0,
                           &means_, &whole, candidates_, scanner_->bandwidth(),
                           whole.fewest_cycles});
  return proposer_.emplace(*problem_);
}

Proposer& CoarseToFineSearch::about(const Problem& whole) {
  return is_condensed(whole.point) ? over_means(whole) : proposer_.emplace(whole);
}

void CoarseToFineSearch::search_means(const Problem& whole) {
  for (int look = 0; look < most_looks; ++look) {
    model = search(over_means(whole));
    phi_ = model.phi;
    model.phi = noise_beside(whole, model.terms);
    known_ = model.terms;
    linear_ = take_fast_lines(whole, model, *scanner_, known_, candidates_);
    if (known_.size() == model.terms.size()) break;
  }
  date_steps(whole, model);
}

}  // namespace trueaxis::diagnose_detail
