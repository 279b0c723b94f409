// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/estimate/geometry.hpp"
#include "infer/dictionary.hpp"
#include "trueaxis/machine_diagnosis.hpp"

namespace trueaxis::calibrate_detail {

/// Where on an axis a local pattern is, that can be moved to its place.
struct PatternPlace {
  enum class Kind { bump, step } kind = Kind::bump;
  std::size_t axis = 0;  ///< of `machine.axes`
  double at = 0.0, width = 0.0;
};

/// A hypothesis: columns of the readings, each per mm or rad.
struct Term {
  MachineEffect of;  ///< of the catalogue; a pattern has its words as the id, and no term
  MatrixXd columns;
  std::vector<ErrorTerm> errors;    ///< of which each column is; empty: no error of the machine
  bool barred = false;              ///< a pattern that an effect makes at these rows
  double tests = 1.0;               ///< how many places of it were tried
  double size_median = 0.0;         ///< plausible size of a column's coefficient; 0: none is known
  double size_spread = 1.0;         ///< of its logarithm
  std::size_t target = 0, row = 0;  ///< of a step of a ball: its target, and its first row
  std::size_t unit = 0;             ///< of a pattern: the column that its functions multiply
  std::optional<ErrorName> error;   ///< of a pattern: which error of an axis has it
  double reach = 0.0;               ///< of a period: its frequency lies within, per mm or rad
  std::string letters;              ///< of the axes that it is a function of; t: of the time
  std::optional<PatternPlace> place;  ///< of a local pattern
  bool of_one_reading = false;        ///< a pattern: one number of one row is off

  const std::string& effect() const { return of.id; }
  bool angle() const { return of.unit == "rad"; }
  bool is_pattern() const { return std::holds_alternative<std::monostate>(of.term); }
  bool is_slip() const {
    return std::holds_alternative<BallStep>(of.term) || std::holds_alternative<ZeroStep>(of.term);
  }
  double period() const { return of.shape.front().value; }  ///< of one that is periodic
  bool is_periodic() const {
    const auto* error = std::get_if<ErrorOfPosition>(&of.term);
    return error != nullptr && error->periodic;
  }
};

/// The terms of every effect of a catalogue that these rows may show.
std::vector<Term> effect_terms(const Problem& problem, const Geometry& geometry,
                               const std::vector<MachineEffect>& catalogue);

using Set = infer::Dictionary::Set;
/// Terms as hypotheses after what is always fitted. @param base columns over σ, of any rank
infer::Dictionary dictionary_of(const std::vector<Term>& terms, const MatrixXd& base,
                                const VectorXd& weights, const CalibrationOptions& options);

/// A periodic error of one period, mm or rad.
Term periodic_term(const Problem& problem, const Geometry& geometry, MachineEffect of,
                   double period);

/// One number of one row is off. @param equation of the number
Term reading_term(const Problem& problem, Eigen::Index equation);
/// "row 17 of file 1"
std::string row_in_words(const Problem& problem, Eigen::Index equation);

/// The slip of a target from a row on.
Term slip_term(const Problem& problem, const Geometry& geometry, const MachineEffect& of,
               std::size_t target, std::size_t row);

}  // namespace trueaxis::calibrate_detail
