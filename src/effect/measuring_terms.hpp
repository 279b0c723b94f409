// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "effect/kinds.hpp"

/// Terms of what measures, and of where the part is: arguments, probe line, sensor, a slip.
namespace trueaxis::kind {

Linear linear(const ArgumentShift& term, const TermShape& shape);
Names shapes(const ArgumentShift& term);
void fill(const ArgumentShift& term, const TermContext& at, const TermShape& shape, Columns out);

Linear linear(const ProbeLine& term, const TermShape& shape);
Names shapes(const ProbeLine& term);
void fill(const ProbeLine& term, const TermContext& at, const TermShape& shape, Columns out);

Linear linear(const Response& term, const TermShape& shape);
Names shapes(const Response& term);
void fill(const Response& term, const TermContext& at, const TermShape& shape, Columns out);

Linear linear(const PartStep& term, const TermShape& shape);
Names shapes(const PartStep& term);
void fill(const PartStep& term, const TermContext& at, const TermShape& shape, Columns out);

}  // namespace trueaxis::kind
