// SPDX-License-Identifier: Apache-2.0
#include "measure/centre_of_ball.hpp"

namespace trueaxis {

bool is_probed_behind(const ProbeStream& stream) {
  if (stream.indication == Indication::relative) return set_up_of(stream, 0).rear;
  return stream.reading_mm.front() < 0.0;
}

double centre_at_zero_mm(const ProbeStream& stream, double ball_mm, bool bore) {
  if (stream.indication == Indication::absolute || !stream.nominal_radius_mm) return 0.0;
  const double outwards_mm = *stream.nominal_radius_mm + (bore ? -ball_mm : ball_mm);
  return is_probed_behind(stream) ? -outwards_mm : outwards_mm;
}

}  // namespace trueaxis
