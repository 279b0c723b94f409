// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/diagnosis.hpp"
#include "trueaxis/part_form.hpp"

namespace trueaxis::cli {

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
