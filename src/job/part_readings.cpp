// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "job/part_form_steps.hpp"

namespace trueaxis {
namespace {

template <typename T>
void keep(std::vector<T>& column, const std::vector<bool>& left_out) {
  if (column.size() != left_out.size()) return;
  std::size_t to = 0;
  for (std::size_t i = 0; i < column.size(); ++i)
    if (!left_out[i]) column[to++] = column[i];
  column.resize(to);
}

}  // namespace

PartReadings::PartReadings(const DiagnosedStream& given, double ball_mm, bool with_local_forms)
    : stream_(given.stream) {
  if (!given.diagnosis) return;
  std::vector<bool> left_out(stream_.size(), false);
  std::vector<const Finding*> found;
  for (const Finding& finding : given.diagnosis->findings)
    if (is_of(*given.diagnosis, finding) != FindingIsOf::part) found.push_back(&finding);
  columns_ = motion_columns(given, found, ball_mm);
  const std::vector<double> local_mm =
      with_local_forms ? std::vector<double>{} : local_forms_mm(given, ball_mm);
  for (std::size_t i = 0; i < local_mm.size(); ++i) stream_.reading_mm[i] -= local_mm[i];
  for (const Rejected& one : given.diagnosis->noise.masked)
    if (one.row >= 1 && one.row <= left_out.size()) left_out[one.row - 1] = true;
  left_out_ = static_cast<std::size_t>(std::ranges::count(left_out, true));
  if (left_out_ == 0) return;
  for (auto* column : {&stream_.reading_mm, &stream_.c_rad, &stream_.position_mm, &stream_.time_s})
    keep(*column, left_out);
  keep(stream_.pass, left_out);
  keep(stream_.setup, left_out);
  for (MotionColumns& one : columns_) {
    keep(one.sum_mm, left_out);
    for (std::vector<double>& column : one.columns_mm) keep(column, left_out);
  }
}

ProbeStream PartReadings::less(bool open) const {
  ProbeStream out = stream_;
  for (const MotionColumns& one : columns_)
    if (open || one.of == FindingIsOf::motion)
      for (std::size_t i = 0; i < out.size(); ++i) out.reading_mm[i] -= one.sum_mm[i];
  return out;
}

}  // namespace trueaxis
