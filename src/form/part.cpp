// SPDX-License-Identifier: Apache-2.0
#include "form/part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "form/notes.hpp"
#include "form/sampling.hpp"
#include "measure/centre_of_ball.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::form {
namespace {

constexpr std::size_t listed = 3;  // sections with the same trouble

/// One noise for all sections: a section of few readings shows its own badly. Eq. 270.
void share_noise(std::vector<SectionModel>& models, const FormOptions& options) {
  double squares = 0.0, count = 0.0;
  for (const SectionModel& one : models) {
    const auto readings = static_cast<double>(one.readings());
    const double shown_mm = one.shown_noise_of_reading_mm();
    squares += readings * shown_mm * shown_mm;
    count += readings;
  }
  const double shown_mm = count > 0.0 ? std::sqrt(squares / count) : 0.0;
  for (SectionModel& one : models)
    one.set_noise_of_reading(std::max(shown_mm, options.noise_mm.value_or(0.0)));
}

/// @param together what the readings carry as one surface
std::vector<SectionModel> models_of(const Sections& sections, const FormOptions& options,
                                    const std::string& source, int together) {
  std::vector<SectionModel> models;
  std::vector<Diagnostic> wrong;
  for (const SectionReadings& one : sections.list) {
    models.emplace_back(one, sections.radius_known, options);
    if (models.back().trouble().empty()) continue;
    const std::string where = one.z_mm ? fmt::format("section at Z = {:.6g} mm: ", *one.z_mm) : "";
    wrong.push_back({source, 0, 0, where + models.back().trouble()});
  }
  if (wrong.size() > listed) {
    const std::size_t more = wrong.size() - listed;
    wrong.resize(listed);
    int carried = 500;
    for (const SectionModel& one : models) carried = std::min(carried, highest_order(one.raw()));
    wrong.push_back({source, 0, 0,
                     fmt::format("{} more sections likewise; all of them support up to {} UPR",
                                 more, carried)});
  }
  if (!wrong.empty() && together >= 2)
    wrong = {{source, 0, 0,
              fmt::format("{:g} UPR needs more angles than the readings have, 7 per wave: as one "
                          "surface they support up to {} UPR (--upr 1-{})",
                          options.high_upr, together, together)}};
  if (!wrong.empty()) throw InputError(std::move(wrong));
  share_noise(models, options);
  return models;
}

Part part_within_ball(const ProbeStream& stream, const FormOptions& options) {
  Part out;
  const int carried =
      options.filter == ProfileFilter::none ? 0 : upr_of_surface(stream, options).by_steps;
  if (carried < options.high_upr) {
    out.sections = sections_of(stream, options);
    out.model.sections = models_of(out.sections, options, stream.source, carried);
    return out;
  }
  const SurfaceReadings readings = surface_readings(stream, options);
  out.sections.radius_known = readings.radius_known;
  out.sections.notes.push_back(note_of_surface(readings));
  out.model.surface.emplace(readings, options);
  out.model.sections = out.model.surface->sections();
  return out;
}

}  // namespace

Part part_of(const ProbeStream& stream, const FormOptions& options) {
  Part out = part_within_ball(stream, options);
  for (const SectionModel& one : out.model.sections)
    if (one.radius_known() && !(one.surface_radius_mm() > 0.0))
      throw InputError(stream.source, fmt::format("no part has a radius of {:.6g} mm: {}",
                                                  one.surface_radius_mm(), mend_ball_radius));
  return out;
}

}  // namespace trueaxis::form
