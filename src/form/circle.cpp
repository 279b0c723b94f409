// SPDX-License-Identifier: Apache-2.0
#include "form/circle.hpp"

#include <cmath>
#include <utility>

#include "trueaxis/error.hpp"

namespace trueaxis::form {
namespace {

AssociatedCircle limacon(std::span<const double> angle_rad, std::span<const double> deviation_mm,
                         double radius_mm, Criterion criterion, std::span<const double> shares) {
  Exchange exchange(limacon_rows(angle_rad), criterion, shares);
  const Nearest nearest = exchange(deviation_mm);
  return circle_near(exchange.off(deviation_mm, nearest), nearest, radius_mm);
}

}  // namespace

AssociatedCircle circle_near(std::vector<double> off_mm, const Nearest& nearest, double radius_mm) {
  return {
      nearest.q[1],      nearest.q[2],    radius_mm + nearest.q[0],
      std::move(off_mm), nearest.touches, nearest.determined ? "" : "the readings do not hold it"};
}

std::span<const Criterion> criteria_of(bool all_references) {
  return std::span<const Criterion>(form_criteria).first(all_references ? form_criteria.size() : 2);
}

Exchange::Rows limacon_rows(std::span<const double> angle_rad) {
  Exchange::Rows rows(static_cast<Eigen::Index>(angle_rad.size()), 3);
  for (std::size_t i = 0; i < angle_rad.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) << 1.0, std::cos(angle_rad[i]), std::sin(angle_rad[i]);
  return rows;
}

AssociatedCircle associate_circle(std::span<const double> angle_rad,
                                  std::span<const double> deviation_mm, double radius_mm,
                                  Criterion criterion, std::span<const double> shares) {
  expects(deviation_mm.size() == angle_rad.size(), "a deviation for every angle");
  if (radius_mm == 0.0 || (criterion == Criterion::gaussian && !shares.empty()))
    return limacon(angle_rad, deviation_mm, radius_mm, criterion, shares);
  std::vector<Point3> points;
  for (std::size_t i = 0; i < angle_rad.size(); ++i) {
    const double r = radius_mm + deviation_mm[i];
    points.push_back({r * std::cos(angle_rad[i]), r * std::sin(angle_rad[i]), 0.0});
  }
  const AssociatedFeature found = associate(points, Element::circle, criterion);
  AssociatedCircle circle;
  circle.why = found.status == AssociationStatus::converged ? "" : found.why;
  circle.x_mm = found.feature.point_mm[0];
  circle.y_mm = found.feature.point_mm[1];
  circle.radius_mm = found.feature.radius_mm;
  circle.off_mm = distances_mm(points, found);
  for (const auto& contact : found.certificate.contacts)
    circle.touches.push_back({contact.point, contact.sign, contact.multiplier});
  return circle;
}

}  // namespace trueaxis::form
