// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/coarse_to_fine_search.hpp"

#include "diagnose/regression/noise.hpp"

namespace trueaxis::diagnose_detail {

CoarseToFineSearch::CoarseToFineSearch(const Problem& whole) : whole_(whole) {
  const std::size_t every = condensation(whole.point, whole.resolution);
  if (every > 1) {
    means_ = condense(whole.point, whole.mask,
                      {whole.deviation_mm.begin(), whole.deviation_mm.end()}, every);
    resolution_ = resolution_of(means_.point, means_.mask);
    problem_.emplace(Problem{means_.point, means_.mask, resolution_, means_.deviation_mm,
                             whole.false_alarm, whole.threads, whole.most_terms});
    model = search(*problem_);
    phi_ = model.phi;
    std::vector<Hypothesis> all = small_fourier_legendre_basis(whole.point, whole.resolution);
    all.insert(all.end(), model.terms.begin(), model.terms.end());
    model.phi = autoregression(whole.point, whole.mask, whole.deviation_mm, all);
    if (!fast_line_left(whole, model, every)) return;
    problem_.reset();
  }
  model = search(whole);
  phi_ = model.phi;
}

ConfounderSet CoarseToFineSearch::distinguish(std::size_t term) const {
  Model of = model;
  of.phi = phi_;
  return diagnose_detail::distinguish(problem_ ? *problem_ : whole_, of, term);
}

}  // namespace trueaxis::diagnose_detail
