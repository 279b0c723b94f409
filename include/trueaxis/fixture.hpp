// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trueaxis/machine.hpp"

/// Where a part is in its fixture: from six measured locators (Hong & Yeh 2020), from the errors of
/// its own datum surfaces (Fallah & Arezoo), or from both (fixtures.md). Inside mm and rad.
/// All of it is one rigid displacement D, x_fixture = D x_part, which is an error of the workpiece
/// (X0W … C0W of docs/reference/machine.md) and a frame of a control.
namespace trueaxis {

/// The tip of a locator, in the frame of the part program in the fixture.
struct Locator {
  Vector3 ideal_mm{};     ///< where it should be
  Vector3 measured_mm{};  ///< where it is
  /// Standard uncertainty of every measured coordinate; NaN: not stated.
  double u_mm = std::numeric_limits<double>::quiet_NaN();
};

/// 3-2-1: A, B, C carry the part along z, D and E along y, F along x.
inline constexpr std::size_t locator_count = 6;
using Locators = std::array<Locator, locator_count>;
constexpr char locator_letter(std::size_t i) { return "ABCDEF"[i]; }
/// The direction (0, 1, 2: x, y, z) in which a locator carries the part.
constexpr std::size_t contact_direction(std::size_t i) { return i < 3 ? 2 : i < 5 ? 1 : 0; }

/// Why six locators do not tell where the part is.
struct LocatorTrouble {
  std::size_t locator = 0;
  std::string message;
};

/// Coincident and collinear locators, D and E above each other, tips that were exchanged or are a
/// mirror image: empty where there is none. Locators count as apart from a thousandth of the
/// fixture's size: a micrometre there is a millimetre at the far end of the part.
std::vector<LocatorTrouble> locator_troubles(const Locators& locators);

/// The nine errors of a part's datum surfaces (Fallah & Arezoo): plane k (0, 1, 2: YZ, ZX, XY)
/// passes through E_kk on axis k and has the normal exp(E_ki, E_kj) e_k (Eq. 162).
struct DatumErrors {
  Vector3 offset_mm{};                ///< Exx, Eyy, Ezz
  std::array<Vector3, 3> turn_rad{};  ///< of plane k about x, y, z; about k itself 0

  Vector3 normal(std::size_t plane) const;
};
inline constexpr std::array<const char*, 3> datum_plane_names{"YZ", "ZX", "XY"};

/// Why three datum surfaces make no datum system.
struct DatumTrouble {
  std::size_t plane = 0;
  std::string message;
};

/// Two surfaces that are parallel or three that meet in a line, within a degree, and angles of 45°
/// or more, at which a surface is nearer to another's place: empty where there is none.
std::vector<DatumTrouble> datum_troubles(const DatumErrors& datums);

/// A part in its fixture, with the uncertainty of X0W, Y0W, Z0W (mm), A0W, B0W, C0W (rad).
struct PartSetup {
  RigidTransform fixture_from_part;  ///< D = Tr(X0W, Y0W, Z0W) exp(A0W, B0W, C0W)
  std::array<double, 6> errors{};    ///< X0W … C0W: mm, then the rotation vector in rad
  /// The covariance of `errors`: mm², mm rad, rad². Empty where no uncertainty is stated.
  Covariance covariance;
  bool converged = true;  ///< false: no numbers

  double u(std::size_t i) const;  ///< of errors[i]; NaN: not stated
};

/// Six contacts of a rigid part: every measured tip m on its datum surface,
/// n_k·(D⁻¹ m − e_k (E_kk + ideal_k)) = 0 (Eq. 160), by Newton. u of the tips is propagated (GUM
/// 5.2). @throws InputError where `locator_troubles` or `datum_troubles` has any.
PartSetup locate_rigidly(const Locators& locators, const DatumErrors& datums = {});

/// The ten steps of Hong & Yeh 2020, as they are printed.
struct PrintedLocation {
  double alpha_rad = 0.0, beta_rad = 0.0;  ///< (4.6), (4.7) with n upwards
  double gamma_rad = 0.0;                  ///< the root of (4.12) of least |γ|
  /// (4.12) with the arcus functions it is printed with: 180° off where γ < 0; NaN where the side
  /// locators are level in frame 1, where its quotient is not defined.
  double gamma_as_printed_rad = 0.0;
  Vector3 d_mm{};                               ///< (4.16)–(4.19): seen in frame 2
  RigidTransform fixture_from_part_as_printed;  ///< H₃⁰ of (4.20): d as if it were in frame 0
};
/// @throws InputError where `locator_troubles` has any, or no γ makes D and E as long as they are.
PrintedLocation locate_as_printed(const Locators& locators);

/// D of a part whose three datum surfaces lie on three perfect planes of the fixture: the inverse
/// of the datum system of ISO 5459 (z = n₁ of XY, x along n₂ × n₁ with n₂ of ZX, origin the
/// common point; Eq. 163). `covariance` is that of the nine errors `datum_error_names`, in
/// their order, or empty. @throws InputError where `datum_troubles` has any.
PartSetup setup_of_datums(const DatumErrors& datums, const Covariance& covariance = {});

/// Ezz, Ezx, Ezy, Eyy, Eyx, Eyz, Exx, Exy, Exz: for planes XY, ZX, YZ in turn.
inline constexpr std::array<const char*, 9> datum_error_names{"Ezz", "Ezx", "Ezy", "Eyy", "Eyx",
                                                              "Eyz", "Exx", "Exy", "Exz"};
double& datum_error(DatumErrors& datums, std::string_view name);
double datum_error(const DatumErrors& datums, std::string_view name);

/// A datum surface associated with points of it.
struct ProbedDatum {
  std::array<double, 3> errors{};  ///< E_kk in mm, then its two angles in rad, as they are named
  /// Of them; NaN: not determined. Widened so that 2 u hold 95 % of errors although σ comes from
  /// few points (JCGM 100, G.3).
  Covariance covariance;
  double rms_mm = 0.0;  ///< of the points about the plane
  /// Derivatives of its errors by those of the datums before it, in the order of
  /// `datum_error_names`; 0 of a plane that was associated alone. `covariance` presupposes these.
  std::array<std::array<double, 6>, 3> by_before{};
};

/// The plane `k` (0, 1, 2: YZ, ZX, XY) through points of the design frame, least squares along its
/// axis by `fit()` (Eq. 164). `source` names the points. @throws InputError where they show no such
/// plane.
ProbedDatum fit_datum(std::size_t plane, std::span<const Vector3> points_mm,
                      const std::string& source);

/// The same under the constraint of ISO 5459: square to the datums before it, XY first, then ZX
/// (Eq. 333).
ProbedDatum fit_datum_after(const DatumErrors& before, std::size_t plane,
                            std::span<const Vector3> points_mm, const std::string& source);

}  // namespace trueaxis
