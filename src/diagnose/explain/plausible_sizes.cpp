// SPDX-License-Identifier: Apache-2.0
#include "diagnose/explain/plausible_sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

// The crudest measured tube has ten times the largest ovality of the catalogue.
constexpr double beyond_usual = 20.0;

/// The largest typical amplitude, mm; 0: its size is not a length.
double largest_usual_mm(const Effect& effect) {
  double largest = 0.0;
  for (const LinearParameter& one : linear_parameters(effect.term, {})) {
    const EffectParameter* size = size_for(effect, one);
    if (size == nullptr || size->unit != "mm") return 0.0;
    largest = std::max(largest, size->high);
  }
  return largest;
}

/// The largest of a class; 0: one of it may have any size.
double largest_of_class_mm(const Diagnosis& diagnosis, const Finding& finding) {
  double largest = 0.0;
  for (const std::string& id : finding.members()) {
    const Effect* effect = diagnosis.entry(id);
    const double own = effect && !is_step(effect->term) ? largest_usual_mm(*effect) : 0.0;
    if (!(own > 0.0)) return 0.0;
    largest = std::max(largest, own);
  }
  return largest;
}

}  // namespace

std::string implausible_size(const Diagnosis& diagnosis) {
  for (const Finding& finding : diagnosis.findings) {
    const double amplitude_mm = std::numbers::sqrt2 * finding.rms_mm;
    const double most_mm = largest_of_class_mm(diagnosis, finding);
    if (!(most_mm > 0.0) || amplitude_mm <= beyond_usual * most_mm) continue;
    return fmt::format(
        "the readings contain a regular pattern of {:.3g} µm. Only {} ({}) could cause it, which "
        "is at most {:.3g} µm: X_M is probably not the reading of a probe on this part. Check the "
        "recording",
        amplitude_mm / mm_per_um, finding.term.effect->title, finding.effect(),
        most_mm / mm_per_um);
  }
  return "";
}

}  // namespace trueaxis::diagnose_detail
