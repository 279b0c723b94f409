// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "trueaxis/error.hpp"

namespace trueaxis {

/// Covariance matrix of what has names: symmetric, row and column i are of names()[i], an entry is
/// in the product of their units. Without names it is not known.
template <class Name>
class CovarianceOf {
 public:
  CovarianceOf() = default;
  /// All entries are `fill`.
  explicit CovarianceOf(std::vector<Name> names, double fill = 0.0)
      : names_(std::move(names)), by_rows_(names_.size() * names_.size(), fill) {}
  /// @throws ContractViolation where the entries are not as many as rows times columns.
  CovarianceOf(std::vector<Name> names, std::span<const double> by_rows)
      : names_(std::move(names)), by_rows_(by_rows.begin(), by_rows.end()) {
    expects(by_rows_.size() == names_.size() * names_.size(), "a covariance of all names");
  }

  bool empty() const { return names_.empty(); }
  std::size_t size() const { return names_.size(); }
  const std::vector<Name>& names() const { return names_; }

  double operator()(std::size_t i, std::size_t j) const { return by_rows_[i * size() + j]; }
  double& operator()(std::size_t i, std::size_t j) { return by_rows_[i * size() + j]; }
  /// Standard uncertainty: the root of the variance; NaN where there is none.
  double u(std::size_t i) const { return std::sqrt((*this)(i, i)); }

  /// The row of a name; none where it has not this name.
  std::optional<std::size_t> find(const Name& name) const {
    const auto found = std::ranges::find(names_, name);
    if (found == names_.end()) return std::nullopt;
    return static_cast<std::size_t>(found - names_.begin());
  }
  /// @throws ContractViolation for a name that it does not have.
  double between(const Name& a, const Name& b) const {
    const auto i = find(a), j = find(b);
    expects(i && j, "a name of the covariance");
    return (*this)(*i, *j);
  }

  /// Entries row by row, size() × size().
  double* data() { return by_rows_.data(); }
  const double* data() const { return by_rows_.data(); }

  bool operator==(const CovarianceOf&) const = default;

 private:
  std::vector<Name> names_;
  std::vector<double> by_rows_;
};

using Covariance = CovarianceOf<std::string>;

/// A row of a matrix over an axis.
enum class AxisRow : std::size_t { x, y, slope_x, slope_y };

/// Matrix over x, y, slope_x and slope_y of an Axis.
struct AxisMatrix {
  static constexpr std::size_t size = 4;

  double operator()(AxisRow i, AxisRow j) const { return by_rows[place(i, j)]; }
  double& operator()(AxisRow i, AxisRow j) { return by_rows[place(i, j)]; }
  double* data() { return by_rows.data(); }
  const double* data() const { return by_rows.data(); }

  bool operator==(const AxisMatrix&) const = default;

  std::array<double, size * size> by_rows{};

 private:
  static constexpr std::size_t place(AxisRow i, AxisRow j) {
    return static_cast<std::size_t>(i) * size + static_cast<std::size_t>(j);
  }
};

/// mm², mm and 1.
using AxisCovariance = AxisMatrix;

}  // namespace trueaxis
