// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "job/files/job_toml_parts.hpp"

namespace trueaxis {
namespace {

using Names = std::vector<std::string>;

bool names_a_face(const Job& job, const std::string& name) {
  const auto found = std::ranges::find(job.references, name, &JobReference::name);
  return found != job.references.end() && found->fit.surface == SurfaceKind::plane;
}

bool all_known(TomlTable target, const char* key, const Names& names, const Job& job) {
  Names known;
  for (const JobReference& reference : job.references) known.push_back(reference.name);
  bool all = true;
  for (const std::string& name : names) {
    const auto times = std::ranges::count(known, name);
    if (times == 1) continue;
    all = false;
    target.complain(
        key, times == 0
                 ? fmt::format("names '{}', which is not a reference of this job: those are {}",
                               name, fmt::join(known, ", "))
                 : fmt::format(
                       "names '{}', a name that several references share: give each its own `name`",
                       name));
  }
  return all;
}

/// One datum: cylinders and cones that share an axis, or one face.
bool makes_a_datum(TomlTable target, const char* key, const Names& names, const Job& job) {
  if (!all_known(target, key, names, job)) return false;
  const auto faces =
      std::ranges::count_if(names, [&](const auto& n) { return names_a_face(job, n); });
  if (std::set<std::string>(names.begin(), names.end()).size() < names.size()) {
    target.complain(key, "names a reference twice: name each once");
    return false;
  }
  if (faces > 0 && names.size() > 1) {
    target.complain(
        key,
        "names a face together with another reference: a common datum consists of cylinders and "
        "cones; name the face in the other one of `datum` and `secondary_datum`");
    return false;
  }
  for (const JobReference& reference : job.references)
    if (names.size() > 1 && reference.association &&
        *reference.association != Criterion::gaussian &&
        std::ranges::count(names, reference.name) > 0) {
      target.complain(
          key,
          fmt::format(
              "is a common datum, whose axis is by least squares: remove the `association` of '{}'",
              reference.name));
      return false;
    }
  return true;
}

}  // namespace

std::optional<Criterion> read_association(TomlTable reference, SurfaceKind surface, bool bore) {
  if (!reference.has("association")) return {};
  const auto criterion =
      reference.choice<Criterion>("association",
                                  {{"gaussian", Criterion::gaussian},
                                   {"minimum_zone", Criterion::minimum_zone},
                                   {"minimum_circumscribed", Criterion::minimum_circumscribed},
                                   {"maximum_inscribed", Criterion::maximum_inscribed}},
                                  Criterion::gaussian);
  if (surface != SurfaceKind::cylinder && surface != SurfaceKind::cone) {
    reference.complain("association", "applies to a cylinder or cone: remove it");
    return {};
  }
  const std::string objection = association_objection(
      surface == SurfaceKind::cone ? Element::cone : Element::cylinder, criterion);
  const Criterion of_other_side =
      bore ? Criterion::minimum_circumscribed : Criterion::maximum_inscribed;
  if (!objection.empty())
    reference.complain("association", objection);
  else if (criterion == of_other_side)
    reference.complain(
        "association",
        bore ? "applies to a shaft: the datum of a bore is the maximum_inscribed cylinder"
             : "applies to a bore: the datum of a shaft is the minimum_circumscribed cylinder");
  return criterion;
}

DatumSystem read_datums(TomlTable target, const Job& job) {
  const Names first = target.texts("datum"), second = target.texts("secondary_datum");
  for (const char* key : {"datum", "secondary_datum"})
    if (target.has(key) && (key == std::string("datum") ? first : second).empty())
      target.complain(key, "does not name a reference: remove it for the compromise of all");
  if (first.empty() && !second.empty())
    target.complain("secondary_datum", "needs a primary datum: give `datum` as well");
  if (first.empty() || !makes_a_datum(target, "datum", first, job)) return {};
  if (!second.empty() && !makes_a_datum(target, "secondary_datum", second, job)) return {};
  const bool face = names_a_face(job, first.front());
  const bool needs_place = !job.target || job.target->kind != TargetKind::face;
  if (second.empty() && face && needs_place) {
    target.complain("datum",
                    "is a face, which fixes the direction but not the place: name a cylinder or "
                    "cone as `secondary_datum`");
    return {};
  }
  if (second.empty()) return {first};
  if (names_a_face(job, second.front()) == face) {
    target.complain("secondary_datum",
                    face ? "is a face, as is the primary datum: name a cylinder or cone"
                         : "is an axis, but the primary datum already fixes the axis: name both in "
                           "`datum` for their common axis, or a face here");
    return {};
  }
  return {first, second};
}

}  // namespace trueaxis
