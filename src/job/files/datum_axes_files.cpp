// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "base/number.hpp"
#include "format/text_layout.hpp"
#include "job/files/job_results.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr const char* why_no_u =
    "an association by few readings includes their noise; the axis of the job has the u";

Json end_object(const DatumAxis& one, double z_mm, double off_mm) {
  const auto [x, y] = one.axis.at(z_mm);
  return {{"z", with_unit(z_mm, "mm")},
          {"x", with_unit(x, "mm")},
          {"y", with_unit(y, "mm")},
          {"off", with_unit(off_mm, "mm")}};
}

}  // namespace

Json datum_axes_array(const std::vector<DatumAxis>& axes, const FitResult& used) {
  return list_of(axes, [&](const DatumAxis& one) {
    Json json{{"association", name_of(one.criterion)}, {"of_iso_5459", one.of_iso_5459}};
    if (!one.why.empty()) {
      json["why"] = one.why;
    } else {
      json["ends"] = {end_object(one, used.position_min_mm, one.off_mm[0]),
                      end_object(one, used.position_max_mm, one.off_mm[1])};
      json["u"] = nullptr;
      json["why_no_u"] = why_no_u;
    }
    return json;
  });
}

std::string datum_axes_text(const std::vector<DatumAxis>& axes, const FitResult& used) {
  std::string text;
  for (const DatumAxis& one : axes) {
    const std::string name = name_of(one.criterion);
    const std::string of = one.of_iso_5459 ? " (ISO 5459:2011)" : "";
    constexpr double nothing_mm = 1e-6;
    const bool of_job = one.why.empty() && std::ranges::max(one.off_mm) < nothing_mm;
    text += layout::wrapped(
        "datum       ",
        of_job ? fmt::format("{}{}: the axis of this job", name, of)
        : one.why.empty()
            ? fmt::format("{}{}: its axis would be {} off at Z {:.6g} mm and {} at Z {:.6g} mm",
                          name, of, layout::um(one.off_mm[0]), hundredths(used.position_min_mm),
                          layout::um(one.off_mm[1]), hundredths(used.position_max_mm))
            : fmt::format("{}{}: {}", name, of, one.why));
  }
  return text;
}

}  // namespace trueaxis
