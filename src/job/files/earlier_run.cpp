// SPDX-License-Identifier: Apache-2.0
#include "job/files/earlier_run.hpp"

#include <algorithm>
#include <filesystem>

#include "format/file.hpp"
#include "format/json.hpp"

namespace trueaxis {

std::vector<WrittenFile> files_of_earlier_run(const std::string& result_path,
                                              const std::vector<ResultFile>& now) {
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
    if (plain && std::ranges::find(now, file, &ResultFile::name) == now.end())
      earlier.push_back({file, hash.get<std::string>()});
  }
  return earlier;
}

}  // namespace trueaxis
