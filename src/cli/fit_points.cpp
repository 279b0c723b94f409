// SPDX-License-Identifier: Apache-2.0
#include "cli/fit_points.hpp"

#include <algorithm>
#include <iostream>

#include "associate/files/association_files.hpp"
#include "base/counted.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "format/outputs.hpp"
#include "format/text_layout.hpp"
#include "interchange/number_file.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

template <class Enum, std::size_t N>
Enum named(const std::array<const char*, N>& names, const std::string& name) {
  const auto at = std::ranges::find(names, name);
  return static_cast<Enum>(at - names.begin());
}

}  // namespace

void FitPoints::add_to(CLI::App& command, Results& results) {
  const auto add = [&](const char* name, std::string& value, const CLI::Validator& check,
                       const char* help) {
    return add_option(command, name, value, check, help)->group(points_group);
  };
  add("--points", path, a_place(), "points x y z (text, X3P, HDF5, MATLAB, NumPy), no stream")
      ->type_name("FILE");
  add("--element", element, one_of({element_names.begin(), element_names.end()}), "element");
  add("--material", material, one_of({"inside", "outside"}),
      "side of the material for --criterion constrained");
  add("--unit", unit, one_of({"mm", "um", "m", "in"}), "unit of the points (default mm)");
  add("--array", array, a_place(), array_help)->type_name("ARRAY");
  add_threads(command, threads)->group(points_group);
  results.add(command, "--qif", "trueaxis.qif",
              "--points: element as feature (QIF 3.0, XML), points (X3P, ISO 25178-72)");
  results.add(command, "--x3p", "trueaxis.cloud",
              "--points: element as feature (QIF 3.0, XML), points (X3P, ISO 25178-72)");
}

void FitPoints::expect_fitting(const CLI::App& command, const std::string& criterion) const {
  if (element.empty()) throw CLI::RequiredError("--element");
  expect_only(command,
              {"stream", "--points", "--element", "--criterion", "--material", "--unit", "--array",
               "--json", "--residuals", "--certificate", "--qif", "--x3p", "--threads", "--force",
               "--check", "--verbose"},
              "is for a stream: --points has none");
  if (command.count("stream") > 0 && command.count("--points") > 0)
    throw CLI::ValidationError("stream", "name one file, a stream or --points");
  const std::string objection = association_objection(named<Element>(element_names, element),
                                                      named<Criterion>(criterion_names, criterion));
  if (!objection.empty()) throw CLI::ValidationError("--criterion", objection);
  if ((criterion == "constrained") == material.empty())
    throw CLI::ValidationError("--material", material.empty()
                                                 ? "say where the material is, inside or outside"
                                                 : "is for --criterion constrained");
}

int FitPoints::execute(const std::string& criterion_name, const Results& results,
                       bool check) const {
  const auto kind = named<Element>(element_names, element);
  const auto criterion = named<Criterion>(criterion_names, criterion_name);
  Outputs outputs(results.force);
  results.name_to(outputs, {path});
  outputs.check();
  const PointText points = read_points(path, unit, array);
  if (check)
    return checked(outputs, "fit a " + element + " to " +
                                counted(points.points_mm.size(), "point") + " of " + path);
  const AssociatedFeature result =
      associate(points.points_mm, kind, criterion,
                {.material = material == "outside" ? Material::outside : Material::inside,
                 .threads = threads});
  if (result.status == AssociationStatus::too_few || result.status == AssociationStatus::degenerate)
    throw InputError(path, result.why);
  if (const std::string why = of_other_element(points.points_mm, result); !why.empty())
    throw InputError(path, why);
  const bool converged = result.status == AssociationStatus::converged;
  results.write(outputs, "--json", [&] { return association_json(result, points); });
  if (converged) {
    results.write(outputs, "--certificate",
                  [&] { return association_certificate(result, points); });
    results.write(outputs, "--residuals", [&] { return association_distances(result, points); });
    results.write(outputs, "--qif", [&] { return association_qif(result, points); });
  }
  results.write(outputs, "--x3p",
                [&] { return x3p_of_points(metres_of(points), TRUEAXIS_VERSION); });
  outputs.commit();
  if (!converged) {
    std::cerr << path << ": " << result.why << ".\n";
    return numerical;
  }
  if (results.printed()) return done;
  std::cout << association_text(result);
  for (const std::string& note : points.notes)
    std::cout << layout::wrapped("  note           ", note);
  return done;
}

}  // namespace trueaxis::cli
