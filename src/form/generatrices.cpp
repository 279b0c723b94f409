// SPDX-License-Identifier: Apache-2.0
#include "form/generatrices.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "trueaxis/units.hpp"

namespace trueaxis::form {
namespace {

constexpr int generatrices = 72;

/// The convex hull of points above (sign 1) or below them (−1), at the x of every point.
std::vector<double> hull(std::span<const double> x, std::span<const double> y, double sign) {
  std::vector<std::size_t> corners;
  for (std::size_t i = 0; i < x.size(); ++i) {
    while (corners.size() > 1) {
      const std::size_t a = corners[corners.size() - 2], b = corners.back();
      if (sign * ((x[b] - x[a]) * (y[i] - y[a]) - (x[i] - x[a]) * (y[b] - y[a])) < 0.0) break;
      corners.pop_back();
    }
    corners.push_back(i);
  }
  std::vector<double> out;
  std::size_t next = 0;
  for (const double at : x) {
    while (next + 1 < corners.size() && x[corners[next]] < at) ++next;
    const std::size_t b = corners[next], a = corners[next > 0 ? next - 1 : 0];
    const double length = x[b] - x[a], share = length > 0.0 ? (at - x[a]) / length : 1.0;
    out.push_back(y[a] + share * (y[b] - y[a]));
  }
  return out;
}

}  // namespace

double width_of_zone(std::span<const double> x, std::span<const double> y) {
  const std::vector<double> above = hull(x, y, 1.0), below = hull(x, y, -1.0);
  double widest = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) widest = std::max(widest, above[i] - below[i]);
  return widest;
}

Generatrices::Generatrices(const std::vector<SectionModel>& sections, const AxisLine& axis)
    : sections_(sections.size()) {
  std::iota(sections_.begin(), sections_.end(), std::size_t{0});
  std::ranges::stable_sort(sections_, {}, [&](std::size_t s) { return *sections[s].z_mm(); });
  for (const std::size_t s : sections_) z_mm_.push_back(*sections[s].z_mm());
  for (int g = 0; g < generatrices; ++g) {
    const double at = two_pi * g / generatrices;
    list_.emplace_back();
    for (const std::size_t s : sections_) {
      const SectionModel& section = sections[s];
      const std::vector<double>& angle = section.raw().at;
      const auto [x0, y0] = axis.at(*section.z_mm());
      const auto base = [&](std::size_t i) {
        return section.radius_mm() + (section.x_mm() - x0) * std::cos(angle[i]) +
               (section.y_mm() - y0) * std::sin(angle[i]);
      };
      const std::size_t n = angle.size();
      const auto behind =
          static_cast<std::size_t>(std::ranges::lower_bound(angle, at) - angle.begin()) % n;
      const std::size_t before = (behind + n - 1) % n;
      const double t = std::remainder(at - angle[before], two_pi) / section.raw().step(before);
      list_.back().push_back({before, behind, t, (1.0 - t) * base(before) + t * base(behind)});
    }
  }
}

double Generatrices::straightness_mm(const std::vector<std::vector<double>>& filtered_mm) const {
  double largest = 0.0;
  std::vector<double> y(sections_.size());
  for (const std::vector<Crossing>& one : list_) {
    for (std::size_t k = 0; k < y.size(); ++k) {
      const auto& [before, behind, share, base_mm] = one[k];
      const std::vector<double>& profile = filtered_mm[sections_[k]];
      y[k] = base_mm + (1.0 - share) * profile[before] + share * profile[behind];
    }
    largest = std::max(largest, width_of_zone(z_mm_, y));
  }
  return largest;
}

}  // namespace trueaxis::form
