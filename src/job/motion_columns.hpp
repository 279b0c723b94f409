// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "trueaxis/part_form.hpp"

namespace trueaxis {

/// What a finding is of, by its class: form of the part, motion of anything else, or either.
enum class FindingIsOf { part, motion, open };
FindingIsOf is_of(const Diagnosis& diagnosis, const Finding& finding);

/// A finding's term over the readings, as it was fitted.
struct MotionColumns {
  const Finding* finding = nullptr;
  FindingIsOf of = FindingIsOf::open;
  std::vector<double> sum_mm;                   ///< what it does to every reading
  std::vector<std::vector<double>> columns_mm;  ///< for one u of each linear parameter
  std::vector<double> correlation;              ///< of these, row-major
};

/// Terms of findings over all readings of a stream, about the surface that was found.
std::vector<MotionColumns> motion_columns(const DiagnosedStream& diagnosed,
                                          std::span<const Finding* const> findings, double ball_mm);

}  // namespace trueaxis
