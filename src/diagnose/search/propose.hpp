// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "diagnose/regression/normal_equations.hpp"
#include "diagnose/search/dictionary.hpp"
#include "diagnose/search/judge.hpp"
#include "diagnose/search/local_forms.hpp"
#include "diagnose/search/scan.hpp"
#include "infer/significance.hpp"

namespace trueaxis::diagnose_detail {

/// Sums of the residuals over windows in (θ, s): where a local form may be. In which window of
/// every size a reading lies is worked out once.
class BumpScanner {
 public:
  /// @param point, mask outlive this
  BumpScanner(const LinearisationPoint& point, const ObservationMask& mask);

  /// The best window of every size.
  /// @param equations of the same readings
  std::vector<Hypothesis> operator()(const NormalEquations& equations,
                                     std::span<const double> remainder_mm) const;
  double tests() const { return tests_; }  ///< how many windows are looked at

 private:
  /// Windows of one size.
  struct Grid {
    std::size_t sectors, lengths;
    std::vector<std::uint16_t> window;  ///< of every reading
    std::vector<std::size_t> count;     ///< readings of every window
    std::vector<char> seen;             ///< whether it is looked at
  };
  Grid grid_of(std::size_t sectors, std::size_t lengths) const;
  /// @returns whether one is exceptional, as `best`
  bool best_of(const Grid& grid, std::span<const double> weighted, Hypothesis& best) const;

  const LinearisationPoint* point_;
  const ObservationMask* mask_;
  std::size_t least_readings_;
  std::vector<char> rear_;
  std::vector<Grid> grids_;
  double tests_ = 0.0;
};

/// The best next hypotheses after some terms, refined, best first.
struct Proposal {
  std::vector<Candidate> causes, patterns;
  std::vector<Candidate> impossible;  ///< the best cause of a size that cannot be, or none
  Family family;
  double noise_freedom = 0.0;  ///< readings beyond the columns that the noise was estimated with
};

constexpr double step_start = 0.06;  ///< of a refinement, on a scale where 1 is the range

/// Proposes hypotheses of a problem, which outlives it; keeps the dictionary of the last noise for
/// the next step.
class Proposer {
 public:
  explicit Proposer(const Problem& problem) : problem_(problem), scanner_(problem) {
    if (problem.resolution.sparse) local_forms_.emplace(problem);
  }

  /// What was asked before is not worked out again; the answer lives as long as this.
  /// @param phi autoregression of the noise
  const Proposal& beside(const std::vector<Hypothesis>& terms, const std::vector<double>& phi);

  /// Asks after some lists of terms at the same time, if there are threads to do so.
  void ask(std::vector<std::vector<Hypothesis>> lists, const std::vector<double>& phi);

  /// Makes ready for rival causes.
  void prepare(const std::vector<double>& phi);
  /// One of each effect that might explain the same as a cause that was named, which is among them;
  /// with the noise that was prepared for. May be asked by several threads.
  std::vector<Candidate> rivals(const Hypothesis& named, const std::vector<Hypothesis>& others,
                                int threads) const;
  int threads() const;  ///< at most

  const Problem& problem() const { return problem_; }

 private:
  struct Step;
  struct Asked {
    std::vector<Hypothesis> terms;
    std::vector<double> phi;
    Proposal proposal;
  };
  const Proposal* answer(const std::vector<Hypothesis>& terms,
                         const std::vector<double>& phi) const;
  Proposal propose(const std::vector<Hypothesis>& terms, int threads) const;
  Step step(const std::vector<Hypothesis>& terms, int threads) const;
  /// Local forms that may be left, and how many were looked at.
  std::vector<Hypothesis> bumps(const NormalEquations& equations, std::span<const double> left_mm,
                                const std::vector<Hypothesis>& terms, double& tests) const;
  std::vector<Hypothesis> shortlist(const Step& of, std::size_t presets) const;

  const Problem& problem_;
  LineScanner scanner_;
  std::optional<LocalForms> local_forms_;    ///< of a sparse design
  std::optional<BumpScanner> bump_scanner_;  ///< of any other
  std::unique_ptr<const Dictionary> dictionary_;
  std::deque<Asked> asked_;
};

/// Erases what noise alone may have made, by p-values averaged over what the noise may also be.
/// With ν readings beyond the columns the first partial correlation a is known to u = 1/√ν of
/// artanh a (Fisher). If it is underestimated, all that is slow looks significant. Three nodes of a
/// Gauss-Hermite rule.
/// @param from what was proposed after `terms`; the candidates are some of it
void erase_chance(const Problem& problem, const Proposal& from, const std::vector<double>& phi,
                  const std::vector<Hypothesis>& terms, std::vector<Candidate>& list);

/// A hypothesis refined to its own best shape together with `others`.
Hypothesis refine(const Problem& problem, const std::vector<double>& phi,
                  const std::vector<Hypothesis>& others, const Hypothesis& candidate, double step);

}  // namespace trueaxis::diagnose_detail
