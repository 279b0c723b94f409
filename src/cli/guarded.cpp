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

int exit_code_of(const FitResult& fit, const std::string& source) {
  if (fit.status != FitStatus::converged) {
    std::cerr << source << ": " << to_string(fit.status) << ": " << fit.message << '\n';
    return numerical;
  }
  if (fit.axis_known()) return done;
  std::cerr << "refused: " << source << ": the axis is not known\n";
  return refused;
}

}  // namespace trueaxis::cli
