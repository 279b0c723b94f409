// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "associate/files/association_files.hpp"
#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/results.hpp"
#include "format/outputs.hpp"
#include "format/text_layout.hpp"
#include "interchange/number_file.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

struct AssociateCommand {
  std::string path, element, criterion = "gaussian", material, unit, array;
  Results results;
  int threads = 0;
};

template <class Enum, std::size_t N>
Enum named(const std::array<const char*, N>& names, const std::string& name) {
  const auto at = std::ranges::find(names, name);
  return static_cast<Enum>(at - names.begin());
}

int execute(const AssociateCommand& options) {
  const auto element = named<Element>(element_names, options.element);
  const auto criterion = named<Criterion>(criterion_names, options.criterion);
  const Results& results = options.results;
  Outputs outputs(results.force);
  outputs.reads(options.path);
  results.name_to(outputs);
  outputs.check();
  const PointText points = read_points(options.path, options.unit, options.array);
  const AssociatedFeature result =
      associate(points.points_mm, element, criterion,
                {.material = options.material == "outside" ? Material::outside : Material::inside,
                 .threads = options.threads});
  if (result.status == AssociationStatus::too_few || result.status == AssociationStatus::degenerate)
    throw InputError(options.path, result.why);
  const bool converged = result.status == AssociationStatus::converged;
  results.write(outputs, "--json", [&] { return association_json(result, points); });
  if (converged) {
    results.write(outputs, "--certificate",
                  [&] { return association_certificate(result, points); });
    results.write(outputs, "--distances", [&] { return association_distances(result, points); });
    results.write(outputs, "--qif", [&] { return association_qif(result, points); });
  }
  results.write(outputs, "--x3p",
                [&] { return x3p_of_points(metres_of(points), TRUEAXIS_VERSION); });
  outputs.commit();
  if (!converged) {
    std::cerr << options.path << ": " << result.why << ".\n";
    return numerical;
  }
  if (results.printed()) return done;
  std::cout << association_text(result);
  for (const std::string& note : points.notes)
    std::cout << layout::wrapped("  note           ", note);
  return done;
}

}  // namespace

void add_associate(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("associate",
                         "the geometrical element of Cartesian points, by any of four "
                         "criteria, with what proves it");
  auto options = std::make_shared<AssociateCommand>();
  command
      ->add_option(
          "points", options->path,
          "x y z a line (text), or an X3P, HDF5, MATLAB or NumPy file; '-' for standard input")
      ->required();
  add_option(*command, "--element", options->element,
             one_of({element_names.begin(), element_names.end()}),
             "line, circle, plane, sphere, cylinder, cone or torus; with z = 0 throughout a "
             "line or circle is one of the plane")
      ->required();
  add_option(*command, "--criterion", options->criterion,
             one_of({criterion_names.begin(), criterion_names.end()}),
             "gaussian, minimum_zone, minimum_circumscribed, maximum_inscribed or constrained "
             "(gaussian)");
  add_option(*command, "--material", options->material, one_of({"inside", "outside"}),
             "of --criterion constrained: inside of the element (a shaft; of a plane or a "
             "line of the plane against its direction or to its right) or outside (a bore)");
  add_option(*command, "--unit", options->unit, one_of({"mm", "um", "m", "in"}),
             "of the coordinates: mm, um, m or in (mm; of a binary file what it says)");
  add_option(*command, "--array", options->array, a_place(), array_help);
  Results& results = options->results;
  results.add(*command, "--json", "trueaxis.association", "write the result here, '-' prints it");
  results.add(*command, "--certificate", "trueaxis.certificate",
              "write what proves it here, to be checked by hand, '-' prints it");
  results.add(*command, "--distances", "trueaxis.distances",
              "write every point with its distance here (CSV), '-' prints them");
  results.add(*command, "--qif", "trueaxis.qif",
              "write the element as a measured feature here (QIF 3.0, XML), '-' prints it");
  results.add(*command, "--x3p", "trueaxis.cloud", "write the points here as X3P (ISO 25178-72)");
  add_option(*command, "--threads", options->threads, CLI::NonNegativeNumber,
             "threads (0: as many as there are)");
  add_force(*command, options->results.force);
  command->callback([options, &exit_code] {
    const std::string objection =
        association_objection(named<Element>(element_names, options->element),
                              named<Criterion>(criterion_names, options->criterion));
    if (!objection.empty()) throw CLI::ValidationError("--criterion", objection);
    if ((options->criterion == "constrained") == options->material.empty())
      throw CLI::ValidationError("--material", options->material.empty()
                                                   ? "say where the material is, inside or outside"
                                                   : "is for --criterion constrained");
    if (options->results["--x3p"] == "-")
      throw CLI::ValidationError("--x3p", "is a binary file: give it a name");
    exit_code = execute(*options);
  });
}

}  // namespace trueaxis::cli
