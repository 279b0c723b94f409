// SPDX-License-Identifier: Apache-2.0
#include "form/circle.hpp"

#include <cmath>

#include "trueaxis/error.hpp"

namespace trueaxis::form {
namespace {

constexpr int most_recentrings = 30;
constexpr double centre_settled_mm = 1e-13;  // a move of the centre, over the radius in mm

}  // namespace

Criterion criterion_of(ReferenceFeature feature) {
  switch (feature) {
    case ReferenceFeature::least_squares:
      return Criterion::least_squares;
    case ReferenceFeature::minimum_zone:
      return Criterion::minimum_zone;
    case ReferenceFeature::minimum_circumscribed:
      return Criterion::minimum_circumscribed;
    case ReferenceFeature::maximum_inscribed:
      return Criterion::maximum_inscribed;
  }
  return Criterion::least_squares;
}

Exchange::Rows limacon_rows(std::span<const double> angle_rad) {
  Exchange::Rows rows(static_cast<Eigen::Index>(angle_rad.size()), 3);
  for (std::size_t i = 0; i < angle_rad.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) << 1.0, std::cos(angle_rad[i]), std::sin(angle_rad[i]);
  return rows;
}

AssociatedCircle associate_circle(std::span<const double> angle_rad,
                                  std::span<const double> deviation_mm, double radius_mm,
                                  ReferenceFeature feature) {
  const std::size_t n = angle_rad.size();
  expects(deviation_mm.size() == n && n > 3, "more points than a circle has parameters");
  Exchange::Rows rows = limacon_rows(angle_rad);
  std::vector<double> y(deviation_mm.begin(), deviation_mm.end());
  const Eigen::Matrix<double, Eigen::Dynamic, 2> towards = rows.rightCols<2>();
  AssociatedCircle circle;
  for (int round = 0; round < most_recentrings; ++round) {
    const Nearest nearest = Exchange(rows, criterion_of(feature))(y);
    const double dx = nearest.q[1], dy = nearest.q[2];
    circle.x_mm += dx;
    circle.y_mm += dy;
    circle.radius_mm = radius_mm + nearest.q[0];
    circle.touches = nearest.touches;
    circle.determined = nearest.determined;
    circle.off_mm.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      if (radius_mm == 0.0) {
        circle.off_mm[i] = y[i] - rows.row(row).dot(nearest.q);
        continue;
      }
      const double px = (radius_mm + deviation_mm[i]) * towards(row, 0) - circle.x_mm;
      const double py = (radius_mm + deviation_mm[i]) * towards(row, 1) - circle.y_mm;
      const double distance = std::hypot(px, py);
      rows.row(row) << 1.0, px / distance, py / distance;
      y[i] = distance - radius_mm;
      circle.off_mm[i] = y[i] - nearest.q[0];
    }
    if (radius_mm == 0.0 || !circle.determined ||
        std::hypot(dx, dy) <= centre_settled_mm * (1.0 + radius_mm))
      break;
  }
  return circle;
}

}  // namespace trueaxis::form
