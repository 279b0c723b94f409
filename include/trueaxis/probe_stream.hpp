// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace trueaxis {

/// What was done to part and probe before the readings of a set-up, as the stream states it
/// (`setup.2.reindex: 70 deg`, …). All of it is against the part as it was first clamped.
struct SetUp {
  int number = 1;            ///< as in the column `setup`
  double reindex_rad = 0.0;  ///< the part turned about its own axis in the sense of C, as the
                             ///< spindle turns it: a mark at C = 10° is then at 10° − this
  double z_shift_mm = 0.0;   ///< the part moved along Z
  bool rear = false;         ///< probed at the smaller X
  double x_jog_mm = 0.0;     ///< slide moved in X, sensor and machine still adding up to X_M
  double clamp_force_ratio = 1.0;  ///< over the force of the first clamping

  /// Whether the part is in the chuck as in `other`: side and jog do not move the part.
  bool clamped_as(const SetUp& other) const {
    return reindex_rad == other.reindex_rad && z_shift_mm == other.z_shift_mm &&
           clamp_force_ratio == other.clamp_force_ratio;
  }
  /// Whether the part was taken out, shifted or clamped anew: it then has an axis of its own.
  bool moved() const { return !clamped_as(SetUp{}); }

  bool operator==(const SetUp&) const = default;
};

/// What the probe moves along while it reads.
enum class StreamKind {
  lateral,  ///< reads X_M (radius) at (C, Z): cone, cylinder, section
  face,     ///< reads Z_M at (C, X): plane
};

/// Whether readings are positions or only differences.
enum class Indication {
  absolute,  ///< X_M is the machine position of the contact (or of the ball's centre)
  relative,  ///< a gauge: X_M up to an unknown constant; a nominal radius is needed
};

/// The source that states whether the X of a file is a radius or a diameter.
enum class SaidBy { nobody, stream, option, job };

/// What the X of a file (X_M, or X of a face) was taken as. In a ProbeStream it is a radius always.
struct XConvention {
  bool diameter = false;
  SaidBy said_by = SaidBy::nobody;
  bool operator==(const XConvention&) const = default;
};

const char* to_string(SaidBy said_by);

/// A probe stream, structure of arrays; every column has `size()` entries or none.
/// Machine frame, mm, rad, s; X_M is a radius. Nothing is dropped: row i of the file is entry i.
struct ProbeStream {
  StreamKind kind = StreamKind::lateral;
  Indication indication = Indication::absolute;
  std::vector<double> reading_mm;  ///< X_M, or Z_M for a face
  std::vector<double>
      c_rad;  ///< spindle angle, running (a wrapped column is unwrapped by the reader)
  std::vector<double> position_mm;  ///< Z, or X for a face; empty: one section without Z
  std::vector<double> time_s;       ///< empty when the stream has no t
  std::vector<int> pass;            ///< empty when the stream has no pass column
  std::vector<int> setup;           ///< empty when the stream has no setup column

  /// Several sensors of one recording (X_M1, X_M2 …): `reading_mm` is of the first, these are of
  /// the others at the same instants. Such a stream belongs to separate_spindle() (spindle.hpp).
  std::vector<std::vector<double>> more_reading_mm;
  /// The angle of each sensor, the first included, from +X towards +Y; each reads outwards from the
  /// spindle axis. Empty for a stream of the one sensor X_M at +X.
  std::vector<double> sensor_angles_rad;

  /// One for every number in the column `setup`, in order of number (see list_set_ups); without the
  /// column one, number 1.
  std::vector<SetUp> setups{SetUp{}};

  std::optional<double> nominal_radius_mm;  ///< metadata nominal_radius
  std::optional<double> sensor_noise_mm;    ///< metadata sensor_noise, standard deviation
  std::optional<double>
      ball_radius_mm;  ///< metadata ball_radius: the readings are of the ball's centre
  std::optional<double> spindle_rpm;            ///< metadata spindle_rpm, signed like C
  std::map<std::string, std::string> metadata;  ///< every "# key: value", those above included

  /// Of a stream that was read from a file.
  std::optional<XConvention> x_convention;

  /// How the stream was made of another program's recording, in sentences.
  std::vector<std::string> read_as;

  std::string source;      ///< file name, or "-" for standard input
  std::string input_hash;  ///< "xxh3-64:<16 hex digits>" of the bytes read

  std::size_t size() const { return reading_mm.size(); }
  bool has_position() const { return !position_mm.empty(); }
};

/// The set-up of a reading. A number that `setups` does not hold: as first clamped.
SetUp set_up_of(const ProbeStream& stream, std::size_t reading);

/// The set-ups that occur in the column `setup`, in order of number, as `setups` states them; those
/// it does not hold are as first clamped. A stream without the column: number 1.
std::vector<SetUp> list_set_ups(const ProbeStream& stream);

}  // namespace trueaxis
