// SPDX-License-Identifier: Apache-2.0
#include "form/closing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::form {
namespace {

constexpr std::size_t fewest_of_a_line = 3, fewest_places = 10;
constexpr double not_noise = 3.0;  // u: 0.3 % of sections that close are beyond

/// A straight line through some of the readings, in the order of the angle.
struct Line {
  double at_rad = 0.0, value_mm = 0.0, slope = 0.0;
  double operator()(double angle_rad) const { return value_mm + slope * (angle_rad - at_rad); }
};
Line line_through(const SectionReadings& section, std::size_t first, std::size_t count) {
  const auto n = static_cast<double>(count);
  Line line;
  for (std::size_t i = first; i < first + count; ++i)
    line.at_rad += section.angle_rad[i] / n, line.value_mm += section.distance_mm[i] / n;
  double product = 0.0, square = 0.0;
  for (std::size_t i = first; i < first + count; ++i) {
    const double off = section.angle_rad[i] - line.at_rad;
    product += off * section.distance_mm[i], square += off * off;
  }
  line.slope = square > 0.0 ? product / square : 0.0;
  return line;
}

/// The second line less the first, between both; the second is one revolution later.
double step_between(const Line& first, Line second, double later_rad) {
  second.at_rad -= later_rad;
  const double middle_rad = 0.5 * (first.at_rad + second.at_rad);
  return second(middle_rad) - first(middle_rad);
}

}  // namespace

std::optional<Closing> closing_of(const SectionReadings& section, double high_upr) {
  const std::size_t size = section.size();
  if (size < fewest_places || section.turns >= 2.0) return std::nullopt;
  const bool backwards = section.angle_rad.back() < section.angle_rad.front();
  const double turn = backwards ? -two_pi : two_pi;
  const double per_turn = static_cast<double>(size) / section.turns;
  const auto count =
      std::max(fewest_of_a_line, static_cast<std::size_t>(per_turn / 2.0 / high_upr));
  if (2 * count + fewest_places > size) return std::nullopt;
  // Whether C runs one way, and a reading at least is where the first one was but for half a wave.
  for (std::size_t i = 1; i < size; ++i)
    if ((section.angle_rad[i] - section.angle_rad[i - 1]) * turn < 0.0) return std::nullopt;
  const double missing = (1.0 - section.turns) * per_turn;
  if (missing > static_cast<double>(count)) return std::nullopt;
  // Where the end overlaps the beginning, the readings at the same angles.
  const double last_rad = section.angle_rad[size - count] - turn;
  std::size_t first = 0;
  while (first + 2 * count < size && (section.angle_rad[first] - last_rad) * turn < 0.0) ++first;
  Closing out;
  out.step_mm = step_between(line_through(section, first, count),
                             line_through(section, size - count, count), turn);
  double squares = 0.0, places = 0.0;
  for (std::size_t i = 0; i + 2 * count <= size; ++i, ++places) {
    const double step =
        step_between(line_through(section, i, count), line_through(section, i + count, count), 0.0);
    squares += step * step;
  }
  out.u_mm = std::sqrt(squares / places);
  return out;
}

Unclosed::Unclosed(const Sections& sections, double high_upr)
    : sections_(sections), steps_(sections.list.size()) {
  if (sections.pitch_mm != 0.0) return;  // form along Z is a step where a turn of a helix closes
  for (std::size_t s = 0; s < steps_.size(); ++s) {
    const auto step = closing_of(sections.list[s], high_upr);
    if (step && std::abs(step->step_mm) > not_noise * step->u_mm) steps_[s] = step;
  }
}

double Unclosed::u_of_radius(std::size_t s) const {
  return s < steps_.size() && steps_[s] ? 0.5 * std::abs(steps_[s]->step_mm) : 0.0;
}

void Unclosed::add_to(std::vector<Spread>& spread, const std::vector<SectionModel>& models,
                      const std::vector<std::vector<double>>& measured_mm,
                      const OfProfiles& of_profiles) const {
  for (std::size_t s = 0; s < steps_.size(); ++s) {
    if (!steps_[s]) continue;
    const std::vector<NamedValue> values = of_profiles(measured_mm);
    // What drifted went steadily, or bowed: by a quarter where it settles in half a revolution.
    for (const auto& course : {+[](double turn) { return turn - 0.5; },
                               +[](double turn) { return turn * (1.0 - turn); }}) {
      SectionReadings without = sections_.list[s];
      const double from = without.angle_rad.front();
      for (std::size_t i = 0; i < without.size(); ++i)
        without.distance_mm[i] -=
            steps_[s]->step_mm * course(std::abs(without.angle_rad[i] - from) / two_pi);
      std::vector<std::vector<double>> profiles = measured_mm;
      profiles[s] = models[s].changed(without);
      const std::vector<NamedValue> changed = of_profiles(profiles);
      for (std::size_t v = 0; v < values.size(); ++v)
        spread[v].u = std::hypot(spread[v].u, changed[v].value - values[v].value);
    }
  }
}

void Unclosed::note_in(std::vector<std::string>& notes, const char* of) const {
  std::size_t largest = steps_.size(), count = 0;
  for (std::size_t s = 0; s < steps_.size(); ++s) {
    if (!steps_[s]) continue;
    ++count;
    if (largest == steps_.size() ||
        std::abs(steps_[s]->step_mm) > std::abs(steps_[largest]->step_mm))
      largest = s;
  }
  if (count == 0) return;
  const Closing& step = *steps_[largest];
  notes.push_back(fmt::format(
      "{}{} not close: after a revolution the readings are {} ± {} µm (k = 2) {}. U "
      "includes a drift of that size. Find what drifts or moved, or probe several "
      "revolutions",
      of,
      steps_.size() == 1 ? "The trace does"
                         : fmt::format("{} of {} sections do", count, steps_.size()),
      significant(std::abs(step.step_mm) / mm_per_um, 3),
      significant(2.0 * step.u_mm / mm_per_um, 2), step.step_mm > 0.0 ? "larger" : "smaller"));
}

}  // namespace trueaxis::form
