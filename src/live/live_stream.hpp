// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <unordered_map>
#include <vector>

#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// Senses of a motion: −1, 0, +1.
int turning_of(std::uint32_t motion);
int feed_of(std::uint32_t motion);

/// How spindle and slide move at a reading, as one number: senses of C and Z, and the speed of C in
/// steps of 5 %.
class Motion {
 public:
  /// @param time_s that of a stream without times is 0
  std::uint32_t at(double c_rad, double z_mm, double time_s);

 private:
  bool started_ = false;
  double c_ = 0.0, time_ = 0.0, z_turned_ = 0.0;  ///< of the reading before; Z at the last turn
  double c_step_ = 0.0, time_step_ = 0.0;         ///< means of the last readings
  std::uint32_t feed_ = 1;
};

/// What the ideal fit reads at (C, Z), rad and mm.
using IdealReading = std::function<double(double c_rad, double z_mm)>;

/// A stream while it arrives. All readings are kept up to `most`. From then on a kept reading
/// stands for the `stride` readings next to it in C and Z, of the same set-up, senses and speed:
/// its value is the ideal fit there plus the mean deviation of all of them (Eq. 325). So the kept
/// ones hold the information of all, and the memory stays. Without an ideal fit every stride-th
/// reading is kept as it is.
class LiveStream {
 public:
  static constexpr std::size_t most_recent = 200000;  ///< some ten seconds of a fast probe

  explicit LiveStream(std::size_t most);

  /// The next readings, of one and the same recording: C goes on.
  void add(ProbeStream next);
  /// The first one given before something is thinned counts.
  void average_about(IdealReading ideal);

  /// In the order of arrival. Means are in that of their place, as if the part had been probed by a
  /// few passes, a band of Z per revolution: then there is neither a time nor a pass column.
  ProbeStream kept() const;
  std::size_t size() const { return rows_.size(); }
  std::size_t readings() const { return readings_; }  ///< that arrived
  std::size_t stride() const { return stride_; }      ///< 1: nothing was thinned
  bool averages() const { return stride_ > 1 && ideal_; }
  double turns() const;
  /// Readings that are in no mean yet; with those that are kept it is the memory.
  std::size_t open() const { return open_.size(); }
  /// At most `count` of those that are kept, spread evenly, but at no period of the sampling.
  ProbeStream sample(std::size_t count) const;
  /// The same of the latest readings, of which none is thinned.
  ProbeStream recent(std::size_t count) const;
  /// The last readings as they arrived, at most `count`.
  ProbeStream last(std::size_t count) const;

 private:
  struct Reading {
    double value_mm, c_rad, position_mm, time_s;
    int pass, setup;
    std::uint32_t motion;
    std::uint64_t arrival;
  };
  struct Mean {
    Reading first;
    double ideal_mm = 0.0, deviation_mm = 0.0;  ///< at `first`; their sum
    std::size_t count = 0;
    Reading reading() const;
  };

  void put(const Reading& reading);
  void gather(const Reading& reading, std::size_t count);
  void thin();
  std::uint64_t cell_of(const Reading& reading) const;
  std::vector<Mean> means() const;
  std::vector<Reading> in_passes() const;
  ProbeStream stream_of(std::vector<Reading> readings) const;
  template <class Readings>
  ProbeStream sample_of(const Readings& from, std::size_t begin, std::size_t count) const;

  struct Columns {
    bool position = false, time = false, pass = false, setup = false;
  };

  ProbeStream head_;  ///< all that is not a column
  Columns has_;
  std::vector<Reading> rows_;
  std::deque<Reading> recent_;
  std::unordered_map<std::uint64_t, Mean> open_;
  IdealReading ideal_;
  Motion motion_;
  double c_first_ = 0.0, c_last_ = 0.0;
  double z_low_ = 0.0, band_mm_ = 1.0, sectors_ = 1.0;
  std::size_t most_, readings_ = 0, stride_ = 1;
};

}  // namespace trueaxis
