// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "compensate/block_end.hpp"
#include "compensate/nominal_way.hpp"

namespace trueaxis {

/// The way of a G1 block or of a chord: what the control makes between its ends, where the tip then
/// really is (Bohez's interpolation error), and the pieces that keep it near the nominal way.
class BlockPath {
 public:
  /// @param same_setting program frame and tool are those of the move before
  /// @param held axes that the block does not turn
  BlockPath(const CompensationTask& task, const nc::Move& move, const BlockEnd& from,
            const BlockEnd& to, bool same_setting, const HeldAxes& held);

  /// Largest distance of the actual tip from the nominal way, for the program as it was read, and
  /// as it is written in one piece. On an arc the program that was read goes as its control does.
  /// It is right to a hundredth if above `of_interest_mm`, else not more than that.
  double deviation_before_mm(double of_interest_mm) const;
  double deviation_after_mm(double of_interest_mm) const;
  /// The same of the program as it was read on a machine without errors.
  double deviation_nominal_mm() const;

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
  Pieces cut(const std::vector<double>& ends, double of_interest_mm, Tally& tally) const;
  /// How the control goes: its axes or the tip evenly, on the machine with errors or without, or on
  /// the arc of which the move is a chord.
  enum class Motion { even, nominal, arc };
  /// A way from axes to axes, from `begin` to `end` of the move.
  struct Stretch {
    AxisPositions from, to;
    Vector3 from_tip_mm, to_tip_mm;
    Motion motion = Motion::even;
    double begin = 0.0, end = 1.0;
  };
  class ControlWay;
  double deviation_mm(const Stretch& on, double of_interest_mm) const;
  Vector3 written_from_mm() const;

  const CompensationTask& task_;
  const nc::Move& move_;
  const BlockEnd &from_, &to_;
  Setting setting_;
  bool same_setting_;
  HeldAxes held_;
  NominalWay nominal_;
};

}  // namespace trueaxis
