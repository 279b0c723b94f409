// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <utility>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// A limit of a check and where it comes from.
struct Threshold {
  const char* name;
  double value;
  const char* unit;
  const char* source;
};

/// What a check makes of a job that it finds something in.
enum class Weight {
  forbids,      ///< no go
  leaves_open,  ///< not proven
  reserves,     ///< a go with reservations
};

/// When it is made.
enum class CheckedAt {
  references,  ///< before a cut is planned
  cut,         ///< the cut is planned, or refused
  tolerance,   ///< the numbers keep the tolerance
};

struct CheckInput {
  const PlannedJob& job;
  const CutNumbers& cut;
};

/// One thing that is looked at before anybody cuts.
struct JobCheck {
  const char* id;
  CheckedAt at;
  Weight weight;
  std::span<const Threshold> thresholds;
  Reasons (*find)(const CheckInput&);  ///< none: nothing speaks against it

  Reasons operator()(const CheckInput& input) const { return find(input); }
  Reasons operator()(const PlannedJob& job) const { return find({job, {}}); }
};

/// All of them, in the order in which they are made.
std::span<const JobCheck* const> checks();

/// What the first of a weight finds that finds anything, of those made up to `last`.
Reasons first_found(Weight weight, CheckedAt last, const CheckInput& input);

/// What all of a weight find.
Reasons all_found(Weight weight, const CheckInput& input);

/// The first that `find` gives of a reference; none: of no reference.
template <typename Find>
Reasons first_of_references(const IdentifiedJob& job, Find find) {
  for (std::size_t i = 0; i < job.fits.size(); ++i)
    if (std::optional<Reason> one = find(i)) return {std::move(*one)};
  return {};
}

/// The same of a diagnosed reference; what `find` gives is of that one.
template <typename Find>
Reasons first_diagnosed(const IdentifiedJob& job, Find find) {
  return first_of_references(job, [&](std::size_t i) -> std::optional<Reason> {
    if (i >= job.diagnoses.size() || !job.diagnoses[i]) return {};
    std::optional<Reason> one = find(i);
    if (one) one->references = {i};
    return one;
  });
}

}  // namespace trueaxis
