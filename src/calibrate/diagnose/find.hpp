// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "calibrate/diagnose/term.hpp"
#include "calibrate/estimate/tip_fit.hpp"
#include "infer/dictionary_search.hpp"
#include "trueaxis/machine_diagnosis.hpp"

namespace trueaxis::calibrate_detail {

/// Terms, their products, and which of them explain the readings.
struct Found {
  std::vector<Term> terms;
  std::optional<infer::Dictionary> dictionary;
  Set found;
  infer::SearchOptions options;
};

/// The effects that explain the readings, then the patterns that do so better or in addition. Those
/// that gain most alone, with all that was found and with all of it but one take part in the search
/// (Eqs. 178-180, 184). Slips, bumps and steps are moved to where they are.
Found find_terms(const TipFit& fit, const Geometry& geometry,
                 const std::vector<MachineEffect>& catalogue, const MachineDiagnoseOptions& options,
                 bool timed);

}  // namespace trueaxis::calibrate_detail
