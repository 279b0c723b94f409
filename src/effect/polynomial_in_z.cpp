// SPDX-License-Identifier: Apache-2.0
#include <boost/math/special_functions/legendre.hpp>

#include "effect/geometry.hpp"
#include "effect/kinds.hpp"

namespace trueaxis::kind {
namespace {

int last_degree(const PolynomialInZ& term, const TermShape& shape) {
  return term.last > 0 ? term.last : shape.degree;
}

}  // namespace

Linear linear(const PolynomialInZ& term, const TermShape& shape) {
  if (term.plain) return {{"slope", "rad"}};
  Linear list;
  for (int l = term.first; l <= last_degree(term, shape); ++l) {
    list.push_back({"amplitude_" + std::to_string(l), unit_of(term.port)});
  }
  return list;
}

Names shapes(const PolynomialInZ& term) { return term.last > 0 ? Names{} : Names{"degree"}; }

// Bonnet's recursion, which also holds a little outside [−1, 1], where a probe may overrun.
void fill(const PolynomialInZ& term, const TermContext& at, const TermShape& shape, Columns out) {
  const int last = last_degree(term, shape);
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double slope = contact::dx_d(term.port, at, i);
    if (term.plain) {
      out[0][i] = slope * contact::along_mm(term.port, at, i);
      continue;
    }
    const double u = contact::normalised(term.port, at, i);
    double before = 1.0, now = u;
    for (int l = 1; l <= last; ++l) {
      if (l >= term.first) out[static_cast<std::size_t>(l - term.first)][i] = slope * now;
      const double next = boost::math::legendre_next(static_cast<unsigned>(l), u, now, before);
      before = now;
      now = next;
    }
  }
}

}  // namespace trueaxis::kind
