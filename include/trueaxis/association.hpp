// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

/// Association of a geometrical element with Cartesian points (ISO 17450-1, ISO 5459), in any
/// orientation, scale and place, without starting values: association.md. Points and lengths
/// in mm, angles in rad; distances are orthogonal, positive outside (away from an axis, a centre,
/// a tube's middle; of a plane along its normal).
namespace trueaxis {

using Point3 = std::array<double, 3>;

enum class Element { line, circle, plane, sphere, cylinder, cone, torus };
inline constexpr std::array<const char*, 7> element_names{"line",     "circle", "plane", "sphere",
                                                          "cylinder", "cone",   "torus"};

/// What is made least (Eqs. 240-242).
enum class Criterion {
  gaussian,               ///< the sum of squared distances
  minimum_zone,           ///< the largest |distance| (Chebyshev)
  minimum_circumscribed,  ///< the size of a circle, sphere, cylinder, torus that holds all points
  maximum_inscribed,      ///< minus the size of one that holds none
  constrained,            ///< the sum of squares, the element being outside of the material
};
inline constexpr std::array<const char*, 5> criterion_names{
    "gaussian", "minimum_zone", "minimum_circumscribed", "maximum_inscribed", "constrained"};

/// An element in its place. What it does not have is NaN.
struct Feature {
  /// The centre, or the point of a line, axis or plane that is nearest to the centroid of the
  /// points.
  Point3 point_mm{};
  /// Unit vector of the axis or normal. A cone's points to where the radius grows; else the
  /// component largest in size is positive. Of a sphere NaN.
  Point3 direction{};
  double radius_mm = std::numeric_limits<double>::quiet_NaN();  ///< of a torus: major
  double half_angle_rad = std::numeric_limits<double>::quiet_NaN();
  double minor_radius_mm = std::numeric_limits<double>::quiet_NaN();
};

/// What proves that no neighbour of the element is better (Eq. 244): the points it rests on with
/// signs s and multipliers λ ≥ 0, Σλ = 1, for which Σ λᵢ sᵢ ∇dᵢ = 0.
struct AssociationCertificate {
  struct Contact {
    std::size_t point = 0;  ///< its index, from 0
    int sign = 1;           ///< +1: outer side, -1: inner side
    double distance_mm = 0.0;
    double multiplier = 0.0;
  };
  std::vector<Contact> contacts;  ///< empty for the Gaussian
  /// For the Gaussian |Jᵀd|, for all others |Σ λ s ∇d|, per parameter as motion of the surface at
  /// the far end of the points; 0 at an optimum.
  double stationarity = 0.0;
  /// What a neighbour within the size of the points could be better at most, to first order, mm.
  double gap_mm = 0.0;
  bool global = false;  ///< the criterion is convex here: no other element is better anywhere
  int starts = 1;       ///< where it is not: from how many starts this was the best
};

enum class AssociationStatus {
  converged,
  too_few,         ///< fewer points than the element has parameters
  degenerate,      ///< the points lie in one place, line or plane, where the element needs more
  not_determined,  ///< the points do not single out one element
  max_iterations,
};
inline constexpr std::array<const char*, 5> association_status_names{
    "converged", "too_few", "degenerate", "not_determined", "max_iterations"};

struct AssociatedFeature {
  Element element = Element::circle;
  Criterion criterion = Criterion::gaussian;
  AssociationStatus status = AssociationStatus::converged;
  std::string why{};  ///< what is wrong where it is not converged, one sentence
  std::size_t points = 0;
  bool in_plane = false;  ///< a line or circle of the plane z = 0
  Feature feature{};
  Feature u{};             ///< standard uncertainty of each number, NaN: see why_no_u
  std::string why_no_u{};  ///< empty where u is there
  double rms_mm = std::numeric_limits<double>::quiet_NaN();  ///< of the distances
  /// Largest distance less smallest; twice the largest for a line and a circle in space, which are
  /// tubes about the points.
  double zone_mm = std::numeric_limits<double>::quiet_NaN();
  AssociationCertificate certificate{};
  int iterations = 0;
};

/// On which side of an element its material lies: inside of a shaft, a ball, below a face (against
/// the direction of the result); outside of a bore.
enum class Material { inside, outside };

struct AssociateOptions {
  Material material = Material::inside;  ///< of the constrained criterion
  int threads = 0;                       ///< 0: as many as there are; the result is the same bytes
  int max_iterations = 500;              ///< of one start; a hard one takes 50
};

/// The element of the points. A line or circle is one of the plane where every third coordinate is
/// 0. A line, plane or cone has no size, so that the third and fourth criterion do not apply; a
/// line or circle of space has no side: the fifth sees a circle along its axis and no line.
/// @throws ContractViolation for a coordinate that is not finite or a criterion that does not apply
AssociatedFeature associate(std::span<const Point3> points_mm, Element element, Criterion criterion,
                            const AssociateOptions& options = {});

/// Why the points cannot be those of the surface that was associated; empty: they can. A plane,
/// sphere, cylinder or cone leaves a tenth of the RMS or less, or it is more than a part leaves.
std::string of_other_element(std::span<const Point3> points_mm, const AssociatedFeature& found);

/// Why `criterion` does not apply to `element`; empty where it does.
std::string association_objection(Element element, Criterion criterion);

/// Orthogonal distance of every point from the associated element; of a line or circle in space
/// always positive.
std::vector<double> distances_mm(std::span<const Point3> points_mm,
                                 const AssociatedFeature& associated);

}  // namespace trueaxis
