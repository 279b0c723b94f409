// SPDX-License-Identifier: Apache-2.0
#include "diagnose/sought.hpp"

#include "diagnose/noise.hpp"

namespace trueaxis::diagnose_detail {

Sought::Sought(const Problem& whole) : whole_(whole) {
  const std::size_t every = condensation(whole.scene, whole.resolution);
  if (every > 1) {
    means_ = condense(whole.scene, whole.rows,
                      {whole.deviation_mm.begin(), whole.deviation_mm.end()}, every);
    resolution_ = resolution_of(means_.scene, means_.rows);
    problem_.emplace(Problem{means_.scene, means_.rows, resolution_, means_.deviation_mm,
                             whole.false_alarm, whole.threads, whole.most_terms});
    model = search(*problem_);
    phi_ = model.phi;
    std::vector<Hypothesis> all = small_atlas(whole.scene, whole.resolution);
    all.insert(all.end(), model.terms.begin(), model.terms.end());
    model.phi = autoregression(whole.scene, whole.rows, whole.deviation_mm, all);
    if (!fast_line_left(whole, model, every)) return;
    problem_.reset();
  }
  model = search(whole);
  phi_ = model.phi;
}

Class Sought::distinguish(std::size_t term) const {
  Model of = model;
  of.phi = phi_;
  return diagnose_detail::distinguish(problem_ ? *problem_ : whole_, of, term);
}

}  // namespace trueaxis::diagnose_detail
