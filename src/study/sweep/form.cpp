// SPDX-License-Identifier: Apache-2.0
#include "study/sweep/form.hpp"

#include <algorithm>
#include <cmath>

#include "simulate/clean_stream.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::study {
namespace {

constexpr std::array<const char*, 4> circles{"LSCI", "MZCI", "MCCI", "MICI"};
constexpr int trials = 20;  // u to 16 %
/// Readings a wave of the shortest wave: a peak is missed by 1 − cos(π/60), 0.14 % of it.
constexpr double dense_per_wave = 60.0;

long turn_of(const ProbeStream& stream, std::size_t i) {
  return static_cast<long>(std::abs(stream.c_rad[i] - stream.c_rad.front()) / two_pi);
}

/// Three turns about the middle of the stream.
ProbeStream middle_turns(const ProbeStream& stream) {
  const long middle = turn_of(stream, stream.size() - 1) / 2;
  ProbeStream out = stream;
  for (auto* column : {&out.reading_mm, &out.c_rad, &out.position_mm, &out.time_s}) column->clear();
  out.pass.clear(), out.setup.clear();
  for (std::size_t i = 0; i < stream.size(); ++i) {
    if (std::abs(turn_of(stream, i) - middle) > 1) continue;
    out.reading_mm.push_back(stream.reading_mm[i]);
    out.c_rad.push_back(stream.c_rad[i]);
    if (stream.has_position()) out.position_mm.push_back(stream.position_mm[i]);
  }
  return out;
}

}  // namespace

std::vector<Quantity> form_quantities() {
  std::vector<Quantity> out;
  for (const char* circle : circles) out.push_back({std::string("RONt_") + circle, "mm"});
  return out;
}

TurnForm form_of_middle_turn(const ProbeStream& stream, const std::array<double, 2>& band_upr,
                             bool bore) {
  expects(stream.size() > 0, "readings");
  FormOptions options;
  options.low_upr = band_upr[0], options.high_upr = band_upr[1];
  options.bore = bore;
  options.trials = trials;
  options.each_turn_by_itself = true;
  options.threads = 1;
  const FormResult form = assess_form(middle_turns(stream), options);
  const SectionForm& section = form.sections[form.sections.size() / 2];
  TurnForm out{};
  for (std::size_t c = 0; c < circles.size(); ++c) {
    const auto value = std::ranges::find_if(section.values, [&](const FormValue& one) {
      return one.name == "RONt" && one.reference == circles[c];
    });
    expects(value != section.values.end(), "RONt about every circle");
    out.value_mm[c] = value->estimate.value;
    out.u_mm[c] = value->estimate.u;
  }
  return out;
}

TurnForm true_form_of_middle_turn(const virtual_lathe::Scenario& scenario,
                                  const std::array<double, 2>& band_upr) {
  virtual_lathe::Scenario dense = scenario;
  for (virtual_lathe::PlannedPass& pass : dense.plan.passes) {
    const double times = std::ceil(dense_per_wave * band_upr[1] / pass.readings_per_revolution);
    pass.readings_per_revolution *= std::max(1.0, times);
  }
  virtual_lathe::CleanStream clean = virtual_lathe::simulate_clean(dense);
  clean.stream.reading_mm = clean.value_mm;
  return form_of_middle_turn(clean.stream, band_upr, scenario.part.bore);
}

}  // namespace trueaxis::study
