// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "trueaxis/covariance.hpp"

namespace trueaxis {

/// Of a matrix that is symmetric.
template <class Name>
CovarianceOf<Name> with_names(std::vector<Name> names, const Eigen::MatrixXd& matrix) {
  const auto size = static_cast<std::size_t>(matrix.size());
  return CovarianceOf<Name>(std::move(names), std::span(matrix.data(), size));
}

template <class Name>
Eigen::MatrixXd matrix_of(const CovarianceOf<Name>& covariance) {
  const auto n = static_cast<Eigen::Index>(covariance.size());
  return Eigen::Map<const Eigen::MatrixXd>(covariance.data(), n, n);
}

}  // namespace trueaxis
