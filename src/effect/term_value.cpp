// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/effect.hpp"

namespace trueaxis {

std::size_t TermValue::columns() const {
  if (!effect) {
    const bool line = pattern.kind == Pattern::Kind::line;
    return pattern.kind == Pattern::Kind::bump || (!line && pattern.order == 0.0) ? 1 : 2;
  }
  const std::size_t own =
      free.empty() ? linear_parameters(effect->term, shape).size() : free.size();
  return own + (with_radial ? 2 : 0);
}

}  // namespace trueaxis
