// SPDX-License-Identifier: Apache-2.0
#include "form/taken_off.hpp"

#include <algorithm>
#include <cmath>

#include "trueaxis/error.hpp"

namespace trueaxis::form {

std::vector<double> added(std::span<const double> reading_mm, const TakenOff& one,
                          std::size_t column) {
  const std::vector<double>& more_mm = one.columns_mm[column];
  expects(more_mm.size() == reading_mm.size(), "a change for every reading");
  std::vector<double> out(reading_mm.begin(), reading_mm.end());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] += more_mm[i];
  return out;
}

void add_taken_off(std::span<const TakenOff> taken_off, const std::vector<NamedValue>& values,
                   std::vector<Spread>& spread, const Changed& changed) {
  std::vector<double> variance(values.size(), 0.0);
  for (const TakenOff& one : taken_off) {
    const std::size_t count = one.columns_mm.size();
    std::vector<std::vector<double>> change(count);
    for (std::size_t k = 0; k < count; ++k) {
      const std::vector<NamedValue> now = changed(one, k);
      for (std::size_t v = 0; v < values.size(); ++v)
        change[k].push_back(now[v].value - values[v].value);
    }
    for (std::size_t v = 0; v < values.size(); ++v)
      for (std::size_t k = 0; k < count; ++k)
        for (std::size_t l = 0; l < count; ++l)
          variance[v] += one.correlation[k * count + l] * change[k][v] * change[l][v];
  }
  for (std::size_t v = 0; v < values.size(); ++v)
    spread[v].u = std::hypot(spread[v].u, std::sqrt(std::max(0.0, variance[v])));
}

}  // namespace trueaxis::form
