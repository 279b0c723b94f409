// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "diagnose/regression/normal_equations.hpp"
#include "diagnose/search/dictionary.hpp"
#include "diagnose/search/scan.hpp"

namespace trueaxis::diagnose_detail {

/// What a search is given and does not change.
struct Problem {
  const LinearisationPoint& point;
  const ObservationMask& mask;
  const Resolution& resolution;
  std::span<const double> deviation_mm;
  double false_alarm = 0.01;
  int threads = 1;
  std::size_t most_terms = 8;
  /// The last dictionary made; a step of the same noise uses it again.
  std::shared_ptr<std::unique_ptr<Dictionary>> dictionary =
      std::make_shared<std::unique_ptr<Dictionary>>();

  /// The same readings about another point.
  Problem about(const LinearisationPoint& other, std::span<const double> deviation) const {
    return {other, mask, resolution, deviation, false_alarm, threads, most_terms};
  }
};

/// How many tests a verdict is the best of: those one by one, and those of the periodograms, whose
/// number grows with the statistic (Rice's rate of upcrossings; Baluev 2008, eq. 6).
struct Family {
  double single = 0.0;
  double bandwidth = 0.0;

  /// Probability that the largest of all statistics passes one with this single p-value by chance.
  double p_value(double single_p) const;
  /// Statistic with two degrees of freedom that does so with probability `level`.
  double threshold(double level) const;
};

/// A hypothesis beside the terms of a model.
struct Candidate {
  Hypothesis hypothesis;
  double gain = 0.0;  ///< decrease of the residual sum of squares
  std::size_t rank = 0;
  double log_p = 0.0;      ///< ln of its own p-value
  double criterion = 0.0;  ///< change of the extended BIC; negative is better
};

/// A set of terms beside the surface.
struct Model {
  std::vector<Hypothesis> terms;
  std::vector<double> p_values;  ///< family-wise
  std::vector<double> phi;       ///< autoregression of the noise beside them
  double criterion = 0.0;
  Family family;
};

/// The best next hypotheses beside `terms`, refined, best first. With `named`, one of each effect
/// that might explain the same, the named one included.
struct Proposal {
  std::vector<Candidate> causes, patterns;
  Family family;
};
Proposal propose(const Problem& problem, const std::vector<double>& phi,
                 const std::vector<Hypothesis>& terms, const Hypothesis* named = nullptr);

constexpr double step_start = 0.06;  ///< of a refinement, on a scale where 1 is the range

/// Candidates of one finding refined to their own best shape beside `others`, best first.
std::vector<Candidate> refine(const Problem& problem, const std::vector<double>& phi,
                              const std::vector<Hypothesis>& others,
                              std::vector<Hypothesis> candidates, double step = step_start);

/// Forward by the best hypothesis, backward, swapped and merged, until nothing changes; once with
/// catalogued causes first and, where a pattern did better on the way, once with patterns allowed:
/// the better of the two.
Model search(const Problem& problem);

/// Whether a line is left that means of so many readings would weaken: search all readings then.
bool fast_line_left(const Problem& problem, const Model& model, std::size_t means);

/// ln n per column, twice the log of the choice among its kind (Chen and Chen 2008), and what an
/// implausible size costs.
double penalty(const Hypothesis& hypothesis, std::size_t rank, std::size_t count,
               const Eigen::VectorXd& coefficients);

/// ln p of an F test: `gain` for `rank` columns off `rss` with `freedom` degrees of freedom before.
double log_p_value(double gain, double rank, double rss, double freedom);

}  // namespace trueaxis::diagnose_detail
