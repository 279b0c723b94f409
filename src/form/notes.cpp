// SPDX-License-Identifier: Apache-2.0
#include "form/notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "form/axis_line.hpp"
#include "form/sampling.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::form {
namespace {

constexpr double share_worth_a_note = 0.1;  // of a RONt
constexpr double shown_mm = 1e-5;           // digit of a screen

void note_radius(const ProbeStream& stream, const Sections& sections, FormResult& result) {
  if (!sections.radius_known) {
    const double e = result.sections.front().values.front().estimate.value;
    result.notes.push_back(fmt::format(
        "The radius of the section is not known (a relative gauge without nominal_radius): the "
        "reference circles are limaçons. An eccentric circle of radius R adds {:.3g} µm / (R in "
        "mm) of two lobes: centre the part or give --nominal-radius-mm",
        0.25 * e * e / mm_per_um));
    if (result.sections.size() > 1)
      result.notes.emplace_back("Cylindricity and run-out of several sections need the radius");
  } else if (stream.x_convention && stream.x_convention->said_by == SaidBy::nobody) {
    result.notes.emplace_back("TrueAxis assumes that X_M is a radius: give --radius or --diameter");
  }
}

void note_sampling(FormResult& result) {
  const FormOptions& options = result.options;
  double gaps = 0.0, worst = 0.5;
  for (const SectionForm& section : result.sections) {
    gaps = std::max(gaps, section.gaps_rad);
    if (std::abs(section.transmission - 0.5) > std::abs(worst - 0.5)) worst = section.transmission;
  }
  if (gaps > 0.0)
    result.notes.push_back(
        fmt::format("{:.1f}° of a section have no readings over more than half a wave of the "
                    "cut-off: TrueAxis does not fill the gap, and no value includes form there",
                    gaps / rad_per_deg));
  if (options.filter != ProfileFilter::none && std::abs(worst - 0.5) > 0.01)
    result.notes.push_back(fmt::format(
        "{}: it lets {:.1f} % of a wave at the cut-off through here, not 50 %",
        options.filter == ProfileFilter::robust_gaussian
            ? "The robust filter excludes readings, and too few remain or they are uneven"
            : "The angles of the readings are uneven or too few for the filter",
        100.0 * worst));
  if (options.filter == ProfileFilter::none)
    result.notes.emplace_back(
        "No filter: the values are those of the unfiltered readings and cannot be compared with "
        "others");
}

void note_ball(FormResult& result) {
  const FormOptions& options = result.options;
  if (!(options.ball_radius_mm > 0.0)) {
    result.notes.emplace_back(
        "The ball's radius is not known (--ball-radius-mm): U does not include what it bridges");
    return;
  }
  const SectionForm& section = result.sections.front();
  const double radius_mm = section.circles.front().radius_mm;
  for (const FormHarmonic& one : section.harmonics) {
    if (one.order < 2 || one.order > options.high_upr) continue;
    const double followed =
        followed_amplitude_mm(one.order, radius_mm, options.ball_radius_mm, options.bore);
    if (one.amplitude_mm < 0.5 * followed) continue;
    result.notes.push_back(fmt::format(
        "The ball of radius {:g} mm reaches the bottom of {} lobes only up to an amplitude of "
        "{:.3g} µm, and {:.3g} µm were found: valleys are deeper than measured",
        options.ball_radius_mm, one.order, followed / mm_per_um, one.amplitude_mm / mm_per_um));
    return;
  }
}

/// A section across the spindle of a cylinder that leans by t is an ellipse: R t²/2 is its range.
void note_lean(FormResult& result) {
  std::vector<CentrePoint> centres;
  double radius_mm = 0.0, largest_mm = 0.0;
  for (const SectionForm& section : result.sections) {
    if (!section.z_mm || section.circles.empty()) return;
    const FormCircle& circle = section.circles.front();
    centres.push_back({circle.x_mm, circle.y_mm, *section.z_mm});
    radius_mm = std::max(radius_mm, circle.radius_mm);
    for (const FormValue& one : section.values)
      if (one.name == "RONt")
        largest_mm = std::max(
            largest_mm, one.estimate.interval ? one.estimate.interval->back() : one.estimate.value);
  }
  if (centres.size() < 2) return;
  const AxisLine axis = least_squares_line(centres);
  const double lean = std::hypot(axis.l, axis.m), range_mm = 0.5 * radius_mm * lean * lean;
  if (range_mm > std::max(share_worth_a_note * largest_mm, shown_mm))
    result.notes.push_back(fmt::format(
        "The part leans by {:.3g} mrad, and its sections lie across the spindle: this alone makes "
        "a RONt of {:.2g} µm. CYLt is without it",
        1e3 * lean, range_mm / mm_per_um));
}

/// Of a surface the value has no such bias.
void note_noise(FormResult& result) {
  if (result.surface) return;
  double share = 0.0, bias = 0.0, value = 0.0;
  for (const SectionForm& section : result.sections)
    for (const FormValue& one : section.values)
      if (one.name == "RONt" && one.estimate.value > 0.0 &&
          one.bias_mm / one.estimate.value > share) {
        share = one.bias_mm / one.estimate.value;
        bias = one.bias_mm;
        value = one.estimate.value;
      }
  if (share > share_worth_a_note)
    result.notes.push_back(
        fmt::format("Noise alone makes a RONt of {:.3g} µm larger by {:.3g} µm on average: this is "
                    "included in U and not subtracted",
                    value / mm_per_um, bias / mm_per_um));
}

}  // namespace

void expect_options(const FormOptions& options) {
  std::vector<Diagnostic> wrong;
  const auto add = [&](std::string message) { wrong.push_back({"options", 0, 0, message}); };
  if (!(options.high_upr >= 2.0 && options.high_upr <= 1500.0))
    add(fmt::format("a cut-off of {:g} UPR: give 2 to 1500", options.high_upr));
  if (!(options.low_upr >= 1.0 && options.low_upr < options.high_upr))
    add(fmt::format("a pass band of {:g} to {:g} UPR: begin at 1 or above and end higher",
                    options.low_upr, options.high_upr));
  if (options.trials < 10) add("a Monte Carlo takes 10 trials at least");
  if (!(options.coverage_factor > 0.0)) add("the coverage factor is above 0");
  if (!wrong.empty()) throw InputError(std::move(wrong));
}

std::string note_of_surface(const SurfaceReadings& readings) {
  return fmt::format(
      "The form is estimated as one surface from all {} readings ({:.4g} revolutions or sections). "
      "Values are read from it at stations along Z. Form that changes within {} cannot be seen",
      readings.size(), readings.turns,
      readings.turns < 10.0 ? "a revolution along Z" : "a tenth of the length");
}

void add_notes(const ProbeStream& stream, const Sections& sections, FormResult& result) {
  result.notes.insert(result.notes.end(), stream.read_as.begin(), stream.read_as.end());
  result.notes.insert(result.notes.end(), sections.notes.begin(), sections.notes.end());
  note_radius(stream, sections, result);
  note_sampling(result);
  note_ball(result);
  note_noise(result);
  note_lean(result);
  for (const SectionForm& section : result.sections)
    for (const FormCircle& circle : section.circles)
      if (!circle.why_not.empty()) {
        result.notes.push_back(
            fmt::format("No {} circle: {}", name_of(circle.criterion), circle.why_not));
        return;
      }
}

}  // namespace trueaxis::form
