// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "diagnose/search/local_forms.hpp"
#include "diagnose/search/search.hpp"

namespace trueaxis::diagnose_detail {

/// Which local forms a model may have: any, none, or those it is begun with, which stay.
enum class LocalFormsTaken { any, none, given };

/// Terms taken, dropped and exchanged one by one until nothing changes (theory.md, §8.2).
class StepwiseSearch {
 public:
  explicit StepwiseSearch(Proposer& proposer);
  ~StepwiseSearch();

  /// Any at first.
  void take_local_forms(LocalFormsTaken which);

  /// @param patterns whether a pattern may be taken while a cause still passes
  /// @param[out] pattern_was_better set where one did better than every cause on the way
  /// @param first terms to begin with
  Model run(bool patterns, bool& pattern_was_better, std::vector<Hypothesis> first = {});

  /// Begins with the terms that remain after those that fail are dropped, then goes on as run().
  /// @returns `found` if that is it
  Model left_of(std::vector<Hypothesis> first, const Model& found);

  /// The model, or none where noise alone, as correlated as the readings may show it, is not less
  /// probable than the false alarm: before any term what is slow is not counted as noise.
  Model unless_noise(Model model);

 private:
  class Engine;
  std::unique_ptr<Engine> engine_;
};

/// Lobes of one order: constant ones, then, where sections show it, such as grow along the part.
using LobesOfOrder = std::vector<Hypothesis>;

/// Local forms of few angles, each with the lobes that are left after it. Lobes of different
/// orders are orthogonal: once the size of the form is given, each order is there or not by itself,
/// and the size is what the orders show that are not there. So a form is found also where it hides
/// in many orders, of which a search step by step would take one after the other (Eq. 82c).
/// @returns lobes and form: the best of every width and length, best first
std::vector<std::vector<Hypothesis>> forms_with_lobes(const Problem& problem,
                                                      const LocalForms& forms,
                                                      const std::vector<LobesOfOrder>& lobes,
                                                      std::size_t most);

}  // namespace trueaxis::diagnose_detail
