// SPDX-License-Identifier: Apache-2.0
#include "cli/guarded.hpp"

#include <exception>
#include <iostream>
#include <new>

#include "trueaxis/error.hpp"

namespace trueaxis::cli {

int guarded(const std::function<int()>& run) {
  try {
    return run();
  } catch (const InputError& error) {
    std::cerr << error.what() << '\n';
    return input;
  } catch (const Refusal& refusal) {
    std::cerr << "refused: " << refusal.what() << '\n';
    return refused;
  } catch (const std::bad_alloc&) {
    std::cerr << "not enough memory for this input\n";
    return input;
  } catch (const std::exception& error) {
    std::cerr << "trueaxis: a bug, please report it: " << error.what() << '\n';
    return bug;
  }
}

Ending ending_of(const FitResult& fit, const std::string& source) {
  if (fit.status != FitStatus::converged)
    return {numerical, source + ": " + to_string(fit.status) + ": " + fit.message};
  if (fit.axis_known()) return {};
  return {refused, "refused: " + source + ": the axis is not known"};
}

void set_aside(Outputs& outputs, const std::string& path) {
  if (const std::string name = outputs.set_aside(path); !name.empty())
    std::cerr << "warning: " << path << " is not of this run: TrueAxis keeps it as " << name
              << '\n';
}

int exit_code_of(const FitResult& fit, const std::string& source) {
  const Ending ending = ending_of(fit, source);
  if (ending.code != done) std::cerr << ending.why << '\n';
  return ending.code;
}

}  // namespace trueaxis::cli
