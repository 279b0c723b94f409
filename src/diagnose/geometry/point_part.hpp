// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace trueaxis::diagnose_detail {

/// A column that is kept here, or a view of another one that outlives it; copies share it.
class SharedColumn {
 public:
  SharedColumn() = default;
  explicit SharedColumn(std::vector<double> own)
      : own_(std::make_shared<const std::vector<double>>(std::move(own))), view_(*own_) {}
  static SharedColumn of(std::span<const double> others) {
    SharedColumn column;
    column.view_ = others;
    return column;
  }

  operator std::span<const double>() const { return view_; }
  std::size_t size() const { return view_.size(); }
  double operator[](std::size_t i) const { return view_[i]; }
  double front() const { return view_.front(); }
  double back() const { return view_.back(); }
  auto begin() const { return view_.begin(); }
  auto end() const { return view_.end(); }

 private:
  std::shared_ptr<const std::vector<double>> own_;
  std::span<const double> view_;
};

/// The geometry of some readings in a row about the fitted surface: what terms and base columns are
/// made of. Columns of one entry a reading; mm, rad, s.
struct PointPart {
  std::size_t begin = 0;  ///< number of the first reading
  std::span<const double> c, z, time, speed, velocity, x, sensed, dx_dc, dx_dz, d2x_dc2, theta,
      chuck, s, clamp;
  std::span<const double> sine, cosine;  ///< of C
  std::span<const double> dx_dnormal;    ///< of form along the normal
  std::span<const double> dx_dy;         ///< across the probe
  std::span<const std::uint32_t> axis;   ///< of every reading
  std::span<const char> rear;            ///< of every reading

  std::size_t size() const { return c.size(); }
  /// Readings [from, to) of it.
  PointPart part(std::size_t from, std::size_t to) const;
};

/// Calls work(part) for the stretches of a part that are read from one side.
template <typename Work>
void for_each_side(const PointPart& part, const Work& work) {
  for (std::size_t from = 0, to = 0; from < part.size(); from = to) {
    while (to < part.size() && part.rear[to] == part.rear[from]) ++to;
    work(from == 0 && to == part.size() ? part : part.part(from, to));
  }
}

/// One of its columns.
using PointColumn = std::span<const double> PointPart::*;

/// What a part is made in; columns may be longer.
struct PointRoom {
  std::vector<double> speed, velocity, x, sensed, dx_dc, dx_dz, d2x_dc2, theta, chuck, s, clamp,
      dx_dnormal, dx_dy, sine, cosine, z, from;
  std::vector<std::uint32_t> axis;
  std::vector<char> rear;

  void resize(std::size_t size);
};

}  // namespace trueaxis::diagnose_detail
