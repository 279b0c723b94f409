// SPDX-License-Identifier: Apache-2.0
#include "diagnose/refit/timing.hpp"

#include <cmath>
#include <variant>

#include "trueaxis/error.hpp"

namespace trueaxis::diagnose_detail {

bool is_lag(const Hypothesis& h) {
  const auto* response = h.effect ? std::get_if<Response>(&h.effect->term) : nullptr;
  return response != nullptr && response->of == Response::Of::lag;
}

bool is_delay(const Hypothesis& h) {
  const auto* shift = h.effect ? std::get_if<ArgumentShift>(&h.effect->term) : nullptr;
  return shift != nullptr && shift->by == ArgumentShift::By::delay;
}

std::vector<double> timing_mm(const Hypothesis& h, double seconds,
                              const LinearisationPoint& point) {
  expects(is_lag(h) || is_delay(h), "a lag or a delay");
  std::vector<double> out(point.size());
  point.for_each_part([&](const PointPart& at) {
    for (std::size_t k = 0; k < at.size(); ++k) {
      const double angle = at.speed[k] * seconds;
      const double kept = 1.0 / (1.0 + angle * angle);
      const double turned = is_lag(h) ? -angle * kept : -std::sin(angle);
      const double bent = is_lag(h) ? angle * angle * kept : 1.0 - std::cos(angle);
      out[at.begin + k] =
          turned * at.dx_dc[k] + bent * at.d2x_dc2[k] - seconds * at.velocity[k] * at.dx_dz[k];
    }
  });
  return out;
}

}  // namespace trueaxis::diagnose_detail
