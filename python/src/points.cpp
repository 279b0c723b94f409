// SPDX-License-Identifier: Apache-2.0
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

#include "associate/files/association_files.hpp"
#include "form/files/form_files.hpp"
#include "format/file.hpp"
#include "job/files/stream_job.hpp"
#include "outcome.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/form.hpp"
#include "work.hpp"

namespace trueaxis::python {
namespace {

using Points = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// The place of a name in a list of names, whose order is that of the enumeration.
template <class Enum, std::size_t N>
Enum named(const std::array<const char*, N>& names, const std::string& name, const char* what) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) {
    std::string known;
    for (const char* one : names) known += (known.empty() ? "" : ", ") + std::string(one);
    throw InputError(name, std::string("is not ") + what + ": use one of " + known);
  }
  return static_cast<Enum>(found - names.begin());
}

/// Rows x, y, z in mm.
PointText points_of(const Points& rows) {
  if (rows.ndim() != 2 || rows.shape(1) != 3)
    throw InputError("points", "must be an array of n rows x, y, z");
  PointText points;
  points.source = "points";
  const double* at = rows.data();
  for (py::ssize_t i = 0; i < rows.shape(0); ++i, at += 3) {
    for (int k = 0; k < 3; ++k)
      if (!(std::abs(at[k]) < largest_coordinate_mm))
        throw InputError(
            std::vector<Diagnostic>{{points.source, static_cast<std::size_t>(i) + 1, 0,
                                     "a coordinate is not finite, or beyond 1e12 mm"}});
    points.points_mm.push_back({at[0], at[1], at[2]});
    points.lines.push_back(static_cast<std::size_t>(i) + 1);
  }
  points.hash = content_hash(
      {reinterpret_cast<const char*>(rows.data()), static_cast<std::size_t>(rows.nbytes())});
  return points;
}

struct Associated {
  PointText points;
  AssociatedFeature result;
  std::vector<double> distance_mm;
};

Outcome associated_of(PointText points, const std::string& element_name,
                      const std::string& criterion_name, const std::string& material, int threads,
                      const py::object& progress) {
  const auto element = named<Element>(element_names, element_name, "an element");
  const auto criterion = named<Criterion>(criterion_names, criterion_name, "a criterion");
  const std::string objection = association_objection(element, criterion);
  if (!objection.empty()) throw InputError("criterion", objection);
  const AssociateOptions options{
      .material = material == "outside" ? Material::outside : Material::inside, .threads = threads};
  const auto found = stoppable(progress, [&] {
    auto one = std::make_shared<Associated>(Associated{std::move(points), {}, {}});
    one->result = associate(one->points.points_mm, element, criterion, options);
    if (one->result.status == AssociationStatus::too_few ||
        one->result.status == AssociationStatus::degenerate)
      throw InputError(one->points.source, one->result.why);
    if (const std::string why = of_other_element(one->points.points_mm, one->result); !why.empty())
      throw InputError(one->points.source, why);
    if (one->result.status == AssociationStatus::converged)
      one->distance_mm = distances_mm(one->points.points_mm, one->result);
    return std::shared_ptr<const Associated>(one);
  });
  Outcome out = outcome_of(
      found, [](const Associated& one) { return association_json(one.result, one.points); },
      [](const Associated& one) { return association_text(one.result); });
  out.arrays = {{"distance_mm", found->distance_mm}};
  if (found->result.status != AssociationStatus::converged)
    out.ending = {cli::numerical, found->points.source + ": " + found->result.why + "."};
  return out;
}

ProfileFilter filter_of(const std::string& name) {
  for (const ProfileFilter filter : {ProfileFilter::none, ProfileFilter::gaussian,
                                     ProfileFilter::robust_gaussian, ProfileFilter::spline})
    if (name == to_string(filter)) return filter;
  throw InputError(name, "is not a profile filter: none, gaussian, robust_gaussian or spline");
}

FormOptions form_options(const std::string& filter, std::pair<double, double> band_upr, bool bore,
                         double ball_radius_mm, std::optional<double> noise_um,
                         double spindle_range_um, const std::string& datum_association,
                         double coverage_factor, int trials, std::uint64_t seed, int threads) {
  FormOptions options;
  options.filter = filter_of(filter);
  std::tie(options.low_upr, options.high_upr) = band_upr;
  options.bore = bore;
  options.ball_radius_mm = ball_radius_mm;
  if (noise_um) options.noise_mm = *noise_um * mm_per_um;
  options.spindle_range_mm = spindle_range_um * mm_per_um;
  options.datum = named<Criterion>(criterion_names, datum_association, "an association");
  options.coverage_factor = coverage_factor;
  options.trials = trials;
  options.seed = seed;
  options.threads = threads;
  return options;
}

Outcome outcome_of_form(FormResult&& result) {
  const auto found = std::make_shared<const FormResult>(std::move(result));
  Outcome out = outcome_of(
      found, [](const FormResult& one) { return form_json(one); },
      [](const FormResult& one) { return form_text(one, false); });
  for (std::size_t i = 0; i < found->sections.size(); ++i) {
    const FormProfile& profile = found->sections[i].profile;
    const std::string of_section = '_' + std::to_string(i);
    out.arrays["angle_rad" + of_section] = profile.angle_rad;
    out.arrays["raw_mm" + of_section] = profile.raw_mm;
    out.arrays["filtered_mm" + of_section] = profile.filtered_mm;
  }
  return out;
}

void bind_form(py::module_& module) {
  py::class_<FormOptions>(module, "FormOptions").def(py::init(&form_options));
  module.def("form", [](const Stream& stream, const std::optional<Stream>& datum,
                        const FormOptions& options, const py::object& progress) {
    return outcome_of_form(stoppable(progress, [&] {
      for (const Stream* one : {&stream, datum ? &*datum : &stream})
        expect_one_surface(**one, SurfaceKind::cylinder, RangesAs::options);
      return assess_form(*stream, options, datum ? datum->get() : nullptr);
    }));
  });
  module.def("form_of_points", [](const Points& rows, const std::string& element,
                                  const FormOptions& options, const py::object& progress) {
    const PointText points = points_of(rows);
    const auto of = named<Element>(element_names, element, "an element");
    return outcome_of_form(stoppable(progress, [&] {
      FormResult result = assess_form(points.points_mm, of, options);
      result.source = points.source;
      result.input_hash = points.hash;
      return result;
    }));
  });
}

}  // namespace

void bind_points(py::module_& module) {
  bind_form(module);
  module.def(
      "associate", [](const Points& rows, const std::string& element, const std::string& criterion,
                      const std::string& material, int threads, const py::object& progress) {
        return associated_of(points_of(rows), element, criterion, material, threads, progress);
      });
  module.def("associate_file",
             [](const std::string& path, const std::string& unit, const std::string& array,
                const std::string& element, const std::string& criterion,
                const std::string& material, int threads, const py::object& progress) {
               return associated_of(without_python([&] { return read_points(path, unit, array); }),
                                    element, criterion, material, threads, progress);
             });
}

}  // namespace trueaxis::python
