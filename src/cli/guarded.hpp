// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>

#include "format/outputs.hpp"
#include "trueaxis/calibration.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis::cli {

/// The contract's exit codes.
enum Exit {
  done = 0,
  refused = 1,    ///< understood and not carried out, a tolerance not met, no axis known; Refusal
  usage = 2,      ///< of the command line
  input = 3,      ///< InputError
  numerical = 4,  ///< a fit that failed
  bug = 70        ///< ContractViolation, or any other exception
};

/// What `run` returns, or the contract's exit code of what it throws, said on standard error.
int guarded(const std::function<int()>& run);

/// What a script that takes the axis of `fit` has to know: numerical where it failed, refused where
/// its axis is not known.
struct Ending {
  Exit code = done;
  std::string why;
};
Ending ending_of(const FitResult& fit, const std::string& source);
/// The same, said on standard error.
int exit_code_of(const FitResult& fit, const std::string& source);

/// `--check`: the command reads everything and looks at every place of a result. It computes and
/// writes nothing.
CLI::Option* add_check(CLI::App& command, bool& check);

/// `--force` and `--check` of a command that writes, `--verbose` of one that prints a screen too.
void add_usual(CLI::App& command, bool& force, bool& check, bool* verbose = nullptr);

/// Says what a command would do ("fit a cone to 1469 readings"), what it has read and what it would
/// write. @returns the exit code
int checked(const Outputs& outputs, const std::string& would);

/// What is at a place that this run does not write gets another name, said on standard error.
void set_aside(Outputs& outputs, const std::string& path);

/// Takes every step, whatever is wrong in those before it.
/// @throws InputError with what is wrong in all of them
void all_of(std::initializer_list<std::function<void()>> steps);

/// A program cannot say that TrueAxis wrote it, for all its bytes are the user's: what may be
/// `program`, compensated before, is replaced. @throws InputError if another program is there
void expect_no_other_program(const std::string& path, const std::string& program, bool force);

/// @param left_by_all_mm as of `likely_mistake`
/// @throws Refusal where a measurement of a machine is most likely written wrongly
inline void expect_no_mistake(const Machine& machine, std::span<const MachineMeasurement> data,
                              const CalibrationOptions& options, const Calibration& found,
                              double left_by_all_mm) {
  const std::string mistake = likely_mistake(machine, data, options, found, left_by_all_mm);
  const std::string why = found.converged ? implausible(found, options) : "";
  if (!mistake.empty()) throw Refusal(mistake);
  if (!why.empty()) throw Refusal(why);
}

}  // namespace trueaxis::cli
