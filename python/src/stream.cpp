// SPDX-License-Identifier: Apache-2.0
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <vector>

#include "job/files/job_file.hpp"
#include "measure/files/stream_csv.hpp"
#include "measure/files/stream_csv_write.hpp"
#include "outcome.hpp"
#include "trueaxis/units.hpp"
#include "work.hpp"

namespace trueaxis::python {
namespace {

using Column = py::array_t<double, py::array::c_style | py::array::forcecast>;

StreamReadOptions read_options(std::optional<bool> diameter, bool relative,
                               std::optional<double> nominal_radius_mm, bool drop_invalid,
                               const std::vector<double>& sensor_angles_deg) {
  StreamReadOptions options;
  options.diameter = diameter;
  if (relative) options.indication = Indication::relative;
  options.nominal_radius_mm = nominal_radius_mm;
  options.drop_invalid = drop_invalid;
  options.several_sensors = true;
  for (const double angle_deg : sensor_angles_deg)
    options.sensor_angles_rad.push_back(angle_deg * rad_per_deg);
  return options;
}

void bind_columns(py::class_<ProbeStream, std::shared_ptr<ProbeStream>>& stream) {
  const auto column = [&](const char* name, std::vector<double> ProbeStream::*values) {
    stream.def_property_readonly(name, [values](const std::shared_ptr<ProbeStream>& one) {
      return view_of((*one).*values, one);
    });
  };
  column("reading_mm", &ProbeStream::reading_mm);
  column("c_rad", &ProbeStream::c_rad);
  column("position_mm", &ProbeStream::position_mm);
  column("time_s", &ProbeStream::time_s);
  const auto whole = [&](const char* name, std::vector<int> ProbeStream::*values) {
    stream.def_property_readonly(
        name, [values](const ProbeStream& one) { return py::array(py::cast(one.*values)); });
  };
  whole("pass_number", &ProbeStream::pass);
  whole("setup_number", &ProbeStream::setup);
}

}  // namespace

void bind_stream(py::module_& module) {
  py::class_<ProbeStream, std::shared_ptr<ProbeStream>> stream(module, "Stream");
  bind_columns(stream);
  stream.def("__len__", &ProbeStream::size)
      .def_property_readonly("sensors",
                             [](const ProbeStream& one) { return one.more_reading_mm.size() + 1; })
      .def("sensor_mm",
           [](const std::shared_ptr<ProbeStream>& one, std::size_t sensor) {
             return view_of(sensor == 0 ? one->reading_mm : one->more_reading_mm.at(sensor - 1),
                            one);
           })
      .def_property_readonly("is_face",
                             [](const ProbeStream& one) { return one.kind == StreamKind::face; })
      .def_property_readonly("x_said",
                             [](const ProbeStream& one) {
                               return one.x_convention &&
                                      one.x_convention->said_by != SaidBy::nobody;
                             })
      .def_readonly("source", &ProbeStream::source)
      .def_readonly("input_hash", &ProbeStream::input_hash)
      .def_readonly("read_as", &ProbeStream::read_as)
      .def_readonly("metadata", &ProbeStream::metadata)
      .def("write", [](const ProbeStream& one, const std::string& path) {
        const py::gil_scoped_release released;
        write_stream_csv(one, path);
      });

  module.def("stream_of", [](const std::string& head, const std::vector<Column>& columns,
                             const std::string& source, std::optional<bool> diameter, bool relative,
                             std::optional<double> nominal_radius_mm, bool drop_invalid,
                             const std::vector<double>& sensor_angles_deg) {
    std::vector<std::span<const double>> numbers;
    for (const Column& column : columns)
      numbers.emplace_back(column.data(), static_cast<std::size_t>(column.size()));
    const StreamReadOptions options =
        read_options(diameter, relative, nominal_radius_mm, drop_invalid, sensor_angles_deg);
    return without_python([&] {
      return std::make_shared<ProbeStream>(read_stream_columns(head, numbers, source, options));
    });
  });

  module.def("read_stream", [](const std::string& path, const std::string& columns,
                               std::size_t skip, std::optional<double> z_from_mm,
                               std::optional<double> z_to_mm, std::optional<bool> diameter,
                               bool relative, std::optional<double> nominal_radius_mm,
                               bool drop_invalid, const std::vector<double>& sensor_angles_deg) {
    StreamReadOptions options =
        read_options(diameter, relative, nominal_radius_mm, drop_invalid, sensor_angles_deg);
    ZRange range{};
    if (z_from_mm) range.from_mm = *z_from_mm;
    if (z_to_mm) range.to_mm = *z_to_mm;
    return without_python([&] {
      return std::make_shared<ProbeStream>(read_stream({path, {columns, skip, options}, range}));
    });
  });
}

}  // namespace trueaxis::python
