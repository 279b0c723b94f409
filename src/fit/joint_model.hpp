// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "fit/place_set_ups.hpp"
#include "model/normal_matrix.hpp"
#include "surface/catalogue.hpp"
#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The readings of one clamping from one side, with the surface that they are of.
struct JointPart {
  std::size_t clamping = 0;
  Root root = Root::front;
  std::vector<std::size_t> rows;          ///< of the stream; empty: all of it
  std::unique_ptr<ProbeStream> readings;  ///< of these rows; none where they are the whole stream
  std::unique_ptr<PreparedStream> prepared;
  std::unique_ptr<Surface> surface;
  double reach = 0.0;  ///< probed length × readings: how well it determines a start
};

/// The surfaces of all set-ups as one. Every clamping has an axis (or gauge offset, or face) of its
/// own, taken in the middle of its readings and first in the joint parameters; radius and half
/// angle follow, which all share. They belong to the part: radius(s) = radius + tan · (s − ref), s
/// along the axis from where it pierces the plane Z = z_shift, ref the middle of all readings. One
/// clamping: the parameters are the working parameters of the surface themselves (Eqs. 29, 30).
class JointModel {
 public:
  /// All of `frame` but side and positions, which are those of each set-up. The stream must outlive
  /// the model.
  JointModel(const ProbeStream& stream, const std::vector<PlacedSetUp>& set_ups,
             const CatalogueEntry& surface, const SurfaceFrame& frame);

  /// The stream's readings are other numbers now; C, positions and set-ups are as they were.
  void reload_readings(const ProbeStream& stream);

  const SurfaceInfo& info() const { return info_; }
  std::size_t parameter_count() const { return names_.size(); }
  std::size_t size() const { return size_; }
  Indication indication() const { return parts_.front().prepared->source().indication; }
  std::size_t clampings() const { return first_.size(); }
  /// Lowest and highest position probed in the last clamping; 0 without positions.
  const std::array<double, 2>& last_range_mm() const { return last_range_mm_; }
  const std::vector<JointPart>& parts() const { return parts_; }
  const JointPart& part_of(const PlacedSetUp& set_up) const { return parts_[part_index(set_up)]; }
  const std::vector<std::string>& names() const { return names_; }
  std::vector<double> scale_mm(const std::vector<double>& joint) const;

  /// Working parameters of a part's surface, and their derivative with respect to the joint ones.
  std::vector<double> working(std::span<const double> joint, const JointPart& part) const;
  Eigen::MatrixXd working_jacobian(std::span<const double> joint, const JointPart& part) const;
  /// Joint parameters from working ones of each part: the shape of the part that reaches farthest.
  std::vector<double> joined(const std::vector<std::vector<double>>& working) const;
  /// The same with the tilt of one clamping reversed.
  std::vector<double> mirrored(std::vector<double> joint, std::size_t clamping) const;
  /// The same with the axis of one clamping at these slopes.
  std::vector<double> tilted(std::vector<double> joint, std::size_t clamping,
                             std::array<double, 2> slope) const;
  bool tilt_may_be_mirrored(std::span<const double> joint, std::size_t clamping) const;

  /// As the functions of these names for one surface; residuals in the order of the stream.
  /// Eq. 20.
  NormalMatrix accumulate(std::span<const double> joint, const LossScale& loss) const;
  bool residuals(std::span<const double> joint, std::span<double> out_mm) const;

 private:
  void place_frames(const ProbeStream& stream, const std::vector<PlacedSetUp>& set_ups,
                    const SurfaceFrame& frame);
  std::size_t part_index(const PlacedSetUp& set_up) const;
  std::size_t joint_index(std::size_t clamping, std::size_t working_index) const;
  /// What the tilt of an axis and its reference place add to s.
  double beyond_ref(std::size_t clamping, double slope_x, double slope_y) const;
  bool shares_taper() const {
    return clampings() > 1 && radius_ < working_names_.size() && tan_ < working_names_.size();
  }

  SurfaceInfo info_;
  std::vector<JointPart> parts_;
  std::size_t size_;
  std::span<const std::string_view> working_names_;
  std::vector<SetUp> first_;  ///< of each clamping
  std::vector<std::string> names_;
  std::size_t own_ = 0;  ///< how many working parameters a clamping has for itself
  std::size_t radius_ = 0, tan_ = 0, slope_ = 0;  ///< working indices; past the end where absent
  double ref_mm_ = 0.0;
  std::vector<double> middle_mm_;  ///< of each clamping, on the part
  std::array<double, 2> last_range_mm_{};
  std::vector<SurfaceFrame> frames_;  ///< of each clamping, the side that of its first set-up
};

}  // namespace trueaxis
