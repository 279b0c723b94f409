// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnose/explain/confounder_set.hpp"
#include "diagnose/regression/joint.hpp"
#include "diagnose/search/search.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {

/// One typical form of an effect and the largest size it typically has.
struct Typical {
  Hypothesis hypothesis;
  double size = 0.0;  ///< of its first linear parameter, inside units
  std::string unit;   ///< of that parameter
  std::string form;   ///< which of its forms, where it has several
};

/// Every effect that may be a cause, once; a few in two forms.
std::vector<Typical> typical_effects(const Problem& problem);

/// Probability that a statistic with `columns` degrees of freedom and noncentrality λ passes the
/// threshold of a family of tests (Eq. 97).
double detection_power(double lambda, std::size_t columns, const Family& family, double level);

/// λ of a typical size after columns that were taken out of a Gram matrix: averaged over its phase
/// (Eq. 96).
double typical_lambda(const Projection& projection, const Columns& columns, double size,
                      double sigma_mm);

/// The effects that would not be found at their typical size, with what they do to the axis.
struct Unobservable {
  Typical typical;
  NotObservable entry;
  double axis_bias_mm = 0.0;  ///< at the typical size
  double power = 0.0;
};
/// Eq. 98. An effect in the class of a cause is listed there; if a cause absorbs one, this says
/// which.
std::vector<Unobservable> unobservable_effects(const Problem& problem, const Model& model,
                                               const std::vector<AmbiguousFinding>& findings,
                                               double sigma_mm);

}  // namespace trueaxis::diagnose_detail
