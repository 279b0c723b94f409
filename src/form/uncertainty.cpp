// SPDX-License-Identifier: Apache-2.0
#include "form/uncertainty.hpp"

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cmath>

#include "base/threads.hpp"
#include "form/sampling.hpp"
#include "math/statistics.hpp"
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

namespace {

using Engine = boost::random::mt19937_64;

/// Orders of a motion of which the range alone is known: amplitudes fall with the order.
constexpr int first_unknown = 2, last_unknown = 10;
/// The height of the highest of a profile of noise, over its standard deviation.
constexpr double largest_of_noise = 5.0;
/// A tenth of a nanometre: below is the rounding of an association, and no form.
constexpr double nothing_mm = 1e-7, confidence_of_bound = 0.95;

double sum_of_squares(std::span<const double> values) {
  double sum = 0.0;
  for (const double one : values) sum += one * one;
  return sum;
}

/// What trials add to one section: noise, and what is not known of the spindle's motion.
class Disturbance {
 public:
  Disturbance(Engine& engine, const FormOptions& options) : engine_(engine) {
    for (const SpindleOrder& one : options.spindle)
      if (one.u_mm > 0.0)
        motion_.push_back({one.order, one.u_mm * normal_(engine_), one.u_mm * normal_(engine_)});
    if (options.spindle_range_mm > 0.0) draw_unknown(options.spindle_range_mm);
  }

  /// The same motion in every section, noise of each reading its own.
  std::vector<double> of(const SectionModel& section) {
    std::vector<double> out = motion_at(section.raw().at, motion_);
    for (double& one : out) one += section.noise_mm() * normal_(engine_);
    return out;
  }

  /// The motion alone, through the pass band.
  std::vector<double> motion(const SectionModel& section, const FormOptions& options) const {
    std::vector<SpindleOrder> passed = motion_;
    for (SpindleOrder& one : passed) {
      one.cos_mm *= passed_by_band(options, one.order);
      one.sin_mm *= passed_by_band(options, one.order);
    }
    return motion_at(section.raw().at, passed);
  }

 private:
  void draw_unknown(double range_mm) {
    const std::size_t known = motion_.size();
    for (int n = first_unknown; n <= last_unknown; ++n)
      motion_.push_back({n, normal_(engine_) / n, normal_(engine_) / n});
    std::vector<double> angles;
    for (int k = 0; k < 360; ++k) angles.push_back(k * rad_per_deg);
    const std::vector<SpindleOrder> drawn(motion_.begin() + static_cast<std::ptrdiff_t>(known),
                                          motion_.end());
    const double scale = range_mm / range_of(motion_at(angles, drawn)).length();
    for (std::size_t i = known; i < motion_.size(); ++i) {
      motion_[i].cos_mm *= scale;
      motion_[i].sin_mm *= scale;
    }
  }
  static std::vector<double> motion_at(std::span<const double> angle_rad,
                                       std::span<const SpindleOrder> orders) {
    std::vector<double> out(angle_rad.size(), 0.0);
    for (const SpindleOrder& one : orders)
      for (std::size_t i = 0; i < out.size(); ++i)
        out[i] += one.cos_mm * std::cos(one.order * angle_rad[i]) +
                  one.sin_mm * std::sin(one.order * angle_rad[i]);
    return out;
  }

  Engine& engine_;
  boost::random::normal_distribution<double> normal_;
  std::vector<SpindleOrder> motion_;
};

/// 0: there are none.
double bound_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto rank =
      static_cast<std::size_t>(confidence_of_bound * static_cast<double>(values.size()));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::min(rank, values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

/// By how much the filter lowers the variance of noise, from one draw of it.
double noise_passed(const SectionModel& section) {
  Engine engine(2012);
  boost::random::normal_distribution<double> normal;
  std::vector<double> noise(section.raw().size());
  for (double& one : noise) one = normal(engine);
  return sum_of_squares(section.filtered(noise)) / sum_of_squares(noise);
}

/// Every order without the part that is noise, then filtered. Eq. 271.
std::vector<double> of_shrunk_orders(const SectionModel& section) {
  std::vector<double> sum(section.raw().size(), 0.0);
  for (const Order& one : section.orders()) {
    const double noise = section.noise_mm() * one.u_per_sigma;
    const double square = one.cos_mm * one.cos_mm + one.sin_mm * one.sin_mm;
    if (one.order == 0 || square <= shown_over_noise * noise * noise) continue;
    const double kept = std::sqrt(1.0 - shown_over_noise * noise * noise / square);
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] += kept * (one.cos_mm * std::cos(one.order * section.raw().at[i]) +
                        one.sin_mm * std::sin(one.order * section.raw().at[i]));
  }
  return section.filtered(sum);
}

/// The profile that noise is added to: without its own where what that takes off looks like noise
/// (a scratch is many small orders and does not), else as much smaller as noise made it. Eq. 271.
std::vector<double> less_noise(const SectionModel& section) {
  std::vector<double> profile = section.profile_mm();
  const double noise = section.noise_mm() * std::sqrt(noise_passed(section));
  const std::vector<double> shrunk = of_shrunk_orders(section);
  double largest = 0.0;
  for (std::size_t i = 0; i < profile.size(); ++i)
    largest = std::max(largest, std::abs(profile[i] - shrunk[i]));
  if (largest <= largest_of_noise * noise) return shrunk;
  const double variance = sum_of_squares(profile) / static_cast<double>(profile.size());
  const double kept = variance > noise * noise ? std::sqrt(1.0 - noise * noise / variance) : 0.0;
  for (double& one : profile) one *= kept;
  return profile;
}

std::vector<std::vector<double>> less_noise(const PartModel& part) {
  std::vector<std::vector<double>> out;
  for (const SectionModel& section : part.sections)
    out.push_back(part.surface ? section.profile_mm() : less_noise(section));
  return out;
}

/// Profiles of a trial: those of `base` with noise, or a draw of the surface.
void disturb(const PartModel& part, std::size_t trial, const FormOptions& options,
             Disturbance& disturbance, std::vector<std::vector<double>>& profiles) {
  if (part.surface) profiles = part.surface->profiles(trial);
  for (std::size_t s = 0; s < part.sections.size(); ++s) {
    const SectionModel& section = part.sections[s];
    const std::vector<double> added = part.surface ? disturbance.motion(section, options)
                                                   : section.filtered(disturbance.of(section));
    for (std::size_t i = 0; i < added.size(); ++i) profiles[s][i] += added[i];
  }
}

std::vector<std::vector<double>> touched(const std::vector<SectionModel>& sections,
                                         const FormOptions& options, bool eroded) {
  std::vector<std::vector<double>> out;
  for (const SectionModel& section : sections)
    out.push_back(eroded && section.radius_known()
                      ? touched_by_ball(section.raw(), section.profile_mm(),
                                        section.surface_radius_mm(), options.ball_radius_mm,
                                        options.bore)
                      : section.profile_mm());
  return out;
}

/// By how much each value would be another one if the ball had bridged nothing; Eq. 269.
std::vector<double> by_ball(const std::vector<SectionModel>& part,
                            const std::vector<SectionModel>& datum, const FormOptions& options,
                            const Assess& assess, std::size_t count) {
  std::vector<double> out(count, 0.0);
  if (!(options.ball_radius_mm > 0.0)) return out;
  const auto with = assess({touched(part, options, false), touched(datum, options, false)});
  const auto without = assess({touched(part, options, true), touched(datum, options, true)});
  for (std::size_t v = 0; v < count; ++v) out[v] = without[v].value - with[v].value;
  return out;
}

}  // namespace

std::vector<double> touched_by_ball(const Trace& trace, std::span<const double> centre_mm,
                                    double radius_mm, double ball_mm, bool bore) {
  const double bend = radius_mm * radius_mm / ball_mm + (bore ? -radius_mm : radius_mm);
  const double range = range_of(centre_mm).length();
  const double widest = bend > 0.0 ? std::sqrt(2.0 * range / bend) : 0.5 * trace.period;
  const auto n = static_cast<std::ptrdiff_t>(trace.size());
  const double sense = bore ? -1.0 : 1.0;  // a bore's material lies outwards
  std::vector<double> out(centre_mm.begin(), centre_mm.end());
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const auto here = static_cast<std::size_t>(i);
    for (const std::ptrdiff_t way : {-1, 1}) {
      double distance = 0.0;
      for (std::ptrdiff_t k = 1; k < n; ++k) {
        const auto at = static_cast<std::size_t>(((i + way * k) % n + n) % n);
        distance += trace.step(way > 0 ? static_cast<std::size_t>(((i + k - 1) % n + n) % n) : at);
        if (distance > widest) break;
        const double limit = centre_mm[at] + sense * 0.5 * bend * distance * distance;
        out[here] = bore ? std::max(out[here], limit) : std::min(out[here], limit);
      }
    }
  }
  return out;
}

std::vector<Spread> spreads(const PartModel& part, const PartModel& datum,
                            const FormOptions& options, const Assess& assess) {
  const Profiles base{less_noise(part), less_noise(datum)};
  const std::vector<NamedValue> values = assess(base);
  auto trials = static_cast<std::size_t>(options.trials);
  for (const PartModel* one : {&part, &datum})
    if (one->surface) trials = one->surface->draws();
  std::vector<std::vector<double>> drawn(trials);
  for_each_index(trials, options.threads, [&](std::size_t trial) {
    Engine engine(options.seed + 0x9E3779B97F4A7C15ULL * (trial + 1));
    Disturbance disturbance(engine, options);
    Profiles profiles = base;
    disturb(part, trial, options, disturbance, profiles.part_mm);
    disturb(datum, trial, options, disturbance, profiles.datum_mm);
    for (const NamedValue& one : assess(profiles)) drawn[trial].push_back(one.value);
  });
  const std::vector<double> ball =
      by_ball(part.sections, datum.sections, options, assess, values.size());
  std::vector<Spread> out;
  for (std::size_t v = 0; v < values.size(); ++v) {
    double sum = 0.0, squares = ball[v] * ball[v] / 3.0 * static_cast<double>(trials);
    std::vector<double> there;
    for (const auto& trial : drawn) {
      if (trial[v] > nothing_mm) there.push_back(trial[v]);
      const double off = trial[v] - values[v].value;
      sum += off;
      squares += off * off;
    }
    const double n = static_cast<double>(trials);
    out.push_back({std::sqrt(squares / n), sum / n, bound_of(std::move(there))});
  }
  return out;
}

}  // namespace trueaxis::form
