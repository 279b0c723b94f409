// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace trueaxis::form {

/// Deviations along one coordinate: round a section (angle in rad, period 2π) or along a line
/// (mm, period 0: open). `at` rises; in a closed trace it lies in [0, period).
struct Trace {
  std::vector<double> at;
  std::vector<double> value_mm;
  double period = 0.0;

  bool closed() const { return period > 0.0; }
  std::size_t size() const { return at.size(); }
  /// From reading i to the next one; of a closed trace the last is followed by the first.
  double step(std::size_t i) const;
};

/// A stretch without readings that a filter does not bridge.
struct Gap {
  std::size_t after = 0;  ///< the reading before it
  double from = 0.0, length = 0.0;
};

/// The steps of a trace that are longer than `longest`, in order. The ends of an open trace do not
/// count.
std::vector<Gap> gaps_of(const Trace& trace, double longest);

/// What each reading stands for, half the way to its neighbours on either side: the weights of the
/// trapezoidal rule. Next to a gap or an end the other side counts twice.
std::vector<double> shares_of(const Trace& trace, double longest_step);

/// In order of `at`. Readings nearer to each other than a tenth of the mean step of one of `turns`
/// are averaged, in place and value. (A wave of 7 readings keeps 0.9997, one of 20 keeps 0.99996.)
/// So are those within extent / `most` if that is not 0.
Trace sorted_trace(std::span<const double> at, std::span<const double> value_mm, double period,
                   double turns = 1.0, std::size_t most = 0);

}  // namespace trueaxis::form
