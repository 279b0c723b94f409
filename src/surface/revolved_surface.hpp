// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/jet.h>

#include <span>
#include <vector>

#include "surface/revolved_kernel.hpp"
#include "surface/surface.hpp"

namespace trueaxis {

/// What section, cylinder and cone share. Working parameters, in this order and as far as the
/// surface has them: x, y (mm, at z_ref), slope_x, slope_y, radius (or the offset of a relative
/// gauge), tan of the half angle.
class RevolvedSurface : public Surface {
 public:
  RevolvedSurface(const SurfaceFrame& frame, bool tilts, bool tapers)
      : frame_(frame), tilts_(tilts), tapers_(tapers) {}

  std::size_t column_count() const override { return relative() ? revolved_columns : w_one; }
  std::span<const std::string_view> working_names() const override;
  std::vector<double> working_scale_mm(std::span<const double> working) const override;
  std::vector<double> start(const ReadingBlock& readings, std::size_t count) const override;
  std::vector<double> level_start(const ReadingBlock& readings, std::size_t count) const override;
  bool tilt_may_be_mirrored(std::span<const double> working) const override;
  void evaluate(std::span<const double> working, const ReadingBlock& readings,
                PredictionBlock& out) const override;
  void transform(std::span<const double> working, double* out) const override;
  Axis axis(std::span<const double> working) const override;
  std::vector<double> axis_jacobian(std::span<const double> working) const override;
  Revolved shape(std::span<const double> working) const override;
  Influences influences(std::span<const double> working, double c_rad, double position_mm,
                        double probe_height_mm) const override;

 protected:
  /// All six working parameters of any scalar type, those the surface lacks at their fixed value,
  /// and the ball subtracted from the radius: the contact's offset along the normal is r_b /
  /// cos(half angle).
  template <typename T>
  struct Full {
    T x, y, slope_x, slope_y, radius, tan;
  };
  template <typename T>
  Full<T> expand(const T* w) const {
    const std::size_t r = tilts_ ? 4 : 2;
    Full<T> full{w[0],
                 w[1],
                 tilts_ ? w[2] : T(0.0),
                 tilts_ ? w[3] : T(0.0),
                 relative() ? T(frame_.nominal_radius_mm) : w[r],
                 tapers_ ? w[r + 1] : T(0.0)};
    if (frame_.ball_mm != 0.0 && !relative()) {
      using std::sqrt;
      full.radius -= frame_.ball_mm * sqrt(1.0 + full.tan * full.tan);
    }
    return full;
  }
  double nominal_path_radius(double tan_half_angle) const;
  double gauge_shift(const ReadingBlock& readings, std::size_t count) const;
  /// x0, y0 (the axis at Z = 0), l, m (Constantin et al. Eq. 1) into out[0..3]. @returns n.
  template <typename T>
  T report_line(const Full<T>& full, T* out) const {
    using std::sqrt;
    const T n = 1.0 / sqrt(1.0 + full.slope_x * full.slope_x + full.slope_y * full.slope_y);
    out[0] = full.x - full.slope_x * frame_.position_ref_mm;
    out[1] = full.y - full.slope_y * frame_.position_ref_mm;
    out[2] = full.slope_x * n;
    out[3] = full.slope_y * n;
    return n;
  }
  Revolved probed(std::span<const double> working) const;  ///< where the ball's centre runs
  bool relative() const { return frame_.indication == Indication::relative; }
  std::size_t radius_index() const { return tilts_ ? 4 : 2; }

  SurfaceFrame frame_;
  bool tilts_, tapers_;
};

/// Values and exact Jacobian of `function(const T* working, T* out)` by dual numbers.
template <std::size_t N, typename Function>
/// Eq. 15.
Surface::Reported differentiate(std::span<const double> working, std::size_t outputs,
                                Function function) {
  using Jet = ceres::Jet<double, static_cast<int>(N)>;
  std::vector<Jet> in(N), out(outputs);
  for (std::size_t i = 0; i < N; ++i) in[i] = Jet(working[i], static_cast<int>(i));
  function(in.data(), out.data());
  Surface::Reported reported;
  for (const Jet& jet : out) {
    reported.value.push_back(jet.a);
    for (std::size_t i = 0; i < N; ++i) reported.jacobian.push_back(jet.v[static_cast<int>(i)]);
  }
  return reported;
}

}  // namespace trueaxis
