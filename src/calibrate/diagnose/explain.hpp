// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calibrate/diagnose/term.hpp"
#include "infer/dictionary_search.hpp"
#include "trueaxis/machine_diagnosis.hpp"

namespace trueaxis::calibrate_detail {

/// A found term with its sizes together with all others, and its class: the other effects that the
/// data do not tell from it (Eqs. 87-93). Its `rms_mm` is left over σ and summed: |μ|.
MachineFinding finding_of(const infer::Dictionary& dictionary, const std::vector<Term>& terms,
                          const Set& set, std::size_t at, const infer::SearchOptions& options);

/// States what the base, and base and terms, predict of blocks of rotary positions that were
/// excluded in turn, mm (Eqs. 101, 183). @param columns over σ, those of the base first
void hold_out(const Problem& problem, const Eigen::MatrixXd& columns, Eigen::Index base,
              const Eigen::VectorXd& readings, MachineDiagnosis& out);

}  // namespace trueaxis::calibrate_detail
