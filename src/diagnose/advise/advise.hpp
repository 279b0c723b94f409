// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/explain/confounder_set.hpp"
#include "diagnose/explain/observable.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {

struct Advice {
  NextMeasurement next;
  std::vector<Separating> plans;                     ///< best first
  std::vector<std::optional<Separating>> questions;  ///< one per question
  std::vector<std::optional<Separating>> hidden;     ///< one per hidden effect
};

/// The measurement that raises Φ(d/2) of the classes most per minute, from the Jacobians of what
/// was measured and of what each plan would add; without a class, the one that shows the most
/// harmful of the hidden effects.
Advice advise(const Problem& problem, const Model& model, const ProbeStream& stream,
              const std::vector<Clamping>& clampings,
              const std::vector<AmbiguousFinding>& questions,
              const std::vector<Unobservable>& hidden, double sigma_mm);

}  // namespace trueaxis::diagnose_detail
