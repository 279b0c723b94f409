// SPDX-License-Identifier: Apache-2.0
#include "job/datum_axes.hpp"

#include <cmath>

#include "job/part_form_steps.hpp"
#include "job/references.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t too_many_points = 200'000;

bool has_table(const PlannedJob& result, std::size_t i) {
  const ProbeStream& stream = result.streams[i];
  const SurfaceKind surface = result.fits[i].surface;
  return (surface == SurfaceKind::cylinder || surface == SurfaceKind::cone) &&
         fit_used(result, i).status == FitStatus::converged &&
         stream.indication == Indication::absolute && list_set_ups(stream).size() == 1 &&
         stream.size() <= too_many_points;
}

}  // namespace

std::vector<Point3> datum_points(const PlannedJob& result, std::size_t reference) {
  const bool diagnosed = reference < result.diagnoses.size() && result.diagnoses[reference];
  const FitOptions& fit = result.job.references[reference].fit;
  const ProbeStream& stream = result.streams[reference];
  const double ball_mm =
      fit.ball_radius_mm > 0.0 ? fit.ball_radius_mm : stream.ball_radius_mm.value_or(0.0);
  const PartReadings readings({stream, diagnosed ? &*result.diagnoses[reference] : nullptr},
                              ball_mm, true);
  const ProbeStream of_part = readings.less(false);
  std::vector<Point3> points;
  for (std::size_t i = 0; i < of_part.size(); ++i)
    points.push_back({of_part.reading_mm[i] * std::cos(of_part.c_rad[i]),
                      of_part.reading_mm[i] * std::sin(of_part.c_rad[i]), of_part.position_mm[i]});
  return points;
}

DatumAxis datum_axis(std::span<const Point3> points, Element element, Criterion criterion,
                     bool bore) {
  DatumAxis out;
  out.criterion = criterion;
  out.why = association_objection(element, criterion);
  if (!out.why.empty()) return out;
  AssociateOptions options;
  options.material = bore ? Material::outside : Material::inside;
  const AssociatedFeature found = associate(points, element, criterion, options);
  const Point3& along = found.feature.direction;
  if (found.status != AssociationStatus::converged || !(std::abs(along[2]) > 0.0)) {
    out.why = found.why.empty() ? "the readings give none" : found.why;
    return out;
  }
  out.axis = {found.feature.point_mm[0], found.feature.point_mm[1], along[0] / along[2],
              along[1] / along[2], found.feature.point_mm[2]};
  out.radius_mm = element == Element::cylinder ? found.feature.radius_mm : 0.0;
  return out;
}

std::vector<DatumAxis> datum_axes(const PlannedJob& result, std::size_t reference) {
  std::vector<DatumAxis> out;
  if (!has_table(result, reference)) return out;
  const FitResult& used = fit_used(result, reference);
  const std::vector<Point3> points = datum_points(result, reference);
  const Element element = used.surface == SurfaceKind::cone ? Element::cone : Element::cylinder;
  const Axis of_job = axis_of_reference(result, reference).axis;
  const Criterion of_iso =
      used.bore ? Criterion::maximum_inscribed : Criterion::minimum_circumscribed;
  for (std::size_t c = 0; c < criterion_names.size(); ++c) {
    const auto criterion = static_cast<Criterion>(c);
    if (!association_objection(element, criterion).empty()) continue;
    if (element == Element::cylinder &&
        criterion == (used.bore ? Criterion::minimum_circumscribed : Criterion::maximum_inscribed))
      continue;  // of the other side's datum
    DatumAxis one = datum_axis(points, element, criterion, used.bore);
    one.of_iso_5459 = element == Element::cylinder && criterion == of_iso;
    const double ends[] = {used.position_min_mm, used.position_max_mm};
    for (std::size_t e = 0; e < 2 && one.why.empty(); ++e) {
      const auto [x, y] = of_job.at(ends[e]);
      const auto [x_other, y_other] = one.axis.at(ends[e]);
      one.off_mm[e] = std::hypot(x_other - x, y_other - y);
    }
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace trueaxis
