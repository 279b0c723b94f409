// SPDX-License-Identifier: Apache-2.0
#include "format/doubled_points.hpp"

#include <algorithm>
#include <vector>

#include "trueaxis/error.hpp"

namespace trueaxis {

void refuse_doubled(std::span<const std::array<double, 3>> points, const std::string& source) {
  std::vector<std::array<double, 3>> sorted(points.begin(), points.end());
  std::ranges::sort(sorted);
  const auto repeated = std::ranges::unique(sorted);
  if (repeated.empty() || 2 * repeated.size() < sorted.size()) return;
  throw InputError(source, std::to_string(repeated.size()) + " of its " +
                               std::to_string(sorted.size()) +
                               " points repeat another to the last digit: the file holds its "
                               "points more than once. Keep each point once");
}

}  // namespace trueaxis
