// SPDX-License-Identifier: Apache-2.0
#include "measure/kept_readings.hpp"

#include <fmt/format.h>

#include "base/counted.hpp"
#include "measure/column_checks.hpp"

namespace trueaxis {
namespace {

template <typename T>
void keep(std::vector<T>& column, const std::vector<bool>& kept) {
  if (column.size() != kept.size()) return;
  std::size_t to = 0;
  for (std::size_t i = 0; i < column.size(); ++i)
    if (kept[i]) column[to++] = column[i];
  column.resize(to);
}

}  // namespace

void keep_readings(ProbeStream& stream, const std::vector<bool>& kept) {
  for (auto* column : {&stream.reading_mm, &stream.c_rad, &stream.position_mm, &stream.time_s})
    keep(*column, kept);
  keep(stream.pass, kept);
  keep(stream.setup, kept);
  for (auto& column : stream.more_reading_mm) keep(column, kept);
}

void leave_out_limits(ProbeStream& stream) {
  for (LimitsMet met; stream.size() > 0 && (met = limits_met(stream)).saturates;) {
    const double limit_mm = met.at_high >= met.at_low ? met.high_mm : met.low_mm;
    std::vector<bool> kept(stream.size());
    for (std::size_t i = 0; i < stream.size(); ++i) kept[i] = stream.reading_mm[i] != limit_mm;
    keep_readings(stream, kept);
    stream.read_as.push_back(
        fmt::format("{} at {:.9g} mm, the end of the sensor's range, {} excluded (--drop-invalid)",
                    counted(std::max(met.at_high, met.at_low), "reading"), limit_mm,
                    std::max(met.at_high, met.at_low) == 1 ? "is" : "are"));
  }
}

}  // namespace trueaxis
