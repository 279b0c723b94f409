// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/results.hpp"
#include "cli/stream_options.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/part_form.hpp"

namespace trueaxis::cli {

/// The readings of one surface. `outputs` has the results and the place of the stream.
/// @throws InputError with what is wrong in the stream and with the places
ProbeStream read_one_surface(const StreamOptions& stream, const AssociationOptions& association,
                             const Results& results, Outputs& outputs);

/// A fit without an axis where the stream alone speaks against it: the part moved within a pass, or
/// the sensor was at the end of its range. Angles so few that lobes may count are a note.
FitResult checked_fit(const ProbeStream& stream, const FitOptions& options);

/// A diagnosis without an axis where there is a doubt about it, and the form of the part.
struct CheckedDiagnosis {
  ProbeStream stream;  ///< corrected by what is known
  Diagnosis diagnosis;
  PartForm form;

  /// The fit that broke, else the final one: by it a command ends.
  const FitResult& deciding_fit() const;
};

CheckedDiagnosis checked_diagnosis(ProbeStream stream, const DiagnoseOptions& options);

}  // namespace trueaxis::cli
