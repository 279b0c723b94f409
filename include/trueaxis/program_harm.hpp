// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trueaxis/compensation.hpp"
#include "trueaxis/machine_diagnosis.hpp"

/// What the errors of a machine do to one program: those that a diagnosis found, and those that its
/// measurement does not show (docs/reference/calibration.md).
namespace trueaxis {

/// One effect alone, at the size that was found or that could hide.
struct EffectOnProgram {
  std::string effect;
  bool found = false;
  double size = 0.0;
  std::string unit;  ///< mm or rad
  LargestInProgram tip;
};

struct PlanOnProgram {
  std::string plan;
  LargestInProgram U;  ///< of the tip after it
};

struct ProgramHarm {
  std::string file;
  std::size_t blocks = 0;                ///< that cut; of a program without any those that travel
  std::vector<EffectOnProgram> effects;  ///< the largest first
  LargestInProgram U;            ///< of the tip, without the part's datum; without data before any
  double coverage_factor = 2.0;  ///< k of U, that of the diagnosis
  std::vector<PlanOnProgram> plans;
};

/// The harm of a program by a diagnosis with `covariances`; its `next_plan` becomes that which
/// lowers U most a minute (Eqs. 189, 190). A plan B1 that is first stays the next.
/// @throws InputError as `compensate_program`
ProgramHarm weigh_on_program(const Machine& machine, MachineDiagnosis& diagnosis, std::string text,
                             const std::string& file);

}  // namespace trueaxis
