// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "form/uncertainty.hpp"
#include "form/values.hpp"
#include "trueaxis/form.hpp"

namespace trueaxis::form {

/// Values of form with u, or the bound in place of one that is not beyond the noise. All values of
/// a kind about one element (RONt, RONp …) are bounds, or none.
class Bounded {
 public:
  Bounded(const std::vector<NamedValue>& values, const std::vector<Spread>& spread,
          double coverage_factor);
  /// @param unseen_mm what may be there although no draw has it
  FormValue operator()(const NamedValue& value, const Spread& spread, double unseen_mm = 0.0) const;

 private:
  bool unresolved(const NamedValue& value, const Spread& spread) const;

  double factor_;  ///< of u in a bound
  std::map<std::string, bool> resolved_;
};

/// Value and u as they are.
FormValue as_measured(const NamedValue& value, const Spread& spread);

}  // namespace trueaxis::form
