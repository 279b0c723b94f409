// SPDX-License-Identifier: Apache-2.0
#include "form/form_case.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "form/true_form.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/part_form.hpp"

namespace trueaxis::form_study {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

/// Numbers that are the same with every standard library.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double unit() { return static_cast<double>(random_() >> 11U) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  double log_between(double low, double high) { return low * std::pow(high / low, unit()); }
  int whole(int low, int high) { return static_cast<int>(std::floor(between(low, high + 1.0))); }
  /// By twelve numbers: tails end at 6 σ.
  double normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += unit();
    return sum;
  }

 private:
  std::mt19937_64 random_;
};

struct Lobes {
  int order;
  double amplitude_mm, phase_rad;
  Course course;
  double middle, width;  // of the length
};

double course_of(const Lobes& one, double along) {
  if (one.course == Course::growing) return along;
  if (one.course == Course::local)
    return std::exp(-0.5 * std::pow((along - one.middle) / one.width, 2));
  return 1.0;
}

struct Part {
  double radius_mm, x_mm, y_mm, l, m, length_mm;
  std::vector<Lobes> lobes;

  double radius(double angle, double z) const {
    double r = radius_mm;
    for (const Lobes& one : lobes)
      r += one.amplitude_mm * course_of(one, z / length_mm) *
           std::cos(one.order * angle - one.phase_rad);
    return r;
  }
  /// Where the line of the probe meets the part, by halving.
  double probed(double c, double z) const {
    double inside = 0.5 * radius_mm, outside = 1.5 * radius_mm;
    for (int step = 0; step < 60; ++step) {
      const double x = 0.5 * (inside + outside);
      const double px = x * std::cos(c) - x_mm - l * z, py = x * std::sin(c) - y_mm - m * z;
      (std::hypot(px, py) < radius(std::atan2(py, px), z) ? inside : outside) = x;
    }
    return 0.5 * (inside + outside);
  }
};

Part draw_part(Draw& draw, Course course, double sigma_mm) {
  Part part{draw.log_between(8.0, 60.0), 0.0, 0.0, 0.0, 0.0, draw.between(20.0, 80.0), {}};
  const double off = draw.log_between(1e-3, 0.1), at = draw.between(0.0, turn);
  part.x_mm = off * std::cos(at), part.y_mm = off * std::sin(at);
  part.l = draw.between(-5e-4, 5e-4), part.m = draw.between(-5e-4, 5e-4);
  const int count = course == Course::none ? 0 : draw.whole(1, 3);
  for (int k = 0; k < count; ++k)
    part.lobes.push_back({draw.whole(2, 15), draw.log_between(0.1, 10.0) * sigma_mm,
                          draw.between(0.0, turn), course, draw.between(0.1, 0.9),
                          draw.between(0.12, 0.3)});
  return part;
}

}  // namespace

Drawn draw(std::uint64_t seed, std::size_t readings) {
  Draw draw(seed);
  Drawn out;
  out.course = static_cast<Course>(draw.whole(0, 3));
  out.sections = draw.unit() < 0.25;
  const double sigma_mm = draw.log_between(0.3e-3, 3e-3);
  const Part part = draw_part(draw, out.course, sigma_mm);
  for (const Lobes& one : part.lobes)
    out.largest_um = std::max(out.largest_um, 1e3 * one.amplitude_mm);
  const double count = static_cast<double>(readings);
  // Turns have 20 to 90 readings each, sections fewer, so that none carries a standard band.
  const double per_turn =
      out.sections ? draw.between(20.0, std::min(90.0, count / 5.0))
                   : draw.between(std::min(18.0, count / 5.0), std::min(90.0, count / 4.0));
  const double turns = std::floor(count / per_turn);
  double start = 0.0;
  const auto points = static_cast<int>(std::floor(per_turn));
  for (std::size_t i = 0; i < readings; ++i) {
    const auto number = static_cast<int>(i);
    double c = turn * number / per_turn, z = part.length_mm * number / (count - 1.0);
    if (out.sections) {
      const int section = number / points;
      if (section >= static_cast<int>(turns)) break;
      if (number % points == 0) start = draw.between(0.0, turn);
      c = turn * section + start + turn * (number % points) / points;
      z = part.length_mm * section / (turns - 1.0);
    }
    out.stream.c_rad.push_back(c);
    out.stream.position_mm.push_back(z);
    out.stream.reading_mm.push_back(part.probed(c, z) + sigma_mm * draw.normal());
  }
  int carried = 0;
  try {
    carried = carried_upr(out.stream);
  } catch (const InputError&) {  // C that ends near a whole number of degrees as if of radians
  }
  out.high_upr = carried >= 50 ? 50.0 : carried >= 15 ? 15.0 : carried;
  if (carried < 2) return out;
  const TrueForm truth = true_form([&](double angle, double z) { return part.radius(angle, z); },
                                   part.length_mm, out.high_upr);
  out.ront_mm = truth.ront_mm;
  out.cylt_mm = truth.cylt_mm;
  return out;
}

FormResult assessed(const Drawn& drawn) {
  FormOptions options;
  options.high_upr = drawn.high_upr;
  options.all_references = false;
  options.trials = 200;
  return assess_form(drawn.stream, options);
}

Judged judged(const FormResult& result, const std::string& name, const std::string& reference,
              double truth_mm) {
  const FormValue* value = worst_value(result, name, reference);
  Judged out;
  out.bound = value->estimate.interval.has_value();
  out.holds = least_of(*value, 2.0) <= truth_mm && truth_mm <= most_of(*value, 2.0);
  out.off_mm = out.bound ? 0.0 : value->estimate.value - truth_mm;
  out.U_mm = out.bound ? value->estimate.interval->back() : 2.0 * value->estimate.u;
  return out;
}

double U_by_turns_mm(const Drawn& drawn) {
  FormOptions options;
  options.each_turn_by_itself = true;
  options.all_references = false;
  options.trials = 20;
  options.high_upr = carried_upr(drawn.stream, options);
  if (options.high_upr < 2.0) return 0.0;
  const FormResult result = assess_form(drawn.stream, options);
  const FormValue* value = worst_value(result, "RONt", "MZCI");
  return value->estimate.interval ? value->estimate.interval->back() : 2.0 * value->estimate.u;
}

}  // namespace trueaxis::form_study
