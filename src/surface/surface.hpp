// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "math/gram.hpp"
#include "trueaxis/probe_stream.hpp"
#include "trueaxis/surface.hpp"

namespace trueaxis {

inline constexpr std::size_t max_parameters = 8;
inline constexpr std::size_t max_columns = 8;

/// `block_size` readings as columns; cos C and sin C are computed once per stream.
struct ReadingBlock {
  const double* reading_mm;
  const double* cos_c;
  const double* sin_c;
  const double* position_mm;
};

/// What a surface predicts for a block. The Jacobian of the prediction is transform · column, where
/// the small matrix `transform` (see Surface::transform) is the same for all readings of a pass.
struct PredictionBlock {
  alignas(64) double residual[block_size];             ///< reading − prediction, mm
  alignas(64) double column[max_columns][block_size];  ///< basis functions of the Jacobian
  bool valid = true;  ///< false: a probe line misses the surface; nothing else may then be used
};

/// What a fit knows of the data before it starts; it makes the working parameters well-conditioned.
struct SurfaceFrame {
  double position_ref_mm = 0.0;  ///< middle of the probed length: where working offsets are defined
  double half_length_mm = 0.0;
  Root root = Root::front;
  Indication indication = Indication::absolute;
  double nominal_radius_mm = 0.0;  ///< a relative gauge only
  double ball_mm = 0.0;            ///< ball radius, negative in a bore: subtracted along the normal
};

/// A line of the catalogue.
struct SurfaceInfo {
  SurfaceKind kind;
  const char* id;
  std::string_view title;
  StreamKind stream;
  bool needs_position;                              ///< false: fitted without Z
  std::vector<std::string_view> parameters, units;  ///< as reported (edge units)
};

/// A reference surface over one stream: working parameters inside, the contract's parameters
/// outside.
class Surface {
 public:
  virtual ~Surface() = default;

  std::size_t parameter_count() const { return working_names().size(); }
  virtual std::size_t column_count() const = 0;
  /// Names of the working parameters and the length (mm) that one unit of each is worth on the
  /// surface.
  virtual std::span<const std::string_view> working_names() const = 0;
  virtual std::vector<double> working_scale_mm(std::span<const double> working) const = 0;

  /// Starting values from readings alone (algebraic least squares); `count` ≥ parameter_count().
  virtual std::vector<double> start(const ReadingBlock& readings, std::size_t count) const = 0;
  /// A start whose axis is parallel to the spindle and that every probe line meets where the
  /// spindle axis runs inside the part; empty for a surface whose other start is always good.
  virtual std::vector<double> level_start(const ReadingBlock& /*readings*/,
                                          std::size_t /*count*/) const {
    return {};
  }
  /// Starts that are tried as well, of a surface that has several minima over few turns.
  /// @param level the level start
  virtual std::vector<std::vector<double>> further_starts(
      const std::vector<double>& /*level*/) const {
    return {};
  }
  /// Whether the axis tilted the other way may be a second minimum: tilt then bends the sections
  /// (K R slope²) as much as it shifts them (slope × length), as on a short, large part (Eq. 25).
  virtual bool tilt_may_be_mirrored(std::span<const double> /*working*/) const { return false; }
  /// Residuals and Jacobian columns of one block.
  virtual void evaluate(std::span<const double> working, const ReadingBlock& readings,
                        PredictionBlock& out) const = 0;
  /// Row-major parameter_count() × column_count(): d prediction / d working = transform · columns.
  virtual void transform(std::span<const double> working, double* out) const = 0;

  /// Reported parameters (edge units) and their Jacobian with respect to the working ones,
  /// row-major.
  struct Reported {
    std::vector<double> value;
    std::vector<double> jacobian;
  };
  virtual Reported report(std::span<const double> working) const = 0;
  /// The axis (of a plane: its normal) and its Jacobian, 4 × parameter_count(), row-major.
  virtual Axis axis(std::span<const double> working) const = 0;
  virtual std::vector<double> axis_jacobian(std::span<const double> working) const = 0;
  /// The part's surface, the ball subtracted; a plane returns, with radius 0, the axis that is
  /// perpendicular to it where the spindle's pierces it, there as probed.
  virtual Revolved shape(std::span<const double> working) const = 0;
  /// Derivatives of the prediction with respect to influence quantities, at one reading.
  struct Influences {
    double height = 0.0;    ///< per mm of probe height
    double c = 0.0;         ///< per rad of spindle angle
    double position = 0.0;  ///< per mm of Z (of a face: of X)
  };
  /// @param probe_height_mm of surfaces of revolution, of which alone one is stated
  virtual Influences influences(std::span<const double> working, double c_rad, double position_mm,
                                double probe_height_mm = 0.0) const = 0;
};

/// Every surface the engine knows, in the order it is listed.
std::span<const SurfaceInfo> surface_catalogue();

/// The catalogue line of a kind other than `own`.
const SurfaceInfo& surface_info(SurfaceKind kind);

/// Derivatives of the reported parameters (edge units, catalogue's order) with respect to the axis
/// point x, y at `z_mm`, the slopes, the radius there and the tangent of the half angle: row-major,
/// 6 columns. Of a plane the height stands for the radius.
std::vector<double> reported_jacobian(SurfaceKind kind, const Revolved& shape, double z_mm);

std::unique_ptr<Surface> make_surface(SurfaceKind kind, const SurfaceFrame& frame);

}  // namespace trueaxis
