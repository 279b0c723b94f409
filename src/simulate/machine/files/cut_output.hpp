// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "simulate/machine/files/cut_toml.hpp"

namespace trueaxis {

/// `line,end,t[s],x[mm],y[mm],z[mm],i,j,k,off[um],angle[deg]`, a row a position; numbers that
/// nothing says are left out (docs/virtual_machine.md).
std::string cut_csv(const virtual_machine::Cut& cut);

/// `trueaxis.cut/1`.
std::string cut_json(const virtual_machine::Cut& cut, const CutScenario& scenario);

/// The same in sentences.
std::string cut_text(const virtual_machine::Cut& cut, const CutScenario& scenario);

}  // namespace trueaxis
