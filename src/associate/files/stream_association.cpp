// SPDX-License-Identifier: Apache-2.0
#include "associate/files/stream_association.hpp"

#include <fmt/format.h>

#include "format/json.hpp"
#include "format/text_layout.hpp"
#include "measure/feature.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {

StreamAssociation associate_stream(const ProbeStream& stream, SurfaceKind surface,
                                   Criterion criterion, const StreamPointOptions& options) {
  expect_feature(stream, options.bore);
  StreamAssociation out{.surface = surface};
  out.stream = points_of_stream(stream, surface, options);
  out.of_centres = associate(out.stream.points_mm, element_of(surface), criterion);
  const AssociationStatus status = out.of_centres.status;
  if (status == AssociationStatus::too_few || status == AssociationStatus::degenerate)
    throw InputError(stream.source, out.of_centres.why);
  out.of_surface = out.of_centres;
  out.of_surface.feature = surface_below(out.of_centres, out.stream, options.bore);
  out.points = {.source = stream.source,
                .hash = stream.input_hash,
                .points_mm = out.stream.points_mm,
                .lines = {}};
  if (out.stream.ball_radius_mm > 0.0)
    out.points.source +=
        fmt::format(": centres of the ball of {} mm, through which the element goes",
                    out.stream.ball_radius_mm);
  for (std::size_t i = 0; i < stream.size(); ++i) out.points.lines.push_back(i + 1);
  return out;
}

std::string stream_association_json(const StreamAssociation& of) {
  Json json = Json::parse(association_json(of.of_surface, of.points));
  Json numbers = Json::object();
  for (const SurfaceNumber& number : surface_numbers(of.surface, of.of_surface.feature))
    numbers[number.name] = to_json(Estimate{
        .value = number.value,
        .u = std::numeric_limits<double>::quiet_NaN(),
        .unit = number.unit,
        .why_not = "point, direction and radius have the u of the criteria that have one"});
  json["surface"] = {{"id", to_string(of.surface)}, {"parameters", numbers}};
  json["ball_radius"] = with_unit(of.stream.ball_radius_mm, "mm");
  json["notes"] = of.stream.notes;
  return json_text(json);
}

std::string stream_association_text(const StreamAssociation& of) {
  std::string text = association_text(of.of_surface), row;
  for (const SurfaceNumber& number : surface_numbers(of.surface, of.of_surface.feature))
    row += fmt::format("{}{} {:.6f}{}{}", row.empty() ? "" : ", ", number.name, number.value,
                       number.unit[0] == '1' ? "" : " ", number.unit[0] == '1' ? "" : number.unit);
  text += layout::wrapped("  as of fit      ", row);
  for (const std::string& note : of.stream.notes)
    text += layout::wrapped("  note           ", note);
  return text;
}

}  // namespace trueaxis
