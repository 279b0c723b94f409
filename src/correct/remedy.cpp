// SPDX-License-Identifier: Apache-2.0
#include "correct/remedy.hpp"

#include <cmath>
#include <sstream>

#include "correct/margin.hpp"

namespace trueaxis {
namespace {

/// The least value of a doubling scale above `now` that holds, then halved towards `now`; 0: none
/// up to `most`.
template <typename Holds>
double least_that_holds(double now, double most, double step, Holds holds) {
  double good = now;
  do good *= 2.0;
  while (good <= most && !holds(good));
  if (good > most) return 0.0;
  for (double bad = 0.5 * good; good - bad > step;) {
    const double middle = step * std::ceil(0.5 * (good + bad) / step);
    if (middle >= good) break;
    (holds(middle) ? good : bad) = middle;
  }
  return good;
}

std::string at_speed(double now_rpm, double rpm) {
  if (!(rpm > 0.0)) return "not at any speed";
  std::ostringstream text;
  text.precision(rpm >= 10.0 ? 12 : 2);
  text << "at " << (rpm >= 10.0 ? std::floor(rpm) : std::floor(10.0 * rpm) / 10.0) << " rpm"
       << (rpm < now_rpm ? " or less" : "");
  return text.str();
}

std::string hertz(double value) {
  std::ostringstream text;
  text.precision(12);
  text << value << " Hz";
  return text.str();
}

}  // namespace

std::string remedy(const Spectrum& spectrum, const Profile& profile, const Actuator& actuator,
                   double max_speed_rpm) {
  const double now_rpm = profile.tool().speed_rpm;
  Motion motion = motion_of(profile, now_rpm);
  const int rows = motion.rows_per_revolution;
  constexpr double most_rows = 1e5, most_sampling = 64.0;
  const double more_rows = least_that_holds(rows, most_rows, 1.0, [&](double tried) {
    motion.rows_per_revolution = static_cast<int>(tried);
    return margin_at(spectrum, motion, actuator).follows;
  });
  if (more_rows > 0.0) {
    return "it would with " + std::to_string(static_cast<int>(more_rows)) +
           " rows a revolution (rows_per_revolution): between " + std::to_string(rows) +
           " the interpolation errs too much";
  }
  motion.rows_per_revolution = rows;
  const double faster_hz =
      least_that_holds(actuator.sampling_hz, most_sampling * actuator.sampling_hz,
                       0.01 * actuator.sampling_hz, [&](double tried) {
                         Actuator sampled = actuator;
                         sampled.sampling_hz = tried;
                         return margin_at(spectrum, motion, sampled).follows;
                       });
  const std::string speed = "it would " + at_speed(now_rpm, max_speed_rpm);
  if (!(faster_hz > 0.0)) return speed;
  const bool slower = max_speed_rpm > 0.0 && max_speed_rpm < now_rpm;
  return "it would with set-points at " + hertz(faster_hz) + " (sampling_hz)" +
         (slower ? ", or " + at_speed(now_rpm, max_speed_rpm) : "");
}

}  // namespace trueaxis
