// SPDX-License-Identifier: Apache-2.0
#include "measure/passes_motion.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <span>

#include "base/stop.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t window_readings = 32;

/// Limits between which the tolerance of an axis lies, in its unit.
struct ToleranceLimits {
  double least, most;
};

double tolerance(double noise, const ToleranceLimits& limits) {
  return std::max(limits.least, std::min(10.0 * noise, limits.most));
}

double second_difference(std::span<const double> y, std::size_t middle) {
  return y[middle - 1] - 2.0 * y[middle] + y[middle + 1];
}

/// Standard deviation of white noise on a path of straight pieces: median |second difference| over
/// 0.6745 sqrt(6); a few jumps and turns do not change it.
double robust_noise(std::span<const double> y) {
  if (y.size() < 3) return 0.0;
  std::vector<double> bends;
  const std::size_t stride = 1 + y.size() / 100000;
  for (std::size_t i = 1; i + 1 < y.size(); i += stride) {
    bends.push_back(std::abs(second_difference(y, i)));
  }
  return median(std::move(bends)) / (0.6745 * std::sqrt(6.0));
}

/// Range and noise of y over a window whose two ends only move forward.
class SlidingWindow {
 public:
  explicit SlidingWindow(std::span<const double> y) : y_(y) {}

  void move_to(std::size_t begin, std::size_t end) {
    for (; end_ < end; ++end_) {
      while (!highs_.empty() && y_[highs_.back()] <= y_[end_]) highs_.pop_back();
      while (!lows_.empty() && y_[lows_.back()] >= y_[end_]) lows_.pop_back();
      highs_.push_back(end_);
      lows_.push_back(end_);
      if (end_ >= begin_ + 2) squares_ += bend_squared(end_ - 1);
    }
    for (; begin_ < begin; ++begin_) {
      if (begin_ + 2 < end_) squares_ -= bend_squared(begin_ + 1);
      if (highs_.front() == begin_) highs_.pop_front();
      if (lows_.front() == begin_) lows_.pop_front();
    }
  }
  double range() const { return y_[highs_.front()] - y_[lows_.front()]; }
  double noise() const {
    const std::size_t count = end_ - begin_;
    if (count < 3) return 0.0;
    return std::sqrt(std::max(0.0, squares_) / (6.0 * static_cast<double>(count - 2)));
  }

 private:
  double bend_squared(std::size_t i) const {
    const double bend = second_difference(y_, i);
    return bend * bend;
  }
  std::span<const double> y_;
  std::deque<std::size_t> highs_, lows_;
  std::size_t begin_ = 0, end_ = 0;
  double squares_ = 0.0;
};

/// Senses of the steps [begin, end) of y by its turning points: a turn counts once y has come back
/// by more than `back`.
void sign_by_turns(std::span<const double> y, std::size_t begin, std::size_t end, double back,
                   std::span<signed char> signs) {
  std::size_t start = begin, low = begin, high = begin;
  signed char sense = 0;
  const auto fill = [&](std::size_t until) {
    std::fill(signs.begin() + static_cast<std::ptrdiff_t>(start),
              signs.begin() + static_cast<std::ptrdiff_t>(until), sense);
    start = until;
  };
  for (std::size_t i = begin + 1; i <= end; ++i) {
    if (y[i] > y[high]) high = i;  // the first of equal ones: what follows a pause is the next pass
    if (y[i] < y[low]) low = i;
    if (sense <= 0 && y[i] - y[low] > back) {
      if (sense < 0) fill(low);
      sense = 1;
      high = i;
    } else if (sense >= 0 && y[high] - y[i] > back) {
      if (sense > 0) fill(high);
      sense = -1;
      low = i;
    }
  }
  fill(end);
}

/// Senses of the steps of y. `window_end(i)` is the end of the window that starts at reading i, or
/// 0 where none does.
template <class WindowEnd>
void sign_stretch(std::span<const double> y, const WindowEnd& window_end,
                  const ToleranceLimits& limits, double noise, std::span<signed char> signs) {
  constexpr signed char moving = 2;
  std::fill(signs.begin(), signs.end(), moving);
  SlidingWindow window(y);
  std::size_t rest_until = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const std::size_t end = window_end(i);
    if (end == 0) break;
    window.move_to(i, end);
    if (window.range() > tolerance(window.noise(), limits)) continue;
    for (std::size_t k = std::max(i, rest_until); k + 1 < end; ++k) signs[k] = 0;
    rest_until = end - 1;
  }
  const double back = tolerance(noise, limits);
  for (std::size_t begin = 0; begin < signs.size();) {
    std::size_t end = begin;
    while (end < signs.size() && signs[end] == moving) ++end;
    if (end > begin) sign_by_turns(y, begin, end, back, signs);
    begin = std::max(end, begin + 1);
  }
}

/// Window of `count` readings, or of all where there are fewer.
auto readings_window(std::size_t size, std::size_t count) {
  return [size, count = std::min(size, count)](std::size_t i) {
    return i + count <= size ? i + count : std::size_t{0};
  };
}

/// Window of one turn of c, or of all where there is less.
class TurnWindow {
 public:
  explicit TurnWindow(std::span<const double> c) : c_(c) {}
  std::size_t operator()(std::size_t i) const {
    while (end_ < c_.size() && std::abs(c_[end_] - c_[i]) < 0.999 * two_pi) ++end_;
    if (end_ < c_.size()) return end_ + 1;
    return i == 0 ? c_.size() : 0;
  }

 private:
  std::span<const double> c_;
  mutable std::size_t end_ = 0;
};

/// Whether the feed step from reading i to i + 1 is a positioning move.
bool is_positioning(std::span<const double> c, std::span<const double> z, std::size_t i,
                    double least) {
  const double step = std::abs(z[i + 1] - z[i]);
  const double most = 0.25 * step;
  if (step <= least) return false;
  const auto still = [&](std::size_t from, std::ptrdiff_t direction) {
    double low = z[from], high = z[from], farthest = 0.0;
    for (std::size_t k = from, n = 0; k < z.size(); k += static_cast<std::size_t>(direction), ++n) {
      const double turned = std::abs(c[k] - c[from]);
      farthest = std::max(farthest, turned);
      const bool returns = turned < farthest - 0.1;
      const bool rests = n > window_readings && turned < 1e-4;
      if (turned > 0.95 * two_pi || returns || rests) break;
      // The next positioning move, where C turns back.
      const std::size_t before = k - static_cast<std::size_t>(direction);
      if (farthest > 0.5 && std::abs(c[k] - c[before]) < 1e-4 &&
          std::abs(z[k] - z[before]) > most) {
        break;
      }
      low = std::min(low, z[k]);
      high = std::max(high, z[k]);
      if (high - low > most) return false;
    }
    return true;
  };
  return still(i, -1) && still(i + 1, 1);
}

/// Steps along Z at rest in C (a generatrix at a time): four readings within 1e-4 rad that go on by
/// a thousandth of all travel or more.
void rest_on_generatrices(std::span<const double> c, std::span<const double> z,
                          std::span<signed char> c_signs) {
  const auto [low, high] = std::minmax_element(z.begin(), z.end());
  const double least = std::max(0.05, 1e-3 * (*high - *low));
  for (std::size_t i = 0; i + 3 < z.size(); ++i) {
    const auto [c_low, c_high] = std::minmax({c[i], c[i + 1], c[i + 2], c[i + 3]});
    if (c_high - c_low > 1e-4 || std::abs(z[i + 3] - z[i]) < least) continue;
    for (std::size_t k = i; k < i + 3; ++k) c_signs[k] = 0;
  }
}

/// Senses of the feed steps where C keeps its sense, between positioning moves.
class FeedSigner {
 public:
  FeedSigner(std::span<const double> c, std::span<const double> z, StepSigns& signs)
      : c_(c), z_(z), signs_(signs), jumps_(z.size(), false) {
    constexpr double least_mm = 5e-3, coarsest_resolution_mm = 0.05;
    double resolution_mm = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < z.size(); ++i) {
      jumps_[i] = is_positioning(c, z, i, least_mm);
      const double step = std::abs(z[i + 1] - z[i]);
      if (!jumps_[i] && step > 0.0) resolution_mm = std::min(resolution_mm, step);
    }
    const double floor_mm = resolution_mm <= coarsest_resolution_mm
                                ? std::max(least_mm, 1.01 * resolution_mm)
                                : least_mm;
    limits_ = {floor_mm, std::max(floor_mm, coarsest_resolution_mm)};
    noise_ = robust_noise(z);
  }

  void sign_all() {
    for (std::size_t begin = 0; begin + 1 < z_.size();) {
      if (jumps_[begin]) {
        signs_.feed[begin] = z_[begin + 1] > z_[begin] ? 1 : -1;
        ++begin;
        continue;
      }
      std::size_t end = begin + 1;
      while (end + 1 < z_.size() && !jumps_[end] && signs_.c[end] == signs_.c[begin]) ++end;
      piece(begin, end);
      begin = end;
    }
  }

 private:
  /// Steps [begin, end), readings begin to end.
  void piece(std::size_t begin, std::size_t end) {
    const std::size_t count = end - begin + 1;
    const auto z = z_.subspan(begin, count);
    const auto signs = std::span(signs_.feed).subspan(begin, count - 1);
    if (signs_.c[begin] != 0) {
      sign_stretch(z, TurnWindow(c_.subspan(begin, count)), limits_, noise_, signs);
    } else {
      const std::size_t window = std::max(window_readings, count / 50);
      sign_stretch(z, readings_window(count, window), limits_, noise_, signs);
    }
  }

  std::span<const double> c_, z_;
  StepSigns& signs_;
  std::vector<bool> jumps_;
  ToleranceLimits limits_{};
  double noise_ = 0.0;
};

}  // namespace

StepSigns find_step_signs(const ProbeStream& stream, std::size_t begin, std::size_t end) {
  stop_if_asked();
  const std::size_t count = end - begin;
  StepSigns signs;
  signs.c.assign(count - 1, 0);
  signs.feed.assign(count - 1, 0);
  const auto c = std::span(stream.c_rad).subspan(begin, count);
  constexpr ToleranceLimits c_limits{1e-4, 0.1};
  sign_stretch(c, readings_window(count, window_readings), c_limits, robust_noise(c), signs.c);
  if (!stream.has_position()) return signs;
  const auto z = std::span(stream.position_mm).subspan(begin, count);
  rest_on_generatrices(c, z, signs.c);
  FeedSigner(c, z, signs).sign_all();
  return signs;
}

}  // namespace trueaxis
