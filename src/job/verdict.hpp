// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// The whole decision about a job, from what is identified, planned and assessed of its form; Eq.
/// 120. Made of checks(): no go where the first finds what forbids a cut; not proven where one
/// leaves the axis open; then the tolerance, and what is to be said beside a go.
Verdict decide(const PlannedJob& job, std::span<const PartForm> forms = {});

}  // namespace trueaxis
