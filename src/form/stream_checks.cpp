// SPDX-License-Identifier: Apache-2.0
#include "form/stream_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "math/linear_algebra.hpp"
#include "math/statistics.hpp"
#include "measure/centre_step.hpp"
#include "measure/column_checks.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::form {
namespace {

constexpr double few_deg = 60.0;  // of ten turns in radians, of sixty in turns

class Troubles {
 public:
  explicit Troubles(const ProbeStream& stream) : stream_(stream) {}
  void add(std::string message) { list_.push_back({stream_.source, 0, 0, std::move(message)}); }
  void finish() {
    if (!list_.empty()) throw InputError(std::move(list_));
  }

 private:
  const ProbeStream& stream_;
  std::vector<Diagnostic> list_;
};

bool all_finite(std::span<const double> values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

/// How near `length` is to a whole multiple of `unit`, over `unit`; at least one.
double off_multiple(double length, double unit) {
  const double times = std::max(1.0, std::round(length / unit));
  return std::abs(length / unit - times);
}

/// More is a face, or X and Z exchanged.
constexpr double steepest = 2.0;

/// Readings less a straight line along Z that may be a taper.
std::vector<double> less_taper(const ProbeStream& stream) {
  const auto count = static_cast<Eigen::Index>(stream.size());
  Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(count, 2);
  for (Eigen::Index i = 0; i < count; ++i)
    columns(i, 1) = stream.has_position() ? stream.position_mm[static_cast<std::size_t>(i)] : 0.0;
  const Eigen::Map<const Eigen::VectorXd> reading(stream.reading_mm.data(), count);
  constexpr double rounding = 1e-12;
  const Eigen::VectorXd line = linear::least_squares(columns, Eigen::VectorXd(reading), rounding);
  if (std::abs(line[1]) > steepest) return stream.reading_mm;
  const Eigen::VectorXd left = reading - columns * line;
  return {left.begin(), left.end()};
}

/// Sum of the squared steps from place to place round the part, if an angle is C times `unit`.
double roughness(const ProbeStream& stream, std::span<const double> value_mm, double unit) {
  std::vector<std::pair<double, double>> places;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    const double angle = stream.c_rad[i] * unit;
    places.emplace_back(angle - two_pi * std::floor(angle / two_pi), value_mm[i]);
  }
  std::ranges::sort(places);
  double sum = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i)
    sum += (places[i].second - places[i - 1].second) * (places[i].second - places[i - 1].second);
  return sum;
}

/// Whether the readings round the part are rough as C says, and smooth if it is in degrees.
bool is_smooth_in_degrees(const ProbeStream& stream) {
  constexpr double much = 2.0;  // noise alone is as rough either way
  const std::vector<double> value_mm = less_taper(stream);
  return roughness(stream, value_mm, 1.0) > much * roughness(stream, value_mm, rad_per_deg);
}

/// C in radians under a header of degrees, and the other way round.
void check_angles(const ProbeStream& stream, Troubles& troubles) {
  const auto [low, high] = range_of(stream.c_rad);
  std::vector<double> steps;
  for (std::size_t i = 1; i < stream.size(); ++i)
    steps.push_back(std::abs(stream.c_rad[i] - stream.c_rad[i - 1]));
  const double covered = high - low + median(steps);
  if (covered < 0.5 * two_pi) {
    const double as_said = covered / rad_per_deg;
    const std::string hint = as_said < few_deg && off_multiple(as_said, two_pi) < 0.01
                                 ? ": it looks like radians, write C[rad]"
                             : as_said < few_deg && off_multiple(as_said, 1.0) < 0.01
                                 ? ": it looks like turns, write C[rev]"
                                 : ": probe at least half a turn, and a whole turn for roundness";
    troubles.add(
        fmt::format("C covers only {:.4g}°, and a section needs half a turn{}", as_said, hint));
  } else if (covered > 300.0 && off_multiple(covered, 360.0) < 1e-3 &&
             off_multiple(covered, two_pi) > 1e-2 && is_smooth_in_degrees(stream)) {
    troubles.add(
        fmt::format("C runs over {:.6g} rad, which is not a whole number of turns, while {:.0f} "
                    "degrees are: if it is in degrees, write C[deg]",
                    covered, covered));
  }
}

void check_common(const ProbeStream& stream, Troubles& troubles) {
  if (!stream.more_reading_mm.empty())
    troubles.add(
        "several sensors X_M1, X_M2 …: `trueaxis spindle` separates form and motion of these; give "
        "the form one sensor X_M");
  if (list_set_ups(stream).size() > 1)
    troubles.add("several set-ups: form is assessed for one, so write a stream for each");
  const std::size_t least = stream.has_position() ? 7 : 4;  // one more than what they determine
  if (stream.size() < least)
    troubles.add(fmt::format("{} readings: the form of a {} needs at least {}", stream.size(),
                             stream.has_position() ? "cylinder" : "circle", least));
  if (!all_finite(stream.reading_mm) || !all_finite(stream.c_rad) ||
      !all_finite(stream.position_mm))
    troubles.add("a number is not finite");
  if (std::string why = column_objection(stream); !why.empty()) troubles.add(std::move(why));
  troubles.finish();
  // What hides in the scatter of a reading hides in U of every value.
  const TurnCentres centres = turn_centres(stream, stream.reading_mm);
  const auto step = find_centre_step(centres);
  if (step && step->size_mm > 2.0 * centres.sigma_mm)
    troubles.add(moved_text(weighed_with_delay(*step, stream, stream.reading_mm)));
  troubles.finish();
}

}  // namespace

void expect_sections(const ProbeStream& stream) {
  expects(stream.kind == StreamKind::lateral, "a lateral stream");
  Troubles troubles(stream);
  check_common(stream, troubles);
  if (stream.indication == Indication::absolute) {
    const auto [low, high] = range_of(stream.reading_mm);
    const double form = range_of(less_taper(stream)).length();
    if (low * high <= 0.0 || form > 0.5 * std::max(std::abs(low), std::abs(high)))
      troubles.add(fmt::format(
          "X_M from {:.6g} to {:.6g} mm is not a radius of a section: readings of a gauge need "
          "'# reading: relative' (--relative), with '# nominal_radius: R mm' if it is known",
          low, high));
  }
  check_angles(stream, troubles);
  troubles.finish();
}

void expect_face(const ProbeStream& stream) {
  expects(stream.kind == StreamKind::face, "a stream of a face");
  Troubles troubles(stream);
  check_common(stream, troubles);
  if (stream.position_mm.size() != stream.size()) troubles.add("a face needs the column X");
  check_angles(stream, troubles);
  troubles.finish();
}

}  // namespace trueaxis::form
