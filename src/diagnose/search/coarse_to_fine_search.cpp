// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/coarse_to_fine_search.hpp"

#include "diagnose/regression/noise.hpp"
#include "diagnose/search/fourier_legendre_basis.hpp"

namespace trueaxis::diagnose_detail {

CoarseToFineSearch::CoarseToFineSearch(const Problem& whole) {
  const std::size_t every = condensation(whole.point, whole.resolution);
  if (every > 1) {
    means_ = condense(whole.point, whole.mask,
                      {whole.deviation_mm.begin(), whole.deviation_mm.end()}, every);
    resolution_ = resolution_of(means_.point, means_.mask);
    problem_.emplace(Problem{means_.point, means_.mask, resolution_, means_.deviation_mm,
                             whole.false_alarm, whole.threads, whole.most_terms, whole.effects});
    model = search(proposer_.emplace(*problem_));
    phi_ = model.phi;
    std::vector<Hypothesis> all = small_fourier_legendre_basis(whole.point, whole.resolution);
    all.insert(all.end(), model.terms.begin(), model.terms.end());
    model.phi = autoregression(whole.point, whole.mask, whole.deviation_mm, all).phi;
    if (!fast_line_left(whole, model, every)) return;
  }
  model = search(proposer_.emplace(whole));
  phi_ = model.phi;
}

Model CoarseToFineSearch::searched_model() const {
  Model out = model;
  out.phi = phi_;
  return out;
}

}  // namespace trueaxis::diagnose_detail
