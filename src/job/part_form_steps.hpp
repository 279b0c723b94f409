// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "trueaxis/job.hpp"
#include "trueaxis/part_form.hpp"

namespace trueaxis {

/// What a cause belongs to, by its class: form of the part, motion of anything else, or either.
enum class FindingIsOf { part, motion, open };
FindingIsOf is_of(const Diagnosis& diagnosis, const Finding& finding);

/// A cause's term over the readings, as it was fitted.
struct MotionColumns {
  const Finding* finding = nullptr;
  FindingIsOf of = FindingIsOf::open;
  std::vector<double> sum_mm;                   ///< what it does to every reading
  std::vector<std::vector<double>> columns_mm;  ///< for one u of each linear parameter
  std::vector<double> correlation;              ///< of these, row-major
};

/// Terms of causes over all readings of a stream, about the surface that was found.
std::vector<MotionColumns> motion_columns(const DiagnosedStream& diagnosed,
                                          std::span<const Finding* const> findings, double ball_mm);

/// Whether a pattern is a bump or a dent of no known cause. One of all the length is lobes to a
/// surface.
inline bool is_local_form(const Unexplained& one) {
  const Pattern& pattern = one.term.pattern;
  return !one.term.effect && pattern.kind == Pattern::Kind::bump && pattern.length_mm > 0.0;
}
/// What these do to every reading; empty: there are none.
std::vector<double> local_forms_mm(const DiagnosedStream& diagnosed, double ball_mm);

/// The readings of a stream that count, and what causes do to them that are not, or may not be, of
/// the part.
class PartReadings {
 public:
  /// @param with_local_forms else they are subtracted
  PartReadings(const DiagnosedStream& given, double ball_mm, bool with_local_forms);

  const ProbeStream& stream() const { return stream_; }
  const std::vector<MotionColumns>& columns() const { return columns_; }
  std::size_t left_out() const { return left_out_; }

  /// Without the causes that are not of the part, and without those that may be either (Eq. 290).
  ProbeStream less(bool open) const;

 private:
  ProbeStream stream_;
  std::vector<MotionColumns> columns_;
  std::size_t left_out_ = 0;
};

/// Holds every tolerance of the task against the form of the part: met where the larger value + U
/// is no more, not met where the smaller value − U is more, else not proven (ISO 14253-1; Eq. 292).
/// The two differ where the readings leave open what is of the part.
void judge(const FormTask& task, PartForm& form);

/// The verdict is of the cut: a tolerance of form that is not proven met is a reservation of it.
Reasons form_reservations(std::span<const PartForm> forms);

}  // namespace trueaxis
