// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "trueaxis/error.hpp"
#include "trueaxis/spindle.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using Complex = std::complex<double>;

constexpr int grid = 3600;  // angles are whole tenths of a degree
constexpr int coarse = 10;  // first searched in steps of 1°
constexpr int most_rounds = 50;

/// κ² of an order from the 3 × 3 matrix AᴴA, its eigenvalues in closed form.
double squared_condition(double m, Complex a, Complex b, double cc, double cs, double ss) {
  const double q = (m + cc + ss) / 3.0;
  const double x = m - q, y = cc - q, z = ss - q;
  const double off = std::norm(a) + std::norm(b) + cs * cs;
  const double p = std::sqrt((x * x + y * y + z * z + 2.0 * off) / 6.0);
  const double det = x * y * z + 2.0 * cs * (a * std::conj(b)).real() - x * cs * cs -
                     y * std::norm(b) - z * std::norm(a);
  const double phi = std::acos(std::clamp(0.5 * det / (p * p * p), -1.0, 1.0)) / 3.0;
  const double least = q + 2.0 * p * std::cos(phi + two_pi / 3.0);
  const double largest = q + 2.0 * p * std::cos(phi);
  return least > 1e-14 * largest ? largest / least : std::numeric_limits<double>::infinity();
}

/// The search for angles in tenths of a degree, the first at 0.
class AngleSearch {
 public:
  explicit AngleSearch(const ProposeOptions& options)
      : apart_(static_cast<int>(std::ceil(options.least_apart_rad / two_pi * grid - 1e-9))) {
    for (int n = options.order_min; n <= options.order_max; ++n) orders_.push_back(n);
    for (int i = 0; i < grid; ++i) unit_.push_back(std::polar(1.0, two_pi * i / grid));
  }

  std::vector<int> best_of(std::size_t sensors) {
    std::vector<int> angles = best_three();
    while (angles.size() < sensors) {
      angles = best_with_one_more(angles);
      descend(angles, coarse);
    }
    for (const int step : {coarse / 2, 2, 1}) descend(angles, step);
    std::ranges::sort(angles);
    return angles;
  }

 private:
  /// The worst κ² over the orders, or anything above `limit` once one order is worse.
  double worst(const std::vector<int>& angles, double limit) {
    double cc = 0.0, cs = 0.0, ss = 0.0, out = 0.0;
    for (const int at : angles) {
      const Complex u = unit(at);
      cc += u.real() * u.real();
      cs += u.real() * u.imag();
      ss += u.imag() * u.imag();
    }
    for (std::size_t k = 0; k < orders_.size(); ++k) {
      Complex a = 0.0, b = 0.0;
      for (const int at : angles) {
        const Complex u = unit(at), turned = std::conj(unit(orders_[k] * at));
        a += turned * u.real();
        b += turned * u.imag();
      }
      out = std::max(out, squared_condition(static_cast<double>(angles.size()), a, b, cc, cs, ss));
      if (out <= limit) continue;
      std::rotate(orders_.begin(), orders_.begin() + static_cast<std::ptrdiff_t>(k),
                  orders_.begin() + static_cast<std::ptrdiff_t>(k) + 1);  // it refuses most
      return out;
    }
    return out;
  }

  std::vector<int> best_three() {
    std::vector<int> best;
    double least = std::numeric_limits<double>::infinity();
    for (int second = 0; second < grid; second += coarse) {
      for (int third = second + coarse; third < grid; third += coarse) {
        const std::vector<int> angles{0, second, third};
        if (!fits(angles)) continue;
        keep_if_better(angles, best, least);
      }
    }
    return best;
  }

  std::vector<int> best_with_one_more(const std::vector<int>& angles) {
    std::vector<int> best;
    double least = std::numeric_limits<double>::infinity();
    for (int at = 0; at < grid; at += coarse) {
      std::vector<int> more = angles;
      more.push_back(at);
      if (fits(more)) keep_if_better(more, best, least);
    }
    if (best.empty())
      throw InputError("advise",
                       "so many sensors do not fit at this separation: use fewer, or reduce it "
                       "(--min-separation-deg)");
    return best;
  }

  /// One sensor after the other to the best place within ± 3 steps (coarse: anywhere).
  void descend(std::vector<int>& angles, int step) {
    double least = worst(angles, std::numeric_limits<double>::infinity());
    for (int round = 0; round < most_rounds; ++round) {
      const double before = least;
      for (std::size_t s = 1; s < angles.size(); ++s) {
        const int from = angles[s], reach = step == coarse ? grid / coarse / 2 : 12;
        for (int k = -reach; k <= reach; ++k) {
          std::vector<int> moved = angles;
          moved[s] = ((from + k * step) % grid + grid) % grid;
          if (fits(moved)) keep_if_better(moved, angles, least);
        }
      }
      if (!(least < before)) return;
    }
  }

  void keep_if_better(const std::vector<int>& angles, std::vector<int>& best, double& least) {
    const double now = worst(angles, least);
    if (now < least || best.empty()) {
      least = now;
      best = angles;
    }
  }

  bool fits(const std::vector<int>& angles) const {
    for (std::size_t i = 0; i < angles.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const int apart = std::abs(angles[i] - angles[j]);
        if (std::min(apart, grid - apart) < std::max(apart_, 1)) return false;
      }
    }
    return true;
  }

  Complex unit(int tenths) const { return unit_[static_cast<std::size_t>(tenths % grid)]; }

  int apart_;
  std::vector<int> orders_;
  std::vector<Complex> unit_;
};

}  // namespace

std::vector<double> propose_sensor_angles(const ProposeOptions& options) {
  expects(
      options.order_min >= 2 && options.order_max >= options.order_min && options.order_max <= 1000,
      "orders from 2 to 1000 at most");
  if (options.sensors < 3 || options.sensors > 8)
    throw InputError("advise",
                     "form, motion along X and along Y are three unknowns: 3 to 8 sensors in one "
                     "set-up (with two, or one, re-index or reverse the part)");
  if (options.sensors * options.least_apart_rad > two_pi * (1.0 + 1e-9))
    throw InputError("advise",
                     "so many sensors do not fit at this separation: use fewer, or reduce it "
                     "(--min-separation-deg)");
  std::vector<double> out;
  for (const int tenths : AngleSearch(options).best_of(static_cast<std::size_t>(options.sensors)))
    out.push_back(two_pi * tenths / grid);
  return out;
}

}  // namespace trueaxis
