// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <vector>

#include "blind/subspace.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::blind {

/// A plan on the virtual lathe without effects, the readings of it that are kept, and what the
/// parameters of the ideal fit can move them by.
class Bench {
 public:
  /// `scenario`: without effects; `rows`: those of the stream, ascending; empty: all.
  explicit Bench(virtual_lathe::Scenario scenario, std::vector<std::size_t> rows = {});

  /// Readings without noise of the part with these effects, mm, the kept rows.
  Eigen::VectorXd clean(const std::vector<virtual_lathe::Effect>& effects) const;

  /// clean(effects) − clean({}).
  Eigen::VectorXd change(const std::vector<virtual_lathe::Effect>& effects) const {
    return clean(effects) - plain_;
  }

  /// Span of the derivatives with respect to x0, y0, l, m (of every chucking of its own), radius
  /// and half angle: central differences of the lathe.
  const Subspace& surface() const { return surface_; }

  const virtual_lathe::Scenario& scenario() const { return scenario_; }
  const Eigen::VectorXd& plain() const { return plain_; }  ///< clean({})
  const Eigen::VectorXd& c_rad() const { return c_; }
  const Eigen::VectorXd& z_mm() const { return z_; }
  const Eigen::VectorXd& time_s() const { return t_; }
  const std::vector<int>& pass() const { return pass_; }
  const std::vector<int>& setup() const { return setup_; }
  Eigen::Index size() const { return plain_.size(); }

 private:
  Eigen::VectorXd kept(const std::vector<double>& column) const;
  Eigen::MatrixXd surface_columns() const;

  virtual_lathe::Scenario scenario_;
  std::vector<std::size_t> rows_;
  Eigen::VectorXd plain_, c_, z_, t_;
  std::vector<int> pass_, setup_;
  Subspace surface_;
};

}  // namespace trueaxis::blind
