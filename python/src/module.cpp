// SPDX-License-Identifier: Apache-2.0
#include <glog/logging.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "outcome.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::python {

py::array_t<double> view_of(std::span<const double> values, std::shared_ptr<const void> owner) {
  using Owner = std::shared_ptr<const void>;
  const py::capsule keep(new Owner(std::move(owner)),
                         [](void* held) { delete static_cast<Owner*>(held); });
  py::array_t<double> array(static_cast<py::ssize_t>(values.size()), values.data(), keep);
  array.attr("flags").attr("writeable") = false;
  return array;
}

template <class Map>
std::vector<std::string> names_of(const Map& map) {
  std::vector<std::string> names;
  for (const auto& [name, value] : map) names.push_back(name);
  return names;
}

void bind_outcome(py::module_& module) {
  py::class_<Outcome>(module, "Outcome")
      .def("json", [](const Outcome& one) { return one.json(); })
      .def("screen", [](const Outcome& one) { return one.screen(); })
      .def("file", [](const Outcome& one, const std::string& name) { return one.files.at(name)(); })
      .def_property_readonly("files", [](const Outcome& one) { return names_of(one.files); })
      .def_property_readonly("arrays", [](const Outcome& one) { return names_of(one.arrays); })
      .def("array", [](const Outcome& one,
                       const std::string& name) { return view_of(one.arrays.at(name), one.owner); })
      .def_property_readonly("code", [](const Outcome& one) { return int{one.ending.code}; })
      .def_property_readonly("why", [](const Outcome& one) { return one.ending.why; });
}

}  // namespace trueaxis::python

PYBIND11_MODULE(_core, module) {
  namespace tp = trueaxis::python;
  namespace py = pybind11;
  module.doc() = "What the Python package trueaxis is made of; use the package.";
  if (!google::IsGoogleLoggingInitialized()) {
    FLAGS_logtostderr = true;
    FLAGS_minloglevel = google::GLOG_ERROR;  // a fit's status says what its solver warns of
    google::InitGoogleLogging("trueaxis");
  }
  py::register_exception_translator([](std::exception_ptr thrown) {
    const auto raise = [](const char* name, const std::exception& error) {
      PyErr_SetString(py::module_::import("trueaxis._errors").attr(name).ptr(), error.what());
    };
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const trueaxis::InputError& error) {
      raise("InputError", error);
    } catch (const trueaxis::Refusal& error) {
      raise("Refused", error);
    }
  });
  module.attr("version") = TRUEAXIS_VERSION;
  tp::bind_outcome(module);
  tp::bind_stream(module);
  tp::bind_lathe(module);
  tp::bind_points(module);
  tp::bind_machine(module);
  tp::bind_command(module);
}
