// SPDX-License-Identifier: Apache-2.0
#include "job/files/stream_job.hpp"

#include <filesystem>
#include <fstream>
#include <utility>

#include "base/counted.hpp"
#include "format/reason_words.hpp"
#include "job/evidence.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {

bool is_job(const std::string& path) {
  if (path == "-" || path.ends_with(".toml")) return true;
  std::ifstream file(std::filesystem::path(path), std::ios::binary);
  for (std::string line; std::getline(file, line);) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    const std::size_t word = line.find_first_not_of("abcdefghijklmnopqrstuvwxyz_", first);
    return line[first] == '[' || (word != std::string::npos && word > first &&
                                  line.find_first_not_of(' ', word) == line.find('='));
  }
  return false;
}

JobFile job_of_stream(StreamFile stream, FitOptions fit) {
  JobFile file{stream.path};
  file.job.name = std::filesystem::path(stream.path).stem().string();
  JobReference& reference = file.job.references.emplace_back();
  reference.name = to_string(fit.surface);
  reference.fit = std::move(fit);
  file.streams.push_back(std::move(stream));
  return file;
}

void expect_one_surface(const ProbeStream& stream, SurfaceKind surface, RangesAs ranges) {
  const ReasonCode of_seat =
      ranges == RangesAs::options ? ReasonCode::range_by_options : ReasonCode::range_by_keys;
  if (const auto why = not_one_surface(stream, surface, of_seat))
    throw InputError(stream.source, words_of(*why));
}

void take_seats(Job& job, std::vector<ProbeStream>& streams) {
  if (const auto seats = take_every_seat(job, streams))
    streams.front().read_as.push_back(words_of(*seats));
}

void choose_surfaces(Job& job, std::vector<ProbeStream>& streams) {
  for (std::size_t i = 0; i < streams.size(); ++i) {
    const SurfaceEvidence evidence = surface_by_evidence(streams[i]);
    job.references[i].fit.surface = evidence.surface;
    streams[i].read_as.push_back(words_of(evidence.why));
  }
  if (streams.size() == 1)
    job.references.front().name = to_string(job.references.front().fit.surface);
}

std::string job_plan_text(const Job& job, const std::vector<ProbeStream>& streams,
                          bool surface_known) {
  std::string text;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    const std::string of = counted(streams[i].size(), "reading") + " of " + streams[i].source;
    text += i == 0 ? "" : "; ";
    text += surface_known ? std::string("fit and diagnose a ") +
                                to_string(job.references[i].fit.surface) + " in " + of
                          : "choose the surface of " + of + " by evidence, fit and diagnose it";
  }
  return text + (job.target ? "; correct the target, and decide about it" : "");
}

}  // namespace trueaxis
