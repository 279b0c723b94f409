// SPDX-License-Identifier: Apache-2.0
#include "job/files/job_file.hpp"

#include <utility>

#include "base/diagnostics.hpp"

namespace trueaxis {
namespace {

/// Whether two references share readings of one file.
bool overlap(const ZRange& a, const ZRange& b) {
  return a.from_mm <= b.to_mm && b.from_mm <= a.to_mm;
}

}  // namespace

ProbeStream read_stream(const StreamFile& file) {
  ProbeStream stream = read_recording(file.path, file.said);
  return file.z.everywhere() ? stream : within(stream, file.z);
}

std::vector<ProbeStream> read_streams(const JobFile& file) {
  std::vector<ProbeStream> streams = read_each(file.streams, read_stream);
  std::vector<Diagnostic> diagnostics;
  const std::vector<JobReference>& references = file.job.references;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (streams[i].input_hash != streams[k].input_hash ||
          !overlap(file.streams[i].z, file.streams[k].z))
        continue;
      diagnostics.push_back({file.streams[i].path, 0, 0,
                             "contains the readings of " + references[k].name + " (" +
                                 file.streams[k].path + ") again, for the reference " +
                                 references[i].name +
                                 ": name the stream of each, or give each its own range of Z "
                                 "(z_from_mm, z_to_mm)"});
    }
  }
  if (!diagnostics.empty()) throw InputError(std::move(diagnostics));
  return streams;
}

}  // namespace trueaxis
