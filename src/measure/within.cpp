// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "measure/kept_readings.hpp"
#include "measure/seats.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {

ProbeStream within(const ProbeStream& stream, const ZRange& range) {
  if (stream.kind == StreamKind::face)
    throw InputError(stream.source, "is of a face, which has no range of Z: leave it out");
  std::vector<bool> kept(stream.size());
  std::size_t inside = 0, first = 0;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    kept[i] = stream.has_position() && range.holds(stream.position_mm[i]);
    if (kept[i] && inside++ == 0) first = i;
  }
  const auto end = [](double z_mm) { return fmt::format("{:.10g}", z_mm); };
  const std::string text = !std::isfinite(range.from_mm) ? "up to " + end(range.to_mm) + " mm"
                           : !std::isfinite(range.to_mm)
                               ? "from " + end(range.from_mm) + " mm"
                               : end(range.from_mm) + " to " + end(range.to_mm) + " mm";
  if (inside == 0) {
    std::string has = "the stream has no Z";
    if (stream.has_position() && stream.size() > 0) {
      const auto [low, high] = std::ranges::minmax(stream.position_mm);
      has = fmt::format("they reach from Z {:.6g} to {:.6g} mm", low, high);
    }
    throw InputError(stream.source, "has no reading at Z " + text + ": " + has);
  }
  ProbeStream out = stream;
  if (inside == stream.size()) return out;
  keep_readings(out, kept);
  out.read_as.push_back(
      fmt::format("Z {}: the other {} of {} readings are excluded; row 1 of the results is row {} "
                  "of the stream",
                  text, stream.size() - inside, stream.size(), first + 1));
  return out;
}

}  // namespace trueaxis
