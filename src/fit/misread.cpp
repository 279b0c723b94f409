// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/number.hpp"
#include "fit/mend_columns.hpp"
#include "fit/plausible.hpp"
#include "math/linear_algebra.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double far_better = 1.0 / 3.0;  // of the RMS: nine in likelihood a reading
constexpr double much_mm = 0.01;          // few lobes of a seat are larger
constexpr double least_mm = 1e-6;         // what a stream's digits leave
constexpr double most_feed_mm = 5.0;      // per revolution: nobody probes coarser
constexpr double many_turns = 20.0;       // three of radians that are read as turns
constexpr double nearly_a_turn = 0.9 * two_pi;
constexpr double restless = 1.2;  // of the travel over its range, Z against X

/// What the columns of a stream look like.
struct Suspicion {
  bool c_stands = false;        ///< C hardly turns
  bool unlike_spindle = false;  ///< C does not turn as a spindle does
  bool leaves_much = false;     ///< residuals of more than lobes usually are
  bool other_unit = false;      ///< unlike a spindle, or many turns leave so much
  bool any = true;              ///< the mend itself leaves a column alone that does not look so
  bool z_to_and_fro = false;    ///< X runs along while Z goes to and fro with every revolution
};

/// Another way to read the numbers of a stream, tried if the columns look like it.
struct Misreading {
  const char* what;
  const char* remedy;
  bool Suspicion::*looks;
  bool needs_position;
  void (*mend)(ProbeStream&);
};

double travel_mm(const ProbeStream& stream) {
  return stream.has_position() ? range_of(stream.position_mm).length() : 0.0;
}

/// Whether C turns as a spindle's: about a turn or more, several readings each.
bool turns_around(const ProbeStream& stream) {
  std::size_t short_steps = 0;
  for (std::size_t i = 1; i < stream.size(); ++i)
    short_steps += std::abs(stream.c_rad[i] - stream.c_rad[i - 1]) <= 0.25 * two_pi;
  return 2 * short_steps >= stream.size() && range_of(stream.c_rad).length() >= nearly_a_turn;
}

/// C does not turn as a spindle's, or its turns are farther apart along Z than is probed.
bool unlike_a_spindle(const ProbeStream& stream) {
  return !turns_around(stream) ||
         travel_mm(stream) > most_feed_mm * range_of(stream.c_rad).length() / two_pi;
}

/// How often a column runs through its range.
double restlessness(const std::vector<double>& column) {
  double way = 0.0;
  for (std::size_t i = 1; i < column.size(); ++i) way += std::abs(column[i] - column[i - 1]);
  return way / std::max(range_of(column).length(), 1e-300);
}

bool z_goes_to_and_fro(const ProbeStream& stream) {
  return stream.has_position() &&
         restlessness(stream.position_mm) > restless * restlessness(stream.reading_mm);
}

template <double Factor>
void scale_c(ProbeStream& stream) {
  for (double& c : stream.c_rad) c *= Factor;
}

/// A column of lengths that holds degrees, and the other way round.
void exchange_with_c(std::vector<double>& length_mm, std::vector<double>& c_rad) {
  for (std::size_t i = 0; i < c_rad.size(); ++i) {
    const double deg = c_rad[i] / rad_per_deg;
    c_rad[i] = length_mm[i] * rad_per_deg;
    length_mm[i] = deg;
  }
}

constexpr const char* wrapped = "record the angle over all revolutions";
constexpr const char* exchange = "exchange their names in the header";

constexpr bool Suspicion::*spindle = &Suspicion::unlike_spindle;

constexpr Misreading misreadings[] = {
    {"X_M and Z are exchanged", exchange, &Suspicion::z_to_and_fro, true,
     [](ProbeStream& s) { std::swap(s.reading_mm, s.position_mm); }},
    {"C and Z are exchanged", exchange, &Suspicion::c_stands, true,
     [](ProbeStream& s) { exchange_with_c(s.position_mm, s.c_rad); }},
    {"C and X_M are exchanged", exchange, &Suspicion::c_stands, false,
     [](ProbeStream& s) { exchange_with_c(s.reading_mm, s.c_rad); }},
    {"C is in radians", "C[rad]", spindle, false, scale_c<1.0 / rad_per_deg>},
    {"C is in radians", "C[rad]", &Suspicion::other_unit, false, scale_c<1.0 / two_pi>},
    {"C is in degrees", "C[deg]", spindle, false, scale_c<rad_per_deg>},
    {"C is in degrees", "C[deg]", spindle, false, scale_c<1.0 / 360.0>},
    {"C is in turns", "C[rev]", spindle, false, scale_c<360.0>},
    {"C is in turns", "C[rev]", &Suspicion::other_unit, false, scale_c<two_pi>},
    {"C has 400 gon in a revolution", "multiply it by 0.9", &Suspicion::leaves_much, false,
     scale_c<0.9>},
    {"C runs at twice the angle", "halve it", &Suspicion::leaves_much, false, scale_c<0.5>},
    {"C restarts every 180°", wrapped, &Suspicion::leaves_much, false, unwrap_c<180>},
    {"C restarts every 90°", wrapped, &Suspicion::leaves_much, false, unwrap_c<90>},
    {"C restarts after a revolution that does not have 360°", "write degrees", &Suspicion::any,
     false, begin_anew_each_turn},
    {"C runs to and fro because it is folded", wrapped, &Suspicion::any, false, unfold_c},
    {"X_M restarts at the end of a display or counter", "record its whole range",
     &Suspicion::leaves_much, false, unwrap_reading},
    // An oval part whose centre runs true would be one that runs out at half the angle.
    {"C runs at half the angle (or the part is oval and runs true)", "double it",
     &Suspicion::leaves_much, false, scale_c<2.0>},
    {"C runs at half the angle and restarts every revolution", wrapped, &Suspicion::leaves_much,
     false,
     [](ProbeStream& s) {
       unwrap_c<180>(s);
       scale_c<2.0>(s);
     }},
    {"X_M repeats at another angle than a revolution of C: C has another unit, or X_M is not from "
     "a probe",
     "check both columns", &Suspicion::leaves_much, false, turn_as_reading_does}};

std::string um_text(double length_mm) { return significant(length_mm / mm_per_um, 3) + " µm"; }

/// RMS of what a + b Z + c cos C + d sin C leaves. That is the surface to first order and needs no
/// start, from which the fit of a short arc may go astray.
double left_by_first_order_mm(const ProbeStream& stream) {
  const auto n = static_cast<Eigen::Index>(stream.size());
  Eigen::MatrixXd columns(n, stream.has_position() ? 4 : 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    columns(i, 0) = 1.0;
    columns(i, 1) = std::cos(stream.c_rad[k]), columns(i, 2) = std::sin(stream.c_rad[k]);
    if (stream.has_position()) columns(i, 3) = stream.position_mm[k];
  }
  const Eigen::VectorXd left = linear::beside(
      linear::orthonormal_basis(columns),
      Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(stream.reading_mm.data(), n)));
  return left.norm() / std::sqrt(static_cast<double>(n));
}

}  // namespace

double left_mm(const ProbeStream& stream, const FitResult& fit) {
  if (!fit.residual_mm.empty()) return fit.rms_mm;
  const auto n = static_cast<double>(stream.size());
  const double mean = std::accumulate(stream.reading_mm.begin(), stream.reading_mm.end(), 0.0) / n;
  double squares = 0.0;
  for (const double reading : stream.reading_mm) squares += (reading - mean) * (reading - mean);
  return std::sqrt(squares / n);
}

std::string turns_text(const ProbeStream& stream) {
  const Extent c = range_of(stream.c_rad);
  const double turns = c.length() / two_pi, travel = travel_mm(stream);
  std::string text =
      fmt::format("C from {}° to {}°, {} revolutions", significant(c.low / rad_per_deg, 4),
                  significant(c.high / rad_per_deg, 4), significant(turns, 3));
  return travel > 0.0 ? text + fmt::format(", {:.3g} per mm", turns / travel) : text;
}

std::string likely_misreading(const ProbeStream& stream, const FitResult& fit, const Refit& refit) {
  const double before_mm = left_mm(stream, fit);
  if (!(before_mm > least_mm)) return "";
  const double turning_rad = range_of(stream.c_rad).length();
  const bool unlike = unlike_a_spindle(stream), much = before_mm > much_mm;
  const Suspicion suspicion{.c_stands = turning_rad < nearly_a_turn,
                            .unlike_spindle = unlike,
                            .leaves_much = much,
                            .other_unit = unlike || (much && turning_rad > many_turns * two_pi),
                            .z_to_and_fro = z_goes_to_and_fro(stream)};
  for (const Misreading& one : misreadings) {
    if (!(suspicion.*one.looks) || (one.needs_position && !stream.has_position())) continue;
    ProbeStream right = stream;
    one.mend(right);
    const bool same = right.c_rad == stream.c_rad && right.reading_mm == stream.reading_mm &&
                      right.position_mm == stream.position_mm;
    if (same || !turns_around(right) || z_goes_to_and_fro(right)) continue;
    const FitResult again = refit(right, fit.surface);
    if (again.status != FitStatus::converged || !(again.rms_mm < far_better * before_mm) ||
        again.points < 2 * again.parameters.size() + 10)
      continue;
    if (!(again.rms_mm < far_better * left_by_first_order_mm(stream))) continue;
    return fmt::format("{}: {}. As written the residuals are {} RMS ({}), otherwise {} ({})",
                       one.what, one.remedy, um_text(before_mm), turns_text(stream),
                       um_text(again.rms_mm), turns_text(right));
  }
  return "";
}

}  // namespace trueaxis
