// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/machine.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>

#include "cli/machine_options.hpp"
#include "machine/limits.hpp"
#include "outcome.hpp"
#include "trueaxis/error.hpp"
#include "work.hpp"

namespace trueaxis::python {
namespace {

using Positions = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// A machine with its errors, and the program frame in force.
struct OpenMachine {
  MachineModel model;
  Setting setting;
  std::vector<std::string> notes;
};

OpenMachine open_machine(const std::string& machine, const std::vector<std::string>& errors,
                         const std::string& sign, bool large_errors,
                         const std::string& work_offset) {
  cli::MachineOptions options;
  options.machine = machine;
  options.errors = errors;
  options.sign = sign;
  options.large_errors = large_errors;
  options.work_offset = work_offset;
  const MachineFile file = options.read_machine();
  const ErrorsOfFiles read = options.read_errors_of(file);
  return {MachineModel(file.machine, read.errors), options.setting_of(file.machine), read.remarks};
}

/// The axes in the order of the words X Y Z A B C.
std::vector<AxisName> axes_of(const Machine& machine) {
  std::vector<AxisName> names;
  for (const MachineAxis& axis : machine.axes) names.push_back(axis.name);
  std::ranges::sort(names);
  return names;
}

/// A row of a table over `axes`, mm and degrees, as positions inside.
AxisPositions positions_of(const double* row, const std::vector<AxisName>& axes) {
  AxisPositions out{};
  for (std::size_t k = 0; k < axes.size(); ++k)
    out[index_of(axes[k])] = row[k] * (is_rotary(axes[k]) ? rad_per_deg : 1.0);
  return out;
}

/// Tip (n × 3, mm) and direction (n × 3) in the part at each row, of the machine with its errors,
/// or without.
py::tuple poses(const OpenMachine& of, const Positions& rows, bool nominal) {
  const std::vector<AxisName> axes = axes_of(of.model.machine());
  if (rows.ndim() != 2 || rows.shape(1) != static_cast<py::ssize_t>(axes.size()))
    throw InputError("positions", "must be an array of n rows, a column for each axis");
  const auto count = static_cast<std::size_t>(rows.shape(0));
  py::array_t<double> tip({rows.shape(0), py::ssize_t{3}}),
      direction({rows.shape(0), py::ssize_t{3}});
  const double* at = rows.data();
  double *tip_mm = tip.mutable_data(), *toward = direction.mutable_data();
  without_python([&] {
    for (std::size_t i = 0; i < count; ++i) {
      const AxisPositions here = positions_of(at + i * axes.size(), axes);
      const std::string why = nominal ? "" : outside_known(of.model.errors(), here);
      if (!why.empty()) throw Refusal("positions:" + std::to_string(i + 1) + ": " + why);
      const ToolPose pose =
          nominal ? of.model.nominal(here, of.setting) : of.model.actual(here, of.setting);
      std::ranges::copy(pose.tip_mm, tip_mm + 3 * i);
      std::ranges::copy(pose.direction, toward + 3 * i);
    }
  });
  return py::make_tuple(tip, direction);
}

}  // namespace

void bind_machine(py::module_& module) {
  py::class_<OpenMachine>(module, "OpenMachine")
      .def_property_readonly("name", [](const OpenMachine& of) { return of.model.machine().name; })
      .def_property_readonly("chain",
                             [](const OpenMachine& of) { return of.model.machine().chain; })
      .def_property_readonly("axes",
                             [](const OpenMachine& of) {
                               std::vector<std::string> names;
                               for (const AxisName axis : axes_of(of.model.machine()))
                                 names.emplace_back(1, letter_of(axis));
                               return names;
                             })
      .def_readonly("notes", &OpenMachine::notes)
      .def("poses", &poses);
  module.def("open_machine", &open_machine);
}

}  // namespace trueaxis::python
