// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/regression/normal_equations.hpp"
#include "infer/fitted.hpp"
#include "infer/significance.hpp"

namespace trueaxis::diagnose_detail {

/// A hypothesis in addition to the terms of a model.
struct Candidate {
  Hypothesis hypothesis;
  double gain = 0.0;  ///< decrease of the residual sum of squares
  std::size_t rank = 0;
  double log_p = 0.0;               ///< ln of its own p-value, of a proposal
  double criterion = 0.0;           ///< change of the extended BIC; negative is better
  bool possible = true;             ///< whether its sizes are
  bool extraordinary = false;       ///< whether they are beyond what is plausible
  double rss = 0.0, freedom = 0.0;  ///< residual without it
};

/// Twice the log of the choice among a hypothesis's kind (Chen and Chen 2008; Eq. 78).
double choice_of(const Hypothesis& hypothesis);

/// The criterion of a rival cause that might have been just the named form. Sizes tell which of
/// both it is, not that the one formula has fewer parameters. The named columns have the sizes of
/// the rival cause, by the root mean square that the other columns leave of them.
double criterion_as(const Hypothesis& rival, const Columns& its, const Hypothesis& named,
                    const Columns& own, const Projection& beside, std::size_t count);

/// How much more the criterion of lobes is than that of a bend of the sensor. The lobes are in
/// phase with the eccentricity, and just what the bend makes: sizes alone tell.
double lobes_over_bend(const Hypothesis& lobes, const Columns& its, const Hypothesis& bend,
                       const Columns& own, const Projection& beside, std::size_t count);

/// How much more of the sum of squares lobes leave in just the phases and ratios that a bend makes
/// than the bend itself.
double apart_in_phase(const Columns& lobes, const Columns& bend, const Projection& beside);

/// What lobes have more in the criterion than a bend with the same readings (Eq. 82e). Lobes in
/// phase with the eccentricity fit as the bend does, and sizes alone give odds of four to one at
/// most.
/// @param over_bend that difference, each with its own columns
/// @param sizes lobes_over_bend() of all
/// @param apart what lobes in that phase leave more than the bend does, over the variance
double counted_as_bend(double over_bend, double sizes, double apart);

/// ln of its own p-value.
double log_p_of(const Candidate& candidate);

/// Scores of hypotheses after given columns, from one projection.
std::vector<Candidate> judge(const NormalEquations& equations, const Solution& taken,
                             const std::vector<Columns>& places,
                             const std::vector<Hypothesis>& list);

/// Judges lists of hypotheses after the same terms.
class Judge {
 public:
  Judge(const Problem& problem, const std::vector<double>& phi,
        const std::vector<Hypothesis>& terms);
  std::vector<Candidate> operator()(const std::vector<Hypothesis>& list);
  const Problem& problem() const { return *problem_; }

 private:
  Solution solve_with(const std::vector<Hypothesis>& terms);

  const Problem* problem_;
  NormalEquations equations_;
  Solution taken_;
};

}  // namespace trueaxis::diagnose_detail
