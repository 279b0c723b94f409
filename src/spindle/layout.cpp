// SPDX-License-Identifier: Apache-2.0
#include "spindle/layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trueaxis/spindle.hpp"

namespace trueaxis {
namespace {

constexpr double aligned = 1e-6;  // of the share across: on one line

}  // namespace

Layout::Layout(std::vector<Channel> channels) : channels_(std::move(channels)) {
  if (std::ranges::any_of(channels_, &Channel::sees_form)) form_ = unknowns_++;
  along_ = unknowns_++;
  const auto sees_across = [](const Channel& one) { return std::abs(one.across) > aligned; };
  if (std::ranges::any_of(channels_, sees_across)) across_ = unknowns_++;
}

Eigen::MatrixXcd Layout::matrix(int order) const {
  Eigen::MatrixXcd rows =
      Eigen::MatrixXcd::Zero(static_cast<Eigen::Index>(channels_.size()), unknowns_);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const Channel& one = channels_[static_cast<std::size_t>(i)];
    if (one.sees_form) rows(i, form_) = std::polar(1.0, order * one.form_angle_rad);
    rows(i, along_) = one.along;
    if (has_across()) rows(i, across_) = one.across;
  }
  return rows;
}

double condition_of(const Eigen::MatrixXcd& matrix) {
  constexpr double none = std::numeric_limits<double>::infinity();
  if (matrix.rows() < matrix.cols()) return none;
  const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXcd>(matrix).singularValues();
  const double least = values[values.size() - 1];
  return least > singular * values[0] ? values[0] / least : none;
}

Layout layout_of_sensors(std::span<const double> angles_rad) {
  std::vector<Channel> channels;
  for (std::size_t i = 0; i < angles_rad.size(); ++i) {
    channels.push_back({.sensor = i,
                        .bracket = i,
                        .form_angle_rad = angles_rad[i],
                        .along = std::cos(angles_rad[i]),
                        .across = std::sin(angles_rad[i])});
  }
  return Layout(std::move(channels));
}

std::vector<double> separation_conditions(std::span<const double> angles_rad, int order_min,
                                          int order_max) {
  const Layout layout = layout_of_sensors(angles_rad);
  std::vector<double> conditions;
  for (int n = order_min; n <= order_max; ++n) conditions.push_back(condition_of(layout.matrix(n)));
  return conditions;
}

}  // namespace trueaxis
