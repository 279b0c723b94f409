// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "measure/files/stream_csv.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis::cli {

/// All streams of a job, with the diagnostics of all of them at once.
inline std::vector<ProbeStream> read_streams(const Job& job) {
  std::vector<ProbeStream> streams;
  std::vector<Diagnostic> diagnostics;
  for (const JobReference& reference : job.references) {
    try {
      const StreamReading& said = reference.read;
      streams.push_back(read_stream_csv(reference.stream,
                                        {said.diameter, said.indication, said.nominal_radius_mm}));
    } catch (const InputError& error) {
      diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  }
  if (!diagnostics.empty()) throw InputError(std::move(diagnostics));
  return streams;
}

}  // namespace trueaxis::cli
