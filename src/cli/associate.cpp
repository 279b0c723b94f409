// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "associate/files/association_files.hpp"
#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "format/outputs.hpp"
#include "format/text_layout.hpp"
#include "interchange/number_file.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

struct AssociateCommand {
  std::string path, element, criterion = "gaussian", material, unit, array;
  std::string json, certificate, distances, qif, x3p;
  int threads = 0;
  bool force = false;
};

template <class Enum, std::size_t N>
Enum named(const std::array<const char*, N>& names, const std::string& name) {
  const auto at = std::ranges::find(names, name);
  return static_cast<Enum>(at - names.begin());
}

int execute(const AssociateCommand& options) {
  const auto element = named<Element>(element_names, options.element);
  const auto criterion = named<Criterion>(criterion_names, options.criterion);
  Outputs outputs(options.force);
  outputs.reads(options.path);
  outputs.may_write(options.json, "trueaxis.association");
  outputs.may_write(options.certificate, "trueaxis.certificate");
  outputs.may_write(options.distances, "trueaxis.distances");
  outputs.may_write(options.qif, "trueaxis.qif");
  outputs.may_write(options.x3p, "trueaxis.cloud");
  outputs.check();
  const PointText points = read_points(options.path, options.unit, options.array);
  const AssociatedFeature result =
      associate(points.points_mm, element, criterion,
                {.material = options.material == "outside" ? Material::outside : Material::inside,
                 .threads = options.threads});
  if (result.status == AssociationStatus::too_few || result.status == AssociationStatus::degenerate)
    throw InputError(options.path, result.why);
  if (!options.json.empty()) outputs.write(options.json, association_json(result, points));
  const bool converged = result.status == AssociationStatus::converged;
  if (converged && !options.certificate.empty())
    outputs.write(options.certificate, association_certificate(result, points));
  if (converged && !options.distances.empty())
    outputs.write(options.distances, association_distances(result, points));
  if (converged && !options.qif.empty())
    outputs.write(options.qif, association_qif(result, points));
  if (!options.x3p.empty())
    outputs.write(options.x3p, x3p_of_points(metres_of(points), TRUEAXIS_VERSION));
  outputs.commit();
  if (!converged) {
    std::cerr << options.path << ": " << result.why << ".\n";
    return numerical;
  }
  for (const std::string& place :
       {options.json, options.certificate, options.distances, options.qif})
    if (place == "-") return done;
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
  command
      ->add_option("--element", options->element,
                   "line, circle, plane, sphere, cylinder, cone or torus; with z = 0 throughout a "
                   "line or circle is one of the plane")
      ->required()
      ->check(CLI::IsMember(std::vector<std::string>(element_names.begin(), element_names.end())));
  command
      ->add_option(
          "--criterion", options->criterion,
          "gaussian, minimum_zone, minimum_circumscribed, maximum_inscribed or constrained "
          "(gaussian)")
      ->check(
          CLI::IsMember(std::vector<std::string>(criterion_names.begin(), criterion_names.end())));
  command
      ->add_option("--material", options->material,
                   "of --criterion constrained: inside of the element (a shaft; of a plane or a "
                   "line of the plane against its direction or to its right) or outside (a bore)")
      ->check(CLI::IsMember(std::vector<std::string>{"inside", "outside"}));
  command
      ->add_option("--unit", options->unit,
                   "of the coordinates: mm, um, m or in (mm; of a binary file what it says)")
      ->check(CLI::IsMember(std::vector<std::string>{"mm", "um", "m", "in"}));
  command->add_option("--array", options->array, array_help)->check(a_place());
  command->add_option("--json", options->json, "write the result here, '-' prints it")
      ->check(a_place());
  command
      ->add_option("--certificate", options->certificate,
                   "write what proves it here, to be checked by hand, '-' prints it")
      ->check(a_place());
  command
      ->add_option("--distances", options->distances,
                   "write every point with its distance here (CSV), '-' prints them")
      ->check(a_place());
  command
      ->add_option("--qif", options->qif,
                   "write the element as a measured feature here (QIF 3.0, XML), '-' prints it")
      ->check(a_place());
  command->add_option("--x3p", options->x3p, "write the points here as X3P (ISO 25178-72)")
      ->check(a_place());
  command->add_option("--threads", options->threads, "threads (0: as many as there are)")
      ->check(CLI::NonNegativeNumber);
  add_force(*command, options->force);
  command->callback([options, &exit_code] {
    const std::string objection =
        association_objection(named<Element>(element_names, options->element),
                              named<Criterion>(criterion_names, options->criterion));
    if (!objection.empty()) throw CLI::ValidationError("--criterion", objection);
    if ((options->criterion == "constrained") == options->material.empty())
      throw CLI::ValidationError("--material", options->material.empty()
                                                   ? "say where the material is, inside or outside"
                                                   : "is for --criterion constrained");
    expect_apart({{"--json", options->json},
                  {"--certificate", options->certificate},
                  {"--distances", options->distances},
                  {"--qif", options->qif},
                  {"--x3p", options->x3p}});
    if (options->x3p == "-")
      throw CLI::ValidationError("--x3p", "is a binary file: give it a name");
    exit_code = execute(*options);
  });
}

}  // namespace trueaxis::cli
