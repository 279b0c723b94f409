// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "diagnose/refit/relinearised_fit.hpp"
#include "diagnose/search/coarse_to_fine.hpp"

namespace trueaxis::diagnose_detail {

/// A model that was searched for, fitted about the part.
struct Searched {
  std::unique_ptr<CoarseToFineSearch> search;  ///< with the model
  std::unique_ptr<RelinearisedFit> fit;
  std::optional<Timing> timing;
  std::vector<std::unique_ptr<RelinearisedFit>> moved;  ///< parts that were searched about
  std::vector<double> at_rest_mm;  ///< of a model with slips: what one without any leaves
  bool dropped = false;            ///< whether the fit dropped terms: about was not near enough
  const Problem* about = nullptr;  ///< what the search was about: one of these, or the ideal part
};

/// Searches about the ideal fit, and then about the part after its first step, and at the time and
/// height of the probe that were found: the best by N ln RSS + k ln N, each about its own part.
/// Steps are weighed against a search without any: a delay, lag or height does the same to all
/// orders, and a step that takes its time the same as what varies along Z. A pattern that has no
/// cause does not speak against a step.
/// @param ideal outlives what is returned
Searched searched(const IdealModel& ideal);

}  // namespace trueaxis::diagnose_detail
