// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iostream>

#include "associate/files/stream_association.hpp"
#include "cli/checked_fit.hpp"
#include "cli/fit_points.hpp"
#include "cli/guarded.hpp"
#include "cli/results.hpp"
#include "format/outputs.hpp"
#include "job/files/stream_job.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

Criterion criterion_of(const std::string& name) {
  const auto at = std::ranges::find(criterion_names, name);
  return static_cast<Criterion>(at - criterion_names.begin());
}

}  // namespace

void FitCriterion::add_to(CLI::App& command, Results& results) {
  add_option(command, "--criterion", name,
             one_of({"probe", "gaussian", "minimum_zone", "minimum_circumscribed",
                     "maximum_inscribed", "constrained"}),
             "criterion (default probe, for points gaussian)")
      ->group(surface_group);
  results.add(command, "--certificate", "trueaxis.certificate",
              "proof of the optimum, for any criterion but probe");
}

void FitCriterion::expect_fitting(const AssociationOptions& association, const Results& results,
                                  const CLI::App& command) const {
  const auto refuse = [](const std::string& option, const std::string& why) {
    throw CLI::ValidationError(option, why);
  };
  if (along_probe()) {
    if (results.asked("--certificate"))
      refuse("--certificate", "needs a --criterion other than probe, whose proof is its U");
    return;
  }
  for (const char* option : {"--loss", "--noise-um", "--coverage-factor", "--report", "--check"})
    if (command.count(option) > 0) refuse(option, "is for --criterion probe: leave it out");
  if (name == "constrained") refuse("--criterion", "constrained is for points");
  const std::string objection =
      association_objection(element_of(surface_from_id(association.surface)), criterion_of(name));
  if (!objection.empty()) refuse("--criterion", objection);
}

int FitCriterion::execute(const StreamOptions& stream, const AssociationOptions& association,
                          Results& results) const {
  results.say("--json", "trueaxis.association");
  results.say("--residuals", "trueaxis.distances");
  Outputs outputs(results.force);
  results.name_to(outputs, {stream.path});
  outputs.check();
  const ProbeStream readings = stream.read();
  expect_one_surface(readings, surface_from_id(association.surface), RangesAs::options);
  const FitOptions chosen = association.chosen(readings);
  const StreamAssociation found =
      associate_stream(readings, surface_from_id(association.surface), criterion_of(name),
                       {.bore = chosen.bore, .ball_radius_mm = chosen.ball_radius_mm});
  // What the readings cannot be, they are by no criterion.
  const FitResult along_probe = checked_fit(readings, chosen);
  if (along_probe.status != FitStatus::converged) return exit_code_of(along_probe, readings.source);
  for (const auto& [name, estimate] : along_probe.parameters)
    if (!along_probe.axis_known() && !estimate.why_not.empty())
      throw Refusal(readings.source + ": " + estimate.why_not);
  const bool converged = found.of_centres.status == AssociationStatus::converged;
  results.write(outputs, "--json", [&] { return stream_association_json(found); });
  if (converged) {
    results.write(outputs, "--certificate",
                  [&] { return association_certificate(found.of_centres, found.points); });
    results.write(outputs, "--residuals",
                  [&] { return association_distances(found.of_centres, found.points); });
  }
  outputs.commit();
  if (!converged) {
    std::cerr << stream.path << ": " << found.of_centres.why << ".\n";
    return numerical;
  }
  if (!results.printed()) std::cout << stream_association_text(found);
  return done;
}

}  // namespace trueaxis::cli
