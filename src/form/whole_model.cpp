// SPDX-License-Identifier: Apache-2.0
#include "form/whole_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "math/statistics.hpp"
#include "trueaxis/error.hpp"
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

namespace {

constexpr int most_realignments = 30;
constexpr double axis_settled_mm = 1e-12;

std::vector<std::vector<double>> profiles_of(const std::vector<SectionModel>& sections) {
  std::vector<std::vector<double>> out;
  for (const SectionModel& section : sections) out.push_back(section.profile_mm());
  return out;
}

}  // namespace

WholeModel::WholeModel(const std::vector<SectionModel>& sections,
                       std::span<const Criterion> criteria, bool in_space)
    : sections_(sections) {
  expects(sections.size() >= 2, "two sections at least");
  double low = 1e300, high = -1e300;
  for (const SectionModel& section : sections) {
    expects(section.radius_known() && section.z_mm().has_value(), "sections of a known radius");
    low = std::min(low, *section.z_mm());
    high = std::max(high, *section.z_mm());
    mean_radius_mm_ += section.radius_mm() / static_cast<double>(sections.size());
    const Exchange::Rows rows = limacon_rows(section.raw().at);
    towards_.emplace_back();
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
      towards_.back().push_back({rows(i, 1), rows(i, 2)});
    circle_fits_.emplace_back(rows, Criterion::gaussian, section.shares());
  }
  middle_mm_ = 0.5 * (low + high);
  half_mm_ = 0.5 * (high - low);
  double mean_mm = 0.0, across = 0.0, squares = 0.0;  // their places need not be even
  for (const SectionModel& section : sections)
    mean_mm += *section.z_mm() / static_cast<double>(sections.size());
  for (const SectionModel& section : sections) {
    const double from_mean = *section.z_mm() - mean_mm;
    across += from_mean * section.radius_mm();
    squares += from_mean * from_mean;
  }
  taper_ = across / squares;
  const auto profiles = profiles_of(sections);
  start_ = least_squares_line(centres(circles(profiles)));
  if (sections.size() > 2) generatrices_.emplace(sections, start_);
  for (const bool of_cone : {false, true}) {
    const Rows now = about(start_, profiles, of_cone);
    base_ = now.y;
    for (const Criterion criterion : criteria) {
      if (of_cone && criterion > Criterion::minimum_zone) continue;
      const auto [at, made] =
          near_.try_emplace({criterion, of_cone}, Exchange(now.rows, criterion));
      if (!made) continue;
      at->second(now.y);
      measured_[{criterion, of_cone}] = !in_space ? fitted_near(now.y, criterion, of_cone)
                                        : of_cone ? cone(profiles, criterion)
                                                  : cylinder(profiles, criterion);
    }
  }
}

std::vector<Eigen::VectorXd> WholeModel::circles(
    const std::vector<std::vector<double>>& filtered_mm) const {
  std::vector<Eigen::VectorXd> out;
  for (std::size_t s = 0; s < sections_.size(); ++s)
    out.push_back(circle_fits_[s].least_squares(filtered_mm[s]).q);
  return out;
}

std::vector<CentrePoint> WholeModel::centres(const std::vector<Eigen::VectorXd>& circles) const {
  std::vector<CentrePoint> out;
  for (std::size_t s = 0; s < sections_.size(); ++s)
    out.push_back({sections_[s].x_mm() + circles[s][1], sections_[s].y_mm() + circles[s][2],
                   *sections_[s].z_mm()});
  // Eq. 273a: the centres of a cone that leans, read across the spindle, are off its axis.
  const AxisLine leans = least_squares_line(out);
  for (std::size_t s = 0; s < sections_.size(); ++s) {
    const double beside = taper_ * sections_[s].radius_mm() / (1.0 + taper_ * taper_);
    out[s].x_mm -= beside * leans.l;
    out[s].y_mm -= beside * leans.m;
  }
  return out;
}

template <class Work>
void WholeModel::each_off(const AxisLine& axis, const std::vector<std::vector<double>>& filtered_mm,
                          Work work) const {
  const Eigen::Vector3d along = Eigen::Vector3d(axis.l, axis.m, 1.0).normalized();
  for (std::size_t s = 0; s < sections_.size(); ++s) {
    const SectionModel& section = sections_[s];
    const double z = *section.z_mm();
    const auto [x0, y0] = axis.at(z);
    const double x = section.x_mm() - x0, y = section.y_mm() - y0;
    for (std::size_t i = 0; i < filtered_mm[s].size(); ++i) {
      const double r = section.radius_mm() + filtered_mm[s][i];
      Eigen::Vector3d off(x + r * towards_[s][i][0], y + r * towards_[s][i][1], 0.0);
      const double on_axis = off.dot(along);
      off -= on_axis * along;
      const double distance = off.norm();
      work(distance, off.x() / distance, off.y() / distance,
           (z + on_axis * along.z() - middle_mm_) / half_mm_);
    }
  }
}

WholeModel::Rows WholeModel::about(const AxisLine& axis,
                                   const std::vector<std::vector<double>>& filtered_mm,
                                   bool cone) const {
  std::size_t count = 0;
  for (const auto& one : filtered_mm) count += one.size();
  Rows out{Exchange::Rows(static_cast<Eigen::Index>(count), cone ? 6 : 5), {}};
  out.y.reserve(count);
  Eigen::Index row = 0;
  each_off(axis, filtered_mm, [&](double distance, double c, double sine, double t) {
    if (cone)
      out.rows.row(row++) << 1.0, c, sine, t * c, t * sine, t;
    else
      out.rows.row(row++) << 1.0, c, sine, t * c, t * sine;
    out.y.push_back(distance - mean_radius_mm_);
  });
  return out;
}

AxisLine WholeModel::moved(const AxisLine& axis, const Eigen::VectorXd& q) const {
  AxisLine out = axis;
  out.l += q[3] / half_mm_;
  out.m += q[4] / half_mm_;
  out.x0_mm += q[1] - q[3] / half_mm_ * middle_mm_;
  out.y0_mm += q[2] - q[4] / half_mm_ * middle_mm_;
  return out;
}

std::vector<double> WholeModel::y_near(const std::vector<std::vector<double>>& filtered_mm) const {
  std::vector<double> y = base_;
  std::size_t row = 0;
  for (std::size_t s = 0; s < sections_.size(); ++s)
    for (std::size_t i = 0; i < filtered_mm[s].size(); ++i)
      y[row++] += filtered_mm[s][i] - sections_[s].profile_mm()[i];
  return y;
}

WholeModel::Fitted WholeModel::fitted_near(const std::vector<double>& y, Criterion criterion,
                                           bool cone) const {
  Exchange fit = near_.at({criterion, cone});
  const Nearest nearest = fit(y);
  return {fit.off(y, nearest), nearest.q, moved(start_, nearest.q)};
}

WholeModel::Fitted WholeModel::cone(const std::vector<std::vector<double>>& filtered_mm,
                                    Criterion criterion) const {
  Fitted out;
  out.axis = start_;
  for (int round = 0; round < most_realignments; ++round) {
    Rows now = about(out.axis, filtered_mm, true);
    Exchange fit(std::move(now.rows), criterion);
    const Nearest nearest = fit(now.y);
    out.q = nearest.q;
    out.off_mm = fit.off(now.y, nearest);
    out.axis = moved(out.axis, nearest.q);
    if (!nearest.determined || nearest.q.segment(1, 4).norm() < axis_settled_mm) break;
  }
  return out;
}

/// In space, by associate().
WholeModel::Fitted WholeModel::cylinder(const std::vector<std::vector<double>>& filtered_mm,
                                        Criterion criterion) const {
  std::vector<Point3> points;
  for (std::size_t s = 0; s < sections_.size(); ++s) {
    const SectionModel& section = sections_[s];
    for (std::size_t i = 0; i < filtered_mm[s].size(); ++i) {
      const double angle = section.raw().at[i], r = section.radius_mm() + filtered_mm[s][i];
      points.push_back({section.x_mm() + r * std::cos(angle), section.y_mm() + r * std::sin(angle),
                        *section.z_mm()});
    }
  }
  const AssociatedFeature found = associate(points, Element::cylinder, criterion);
  const auto& [x, y, z] = found.feature.point_mm;
  const auto& [l, m, n] = found.feature.direction;
  double low = middle_mm_ + half_mm_, high = middle_mm_ - half_mm_;
  for (const auto& contact : found.certificate.contacts) {
    low = std::min(low, points[contact.point][2]);
    high = std::max(high, points[contact.point][2]);
  }
  return {distances_mm(points, found),
          {},
          {x - l / n * z, y - m / n * z, l / n, m / n},
          std::max(0.0, high - low)};
}

std::string WholeModel::rocking(Criterion criterion) const {
  if (criterion == Criterion::gaussian) return "";
  const Fitted& fit = measured_.at({criterion, false});
  const Fitted& least = measured_.at({Criterion::gaussian, false});
  const char* name = name_of(criterion);
  if (fit.held_mm < 0.5 * half_mm_)
    return fmt::format(
        "The {} cylinder rests on {:.3g} of {:.3g} mm of its length: its axis may rock, which "
        "affects all values about it",
        name, fit.held_mm, 2.0 * half_mm_);
  double apart = 0.0;
  for (const double z : {middle_mm_ - half_mm_, middle_mm_ + half_mm_}) {
    const auto here = fit.axis.at(z), there = least.axis.at(z);
    apart = std::max(apart, std::hypot(here[0] - there[0], here[1] - there[1]));
  }
  if (apart <= 0.5 * range_of(least.off_mm).length()) return "";
  return fmt::format(
      "The axis of the {} cylinder is {:.3g} µm off that of least squares at an end, more than the "
      "form explains: a tapered part rocks in it",
      name, apart / mm_per_um);
}

AxisLine WholeModel::axis_near(const std::vector<std::vector<double>>& filtered_mm,
                               Criterion criterion) const {
  return fitted_near(y_near(filtered_mm), criterion, has_cone(criterion)).axis;
}

std::vector<NamedValue> WholeModel::measured() const {
  return values_of(measured_, profiles_of(sections_));
}

std::vector<NamedValue> WholeModel::near(
    const std::vector<std::vector<double>>& filtered_mm) const {
  const std::vector<double> y = y_near(filtered_mm);
  Fits fits;
  for (const auto& [which, fit] : near_) fits[which] = fitted_near(y, which.first, which.second);
  return values_of(fits, filtered_mm);
}

std::vector<NamedValue> WholeModel::values_of(
    const Fits& fits, const std::vector<std::vector<double>>& filtered_mm) const {
  std::vector<NamedValue> values;
  const auto add = [&](const char* name, std::string reference, double value,
                       const char* unit = "mm") {
    values.push_back({"cylindricity", name, std::move(reference), value, unit});
  };
  for (const auto& [which, fit] : fits) {
    const auto& [criterion, of_cone] = which;
    if (of_cone) continue;
    const auto [low, high] = range_of(fit.off_mm);
    const std::string about = short_name(criterion, "CY");
    add("CYLt", about, high - low);
    const PeakAndValley of(low, high, sections_.front().bore());
    add("CYLp", about, of.peak);
    add("CYLv", about, of.valley);
    add("CYLq", about, root_mean_square(fit.off_mm));
  }
  const std::vector<Eigen::VectorXd> of_sections = circles(filtered_mm);
  std::vector<double> radii;
  for (std::size_t s = 0; s < sections_.size(); ++s)
    radii.push_back(sections_[s].radius_mm() + of_sections[s][0]);
  add("CYLrr", "LSCI", range_of(radii).length());
  if (sections_.size() > 2) {
    add("STRsa", "", smallest_cylinder_mm(centres(of_sections)));
    add("STRsg", "MZLI", generatrices_->straightness_mm(filtered_mm));
    const Fitted& cone = fits.at({Criterion::gaussian, true});
    const double slope = cone.q[5] / half_mm_;
    add("CYLtt", "LSCO", 2.0 * std::abs(cone.q[5]));
    add("CYLat", "LSCO", std::atan(slope), "rad");
    for (const Criterion criterion : {Criterion::gaussian, Criterion::minimum_zone}) {
      const Fitted& about_cone = fits.at({criterion, true});
      add("CONt", short_name(criterion, "CO"),
          range_of(about_cone.off_mm).length() * std::cos(std::atan(slope)));
    }
  }
  return values;
}

std::vector<NamedValue> WholeModel::against(
    const AxisLine& datum, const std::vector<std::vector<double>>& filtered_mm) const {
  std::vector<NamedValue> values;
  std::vector<double> distances, along_mm;
  each_off(datum, filtered_mm, [&](double distance, double, double, double t) {
    distances.push_back(distance);
    along_mm.push_back(middle_mm_ + half_mm_ * t);
  });
  const double total = range_of(distances).length();
  double circular = 0.0;
  const auto middles = centres(circles(filtered_mm));
  std::size_t row = 0;
  for (std::size_t s = 0; s < sections_.size(); ++s) {
    const std::span<double> section(distances.data() + row, filtered_mm[s].size());
    // In the plane at right angles to the datum.
    for (std::size_t i = 0; i < section.size(); ++i)
      section[i] -= taper_ * (along_mm[row + i] - *sections_[s].z_mm());
    circular = std::max(circular, range_of(section).length());
    row += filtered_mm[s].size();
  }
  const auto add = [&](const char* name, double value) {
    values.push_back({"datum", name, "", value});
  };
  add("runout_circular", circular);
  add("runout_total", total);
  add("coaxiality", coaxiality_mm(middles, datum));
  add("parallelism", smallest_parallel_cylinder_mm(middles, datum));
  return values;
}

}  // namespace trueaxis::form
