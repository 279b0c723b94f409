// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "trueaxis/machine.hpp"

namespace trueaxis {

/// What each of several errors does to the tip when it is the only one. Before its joint and after
/// it the chain is then the nominal one, a rigid motion, so that only the joint itself matters:
/// |P(E) p - P p| with p the tip seen from the joint.
class SingleErrors {
 public:
  /// For every name of the errors, in the order in which they come first.
  static SingleErrors of_names(const MachineModel& model);

  const std::vector<std::string>& names() const { return names_; }
  /// Displacement of the tip (mm) by each of them.
  void tip_mm(const AxisPositions& axes, const Setting& setting, std::span<double> out) const;

 private:
  explicit SingleErrors(const MachineModel& model) : all_(model) {}
  void add(const ErrorName& name, std::vector<ErrorTerm> terms);

  MachineModel all_;
  bool whole_ = false;  ///< every name with all of its terms: as `all_` has it
  struct One {
    MachineModel model;  ///< with this error only
    std::size_t joint;   ///< in the chain, or one of the two below
    bool component;
    std::size_t direction;  ///< as of ErrorName
  };
  static constexpr std::size_t of_spindle = 100, of_workpiece = 101;
  std::vector<One> errors_;
  std::vector<std::string> names_;
};

}  // namespace trueaxis
