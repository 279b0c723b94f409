// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "infer/classes.hpp"
#include "infer/dictionary.hpp"
#include "infer/significance.hpp"

namespace trueaxis::infer {

/// How the false alarm of a measurement is shared out.
inline constexpr double share_of_effects = 0.6, share_of_patterns = 0.3, share_of_scatter = 0.1;

/// What a search needs to know and what its verdicts are worth.
struct SearchOptions {
  double false_alarm = 0.01;  ///< of everything
  double tests = 1.0;         ///< all effects that are tried, at every place
  double pattern_tests = 1.0;
  std::size_t most = 6;

  Family effects() const { return {tests / share_of_effects, 0.0}; }
  Family family_of(const Dictionary::Block& block) const {
    return block.pattern ? Family{pattern_tests / share_of_patterns, 0.0} : effects();
  }
};

/// p of a hypothesis after others in its family.
double family_p(const Dictionary& dictionary, const SearchOptions& options,
                const Projection& others, std::size_t term);

/// The hypotheses that explain the residuals: forward one at a time, every pair of the best hundred
/// next to the first, those dropped that no longer pass, and each exchanged for a better one.
Dictionary::Set search(const Dictionary& dictionary, const SearchOptions& options);

/// The other effects of a dictionary that the data do not tell from one of a set (Eqs. 87-93).
Class class_of(const Dictionary& dictionary, const Dictionary::Set& set, std::size_t at);

/// What tests of the noncentral F distribution find of a term after others, in the phase that
/// shows it least (Eq. 182).
class Detection {
 public:
  /// @param found what is fitted after the base
  /// @param variance of a residual over its σ
  Detection(const Dictionary& dictionary, const Dictionary::Set& found, double variance,
            const SearchOptions& options)
      : dictionary_(dictionary),
        beside_(dictionary.beside(found)),
        variance_(variance),
        freedom_(static_cast<double>(dictionary.rows() - beside_.rank)),
        level_(options.effects().single_level(options.false_alarm)) {}

  /// λ at size 1.
  double lambda(std::size_t term) const;
  /// Size that is found with power one half; infinite: none is.
  double detectable_size(std::size_t term) const;
  /// Power at a size.
  double power(std::size_t term, double size) const;

 private:
  const Dictionary& dictionary_;
  Projection beside_;
  double variance_, freedom_, level_;
  mutable std::vector<double> half_lambda_;  ///< λ of power one half, for a rank each
};

}  // namespace trueaxis::infer
