// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include "job/files/job_toml_parts.hpp"

namespace trueaxis {
namespace {

void read_filter(TomlTable table, FormTask& task) {
  task.filter = table.choice<ProfileFilter>("form_filter",
                                            {{"gaussian", ProfileFilter::gaussian},
                                             {"robust", ProfileFilter::robust_gaussian},
                                             {"spline", ProfileFilter::spline},
                                             {"none", ProfileFilter::none}},
                                            ProfileFilter::gaussian);
  if (!table.has("form_upr")) return;
  const std::vector<double> band = table.numbers("form_upr", Range::between(1.0, 1500.0));
  if (band.size() == 2 && band[0] < band[1] && band[1] >= 2.0)
    task.band_upr = {band[0], band[1]};
  else
    table.complain("form_upr",
                   "is the pass band in undulations per revolution: [1, 15], [1, 50], "
                   "[1, 150], [1, 500] or another");
}

bool is_round(SurfaceKind surface) {
  return surface == SurfaceKind::cone || surface == SurfaceKind::cylinder ||
         surface == SurfaceKind::section;
}

}  // namespace

FormTask read_form_task(TomlTable table, SurfaceKind surface) {
  FormTask task;
  task.roundness_tolerance_mm = table.maybe_number("roundness_tolerance_mm", Range::positive());
  task.cylindricity_tolerance_mm =
      table.maybe_number("cylindricity_tolerance_mm", Range::positive());
  task.runout_tolerance_mm = table.maybe_number("runout_tolerance_mm", Range::positive());
  task.runout_datum = table.text("runout_datum", "");
  read_filter(table, task);
  if (task.roundness_tolerance_mm && !is_round(surface))
    table.complain("roundness_tolerance_mm", "applies to a cone, cylinder or section: remove it");
  if (task.cylindricity_tolerance_mm && surface != SurfaceKind::cylinder)
    table.complain("cylindricity_tolerance_mm",
                   "applies to a cylinder: remove it, or use roundness_tolerance_um");
  if (task.runout_tolerance_mm && task.runout_datum.empty())
    table.complain("runout_tolerance_mm",
                   "needs a datum: runout_datum = \"spindle axis\" or the name of "
                   "another reference");
  if (!task.runout_tolerance_mm && !task.runout_datum.empty())
    table.complain("runout_datum", "has no effect without a runout_tolerance_um");
  return task;
}

void check_runout_datums(TomlTable root, const Job& job) {
  for (std::size_t i = 0; i < job.references.size(); ++i) {
    const JobReference& reference = job.references[i];
    const std::string& datum = reference.form.runout_datum;
    if (datum.empty() || datum == spindle_axis) continue;
    const auto named = std::ranges::find(job.references, datum, &JobReference::name);
    const auto complain = [&](const std::string& why) {
      root.complain("reference", "'" + reference.name + "': runout_datum '" + datum + "' " + why);
    };
    if (named == job.references.end())
      complain("is neither a reference of this job nor \"spindle axis\"");
    else if (named->name == reference.name)
      complain("is the reference itself: name another one or \"spindle axis\"");
    else if (!is_round(named->fit.surface))
      complain("is a face, which has no axis: name a cone or cylinder, or \"spindle axis\"");
  }
}

}  // namespace trueaxis
