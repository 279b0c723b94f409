// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "job/files/job_results.hpp"
#include "measure/seats.hpp"
#include "recording/import.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

ZRange range_of_reference(const JobReference& reference) {
  ZRange range;
  if (reference.read.z_from_mm) range.from_mm = *reference.read.z_from_mm;
  if (reference.read.z_to_mm) range.to_mm = *reference.read.z_to_mm;
  return range;
}

ProbeStream read_stream(const JobReference& reference) {
  const StreamReading& said = reference.read;
  RecordingOptions options{said.columns,
                           said.skip_lines,
                           {said.diameter, SaidBy::job, said.indication, said.nominal_radius_mm}};
  options.read.drop_invalid = said.drop_invalid;
  ProbeStream stream = read_recording(reference.stream, options);
  if (!said.z_from_mm && !said.z_to_mm) return stream;
  return within(stream, range_of_reference(reference));
}

/// Whether two references share readings of one file.
bool overlap(const JobReference& a, const JobReference& b) {
  const ZRange first = range_of_reference(a), second = range_of_reference(b);
  return first.from_mm <= second.to_mm && second.from_mm <= first.to_mm;
}

}  // namespace

std::vector<ProbeStream> read_streams(const Job& job) {
  std::vector<ProbeStream> streams;
  std::vector<Diagnostic> diagnostics;
  for (const JobReference& reference : job.references) {
    try {
      streams.push_back(read_stream(reference));
    } catch (const InputError& error) {
      diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  }
  for (std::size_t i = 0; i < streams.size() && diagnostics.empty(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (streams[i].input_hash != streams[k].input_hash ||
          !overlap(job.references[i], job.references[k]))
        continue;
      diagnostics.push_back({job.references[i].stream, 0, 0,
                             "holds the readings of " + job.references[k].name + " (" +
                                 job.references[k].stream + ") again, for the reference " +
                                 job.references[i].name +
                                 ": name the stream of each, or give each its own range of Z "
                                 "(z_from_mm, z_to_mm)"});
    }
  }
  if (!diagnostics.empty()) throw InputError(std::move(diagnostics));
  return streams;
}

}  // namespace trueaxis
