// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calibrate/diagnose/term.hpp"
#include "calibrate/estimate/tip_fit.hpp"
#include "infer/dictionary_search.hpp"
#include "trueaxis/machine_diagnosis.hpp"

namespace trueaxis::calibrate_detail {

/// Orders up to 12 that read as that of a harmonic at the positions of its axis. They are listed,
/// and share the name's probability, an order n as 1/n² (Eq. 185).
void weigh_aliases(const Problem& problem, const Term& term, MachineFinding& finding);

/// Pairs of effects of plausible sizes that are together within d = 3.29 of a cause, while
/// neither is alone (Eq. 186); the nearest five.
std::vector<std::array<std::string, 2>> pairs_like(const infer::Dictionary& dictionary,
                                                   const std::vector<Term>& terms, const Set& set,
                                                   std::size_t at, const MachineFinding& finding);

/// The noise against what is stated, the largest residual, the times.
void add_checks(const TipFit& fit, const infer::Dictionary& dictionary, const Set& found,
                bool timed, const CalibrationOptions& options, MachineDiagnosis& out);

void add_remarks(MachineDiagnosis& out);

/// A found term with its sizes together with all others, and its class: the other effects that the
/// data do not tell from it (Eqs. 87-93). Its `rms_mm` is left over σ and summed: |μ|.
MachineFinding finding_of(const infer::Dictionary& dictionary, const std::vector<Term>& terms,
                          const Set& set, std::size_t at, const infer::SearchOptions& options);

/// States what the base, and base and terms, predict of blocks of rotary positions that were
/// excluded in turn, mm (Eqs. 101, 183). @param columns over σ, those of the base first
void hold_out(const Problem& problem, const MatrixXd& columns, Index base, const VectorXd& readings,
              MachineDiagnosis& out);

}  // namespace trueaxis::calibrate_detail
