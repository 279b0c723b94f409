// SPDX-License-Identifier: Apache-2.0
#include "correct/margin.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using Complex = std::complex<double>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int angles = 180;  // of a revolution: a peak of order 1 to 3 is missed by 1e-3 at most
constexpr int places = 9;    // along the cut; peaks are at its ends unless an axis crosses
constexpr int phases = 96;   // between two rows or set-points
// Images either side. Rows: the neglected part is 2.5 % of the error of a table that runs
// so slowly that the actuator filters nothing. Set-points: the actuator has long filtered the
// fourth.
constexpr int row_images = 24;
constexpr int hold_images = 3;
constexpr double counted_mm = 1e-5;  // a harmonic that the bandwidth must pass

/// Everything about one speed that does not depend on the place along the cut.
struct Chain {
  Motion motion;
  std::vector<HarmonicPath> paths;
  /// What a harmonic of amplitude 1 becomes in addition to itself, by order and phase x:
  /// linear interpolation between M rows, sinc²(n/M) Σ_{k≠0} (n/(n+kM))² H((n+kM)ω) e^{ikx},
  std::vector<std::vector<Complex>> between_rows;
  /// and the hold between set-points at ω_s, Σ_{m≠0} H(nω + mω_s) e^{imx}.
  std::vector<std::vector<Complex>> between_set_points;
};

/// Σ_{k≠0} weight(k) H(hz(k)) e^{ikx} at the phases x.
template <typename Weight, typename Frequency>
std::vector<Complex> image_sum(const Actuator& actuator, int images, Weight weight, Frequency hz) {
  std::vector<Complex> sum(phases);
  for (int k = -images; k <= images; ++k) {
    if (k == 0) continue;
    const Complex amplitude = weight(k) * signed_response(actuator, hz(k));
    for (int p = 0; p < phases; ++p) {
      sum[static_cast<std::size_t>(p)] += amplitude * std::polar(1.0, two_pi * k * p / phases);
    }
  }
  return sum;
}

Chain make_chain(const Spectrum& spectrum, const Motion& motion, const Actuator& actuator) {
  Chain chain;
  chain.motion = motion;
  chain.paths = harmonic_paths(actuator, chain.motion, spectrum.orders());
  const int rows = chain.motion.rows_per_revolution;
  const double turns_hz = motion.omega_rad_per_s / two_pi;
  for (const int n : spectrum.orders()) {
    const double kept = kept_by_interpolation(n, rows);
    chain.between_rows.push_back(image_sum(
        actuator, row_images,
        [&](int k) { return kept * std::pow(static_cast<double>(n) / (n + k * rows), 2); },
        [&](int k) { return (n + k * rows) * turns_hz; }));
    chain.between_set_points.push_back(image_sum(
        actuator, hold_images, [](int) { return 1.0; },
        [&](int m) { return n * turns_hz + m * actuator.sampling_hz; }));
  }
  return chain;
}

/// Largest |Σ Re{c_n e^{inψ}}| and the extremes, over a revolution.
struct Extremes {
  double low = infinity, high = -infinity;
  double peak() const { return std::max(high, -low); }
};

Extremes extremes(const std::vector<HarmonicPath>& paths, const std::vector<Complex>& amplitude,
                  const std::vector<Complex>& turn) {
  Extremes found;
  for (int i = 0; i < angles; ++i) {
    double value = 0.0;
    for (std::size_t k = 0; k < paths.size(); ++k) {
      const Complex& e = turn[static_cast<std::size_t>(i * paths[k].order % angles)];
      value += amplitude[k].real() * e.real() - amplitude[k].imag() * e.imag();
    }
    found.low = std::min(found.low, value);
    found.high = std::max(found.high, value);
  }
  return found;
}

/// Peak of Σ Re{(base_n + command_n images_n(x)) e^{inψ}} over a revolution, at the phase x where
/// the amplitudes are largest together.
double peak_over_phases(const Chain& chain, const std::vector<Complex>& base,
                        const std::vector<Complex>& command,
                        const std::vector<std::vector<Complex>>& images,
                        const std::vector<Complex>& turn) {
  const auto total = [&](std::size_t order, std::size_t phase) {
    return base[order] + command[order] * images[order][phase];
  };
  std::size_t worst = 0;
  double largest = 0.0;
  for (std::size_t p = 0; p < phases; ++p) {
    double sum = 0.0;
    for (std::size_t k = 0; k < base.size(); ++k) sum += std::abs(total(k, p));
    if (sum > largest) worst = p, largest = sum;
  }
  std::vector<Complex> error(base.size());
  for (std::size_t k = 0; k < base.size(); ++k) error[k] = total(k, worst);
  return extremes(chain.paths, error, turn).peak();
}

/// Demands of one place along the cut, largest over a revolution.
struct Demand {
  Extremes command;
  double slew_mm_per_s = 0.0, following_mm = 0.0, following_once_mm = 0.0, unknown_mm = 0.0;
};

/// What turns once per revolution with the part, Eq. 116a: the first harmonic's own error, and the
/// images n + kM = ±1 of others (those of the set-points are locked to the revolution nowhere).
double once_a_revolution(const Chain& chain, const std::vector<Complex>& following,
                         const std::vector<Complex>& command, const Actuator& actuator) {
  const int rows = chain.motion.rows_per_revolution;
  Complex once;
  for (std::size_t k = 0; k < chain.paths.size(); ++k) {
    const int n = chain.paths[k].order;
    if (n == 1) once += following[k];
    if (n < 2) continue;
    for (const int image : {-1, 1}) {
      if ((image - n) % rows != 0) continue;
      const double share = kept_by_interpolation(n, rows) * n * n;
      const Complex one = share * command[k] *
                          signed_response(actuator, image * chain.motion.omega_rad_per_s / two_pi);
      once += image > 0 ? one : std::conj(one);
    }
  }
  return std::abs(once);
}

/// Eq. 116.
Demand demand_at(const Chain& chain, const std::vector<SlowAmplitude>& wanted,
                 const Actuator& actuator, bool precompensated, const std::vector<Complex>& turn) {
  const std::size_t orders = chain.paths.size();
  std::vector<Complex> command(orders), velocity(orders), following(orders);
  for (std::size_t k = 0; k < orders; ++k) {
    const HarmonicPath& path = chain.paths[k];
    const double rate_mm_per_s = chain.motion.position_mm_per_s;
    const Complex i(0.0, 1.0);
    // ä is neglected: it is of second order in the feed per revolution over the length of the cut.
    const Complex gain = precompensated ? 1.0 / path.response : Complex(1.0);
    const Complex command_rate = gain * wanted[k].slope * rate_mm_per_s;
    command[k] = precompensated ? commanded(path, wanted[k], rate_mm_per_s) : wanted[k].value;
    velocity[k] = i * (path.order * chain.motion.omega_rad_per_s) * command[k] + command_rate;
    following[k] =
        path.response * command[k] - i * path.response_slope * command_rate - wanted[k].value;
  }
  Demand demand;
  demand.command = extremes(chain.paths, command, turn);
  demand.slew_mm_per_s = extremes(chain.paths, velocity, turn).peak();
  // The phases between rows and between set-points run free of each other and of the revolution.
  demand.following_mm = peak_over_phases(chain, following, command, chain.between_rows, turn) +
                        peak_over_phases(chain, std::vector<Complex>(orders), command,
                                         chain.between_set_points, turn);
  demand.following_once_mm = once_a_revolution(chain, following, command, actuator);
  for (std::size_t k = 0; k < orders; ++k) {
    const double unknown_mm = chain.paths[k].unknown * std::abs(wanted[k].value);
    demand.unknown_mm += unknown_mm;
    if (chain.paths[k].order == 1) demand.following_once_mm += unknown_mm;
  }
  demand.following_mm += demand.unknown_mm;
  return demand;
}

/// Calls `each` with the amplitudes at places all along the cut.
template <typename Each>
void for_places(const Spectrum& spectrum, Each each) {
  std::vector<SlowAmplitude> wanted;
  for (int place = 0; place < places; ++place) {
    const double share = static_cast<double>(place) / (places - 1);
    spectrum.at(spectrum.start_mm() + share * (spectrum.end_mm() - spectrum.start_mm()), wanted);
    each(wanted);
  }
}

/// The highest order that the bandwidth and the set-points must pass; 0: none.
int highest_order_of(const Spectrum& spectrum, const std::vector<SlowAmplitude>& wanted) {
  int highest = 0;
  for (std::size_t k = 0; k < wanted.size(); ++k)
    if (std::abs(wanted[k].value) > counted_mm) highest = std::max(highest, spectrum.orders()[k]);
  return highest;
}

/// Whether set-points show an order at all; what they do not show no command brings about.
bool enough_set_points(double per_revolution, int order) { return per_revolution > 2.0 * order; }

void judge(ActuatorMargin& m, int highest_order) {
  const auto within = [&](double used, double available, const char* unit, ReasonCode broken) {
    if (!(used <= available))
      m.breaks.push_back({broken, {}, {{"used", used, unit}, {"available", available, unit}}});
  };
  within(m.stroke_used_mm, m.stroke_available_mm, "mm", ReasonCode::stroke_exceeded);
  within(m.slew_used_mm_per_s, m.slew_available_mm_per_s, "mm/s", ReasonCode::slew_exceeded);
  within(m.highest_frequency_hz, m.bandwidth_hz, "Hz", ReasonCode::frequency_exceeded);
  if (!enough_set_points(m.set_points_per_revolution, highest_order))
    m.breaks.push_back({ReasonCode::set_points_too_few,
                        {},
                        {{"per_revolution", m.set_points_per_revolution},
                         {"needed", 2.0 * highest_order},
                         {"order", double(highest_order)}}});
  within(m.following_mm, m.following_limit_mm, "mm", ReasonCode::following_error_exceeded);
  // Without what the points do not show it would follow.
  if (m.following_mm > m.following_limit_mm &&
      m.following_mm - m.following_unknown_mm <= m.following_limit_mm)
    m.breaks.back().numbers.push_back({"unknown", m.following_unknown_mm, "mm"});
  m.follows = m.breaks.empty();
}

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

/// Rounded down, so that it does follow.
Reason at_speed(double now_rpm, double rpm) {
  if (!(rpm > 0.0)) return {ReasonCode::at_no_speed};
  const double speed_rpm = rpm >= 10.0 ? std::floor(rpm) : std::floor(10.0 * rpm) / 10.0;
  return {rpm < now_rpm ? ReasonCode::at_speed_or_less : ReasonCode::at_speed,
          {},
          {{"speed", speed_rpm, "rpm"}}};
}

}  // namespace

ActuatorMargin margin_at(const Spectrum& spectrum, const Motion& motion, const Actuator& actuator) {
  const Chain chain = make_chain(spectrum, motion, actuator);
  std::vector<Complex> turn(angles);
  for (int i = 0; i < angles; ++i) {
    turn[static_cast<std::size_t>(i)] = std::polar(1.0, two_pi * i / angles);
  }
  ActuatorMargin margin;
  Extremes command;
  int highest_order = 0;
  const bool ahead = can_precompensate(spectrum, motion, actuator);
  for_places(spectrum, [&](const std::vector<SlowAmplitude>& wanted) {
    const Demand plain = demand_at(chain, wanted, actuator, false, turn);
    const Demand sent = ahead ? demand_at(chain, wanted, actuator, true, turn) : plain;
    command.low = std::min(command.low, sent.command.low);
    command.high = std::max(command.high, sent.command.high);
    margin.slew_used_mm_per_s = std::max(margin.slew_used_mm_per_s, sent.slew_mm_per_s);
    margin.following_mm = std::max(margin.following_mm, sent.following_mm);
    margin.following_once_mm = std::max(margin.following_once_mm, sent.following_once_mm);
    margin.following_unknown_mm = std::max(margin.following_unknown_mm, sent.unknown_mm);
    margin.following_uncompensated_mm =
        std::max(margin.following_uncompensated_mm, plain.following_mm);
    highest_order = std::max(highest_order, highest_order_of(spectrum, wanted));
  });
  margin.stroke_used_mm = command.high - command.low;
  margin.stroke_available_mm = actuator.stroke_mm * (1.0 - actuator.stroke_reserve);
  margin.slew_available_mm_per_s = actuator.slew_mm_per_s;
  const double turns_hz = motion.omega_rad_per_s / two_pi;
  margin.highest_frequency_hz = highest_order * turns_hz;
  margin.bandwidth_hz = actuator.bandwidth_hz();
  margin.set_points_per_revolution = actuator.sampling_hz / turns_hz;
  margin.following_limit_mm = actuator.following_limit_mm;
  judge(margin, highest_order);
  return margin;
}

ActuatorMargin margin_at(const Spectrum& spectrum, const Profile& profile, const Actuator& actuator,
                         double speed_rpm) {
  return margin_at(spectrum, motion_of(profile, speed_rpm), actuator);
}

bool can_precompensate(const Spectrum& spectrum, const Motion& motion, const Actuator& actuator) {
  int order = 0;
  for_places(spectrum, [&](const std::vector<SlowAmplitude>& wanted) {
    order = std::max(order, highest_order_of(spectrum, wanted));
  });
  return actuator.precompensate &&
         enough_set_points(actuator.sampling_hz * two_pi / motion.omega_rad_per_s, order);
}

double max_speed_rpm(const Spectrum& spectrum, const Profile& profile, const Actuator& actuator) {
  const auto follows = [&](double rpm) {
    return margin_at(spectrum, profile, actuator, rpm).follows;
  };
  // From the top in steps of 20 %: a slow spindle can break limits too (interpolation errors pass
  // through the actuator that a fast one filters), so the highest speed is searched, not the lowest
  // break.
  double broken = 60.0 * actuator.bandwidth_hz();
  if (follows(broken)) return broken;
  double good = broken;
  for (int step = 0; step < 70 && good == broken; ++step) {
    if (follows(broken / 1.2)) {
      good = broken / 1.2;
    } else {
      broken = good = broken / 1.2;
    }
  }
  if (good == broken) return 0.0;
  for (int step = 0; step < 20; ++step) {
    const double middle = 0.5 * (good + broken);
    (follows(middle) ? good : broken) = middle;
  }
  return good;
}

double trusted_speed_rpm(const ActuatorMargin& at, double speed_rpm) {
  const double once_hz = speed_rpm / 60.0;
  return speed_rpm * at.bandwidth_hz / 3.0 / std::max(at.highest_frequency_hz, once_hz);
}

Reason remedy(const Spectrum& spectrum, const Profile& profile, const Actuator& actuator,
              double max_speed_rpm) {
  const double now_rpm = profile.tool().speed_rpm;
  Motion motion = motion_of(profile, now_rpm);
  const int rows = motion.rows_per_revolution;
  constexpr double most_rows = 1e5, most_sampling = 64.0;
  const double more_rows = least_that_holds(rows, most_rows, 1.0, [&](double tried) {
    motion.rows_per_revolution = static_cast<int>(tried);
    return margin_at(spectrum, motion, actuator).follows;
  });
  if (more_rows > 0.0)
    return {ReasonCode::follows_with_rows, {}, {{"rows", more_rows}, {"now", double(rows)}}};
  motion.rows_per_revolution = rows;
  const double faster_hz =
      least_that_holds(actuator.sampling_hz, most_sampling * actuator.sampling_hz,
                       0.01 * actuator.sampling_hz, [&](double tried) {
                         Actuator sampled = actuator;
                         sampled.sampling_hz = tried;
                         return margin_at(spectrum, motion, sampled).follows;
                       });
  const Reason speed = at_speed(now_rpm, max_speed_rpm);
  if (!(faster_hz > 0.0)) return {ReasonCode::follows_at_speed, {}, {}, {}, {speed}};
  Reason faster{ReasonCode::follows_with_set_points, {}, {{"rate", faster_hz, "Hz"}}};
  if (max_speed_rpm > 0.0 && max_speed_rpm < now_rpm) faster.parts = {speed};
  return faster;
}

}  // namespace trueaxis
