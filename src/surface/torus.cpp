// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <cmath>

#include "math/linear_algebra.hpp"
#include "surface/own_surface.hpp"
#include "surface/revolved_surface.hpp"

namespace trueaxis {
namespace {

/// r(h) = R + sign(ρ) √(ρ² − (h − z)²): the tube of radius |ρ| about a circle of radius R; ρ < 0
/// is its side towards the axis, a groove of a shaft (Eq. 302).
class Tube final : public RevolvedProfile {
 public:
  std::vector<Parameter> parameters() const override {
    return {{.name = "z", .unit = "mm"},
            {.name = "radius", .unit = "mm"},
            {.name = "minor_radius", .unit = "mm"}};
  }
  Radius radius(double height_mm, std::span<const double> p) const override {
    const double h = height_mm - p[0], side = p[2] < 0.0 ? -1.0 : 1.0;
    const double root = std::sqrt(p[2] * p[2] - h * h);
    return {.mm = p[1] + side * root,
            .per_height = -side * h / root,
            .per_parameter = {side * h / root, 1.0, side * p[2] / root}};
  }
};

/// A groove or a bead of circular section. The probe's ball runs on the tube of its parallel
/// surface.
class Torus final : public ProfileSurface {
 public:
  explicit Torus(const SurfaceFrame& frame)
      : ProfileSurface(std::make_shared<const Tube>(),
                       std::make_shared<const Parameters>(Tube().parameters()), frame) {}

  /// Over about one turn a tilt and another tube read alike, and there are several minima: tubes of
  /// other radii through the same middle of the section, by a factor from half to double.
  std::vector<std::vector<double>> further_starts(const std::vector<double>& level) const override {
    std::vector<std::vector<double>> out;
    for (const double factor : {0.5, 0.7, 1.4, 2.0}) {
      out.push_back(level);
      double &radius = out.back()[level.size() - 2], &tube = out.back().back();
      radius += (1.0 - factor) * tube;
      tube *= factor;
    }
    return out;
  }

  Reported report(std::span<const double> working) const override {
    Reported all = ProfileSurface::report(working);
    const std::size_t last = working.size() - 1;
    const double side = working[last] < 0.0 ? -1.0 : 1.0;
    all.value[last] = side * (working[last] - frame().ball_mm);
    all.jacobian[last * working.size() + last] = side;
    return all;
  }

 protected:
  /// The circle through height and distance from the axis: h² + r² = 2hz + 2rR + (ρ² − z² − R²).
  std::vector<double> profile_start(const Axis& axis, const ReadingBlock& readings,
                                    std::size_t count) const override {
    const auto n = static_cast<Eigen::Index>(count);
    Eigen::MatrixXd rows(n, 3);
    Eigen::VectorXd square(n);
    double mean = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double h = readings.position_mm[i] - frame().position_ref_mm;
      const auto [x, y] = axis.at(readings.position_mm[i]);
      const double r = std::hypot(readings.reading_mm[i] * readings.cos_c[i] - x,
                                  readings.reading_mm[i] * readings.sin_c[i] - y);
      rows.row(i) << 2.0 * h, 2.0 * r, 1.0;
      square(i) = h * h + r * r;
      mean += r / static_cast<double>(count);
    }
    const Eigen::Vector3d c = linear::pivoted_least_squares(rows, square);
    const double tube = std::sqrt(std::max(0.0, c(2) + c.head<2>().squaredNorm()));
    return {c(0) + frame().position_ref_mm, c(1), mean < c(1) ? -tube : tube};
  }
};

}  // namespace

CatalogueEntry torus_entry() {
  return entry_of<Torus>({SurfaceKind::torus,
                          "torus",
                          "torus: a groove or bead of circular section",
                          StreamKind::lateral,
                          true,
                          {"x0", "y0", "l", "m", "z0", "radius", "minor_radius"},
                          {"mm", "mm", "1", "1", "mm", "mm", "mm"}});
}

}  // namespace trueaxis
