// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "surface/catalogue.hpp"
#include "trueaxis/surface.hpp"

namespace trueaxis {

/// A surface of revolution by its profile, about an axis that is found with it. Working parameters:
/// x, y (mm, at z_ref), slope_x, slope_y, then the profile's.
class ProfileSurface : public Surface {
 public:
  using Parameters = std::vector<RevolvedProfile::Parameter>;

  /// @param parameters of the profile; names of a catalogue line may point into them
  ProfileSurface(std::shared_ptr<const RevolvedProfile> profile,
                 std::shared_ptr<const Parameters> parameters, const SurfaceFrame& frame);

  std::size_t column_count() const override { return names_.size(); }
  std::span<const std::string_view> working_names() const override { return names_; }
  std::vector<double> working_scale_mm(std::span<const double> working) const override;
  std::vector<double> start(const ReadingBlock& readings, std::size_t count) const override;
  std::vector<double> level_start(const ReadingBlock& readings, std::size_t count) const override;
  void evaluate(std::span<const double> working, const ReadingBlock& readings,
                PredictionBlock& out) const override;
  void transform(std::span<const double> working, double* out) const override;
  Reported report(std::span<const double> working) const override;
  Axis axis(std::span<const double> working) const override;
  std::vector<double> axis_jacobian(std::span<const double> working) const override;
  Revolved shape(std::span<const double> working) const override;  ///< that touches in the middle
  Influences influences(std::span<const double> working, double c_rad, double position_mm,
                        double probe_height_mm) const override;

 protected:
  static constexpr std::size_t line_parameters = 4;

  /// The profile's own parameters about an axis to start from.
  virtual std::vector<double> profile_start(const Axis& axis, const ReadingBlock& readings,
                                            std::size_t count) const;
  const SurfaceFrame& frame() const { return frame_; }

 private:
  /// Where a probe line meets the surface, and the derivatives there.
  struct Contact {
    bool hit = false;
    double x_mm = 0.0, height_mm = 0.0;
    RevolvedProfile::Radius radius;
    std::array<double, line_parameters + RevolvedProfile::most> per_working{};
  };
  Contact meet(std::span<const double> working, double cos_c, double sin_c, double z_mm,
               double guess_mm) const;
  Revolved tangent_cone(std::span<const double> working, double height_mm) const;
  std::vector<double> with_profile(std::vector<double> cone, const ReadingBlock& readings,
                                   std::size_t count) const;

  std::shared_ptr<const RevolvedProfile> profile_;
  std::shared_ptr<const Parameters> parameters_;
  std::vector<std::string_view> names_{"x", "y", "slope_x", "slope_y"};
  SurfaceFrame frame_;
  std::unique_ptr<Surface> cone_;  ///< finds the axis to start from
};

/// A profile of the user's in the place of a catalogue line.
/// @throws ContractViolation for more parameters than a profile may have
CatalogueEntry own_entry(std::shared_ptr<const RevolvedProfile> profile);

}  // namespace trueaxis
