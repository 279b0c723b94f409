// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "form/axis_line.hpp"
#include "form/section_model.hpp"
#include "form/uncertainty.hpp"

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

/// All sections of a surface of revolution as one: points about a straight axis.
class WholeModel {
 public:
  /// @param sections of known radius, from two on; they outlive this
  /// @param criteria of the cylinders that are asked for
  /// @param in_space by associate(), else by Eq. 273 about the line of least squares
  WholeModel(const std::vector<SectionModel>& sections, std::span<const Criterion> criteria,
             bool in_space);

  /// The axis by a criterion, for the measured profiles and for some near these: by least squares
  /// of the cone, which a cylinder is as well; else of the cylinder.
  AxisLine axis(Criterion criterion) const {
    return measured_.at({criterion, has_cone(criterion)}).axis;
  }
  AxisLine axis_near(const std::vector<std::vector<double>>& filtered_mm,
                     Criterion criterion) const;

  double taper() const { return taper_; }

  /// Why the axis of a criterion may rock: the cylinder rests on less than a quarter of the length
  /// (a tapered shaft touches at one end). Empty: it does not.
  std::string rocking(Criterion criterion) const;

  /// CYLt, CYLp, CYLv, CYLq about the four cylinders, and the parts of ISO 12180; the cone's. They
  /// are of the measured profiles, and of some near these, by Eq. 273 at the optimum.
  std::vector<NamedValue> measured() const;
  std::vector<NamedValue> near(const std::vector<std::vector<double>>& filtered_mm) const;

  /// Run-out, coaxiality, concentricity and parallelism (ISO 1101) against an axis.
  std::vector<NamedValue> against(const AxisLine& datum,
                                  const std::vector<std::vector<double>>& filtered_mm) const;

 private:
  struct Fitted {
    std::vector<double> off_mm;
    Eigen::VectorXd q;  ///< radius, x and y in the middle, both at the end, radius at the end
    AxisLine axis;
    double held_mm = 0.0;  ///< along the axis, from the first to the last contact
  };
  using Fits = std::map<std::pair<Criterion, bool>, Fitted>;  ///< of a cylinder, of a cone: true
  static bool has_cone(Criterion criterion) { return criterion == Criterion::gaussian; }
  Fitted fitted_near(const std::vector<double>& y, Criterion criterion, bool cone) const;
  Fitted cylinder(const std::vector<std::vector<double>>& filtered_mm, Criterion criterion) const;
  Fitted cone(const std::vector<std::vector<double>>& filtered_mm, Criterion criterion) const;
  /// What is added to `base_`.
  std::vector<double> y_near(const std::vector<std::vector<double>>& filtered_mm) const;
  std::vector<NamedValue> values_of(const Fits& fits,
                                    const std::vector<std::vector<double>>& filtered_mm) const;
  /// The least-squares circle of every section: radius and centre less those of the section.
  std::vector<Eigen::VectorXd> circles(const std::vector<std::vector<double>>& filtered_mm) const;
  /// Centres of sections at right angles to the axis, by Eq. 273a.
  std::vector<CentrePoint> centres(const std::vector<Eigen::VectorXd>& circles) const;
  struct Rows {
    Exchange::Rows rows;
    std::vector<double> y;
  };
  /// Eq. 273 about an axis: distances from it less the mean radius, and their derivatives.
  Rows about(const AxisLine& axis, const std::vector<std::vector<double>>& filtered_mm,
             bool cone) const;
  /// Calls work(distance from an axis in mm, its direction's cosine and sine, t along the axis) for
  /// every place.
  template <class Work>
  void each_off(const AxisLine& axis, const std::vector<std::vector<double>>& filtered_mm,
                Work work) const;
  AxisLine moved(const AxisLine& axis, const Eigen::VectorXd& q) const;

  const std::vector<SectionModel>& sections_;
  std::vector<std::vector<std::array<double, 2>>> towards_;  ///< cos, sin of a section's angles
  double middle_mm_ = 0.0, half_mm_ = 1.0, mean_radius_mm_ = 0.0;
  double taper_ = 0.0;  ///< of the radius, along Z
  AxisLine start_;
  std::vector<double> base_;  ///< y of `about(start_)` of the measured profiles
  std::vector<Exchange> circle_fits_;
  std::optional<Generatrices> generatrices_;             ///< about `start_`
  Fits measured_;                                        ///< in space
  std::map<std::pair<Criterion, bool>, Exchange> near_;  ///< about `start_`, at the optimum
};

}  // namespace trueaxis::form
