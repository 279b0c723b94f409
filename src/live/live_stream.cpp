// SPDX-License-Identifier: Apache-2.0
#include "live/live_stream.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "math/golden_section.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double means_of_cell = 14.0;     // at least half as many are kept of each
constexpr double sectors_per_band = 14.0;  // form has more waves over C than over Z
constexpr double most_sectors = 3600.0;

}  // namespace

LiveStream::LiveStream(std::size_t most) : most_(most) {
  expects(most >= 2, "two readings or more");
}

void LiveStream::average_about(IdealReading ideal) {
  if (stride_ == 1) ideal_ = std::move(ideal);
}

double LiveStream::turns() const { return std::abs(c_last_ - c_first_) / two_pi; }

void LiveStream::add(ProbeStream next) {
  expects(next.more_reading_mm.empty(), "one sensor");
  if (next.size() == 0) return;
  double whole = 0.0;
  if (readings_ == 0) {
    has_ = {next.has_position(), !next.time_s.empty(), !next.pass.empty(), !next.setup.empty()};
    head_ = next;
    for (auto* column : {&head_.reading_mm, &head_.c_rad, &head_.position_mm, &head_.time_s})
      column->clear();
    for (auto* column : {&head_.pass, &head_.setup}) column->clear();
    c_first_ = next.c_rad.front();
  } else {
    whole = two_pi * std::round((c_last_ - next.c_rad.front()) / two_pi);
  }
  const auto at = [](const auto& column, std::size_t row) {
    return column.empty() ? 0 : column[row];
  };
  for (std::size_t row = 0; row < next.size(); ++row) {
    Reading reading{next.reading_mm[row],
                    next.c_rad[row] + whole,
                    at(next.position_mm, row),
                    at(next.time_s, row),
                    at(next.pass, row),
                    at(next.setup, row),
                    0,
                    readings_++};
    reading.motion = motion_.at(reading.c_rad, reading.position_mm, reading.time_s);
    c_last_ = reading.c_rad;
    recent_.push_back(reading);
    if (recent_.size() > most_recent) recent_.pop_front();
    put(reading);
  }
}

void LiveStream::put(const Reading& reading) {
  const bool full = rows_.size() == most_ || open_.size() > most_;
  if (full) thin();
  if (averages())
    gather(reading, 1);
  else if (reading.arrival % stride_ == 0)
    rows_.push_back(reading);
}

LiveStream::Reading LiveStream::Mean::reading() const {
  Reading mean = first;
  if (count > 1) mean.value_mm = ideal_mm + deviation_mm / static_cast<double>(count);
  return mean;
}

void LiveStream::gather(const Reading& reading, std::size_t count) {
  const std::uint64_t cell = cell_of(reading);
  Mean& mean = open_[cell];
  const double ideal_mm = ideal_(reading.c_rad, reading.position_mm);
  if (mean.count == 0) mean.first = reading, mean.ideal_mm = ideal_mm;
  mean.deviation_mm += static_cast<double>(count) * (reading.value_mm - ideal_mm);
  mean.count += count;
  if (mean.count < stride_) return;
  rows_.push_back(mean.reading());
  open_.erase(cell);
}

void LiveStream::thin() {
  const std::size_t before = std::exchange(stride_, 2 * stride_);
  std::vector<Reading> rows = std::exchange(rows_, {});
  const auto open = std::exchange(open_, {});
  rows_.reserve(most_);
  std::ranges::sort(rows, {}, &Reading::arrival);
  if (!averages()) {
    for (const Reading& row : rows)
      if (row.arrival % stride_ == 0) rows_.push_back(row);
    return;
  }
  const auto [low, high] = std::ranges::minmax(rows, {}, &Reading::position_mm);
  const double cells = std::max(1.0, static_cast<double>(most_) / means_of_cell);
  const double length = high.position_mm - low.position_mm;
  sectors_ = length > 0.0 ? std::sqrt(sectors_per_band * cells) : cells;
  sectors_ = std::floor(std::clamp(sectors_, 1.0, most_sectors));
  z_low_ = low.position_mm;
  band_mm_ = length > 0.0 ? length / std::max(1.0, std::floor(cells / sectors_)) : 1.0;
  for (const Reading& row : rows) gather(row, before);
  for (const auto& [cell, mean] : open) gather(mean.reading(), mean.count);
}

std::uint64_t LiveStream::cell_of(const Reading& reading) const {
  const double turns = reading.c_rad / two_pi, share = turns - std::floor(turns);
  const auto sector = static_cast<std::uint64_t>(share * sectors_);
  const double bands = std::floor((reading.position_mm - z_low_) / band_mm_);
  const auto band = static_cast<std::uint64_t>(std::clamp(bands + 32768.0, 0.0, 65535.0));
  const auto setup = static_cast<std::uint64_t>(reading.setup) & 0xff;
  return (((setup << 16 | reading.motion) << 16 | sector) << 16) | band;
}

ProbeStream LiveStream::stream_of(std::vector<Reading> readings) const {
  std::ranges::sort(readings, {}, &Reading::arrival);
  ProbeStream out = head_;
  const auto fill = [&](auto& column, auto member) {
    column.reserve(readings.size());
    for (const Reading& one : readings) column.push_back(one.*member);
  };
  fill(out.reading_mm, &Reading::value_mm);
  fill(out.c_rad, &Reading::c_rad);
  if (has_.position) fill(out.position_mm, &Reading::position_mm);
  if (has_.time) fill(out.time_s, &Reading::time_s);
  if (has_.pass) fill(out.pass, &Reading::pass);
  if (has_.setup) fill(out.setup, &Reading::setup);
  return out;
}

/// All means, in the order of arrival. Every cell has at most as many as the cells of its motion
/// have in the mean; what is more is in its last one, so that no pass is nearly empty.
std::vector<LiveStream::Mean> LiveStream::means() const {
  std::vector<Mean> all;
  for (const Reading& row : rows_) {
    const double ideal_mm = ideal_(row.c_rad, row.position_mm);
    all.push_back(
        {row, ideal_mm, static_cast<double>(stride_) * (row.value_mm - ideal_mm), stride_});
  }
  for (const auto& [cell, mean] : open_) all.push_back(mean);
  std::ranges::sort(all, {}, [](const Mean& mean) { return mean.first.arrival; });

  struct Share {
    std::size_t cells = 0, means = 0;
  };
  std::map<std::pair<int, std::uint32_t>, Share> shares;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> of_cell;
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::vector<std::size_t>& here = of_cell[cell_of(all[i].first)];
    Share& share = shares[{all[i].first.setup, all[i].first.motion}];
    ++share.means, share.cells += here.empty() ? 1 : 0;
    here.push_back(i);
  }
  for (const auto& [cell, here] : of_cell) {
    const Share& share = shares[{all[here[0]].first.setup, all[here[0]].first.motion}];
    for (std::size_t k = share.means / share.cells; k < here.size(); ++k) {
      Mean& last = all[here[share.means / share.cells - 1]];
      last.deviation_mm += all[here[k]].deviation_mm;
      last.count += std::exchange(all[here[k]].count, 0);
    }
  }
  std::erase_if(all, [this](const Mean& mean) { return 2 * mean.count < stride_; });
  return all;
}

/// The k-th mean of every cell is of pass k: band by band along the feed, sector by sector.
std::vector<LiveStream::Reading> LiveStream::in_passes() const {
  struct Place {
    int setup;
    std::size_t pass;  ///< 0 if C does not turn
    std::uint32_t motion;
    std::int64_t along;  ///< the band, in the order of the feed
    double share;        ///< of the revolution, in the sense of C
    std::uint64_t arrival;
    Reading mean;
    double off_mm;
    auto key() const { return std::tie(setup, pass, motion, along, share, arrival); }
    auto turn() const { return std::tie(setup, pass, motion, along); }
  };
  std::unordered_map<std::uint64_t, std::size_t> met;
  std::vector<Place> places;
  for (const Mean& mean : means()) {
    const Reading& at = mean.first;
    const std::uint64_t cell = cell_of(at);
    const std::size_t pass = met[cell]++;
    const std::int64_t band = static_cast<std::int64_t>(cell & 0xffff) - 32768;
    const double turns = at.c_rad / two_pi, share = turns - std::floor(turns);
    const int turning = turning_of(at.motion);
    places.push_back({at.setup, turning == 0 ? 0 : pass, at.motion,
                      feed_of(at.motion) < 0 ? -band : band, turning < 0 ? 1.0 - share : share,
                      at.arrival, at, mean.deviation_mm / static_cast<double>(mean.count)});
  }
  std::ranges::sort(places, [](const Place& a, const Place& b) { return a.key() < b.key(); });
  std::vector<Reading> out;
  double turn = 0.0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Place& place = places[k];
    if (k > 0 && places[k - 1].turn() != place.turn()) turn += 1.0;
    Reading mean = place.mean;
    const int turning = turning_of(mean.motion), feed = feed_of(mean.motion);
    mean.c_rad = two_pi * (turning < 0 ? -turn - place.share : turn + place.share);
    if (turning != 0 && feed != 0) {
      const double bands = static_cast<double>(place.along) + place.share;
      mean.position_mm = z_low_ + band_mm_ * (feed < 0 ? 1.0 - bands : bands);
    }
    mean.value_mm = ideal_(mean.c_rad, mean.position_mm) + place.off_mm;
    mean.arrival = k;
    out.push_back(mean);
  }
  return out;
}

ProbeStream LiveStream::kept() const {
  if (!averages()) return stream_of(rows_);
  ProbeStream out = stream_of(in_passes());
  out.time_s.clear();
  out.pass.clear();
  if (out.sensor_noise_mm) *out.sensor_noise_mm /= std::sqrt(static_cast<double>(stride_));
  return out;
}

template <class Readings>
ProbeStream LiveStream::sample_of(const Readings& from, std::size_t begin,
                                  std::size_t count) const {
  const std::size_t size = from.size() - begin;
  const double step = std::max(1.0, static_cast<double>(size) / static_cast<double>(count));
  std::vector<Reading> readings;
  for (std::size_t k = 0; k < std::min(size, count); ++k) {
    const double at =
        size > count ? (static_cast<double>(k) + golden_share(k)) * step : static_cast<double>(k);
    readings.push_back(from[begin + std::min(static_cast<std::size_t>(at), size - 1)]);
  }
  return stream_of(std::move(readings));
}

ProbeStream LiveStream::sample(std::size_t count) const { return sample_of(rows_, 0, count); }
ProbeStream LiveStream::recent(std::size_t count) const { return sample_of(recent_, 0, count); }
ProbeStream LiveStream::last(std::size_t count) const {
  return sample_of(recent_, recent_.size() - std::min(count, recent_.size()), count);
}

namespace {

constexpr double share = 1.0 / 64.0;     // of a new step in the mean of the last ones
constexpr double standing_rad = 1e-6;    // a reading
constexpr double turned_mm = 5e-3;       // what counts as feed, as in passes
constexpr double steps_of_speed = 0.05;  // of its logarithm: a latency is that of its speed
constexpr std::uint32_t speeds = 4096;

}  // namespace

int turning_of(std::uint32_t motion) { return static_cast<int>(motion / 3 % 3) - 1; }
int feed_of(std::uint32_t motion) { return static_cast<int>(motion % 3) - 1; }

std::uint32_t Motion::at(double c_rad, double z_mm, double time_s) {
  if (!started_) c_ = c_rad, z_turned_ = z_mm, time_ = time_s;
  const bool second = started_ && c_step_ == 0.0 && time_step_ == 0.0;
  const double weight = second ? 1.0 : share;
  c_step_ += weight * (c_rad - c_ - c_step_);
  time_step_ += weight * (time_s - time_ - time_step_);
  c_ = c_rad, time_ = time_s, started_ = true;
  if (std::abs(z_mm - z_turned_) > turned_mm) {
    feed_ = z_mm > z_turned_ ? 2 : 0;
    z_turned_ = z_mm;
  }
  const std::uint32_t turning = std::abs(c_step_) < standing_rad ? 1 : c_step_ > 0.0 ? 2 : 0;
  std::uint32_t speed = 0;
  if (turning != 1 && time_step_ > 0.0) {
    const double steps = std::log(std::abs(c_step_) / time_step_) / steps_of_speed;
    speed =
        static_cast<std::uint32_t>(std::clamp(std::round(steps) + speeds / 2, 0.0, speeds - 1.0));
  }
  return (speed * 3 + turning) * 3 + feed_;
}

}  // namespace trueaxis
