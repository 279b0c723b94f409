// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/search/local_forms.hpp"

namespace trueaxis::diagnose_detail {

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
