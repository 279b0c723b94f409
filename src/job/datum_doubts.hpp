// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "job/check.hpp"

namespace trueaxis {

/// The part slipped while one of the references of a datum system was probed: the others may be of
/// the part as it stood before.
extern const JobCheck slipped_between_references;

/// The first reference of a common datum that is off its axis by more than the tolerance.
extern const JobCheck datum_members_apart;

/// References beside the datum whose axes are farther off it than the tolerance.
extern const JobCheck references_off_datum;

}  // namespace trueaxis
