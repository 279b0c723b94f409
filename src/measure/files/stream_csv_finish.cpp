// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/number.hpp"
#include "math/statistics.hpp"
#include "measure/files/stream_csv_metadata.hpp"
#include "measure/files/stream_csv_sensors.hpp"
#include "measure/passes.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

void scale(std::vector<double>& column, double factor) {
  if (factor == 1.0) return;
  for (double& value : column) value *= factor;
}

/// Adds whole turns so that no step is longer than half a turn, whatever the sense of rotation.
void unwrap(std::vector<double>& c, double turn) {
  double turns = 0.0, previous = c.front();
  for (double& value : c) {
    const double step = value - previous;
    if (std::abs(step) > 0.5 * turn) turns -= std::round(step / turn);
    previous = value;
    value += turns * turn;
  }
}

/// Refuses angles of no spindle: a number that lost its point or is of another column.
bool refuse_impossible_turning(const std::vector<double>& c, double turn,
                               const std::function<std::size_t(std::size_t)>& line_of_row,
                               CsvDiagnostics& diagnostics) {
  constexpr double most_turned = 1e6;   // turns: 100 minutes at 10 000 rpm
  constexpr double most_counted = 1e9;  // turns: beyond it a double is coarser than a µrad
  const double middle = median(c);
  const auto off = [&](double value) { return std::abs(value - middle) / turn; };
  const auto farthest = std::ranges::max_element(c, {}, off);
  if (off(*farthest) > most_turned) {
    diagnostics.add(line_of_row(static_cast<std::size_t>(farthest - c.begin())), 0,
                    fmt::format("C is {:.10g} here, {:.3g} revolutions from the middle of the "
                                "stream, and a spindle takes 100 minutes for 1e6 at 10 000 rpm: "
                                "correct C, or remove the row",
                                *farthest, off(*farthest)));
    return true;
  }
  const auto far =
      std::ranges::find_if(c, [&](double value) { return std::abs(value) > most_counted * turn; });
  if (far == c.end()) return false;
  diagnostics.add(line_of_row(static_cast<std::size_t>(far - c.begin())), 0,
                  fmt::format("C is {:.10g}, more than 1e9 revolutions, where a double is coarser "
                              "than a µrad: subtract whole revolutions",
                              *far));
  return true;
}

/// What X (X_M, or X of a face) is, and who says so. Unit, metadata and caller must agree.
XConvention x_convention(const CsvHeader& header, const CsvKnownMetadata& known,
                         const StreamReadOptions& options, CsvDiagnostics& diagnostics) {
  const CsvColumn* x =
      header.find(header.kind == StreamKind::face ? CsvRole::position : CsvRole::reading);
  const auto word = [](bool diameter) { return diameter ? "a diameter" : "a radius"; };
  if (x == nullptr) return {};
  if (x->diameter && known.diameter == false) {
    diagnostics.add(header.line, x->character,
                    x->name +
                        " is marked both ways: its unit says a diameter, x_convention in line " +
                        std::to_string(known.diameter_line) + " a radius: keep one");
  }
  const bool said = x->diameter || known.diameter.has_value();
  const bool diameter = x->diameter || known.diameter.value_or(options.diameter.value_or(false));
  if (said && options.diameter && *options.diameter != diameter) {
    diagnostics.add(header.line, x->character,
                    x->name + " is " + word(diameter) + " in the file, but " + options.caller() +
                        " says " + word(*options.diameter) + ": correct one of them");
  }
  const SaidBy caller = options.diameter ? options.diameter_said_by : SaidBy::nobody;
  return {diameter, said ? SaidBy::stream : caller};
}

/// What the file and the caller say of a gauge: they must agree.
void take_gauge(const CsvMetadataReader& metadata, const StreamReadOptions& options,
                ProbeStream& stream, CsvDiagnostics& diagnostics) {
  constexpr double rounding = 1e-9;  // of a length in another unit
  const CsvKnownMetadata& known = metadata.known;
  const auto contradicts = [&](const char* key, const std::string& stated,
                               const std::string& said) {
    diagnostics.add(metadata.line_of(key), 0,
                    fmt::format("{} is {} in the file, but {} says {}: keep one", key, stated,
                                options.caller(), said));
  };
  stream.indication = options.indication.value_or(known.indication.value_or(Indication::absolute));
  if (known.indication.value_or(stream.indication) != stream.indication) {
    const bool relative = stream.indication == Indication::relative;
    contradicts("reading", relative ? "absolute" : "relative", relative ? "relative" : "absolute");
  }
  stream.nominal_radius_mm =
      options.nominal_radius_mm ? options.nominal_radius_mm : known.nominal_radius_mm;
  if (!known.nominal_radius_mm) return;
  const double stated_mm = *known.nominal_radius_mm, said_mm = *stream.nominal_radius_mm;
  if (std::abs(said_mm - stated_mm) > rounding * stated_mm)
    contradicts("nominal_radius", fmt::format("{:.10g} mm", stated_mm),
                fmt::format("{:.10g} mm", said_mm));
}

/// The set-ups that have readings, as the metadata state them; a statement about another is wrong.
void take_set_ups(const CsvHeader& header, const CsvKnownMetadata& known, ProbeStream& stream,
                  CsvDiagnostics& diagnostics) {
  stream.setups.clear();
  for (const auto& [number, set_up] : known.set_ups) stream.setups.push_back(set_up);
  stream.setups = list_set_ups(stream);
  for (const auto& [number, place] : known.set_up_places) {
    if (std::ranges::find(stream.setups, number, &SetUp::number) != stream.setups.end()) continue;
    const std::string name = "setup." + std::to_string(number);
    diagnostics.add(place.line, place.column,
                    header.find(CsvRole::setup) != nullptr
                        ? name + " has no reading: number it as in the column setup, or remove it"
                        : name +
                              " has no reading, as there is no column setup: add the column, or "
                              "remove it");
  }
}

/// A side that is stated as the front, and a reading less than 0, which the rear has.
void expect_front(const CsvKnownMetadata& known, const ProbeStream& stream,
                  CsvDiagnostics& diagnostics) {
  if (stream.kind == StreamKind::face || stream.indication == Indication::relative) return;
  for (const auto& [number, place] : known.set_up_places) {
    const std::string key = "setup." + std::to_string(number) + ".side";
    const auto stated = stream.metadata.find(key);
    if (stated == stream.metadata.end() || stated->second != "front") continue;
    double largest_mm = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < stream.size(); ++i)
      if (stream.setup.empty() || stream.setup[i] == number)
        largest_mm = std::max(largest_mm, stream.reading_mm[i]);
    if (!(largest_mm < 0.0)) continue;
    diagnostics.add(place.line, place.column,
                    key +
                        " is front, but every X_M of the set-up is negative, as on the rear side "
                        "of the spindle axis: correct one");
  }
}

/// What a unit that was mistaken for another makes of a speed: `factor` is that of C over t.
struct MistakenUnit {
  double factor;
  CsvRole column;
  const char* advice;
};
constexpr const char* milliseconds = "t looks like milliseconds: write t[ms]";
constexpr const char* seconds = "t looks like seconds: write t[s]";
constexpr MistakenUnit mistaken_units[] = {
    {rad_per_deg, CsvRole::angle, "C looks like radians: write C[rad]"},
    {1.0 / rad_per_deg, CsvRole::angle, "C looks like degrees: write C[deg]"},
    {rad_per_deg / two_pi, CsvRole::angle, "C looks like turns: write C[rev]"},
    {two_pi / rad_per_deg, CsvRole::angle, "C looks like degrees: write C[deg]"},
    {1.0 / two_pi, CsvRole::angle, "C looks like turns: write C[rev]"},
    {two_pi, CsvRole::angle, "C looks like radians: write C[rad]"},
    {1e-3, CsvRole::time, milliseconds},
    {1e3, CsvRole::time, seconds},
    {60.0, CsvRole::time, "t looks like minutes: write t in seconds, under t[s]"},
    {3600.0, CsvRole::time, "t looks like hours: write t in seconds, under t[s]"}};

/// The speeds from reading to reading while C turns, in ascending order.
std::vector<double> speeds_rpm(const ProbeStream& stream) {
  constexpr std::size_t enough_steps = 10000;  // for a quantile
  std::vector<double> speeds;
  if (stream.time_s.empty()) return speeds;
  for (std::size_t i = 1; i < stream.size(); i += 1 + stream.size() / enough_steps) {
    const double turned_rad = std::abs(stream.c_rad[i] - stream.c_rad[i - 1]);
    const double passed_s = stream.time_s[i] - stream.time_s[i - 1];
    if (turned_rad > 0.0 && passed_s > 0.0) speeds.push_back(turned_rad / passed_s * 60.0 / two_pi);
  }
  std::ranges::sort(speeds);
  return speeds;
}

/// Refuses speeds at which no lathe measures, unless the stream states its own: milliseconds read
/// as seconds make 0.06 rpm of 60, and seconds read as milliseconds 60 000. One reading in twenty
/// may be faster or slower, as if a spindle rests most of the time.
void refuse_impossible_speed(const CsvHeader& header, const ProbeStream& stream,
                             const std::vector<double>& speeds, CsvDiagnostics& diagnostics) {
  constexpr double slowest_rpm = 0.1, fastest_rpm = 1e4;
  const std::size_t few = speeds.size() / 20;
  const double low_rpm = speeds[few], high_rpm = speeds[speeds.size() - 1 - few];
  const bool slow = high_rpm < slowest_rpm;
  if (!slow && low_rpm <= fastest_rpm) return;
  const CsvColumn& time = *header.find(CsvRole::time);
  const double sense = stream.c_rad.back() < stream.c_rad.front() ? -1.0 : 1.0;
  const double rpm = speeds[speeds.size() / 2];
  diagnostics.add(header.line, time.character,
                  fmt::format("C and t give {} rpm, {} s per revolution: {}. If the spindle really "
                              "turns like that, write '# spindle_rpm: {}'",
                              significant(rpm, 4), significant(60.0 / rpm, 3),
                              slow && time.unit.factor == 1.0     ? milliseconds
                              : !slow && time.unit.factor == 1e-3 ? seconds
                                                                  : "check the units of C and t",
                              significant(sense * rpm, 4)));
}

/// Whether a pass turns at `spindle_rpm`: several passes may have speeds of their own. An induction
/// motor slips by up to 5 %, and the next step of a speed override is 10 %.
bool turns_as_stated(const ProbeStream& stream) {
  constexpr double alike = 0.05;
  const double said_rpm = std::abs(*stream.spindle_rpm);
  return std::ranges::any_of(find_passes(stream), [&](const Pass& pass) {
    const double rpm = std::abs(pass.speed_rad_per_s) * 60.0 / two_pi;
    return std::abs(rpm - said_rpm) <= alike * said_rpm;
  });
}

/// Refuses C and t that turn at another speed than `spindle_rpm`: a delay or lag would be one of
/// another angle. The usual speed is neither that of a dwell nor a second one. If it is the stated
/// one times what one unit is in another, a column is not what its header says.
void refuse_mistaken_speed(const CsvHeader& header, const ProbeStream& stream,
                           CsvDiagnostics& diagnostics) {
  constexpr double alike = 0.02;  // a spindle keeps its speed to 2 %
  const std::vector<double> speeds = speeds_rpm(stream);
  if (speeds.empty()) return;
  const double rpm = median(speeds), said_rpm = std::abs(stream.spindle_rpm.value_or(0.0));
  if (said_rpm == 0.0) return refuse_impossible_speed(header, stream, speeds, diagnostics);
  if (turns_as_stated(stream)) return;
  const auto mistaken = std::ranges::find_if(mistaken_units, [&](const MistakenUnit& one) {
    return std::abs(rpm / said_rpm / one.factor - 1.0) <= alike;
  });
  const bool known = mistaken != std::end(mistaken_units);
  diagnostics.add(
      header.line, header.find(known ? mistaken->column : CsvRole::time)->character,
      fmt::format("C and t give {:.4g} rpm, but spindle_rpm states {:.4g}: {}, or "
                  "correct spindle_rpm",
                  rpm, said_rpm, known ? mistaken->advice : "correct the unit of C or t"));
}

/// `spindle_rpm` is signed like C: if C and t always turn against it, one of them is mirrored, and
/// so is y of the axis.
void refuse_mistaken_sense(const CsvHeader& header, const ProbeStream& stream,
                           CsvDiagnostics& diagnostics) {
  if (!stream.spindle_rpm || *stream.spindle_rpm == 0.0) return;
  const double sense = *stream.spindle_rpm;
  double with_rad = 0.0, against_rad = 0.0;
  for (std::size_t i = 1; i < stream.size(); ++i) {
    const double turned_rad = stream.c_rad[i] - stream.c_rad[i - 1];
    (turned_rad * sense > 0.0 ? with_rad : against_rad) += std::abs(turned_rad);
  }
  if (with_rad > 0.0 || against_rad < two_pi) return;
  diagnostics.add(
      header.line, header.find(CsvRole::angle)->character,
      fmt::format("C {} all through, but by spindle_rpm {:.4g} it {}: the axis would be mirrored "
                  "if C has the wrong sign. Correct C, or write "
                  "'# spindle_rpm: {:.4g}'",
                  sense > 0.0 ? "falls" : "grows", sense, sense > 0.0 ? "grows" : "falls", -sense));
}

}  // namespace

bool csv_is_wrapped(const std::vector<double>& c, double turn) {
  if (c.empty()) return false;
  const double slack = 1e-3 * turn;
  const auto [low, high] = std::minmax_element(c.begin(), c.end());
  const bool positive = *low >= -slack && *high <= turn + slack;
  const bool centred = *low >= -0.5 * turn - slack && *high <= 0.5 * turn + slack;
  if (!positive && !centred) return false;
  return std::adjacent_find(c.begin(), c.end(), [&](double a, double b) {
           return std::abs(b - a) > 0.5 * turn;
         }) != c.end();
}

void csv_finish(const CsvHeader& header, const CsvMetadataReader& metadata,
                const StreamReadOptions& options,
                const std::function<std::size_t(std::size_t)>& line_of_row, ProbeStream& stream,
                CsvDiagnostics& diagnostics) {
  const CsvKnownMetadata& known = metadata.known;
  stream.x_convention = x_convention(header, known, options, diagnostics);
  csv_finish_sensors(header, known, options, stream, diagnostics);
  if (diagnostics.any()) return;
  const CsvColumn& angle = *header.find(CsvRole::angle);
  if (stream.c_rad.empty()) {
    diagnostics.add(header.line, 0, "no rows after the header: the stream is empty");
    return;
  }
  const double turn = angle.unit.turn;
  if (refuse_impossible_turning(stream.c_rad, turn, line_of_row, diagnostics)) return;
  if (!angle.running && csv_is_wrapped(stream.c_rad, turn)) unwrap(stream.c_rad, turn);
  const auto [low, high] = std::minmax_element(stream.c_rad.begin(), stream.c_rad.end());
  if (*high - *low < 1e-3 * turn) {
    const auto [least, most] =
        std::minmax_element(stream.reading_mm.begin(), stream.reading_mm.end());
    const bool exchanged = *most - *least > 0.25 * turn && *least > -turn && *most < 1.01 * turn;
    diagnostics.add(header.line, angle.character,
                    exchanged ? fmt::format("C never moves, and the readings run from {:.6g} to "
                                            "{:.6g}: check whether these two columns are exchanged",
                                            *least, *most)
                              : "C never moves: a capture at standstill alone does not locate the "
                                "axis: add readings around the part");
    return;
  }
  const double half = stream.x_convention->diameter ? 0.5 : 1.0;
  const bool face = header.kind == StreamKind::face;
  const double reading_factor = header.find(CsvRole::reading)->unit.factor * (face ? 1.0 : half);
  scale(stream.reading_mm, reading_factor);
  for (auto& column : stream.more_reading_mm) scale(column, reading_factor);
  scale(stream.c_rad, angle.unit.factor);
  if (const CsvColumn* position = header.find(CsvRole::position)) {
    scale(stream.position_mm, position->unit.factor * (face ? half : 1.0));
  }
  if (const CsvColumn* time = header.find(CsvRole::time)) scale(stream.time_s, time->unit.factor);
  stream.kind = header.kind;
  take_gauge(metadata, options, stream, diagnostics);
  stream.sensor_noise_mm = known.sensor_noise_mm;
  stream.ball_radius_mm = known.ball_radius_mm;
  stream.spindle_rpm = known.spindle_rpm;
  refuse_mistaken_speed(header, stream, diagnostics);
  refuse_mistaken_sense(header, stream, diagnostics);
  stream.metadata = metadata.metadata;
  take_set_ups(header, known, stream, diagnostics);
  expect_front(known, stream, diagnostics);
}

}  // namespace trueaxis
