// SPDX-License-Identifier: Apache-2.0
#include "diagnose/files/seen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/never.hpp"
#include "diagnose/files/diagnosis_text.hpp"
#include "format/text_layout.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {

using namespace layout;

std::string short_title(const Effect& effect) {
  return std::string(effect.title.substr(0, effect.title.find(':')));
}

namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

/// The size that is reported first: an amplitude, else the first parameter that has a U.
const FitParameter* size_of(const Finding& finding) {
  const auto named = std::ranges::find(finding.parameters, "amplitude", &FitParameter::name);
  if (named != finding.parameters.end()) return &*named;
  const auto first = std::ranges::find_if(finding.parameters, [](const FitParameter& parameter) {
    return parameter.estimate.determined() && parameter.estimate.u > 0.0;
  });
  return first == finding.parameters.end() ? nullptr : &*first;
}

std::string size_text(const Finding& finding, double k) {
  const FitParameter* size = size_of(finding);
  // A size below its U says nothing of what was seen: another one carries it, such as where a
  // tilting motion seems to turn.
  if (size == nullptr || size->estimate.expanded(k) > std::abs(size->estimate.value))
    return um(finding.rms_mm) + " RMS";
  const Estimate e = at_edge(size->estimate);
  const bool small = e.unit == "mm" && std::abs(e.value) < 1.0;
  return plus_minus(e, k, small ? 1.0 / mm_per_um : 1.0, small ? "µm" : e.unit);
}

/// How far the middle of a part moved across the spindle axis, the length of (dx, dy); of a seat
/// that moves along it the size as of any cause.
std::string moved_text(const Finding& slip, double k) {
  const auto of = [&](const char* name) {
    return std::ranges::find(slip.parameters, name, &FitParameter::name);
  };
  const auto dx = of("dx"), dy = of("dy"), none = slip.parameters.end();
  if (dx == none || dy == none) return size_text(slip, k);
  Estimate moved = dx->estimate;
  moved.value = std::hypot(dx->estimate.value, dy->estimate.value);
  if (!(moved.value > 0.0)) return size_text(slip, k);
  moved.u = std::hypot(dx->estimate.value * dx->estimate.u, dy->estimate.value * dy->estimate.u) /
            moved.value;
  if (!(moved.expanded(k) < moved.value)) return um(slip.rms_mm) + " RMS";
  return plus_minus(moved, k, 1.0 / mm_per_um, "µm");
}

/// Whether what may grow along Z does, by more than its U.
bool grows(const Finding& finding, double k) {
  return std::ranges::any_of(finding.parameters, [&](const FitParameter& p) {
    return p.name == "growth" && std::abs(p.estimate.value) > p.estimate.expanded(k);
  });
}

std::string of_harmonic(const Harmonic& harmonic, const TermShape& shape, const std::string& size,
                        bool growing) {
  const double order = harmonic.fixed_order > 0.0 ? harmonic.fixed_order : shape.order;
  const bool whole = std::abs(order - std::round(order)) < 1e-6;
  const std::string count =
      order == 1.0 ? "one undulation" : fmt::format("{:.{}g} undulations", order, whole ? 6 : 4);
  std::string along;
  switch (harmonic.envelope) {
    case Harmonic::Envelope::constant:
      along = harmonic.port == TermPort::z ? "along Z with the slope of the surface"
                                           : "the same along Z";
      break;
    case Harmonic::Envelope::growing:
      along = growing ? "changing along Z" : "the same along Z";
      break;
    case Harmonic::Envelope::lever:
      along = "growing with the distance from a point of the axis";
      break;
    case Harmonic::Envelope::jaws:
      along = "fading away from the jaws";
      break;
    case Harmonic::Envelope::parabola:
      along = "bent along Z";
      break;
    case Harmonic::Envelope::square:
      along = "growing towards the rim";
      break;
  }
  return count + (whole ? " per revolution, " : " per revolution (not a whole number), ") + size +
         ", " + along;
}

/// When: of a stream without a clock by the reading.
std::string date_text(const Finding& slip) {
  const TermShape& shape = slip.term.shape;
  const double end_s = shape.onset_s + shape.duration_s;
  const auto onset = std::ranges::find(slip.parameters, "onset", &FitParameter::name);
  const bool by_reading = onset != slip.parameters.end() && onset->estimate.unit == "reading";
  if (shape.duration_s > 0.0)
    return by_reading
               ? fmt::format("from reading {:.0f} to {:.0f}", shape.onset_s + 1.0, end_s + 1.0)
               : fmt::format("from {:.4g} s to {:.4g} s after the start", shape.onset_s, end_s);
  return by_reading ? fmt::format("at reading {:.0f}", shape.onset_s + 1.0)
                    : fmt::format("{:.4g} s after the start", shape.onset_s);
}

}  // namespace

std::string seen_text(const Finding& finding, double k) {
  const TermShape& shape = finding.term.shape;
  const std::string size = size_text(finding, k);
  const std::string title = short_title(*finding.term.effect);
  return std::visit(
      Overloaded{
          [&](const Harmonic& harmonic) {
            return of_harmonic(harmonic, shape, size, grows(finding, k));
          },
          [&](const PeriodicInZ& periodic) {
            return periodic.turns == 0.0
                       ? "a wave along Z, " +
                             or_never(shape.period_mm, "mm",
                                      fmt::format("{:.4g} mm long, ", shape.period_mm),
                                      "longer than any part, ") +
                             size
                       : fmt::format("a spiral of {:.4g} mm per revolution, {}", shape.period_mm,
                                     size);
          },
          [&](const PeriodicInTime&) {
            return fmt::format("an oscillation of {:.4g} Hz, {}", shape.frequency_hz, size);
          },
          [&](const GrowthInTime&) { return "a drift with time, " + size; },
          [&](const PartStep&) {
            return "the part moved " + date_text(finding) + ", " + moved_text(finding, k);
          },
          [&](const PolynomialInZ&) { return "a curve along Z, the same all around, " + size; },
          [&](const auto&) { return title + ", " + size; }},
      finding.term.effect->term);
}

std::string seen_text(const Unexplained& pattern, double k) {
  return harmonic_text(pattern.term.pattern) + ", " + dependence_text(pattern.term.pattern) + ", " +
         plus_minus(pattern.amplitude, k, 1.0 / mm_per_um, "µm") + ": of no known cause";
}

std::vector<std::string> cause_lines(const Diagnosis& diagnosis, const Finding& finding,
                                     std::size_t most) {
  std::vector<std::string> lines;
  const auto add = [&](const std::string& id, double p) {
    const Effect* effect = diagnosis.entry(id);
    std::string line = effect ? short_title(*effect) : id;
    if (std::isfinite(p) && !finding.rivals.empty()) line += " (" + percent_of(p) + ")";
    if (effect && !effect->consequence.empty()) line += ": " + std::string(effect->consequence);
    lines.push_back(line + " [" + id + "]");
  };
  std::vector<std::pair<double, std::string>> causes{{finding.probability, finding.effect()}};
  for (const Rival& rival : finding.rivals) causes.emplace_back(rival.probability, rival.effect);
  std::ranges::stable_sort(causes, std::ranges::greater{}, &std::pair<double, std::string>::first);
  for (const auto& [probability, id] : causes) {
    if (lines.size() == most) {
      lines.push_back(fmt::format("or {} more, less likely", causes.size() - most));
      break;
    }
    add(id, probability);
  }
  return lines;
}

}  // namespace trueaxis
