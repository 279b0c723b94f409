// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "surface/surface.hpp"
#include "trueaxis/fit.hpp"
#include "trueaxis/probe_stream.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::laws {

/// A part as it is clamped and probed, for every surface of the catalogue. Lateral surfaces: the
/// axis passes (x, y) at the middle of the probed length, with slopes; a face: d and the slopes of
/// its normal, position is X.
struct LawCase {
  std::string_view surface = "cone";
  double x_mm = 0.0, y_mm = 0.0, slope_x = 0.0, slope_y = 0.0;
  double radius_mm = 20.0;  ///< at the middle of the probed length, across the axis; face: d
  double half_angle_deg = 0.0;
  double start_mm = 0.0, end_mm = 20.0;  ///< of Z (a face: of X)
  double revolutions = 10.3;
  double readings_per_revolution = 10.3;
  double c_start_rad = 0.0;
  double ball_mm = 0.0, noise_mm = 0.0;
  bool rear = false, bore = false, relative = false, returns = false;
  std::uint64_t seed = 1;

  double middle_mm() const { return 0.5 * (start_mm + end_mm); }
  double half_angle_rad() const;
};

/// The case as a literal that can be pasted.
std::string to_literal(const LawCase& c);
inline void PrintTo(const LawCase& c, std::ostream* out) { *out << to_literal(c); }

/// The virtual lathe's scenario; shares no formula with the model.
virtual_lathe::Scenario scenario_of(const LawCase& c);
ProbeStream probe(const LawCase& c);
/// What the virtual lathe reads at one place, the probe line at Y = height.
double single_reading(const LawCase& c, double c_rad, double position_mm, double height_mm = 0.0);
FitOptions options_of(const LawCase& c);

/// What a fit should report, in the order of the catalogue.
std::vector<double> expected_parameters(const LawCase& c);

/// What the engine knows of the case before it fits, and its true working parameters.
SurfaceFrame frame_of(const LawCase& c);
std::vector<double> working_of(const LawCase& c);

/// How far rounding of the readings can move each reported parameter: |Σ (JᵀJ)⁻¹Jᵀ δ| ≤ ‖δ‖
/// √(JᵀJ)⁻¹ᵢᵢ with |δ| ≤ ε of a reading, and the rounding of the parameter itself.
std::vector<double> rounding_of_parameters(const LawCase& c, const FitResult& result);

/// The size that rounding of a reading is relative to, mm: coordinates that its computation meets,
/// those along Z as they show in X, over the cosine of the worst incidence.
double rounding_size_mm(const LawCase& c);

/// Every surface of the catalogue that the virtual lathe makes, for INSTANTIATE_TEST_SUITE_P.
std::vector<std::string> catalogue_ids();
/// Those with a spindle axis inside: all but faces.
std::vector<std::string> lateral_ids();
std::string name_of(const ::testing::TestParamInfo<std::string>& info);

/// Random numbers with a printed seed.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high);
  double log_uniform(double low, double high);
  double sign() { return uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0; }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  template <typename T>
  const T& pick(const std::vector<T>& from) {
    return from[std::uniform_int_distribution<std::size_t>(0, from.size() - 1)(engine_)];
  }

 private:
  std::mt19937_64 engine_;
};

/// The limits of the stated domain that a random case is drawn from.
struct Domain {
  double eccentricity = 0.95;  ///< of the radius at the small end of the probed length
  double least_half_angle_deg = 0.05, largest_half_angle_deg = 80.0;
  double tilt_rad = 0.05;
  double length_min_mm = 1.0, length_max_mm = 200.0;
  double z_offset_mm = 500.0;
  double readings_min = 30.0, readings_max = 3000.0;
};

/// A random part and plan: the spindle axis runs inside the part over the whole length (X_M has one
/// sign); drawn again where it does not.
LawCase draw_case(std::string_view surface, Draw& draw, const Domain& domain = {});

}  // namespace trueaxis::laws
