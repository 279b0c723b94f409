// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <map>
#include <memory>

#include "associate/files/association_files.hpp"
#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "format/outputs.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

struct AssociateCommand {
  std::string path, element, criterion = "gaussian", unit, json, certificate;
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
  outputs.check();
  const PointText points = read_points(options.path, options.unit);
  const AssociatedFeature result =
      associate(points.points_mm, element, criterion, {.threads = options.threads});
  if (result.status == AssociationStatus::too_few || result.status == AssociationStatus::degenerate)
    throw InputError(options.path, result.why);
  if (!options.json.empty()) outputs.write(options.json, association_json(result, points));
  const bool converged = result.status == AssociationStatus::converged;
  if (converged && !options.certificate.empty())
    outputs.write(options.certificate, association_certificate(result, points));
  outputs.commit();
  if (!converged) {
    std::cerr << options.path << ": " << result.why << ".\n";
    return numerical;
  }
  if (options.json != "-" && options.certificate != "-") std::cout << association_text(result);
  return done;
}

}  // namespace

void add_associate(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("associate",
                         "the geometrical element of Cartesian points, by any of four "
                         "criteria, with what proves it");
  auto options = std::make_shared<AssociateCommand>();
  command->add_option("points", options->path, "x y z a line (text), '-' for standard input")
      ->required();
  command
      ->add_option("--element", options->element,
                   "line, circle, plane, sphere, cylinder, cone or torus; with z = 0 throughout a "
                   "line or circle is one of the plane")
      ->required()
      ->check(CLI::IsMember(std::vector<std::string>(element_names.begin(), element_names.end())));
  command
      ->add_option("--criterion", options->criterion,
                   "gaussian, minimum_zone, minimum_circumscribed or maximum_inscribed (gaussian)")
      ->check(
          CLI::IsMember(std::vector<std::string>(criterion_names.begin(), criterion_names.end())));
  command->add_option("--unit", options->unit, "of the coordinates: mm, um, m or in (mm)")
      ->check(CLI::IsMember(std::vector<std::string>{"mm", "um", "m", "in"}));
  command->add_option("--json", options->json, "write the result here, '-' prints it")
      ->check(a_place());
  command
      ->add_option("--certificate", options->certificate,
                   "write what proves it here, to be checked by hand, '-' prints it")
      ->check(a_place());
  command->add_option("--threads", options->threads, "threads (0: as many as there are)")
      ->check(CLI::NonNegativeNumber);
  add_force(*command, options->force);
  command->callback([options, &exit_code] {
    const std::string objection =
        association_objection(named<Element>(element_names, options->element),
                              named<Criterion>(criterion_names, options->criterion));
    if (!objection.empty()) throw CLI::ValidationError("--criterion", objection);
    if (!options->json.empty() && options->json == options->certificate)
      throw CLI::ValidationError("--certificate", "cannot go where --json goes");
    exit_code = execute(*options);
  });
}

}  // namespace trueaxis::cli
