// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "compensate/block_end.hpp"

namespace trueaxis {

/// The way of a G1 block: what the control makes between its ends, where the tip then really is
/// (Bohez's interpolation error), and the pieces that keep it near the line of the nominal tip.
class BlockPath {
 public:
  BlockPath(const CompensationTask& task, const nc::Move& move, const BlockEnd& from,
            const BlockEnd& to);

  /// Largest distance, at quarters of the way, of the actual tip from the line between the nominal
  /// ends: of the program as it was read, and as it is written in one piece. Where the middle is
  /// below `of_interest_mm` it stands for the quarters, which an even curve has below it.
  double deviation_before_mm(double of_interest_mm) const;
  double deviation_after_mm(double of_interest_mm) const;

  /// The positions (words, rounded by whoever writes them) that cut the block in pieces, few more
  /// than its curvature asks for the tolerance, and the deviation that is left. Pieces are equal
  /// under G93, where each takes its share of the time, and else shorter where the way is more
  /// curved. What cannot be reached or kept is noted.
  std::vector<nc::AxisValues> split(double tolerance_mm, double& deviation_mm, Tally& tally) const;

 private:
  struct Pieces {
    std::vector<nc::AxisValues> words;  ///< at the ends of all but the last
    std::vector<double> deviation_mm;   ///< of each
    bool reached = true;
  };
  Pieces cut(const std::vector<double>& ends, Tally& tally) const;
  double off_at_ends_mm() const;
  double deviation_mm(const AxisPositions& from, const AxisPositions& to,
                      double of_interest_mm = 0.0) const;
  double distance_mm(const Vector3& tip) const;
  AxisPositions between(const AxisPositions& from, const AxisPositions& to, double s) const;
  Vector3 tip_at(double s) const;

  const CompensationTask& task_;
  const nc::Move& move_;
  const BlockEnd &from_, &to_;
  Setting setting_;
  Vector3 start_mm_{}, end_mm_{};  ///< nominal tips, in the frame of the block
};

}  // namespace trueaxis
