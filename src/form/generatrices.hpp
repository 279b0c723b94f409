// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "form/axis_line.hpp"
#include "form/section_model.hpp"

namespace trueaxis::form {

/// The lines of a surface along its axis, through all sections.
class Generatrices {
 public:
  /// @param sections of known radius and Z @param axis that they are distances from
  Generatrices(const std::vector<SectionModel>& sections, const AxisLine& axis);

  /// STRsg: the widest zone that a generatrix of filtered profiles takes.
  double straightness_mm(const std::vector<std::vector<double>>& filtered_mm) const;

 private:
  /// Where one meets a section, between two places of its profile.
  struct Crossing {
    std::size_t before, behind;
    double share;    ///< of the one at the rear
    double base_mm;  ///< distance from the axis without the profile
  };
  std::vector<std::size_t> sections_;        ///< in order of Z
  std::vector<double> z_mm_;                 ///< of these
  std::vector<std::vector<Crossing>> list_;  ///< of a generatrix with each of these
};

/// Width along y of the narrowest zone between two parallel lines that holds all points: the
/// longest chord along y of their convex hull. Eq. 265 of a line.
/// @param x ascending
double width_of_zone(std::span<const double> x, std::span<const double> y);

}  // namespace trueaxis::form
