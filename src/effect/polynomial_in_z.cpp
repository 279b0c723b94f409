// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
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
  const std::size_t size = at.size();
  if (term.plain) {
    const std::span<const double> along = contact::along_mm(term.port, at);
    std::copy(along.begin(), along.end(), out[0]);
    return contact::scale_by_dx_d(term.port, at, out);
  }
  const int last = last_degree(term, shape);
  contact::Chunk u, before, now;
  contact::normalised(term.port, at, u.data());
  std::fill_n(before.begin(), size, 1.0);
  std::copy_n(u.begin(), size, now.begin());
  for (int l = 1; l <= last; ++l) {
    if (l >= term.first) {
      std::copy_n(now.begin(), size, out[static_cast<std::size_t>(l - term.first)]);
    }
    for (std::size_t i = 0; i < size; ++i) {
      before[i] = boost::math::legendre_next(static_cast<unsigned>(l), u[i], now[i], before[i]);
    }
    std::swap(before, now);
  }
  contact::scale_by_dx_d(term.port, at, out);
}

}  // namespace trueaxis::kind
