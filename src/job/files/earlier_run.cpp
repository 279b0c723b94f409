// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>

#include "format/file.hpp"
#include "format/json.hpp"
#include "job/files/job_results.hpp"

namespace trueaxis {
namespace {

/// A file that a run wrote, as its result.json names it under `files`.
struct WrittenFile {
  std::string name, hash;  ///< in the folder of the results; content_hash() of what was written
};

/// What the run that left `result_path` wrote next to it; empty if there is no such result. Names
/// that are not plain are passed over.
std::vector<WrittenFile> files_of_earlier_run(const std::string& result_path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(result_path, error)) return {};
  const Json json = Json::parse(read_file(result_path), nullptr, false);
  if (!json.is_object() || json.value("schema", Json()) != "trueaxis.run/2") return {};
  std::vector<WrittenFile> earlier;
  for (const Json& entry : json.value("files", Json::array())) {
    const Json name = entry.is_object() ? entry.value("name", Json()) : Json();
    const Json hash = entry.is_object() ? entry.value("hash", Json()) : Json();
    if (!name.is_string() || !hash.is_string()) continue;
    const std::string file = name.get<std::string>();
    const bool plain = !file.empty() && file != ".." && file != "." &&
                       file == std::filesystem::path(file).filename().string();
    if (plain) earlier.push_back({file, hash.get<std::string>()});
  }
  return earlier;
}

/// A table of this job is there only if it may be run: one that was changed gets another name.
EarlierRun take_away_earlier(Outputs& outputs, const JobResult& result,
                             const std::vector<ResultFile>& files) {
  EarlierRun said;
  std::vector<std::string> tables;
  if (!has_table(result)) {
    tables.push_back("table.csv");
    for (const ControlTable& output : result.job.outputs) tables.push_back(output.file);
  }
  for (const WrittenFile& file : files_of_earlier_run(outputs.in_folder("result.json"))) {
    const std::string place = outputs.in_folder(file.name);
    if (!std::filesystem::exists(place)) continue;
    if (std::ranges::find(files, file.name, &ResultFile::name) != files.end()) {
      if (content_hash(read_file(place)) == file.hash) continue;
      if (const std::string name = outputs.set_aside(place); !name.empty())
        said.kept += "warning: " + place + " was changed since the job that made it: TrueAxis " +
                     "keeps it as " + name + " and writes its own\n";
      continue;
    }
    const bool table = std::ranges::find(tables, file.name) != tables.end();
    if (outputs.remove_unchanged(place, file.hash)) {
      if (!table) said.removed += "gone   " + place + ": from an earlier job\n";
      std::erase(tables, file.name);
    } else if (!table) {
      said.kept += "warning: " + place +
                   " is from an earlier job and was changed since: TrueAxis keeps it, but it does "
                   "not belong to this result\n";
    }
  }
  for (const std::string& table : tables)
    if (const std::string name = outputs.set_aside(outputs.in_folder(table)); !name.empty())
      said.kept += "warning: " + outputs.in_folder(table) +
                   " is not of this job, which makes "
                   "none: TrueAxis keeps it as " +
                   name + "\n";
  return said;
}

}  // namespace

void name_job_files(Outputs& outputs, const JobFile& file, const std::string& folder) {
  outputs.reads(file.path);
  for (const StreamFile& stream : file.streams) outputs.reads(stream.path);
  for (const std::string& one : file.templates) outputs.reads(one);
  if (file.verification) {
    outputs.reads(file.verification->stream.path);
    outputs.reads(file.verification->table);
    if (!file.verification->form.path.empty()) outputs.reads(file.verification->form.path);
  }
  outputs.into(folder);
  for (const ResultName& result : job_file_names(file.job))
    outputs.may_write_in_folder(result.name, result.schema);
  outputs.may_write_in_folder("report.html", "trueaxis.report");
}

EarlierRun write_job_files(Outputs& outputs, const JobResult& result,
                           const std::vector<ResultFile>& files) {
  for (const ResultFile& file : files) outputs.write(outputs.in_folder(file.name), file.text);
  EarlierRun earlier = take_away_earlier(outputs, result, files);
  outputs.commit();
  return earlier;
}

}  // namespace trueaxis
