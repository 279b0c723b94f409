// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/diagnose/diagnosis.hpp"

namespace trueaxis {

Diagnosis diagnose(const ProbeStream& stream, const DiagnoseOptions& options) {
  Diagnosis diagnosis;
  diagnosis.baseline = fit(stream, options.fit);
  diagnosis.extended = diagnosis.baseline;
  return diagnosis;
}

const char* to_string(DiagnosisVerdict verdict) {
  switch (verdict) {
    case DiagnosisVerdict::ideal:
      return "ideal";
    case DiagnosisVerdict::effects:
      return "effects";
    case DiagnosisVerdict::unexplained:
      return "unexplained";
  }
  return "";
}

}  // namespace trueaxis
