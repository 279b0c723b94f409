// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <span>
#include <utility>

#include "diagnose/search/scan_fringes.hpp"
#include "math/sincos.hpp"

namespace trueaxis::diagnose_detail {

TurnedSums turned_sums(const FourierSums& plan, const LinearisationPoint& point, const Scan& scan,
                       const std::vector<double>& left) {
  const double order = std::abs(scan.turns);
  const bool turned_round = is_turned_round(scan, point);
  const auto columns = [&](std::size_t begin, std::size_t size, std::span<double* const> out) {
    const std::span<const double> here = std::span(left).subspan(begin, size);
    if (order == 0.0 && !turned_round) return void(std::ranges::copy(here, out[0]));
    PointRoom room;
    const PointPart at = point.part(begin, begin + size, room);
    std::vector<double> phase(size), g(here.begin(), here.end());
    for (std::size_t i = 0; i < size; ++i) {
      phase[i] = order * (scan.spindle ? at.c[i] : at.theta[i]);
      if (turned_round && at.rear[i]) g[i] = -g[i];
    }
    if (order == 0.0) return void(std::ranges::copy(g, out[0]));
    sincos(phase, {out[1], size}, {out[0], size});
    for (std::size_t i = 0; i < size; ++i) out[0][i] *= g[i], out[1][i] *= g[i];
  };
  std::vector<FourierSums::Sums> sums = plan.of(columns, order == 0.0 ? 1 : 2);
  sums.resize(2);
  return {order, scan.spindle, turned_round, std::move(sums[0]), std::move(sums[1])};
}

}  // namespace trueaxis::diagnose_detail
