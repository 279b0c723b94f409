// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "diagnose/regression/normal_equations.hpp"

namespace trueaxis::diagnose_detail {

/// Whether a hypothesis is a local form of the part.
inline bool is_local(const TermValue& h) {
  return !h.effect && h.pattern.kind == Pattern::Kind::bump;
}

/// Makes a form no wider than a local one is. In a sparse problem it becomes no finer than the
/// readings, and one of the part.
void keep_local(const Problem& problem, Hypothesis& form);

/// What the choice of a local form costs (Eq. 82d): −2 ln of the share of all places, widths and
/// lengths that fit the readings like one of the terms, times that of parts that have one.
double shape_choice(const Problem& problem, const std::vector<double>& phi,
                    const std::vector<Hypothesis>& terms, std::size_t term);

/// Local forms of a part that is probed in sections of a few even angles: at every angle and half
/// way to the next, at every section and all along, some angles wide and some sections long. One
/// that meets a single reading is among them.
class LocalForms {
 public:
  /// @param problem sparse; outlives this
  explicit LocalForms(const Problem& problem);

  /// How many of them are of their own.
  double tests() const { return tests_; }

  const std::vector<Hypothesis>& forms() const { return forms_; }
  /// Which of the widths and lengths a form of the list has.
  std::size_t size_of(std::size_t form) const { return size_[form]; }
  std::size_t sizes() const { return sizes_; }

  /// Columns of terms at the readings that count, after those of the surface if they are wanted.
  Eigen::MatrixXd rows_of(const std::vector<Hypothesis>& terms, bool with_base) const;
  /// The readings that count less the ideal fit, mm.
  const Eigen::VectorXd& deviation_mm() const { return deviation_; }

  /// Those that explain most after base and terms, best first.
  /// @param one_of_each of every width and length the best alone
  std::vector<Hypothesis> beside(const std::vector<Hypothesis>& terms, std::size_t most,
                                 bool one_of_each) const;

 private:
  const Problem& problem_;
  std::vector<std::size_t> used_;
  std::vector<Hypothesis> forms_;
  std::vector<std::size_t> size_;  ///< which of the sizes
  std::size_t sizes_ = 0;
  Eigen::VectorXd deviation_;  ///< mm
  Eigen::MatrixXd columns_;    ///< of all forms, at the readings that count
  double tests_ = 1.0;
};

}  // namespace trueaxis::diagnose_detail
