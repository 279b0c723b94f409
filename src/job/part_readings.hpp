// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "job/motion_columns.hpp"

namespace trueaxis {

/// The readings of a stream that count, and what its findings do to these that are not, or may not
/// be, of the part.
class PartReadings {
 public:
  PartReadings(const DiagnosedStream& given, double ball_mm);

  const ProbeStream& stream() const { return stream_; }
  const std::vector<MotionColumns>& columns() const { return columns_; }
  std::size_t left_out() const { return left_out_; }

  /// Without the findings that are not of the part, and without those that may be either (Eq. 290).
  ProbeStream less(bool open) const;

 private:
  ProbeStream stream_;
  std::vector<MotionColumns> columns_;
  std::size_t left_out_ = 0;
};

}  // namespace trueaxis
