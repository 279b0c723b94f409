// SPDX-License-Identifier: Apache-2.0
#include "fit/joint_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trueaxis {
namespace {

/// The readings of one part, without what the kernels do not look at.
ProbeStream taken(const ProbeStream& stream, const std::vector<std::size_t>& rows) {
  ProbeStream out;
  out.kind = stream.kind;
  out.indication = stream.indication;
  const auto take = [&](const std::vector<double>& from, std::vector<double>& to) {
    if (from.empty()) return;
    to.reserve(rows.size());
    for (const std::size_t row : rows) to.push_back(from[row]);
  };
  take(stream.reading_mm, out.reading_mm);
  take(stream.c_rad, out.c_rad);
  take(stream.position_mm, out.position_mm);
  return out;
}

std::size_t index_of(std::span<const std::string_view> names, std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

/// How much longer a piece of the axis is than its height.
double stretch(double slope_x, double slope_y) {
  const double square = slope_x * slope_x + slope_y * slope_y;
  return square / (1.0 + std::sqrt(1.0 + square));
}

}  // namespace

JointModel::JointModel(const ProbeStream& stream, const std::vector<PlacedSetUp>& set_ups,
                       const CatalogueEntry& surface, const SurfaceFrame& frame)
    : info_(surface.info), size_(stream.size()) {
  place_frames(stream, set_ups, frame);
  for (const PlacedSetUp& placed : set_ups) {
    if (placed.clamping == first_.size()) first_.push_back(placed.set_up);
    if (part_index(placed) < parts_.size()) continue;
    JointPart& part = parts_.emplace_back();
    part.clamping = placed.clamping;
    part.root = placed.root;
    SurfaceFrame from_side = frames_[placed.clamping];
    from_side.root = placed.root;
    part.surface = surface.make(from_side);
  }
  if (parts_.size() == 1) {
    parts_.front().prepared = std::make_unique<PreparedStream>(stream);
  } else {
    for (std::size_t row = 0; row < stream.size(); ++row) {
      const auto at =
          std::ranges::lower_bound(set_ups, stream.setup[row], {},
                                   [](const PlacedSetUp& placed) { return placed.set_up.number; });
      parts_[part_index(*at)].rows.push_back(row);
    }
    for (JointPart& part : parts_) {
      part.readings = std::make_unique<ProbeStream>(taken(stream, part.rows));
      part.prepared = std::make_unique<PreparedStream>(*part.readings);
      part.reach = frames_[part.clamping].half_length_mm * static_cast<double>(part.rows.size());
    }
  }
  working_names_ = parts_.front().surface->working_names();
  radius_ = index_of(working_names_, "radius");
  tan_ = index_of(working_names_, "tan_half_angle");
  slope_ = index_of(working_names_, "slope_x");
  own_ = std::min(radius_, tan_);
  for (std::size_t c = 0; c < clampings(); ++c) {
    for (std::size_t i = 0; i < own_; ++i) {
      names_.emplace_back(working_names_[i]);
      if (clampings() > 1) names_.back() += " (" + set_up_name(first_[c]) + ")";
    }
  }
  names_.insert(names_.end(), working_names_.begin() + static_cast<std::ptrdiff_t>(own_),
                working_names_.end());
}

void JointModel::reload_readings(const ProbeStream& stream) {
  for (JointPart& part : parts_) {
    for (std::size_t i = 0; i < part.rows.size(); ++i)
      part.readings->reading_mm[i] = stream.reading_mm[part.rows[i]];
    part.prepared->reload_readings();
  }
}

void JointModel::place_frames(const ProbeStream& stream, const std::vector<PlacedSetUp>& set_ups,
                              const SurfaceFrame& frame) {
  const std::size_t count = set_ups.back().clamping + 1;
  frames_.assign(count, frame);
  middle_mm_.assign(count, 0.0);
  if (!stream.has_position()) return;
  const auto ranges = probed_ranges(stream, set_ups);
  double lowest = ranges.front()[0], highest = ranges.front()[1];
  for (const auto& [low, high] : ranges) {
    lowest = std::min(lowest, low);
    highest = std::max(highest, high);
  }
  ref_mm_ = 0.5 * (lowest + highest);
  // The nominal radius of a gauge is that of the part's middle.
  const bool at_ref = frame.indication == Indication::relative;
  for (const PlacedSetUp& placed : set_ups) {
    const auto [low, high] = ranges[placed.clamping];
    middle_mm_[placed.clamping] = at_ref ? ref_mm_ : 0.5 * (low + high);
    frames_[placed.clamping].position_ref_mm = middle_mm_[placed.clamping] + placed.z_shift_mm;
    frames_[placed.clamping].half_length_mm = 0.5 * (high - low);
    last_range_mm_ = {low + placed.z_shift_mm, high + placed.z_shift_mm};
  }
}

double JointModel::beyond_ref(std::size_t clamping, double slope_x, double slope_y) const {
  const double middle = middle_mm_[clamping];
  return middle - ref_mm_ + middle * stretch(slope_x, slope_y);
}

std::size_t JointModel::part_index(const PlacedSetUp& set_up) const {
  const auto at = std::ranges::find_if(parts_, [&](const JointPart& part) {
    return part.clamping == set_up.clamping && part.root == set_up.root;
  });
  return static_cast<std::size_t>(at - parts_.begin());
}

std::size_t JointModel::joint_index(std::size_t clamping, std::size_t working_index) const {
  return working_index < own_ ? clamping * own_ + working_index
                              : (clampings() - 1) * own_ + working_index;
}

std::vector<double> JointModel::scale_mm(const std::vector<double>& joint) const {
  std::vector<double> scale(parameter_count(), 0.0);
  for (const JointPart& part : parts_) {
    const std::vector<double> of_part = part.surface->working_scale_mm(working(joint, part));
    for (std::size_t i = 0; i < of_part.size(); ++i) {
      double& entry = scale[joint_index(part.clamping, i)];
      entry = std::max(entry, of_part[i]);
    }
  }
  return scale;
}

// An axis point at the height z above the shift is z √(1 + slope²) along the axis.
std::vector<double> JointModel::working(std::span<const double> joint,
                                        const JointPart& part) const {
  std::vector<double> out(working_names_.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = joint[joint_index(part.clamping, i)];
  if (shares_taper())
    out[radius_] += out[tan_] * beyond_ref(part.clamping, out[slope_], out[slope_ + 1]);
  return out;
}

Eigen::MatrixXd JointModel::working_jacobian(std::span<const double> joint,
                                             const JointPart& part) const {
  const auto index = [&](std::size_t i) {
    return static_cast<Eigen::Index>(joint_index(part.clamping, i));
  };
  const std::size_t p = working_names_.size();
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(p),
                                              static_cast<Eigen::Index>(parameter_count()));
  for (std::size_t i = 0; i < p; ++i) out(static_cast<Eigen::Index>(i), index(i)) = 1.0;
  if (shares_taper()) {
    const auto row = static_cast<Eigen::Index>(radius_);
    const std::vector<double> w = working(joint, part);
    out(row, index(tan_)) = beyond_ref(part.clamping, w[slope_], w[slope_ + 1]);
    const double secant = 1.0 + stretch(w[slope_], w[slope_ + 1]);
    for (const std::size_t i : {slope_, slope_ + 1})
      out(row, index(i)) = w[tan_] * middle_mm_[part.clamping] * w[i] / secant;
  }
  return out;
}

std::vector<double> JointModel::joined(const std::vector<std::vector<double>>& working) const {
  if (parts_.size() == 1) return working.front();
  std::vector<std::size_t> order(parts_.size());  // those that reach farthest overwrite the others
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return parts_[i].reach; });
  std::vector<double> joint(parameter_count(), 0.0);
  for (const std::size_t i : order) {
    std::vector<double> w = working[i];
    if (shares_taper())
      w[radius_] -= w[tan_] * beyond_ref(parts_[i].clamping, w[slope_], w[slope_ + 1]);
    for (std::size_t j = 0; j < w.size(); ++j) joint[joint_index(parts_[i].clamping, j)] = w[j];
  }
  return joint;
}

std::vector<double> JointModel::mirrored(std::vector<double> joint, std::size_t clamping) const {
  for (std::size_t i = slope_; i < std::min(slope_ + 2, own_); ++i) {
    double& slope = joint[joint_index(clamping, i)];
    slope = -slope;
  }
  return joint;
}

std::vector<double> JointModel::tilted(std::vector<double> joint, std::size_t clamping,
                                       std::array<double, 2> slope) const {
  for (std::size_t i = slope_; i < std::min(slope_ + 2, own_); ++i)
    joint[joint_index(clamping, i)] = slope[i - slope_];
  return joint;
}

bool JointModel::tilt_may_be_mirrored(std::span<const double> joint, std::size_t clamping) const {
  return std::ranges::any_of(parts_, [&](const JointPart& part) {
    return part.clamping == clamping && part.surface->tilt_may_be_mirrored(working(joint, part));
  });
}

NormalMatrix JointModel::accumulate(std::span<const double> joint, const LossScale& loss) const {
  if (parts_.size() == 1) {
    const JointPart& all = parts_.front();
    return trueaxis::accumulate(*all.surface, joint, *all.prepared, loss);
  }
  NormalMatrix out;
  out.parameters = parameter_count();
  out.jtj.assign(out.parameters * out.parameters, 0.0);
  out.jtr.assign(out.parameters, 0.0);
  const auto p = static_cast<Eigen::Index>(out.parameters);
  const auto q = static_cast<Eigen::Index>(working_names_.size());
  Eigen::Map<RowMajorMatrix> jtj(out.jtj.data(), p, p);
  Eigen::Map<Eigen::VectorXd> jtr(out.jtr.data(), p);
  out.curvature = 0.0;
  for (const JointPart& part : parts_) {
    const NormalMatrix of_part =
        trueaxis::accumulate(*part.surface, working(joint, part), *part.prepared, loss);
    if (!of_part.valid) return out;
    const Eigen::MatrixXd a = working_jacobian(joint, part);
    jtj += a.transpose() * Eigen::Map<const RowMajorMatrix>(of_part.jtj.data(), q, q) * a;
    jtr += a.transpose() * Eigen::Map<const Eigen::VectorXd>(of_part.jtr.data(), q);
    out.sum_rho += of_part.sum_rho;
    out.curvature += of_part.curvature * static_cast<double>(part.rows.size());
  }
  out.curvature /= static_cast<double>(size_);  // one loss for all: the parts differ at random
  out.valid = true;
  return out;
}

bool JointModel::residuals(std::span<const double> joint, std::span<double> out_mm) const {
  if (parts_.size() == 1) {
    const JointPart& all = parts_.front();
    return trueaxis::residuals(*all.surface, joint, *all.prepared, out_mm);
  }
  bool valid = true;
  std::vector<double> of_part;
  for (const JointPart& part : parts_) {
    of_part.resize(part.rows.size());
    valid =
        trueaxis::residuals(*part.surface, working(joint, part), *part.prepared, of_part) && valid;
    for (std::size_t i = 0; i < of_part.size(); ++i) out_mm[part.rows[i]] = of_part[i];
  }
  return valid;
}

}  // namespace trueaxis
