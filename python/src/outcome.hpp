// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "cli/guarded.hpp"
#include "trueaxis/probe_stream.hpp"

namespace trueaxis::python {

namespace py = pybind11;

/// An array that shows `values`, which `owner` keeps alive. Nothing is copied or may be changed.
py::array_t<double> view_of(std::span<const double> values, std::shared_ptr<const void> owner);

/// What a function of the library found, as the command says it. Texts are made when they are asked
/// for.
struct Outcome {
  using Text = std::function<std::string()>;
  std::shared_ptr<const void> owner;  ///< of all below
  Text json, screen;
  std::map<std::string, Text> files{};  ///< by the name that the command gives them
  std::map<std::string, std::span<const double>> arrays{};
  cli::Ending ending{};  ///< the command's exit code, and what it says on standard error
};

/// An outcome whose results are made of `result` by the functions given.
template <class Result, class ToJson, class ToScreen>
Outcome outcome_of(std::shared_ptr<const Result> result, ToJson json, ToScreen screen) {
  return {result, [result, json] { return json(*result); },
          [result, screen] { return screen(*result); }};
}

using Stream = std::shared_ptr<ProbeStream>;  ///< never changed: pybind11 holds no pointer to const

void bind_outcome(py::module_& module);
void bind_stream(py::module_& module);
void bind_lathe(py::module_& module);
void bind_points(py::module_& module);
void bind_machine(py::module_& module);
void bind_command(py::module_& module);

}  // namespace trueaxis::python
