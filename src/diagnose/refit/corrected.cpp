// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "diagnose/refit/timing.hpp"
#include "diagnose/search/causes.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {

using namespace diagnose_detail;

namespace {

constexpr int times_about =
    6;  // about the surface again; each leaves the share of the axis that moved

/// Whether the probe line is off the axis, and meets the surface there.
bool moves_line(const Influence& influence, const ProbeStream& stream,
                const std::vector<Clamping>& clampings) {
  return influence.kind == Influence::Kind::probe_height && stream.kind == StreamKind::lateral &&
         every_line_meets(stream, clampings, {}, influence.value);
}

/// X of a probe at a height less that of one at the axis, h²/2R of the radius included.
std::vector<double> at_height_mm(const ProbeStream& stream, const std::vector<Clamping>& clampings,
                                 const LinearisationPoint& point, double height_mm) {
  std::vector<double> out =
      linearise_at(stream, clampings, point.base, point.bore, 1, {}, height_mm)
          .column(&PointPart::x);
  const std::vector<double> without = point.column(&PointPart::x);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] -= without[i];
  return out;
}

/// What the stated values do to X about a fitted surface, mm, one a reading.
std::vector<double> done_mm(const ProbeStream& stream, const FitOptions& options,
                            const FitResult& about) {
  const double ball_mm = std::max(stream.ball_radius_mm.value_or(0.0), options.ball_radius_mm);
  const std::vector<Clamping> clampings = clampings_of(about, ball_mm);
  const LinearisationPoint point =
      linearise_at(stream, clampings, base_of(stream, about, clampings), options.bore);
  std::vector<double> out(stream.size(), 0.0);
  for (const Influence& influence : options.influences) {
    const auto effect =
        std::ranges::find(effect_catalogue(), std::optional(influence.kind), &Effect::stated_as);
    if (influence.value == 0.0 || effect == effect_catalogue().end()) continue;
    const InfluenceInfo& info = info_of(influence.kind);
    if (effect->needs.time && !point.has_time)
      throw InputError(
          stream.source,
          fmt::format(
              "{} is stated, but the stream has no t: give a time for every reading, or remove it",
              info.stated));
    const Hypothesis term = of_effect(*effect, typical_shape(*effect, point));
    const std::vector<double> one = is_lag(term) || is_delay(term)
                                        ? timing_mm(term, influence.value, point)
                                    : moves_line(influence, stream, clampings)
                                        ? at_height_mm(stream, clampings, point, influence.value)
                                        : contribution(point, {&term, 1}, {&influence.value, 1});
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += one[i];
  }
  return out;
}

}  // namespace

ProbeStream corrected_by_known(ProbeStream stream, const FitOptions& options) {
  const bool any = std::ranges::any_of(
      options.influences, [](const Influence& influence) { return influence.value != 0.0; });
  if (!any) return stream;
  const std::vector<double> read_mm = stream.reading_mm;
  for (int round = 0; round < times_about; ++round) {
    const FitResult about = fit(stream, options);
    if (!is_diagnosable(about)) return stream;
    const std::vector<double> done = done_mm(stream, options, about);
    for (std::size_t i = 0; i < read_mm.size(); ++i) stream.reading_mm[i] = read_mm[i] - done[i];
  }
  for (const Influence& influence : options.influences)
    if (influence.value != 0.0)
      stream.read_as.push_back(fmt::format("TrueAxis corrects the readings by the stated {}",
                                           info_of(influence.kind).name));
  return stream;
}

}  // namespace trueaxis
