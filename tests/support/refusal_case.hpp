// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "format/toml_reader.hpp"
#include "support/places.hpp"

/// One file of tests/refusals: a wrong job, stream or layout of files as a user meets it, and what
/// the command must say and keep.
namespace trueaxis::testing {

struct RefusalCase {
  struct Edit {
    std::string file, replace, by;
  };
  struct Link {
    std::string name, target;
    bool hard = false;
  };

  std::string why;                   ///< one sentence: what is wrong and was seen
  std::vector<std::string> prepare;  ///< trueaxis commands that must end with 0
  std::string command;               ///< the trueaxis command under test
  int exit = 0;
  std::vector<std::string> says, never;  ///< parts of standard output and error together
  std::vector<std::string> keeps;        ///< files whose bytes must stay
  std::vector<std::string> absent;       ///< files that must not be there after the command
  std::vector<std::string> present;      ///< files that must be there after the command
  std::vector<std::string> read_only;    ///< folders that nobody may write to
  std::vector<std::pair<std::string, std::string>> files;  ///< written first: name and text
  std::vector<Edit> edits;  ///< after `prepare`: every occurrence, at least one
  std::vector<Link> links;  ///< after `prepare`
};

/// `text` with the repository's data folder for every `{data}`.
inline std::string with_data_folder(std::string text) {
  static const std::string key = "{data}", data = places::source() + "/data";
  for (std::size_t at = 0; (at = text.find(key, at)) != std::string::npos; at += data.size())
    text.replace(at, key.size(), data);
  return text;
}

/// @throws InputError for what is not a case, unknown keys among it.
inline RefusalCase read_refusal_case(const std::filesystem::path& path) {
  TomlDocument document(path.string());
  TomlTable root = document.root();
  RefusalCase out;
  out.why = root.required_text("why");
  for (std::string& line : root.texts("prepare"))
    out.prepare.push_back(with_data_folder(std::move(line)));
  out.command = with_data_folder(root.required_text("command"));
  if (!root.has("exit")) root.complain("exit", "the exit code of the command is missing");
  out.exit = static_cast<int>(root.integer("exit", 0, 0, 255));
  out.says = root.texts("says");
  out.never = root.texts("never");
  out.keeps = root.texts("keeps");
  out.absent = root.texts("absent");
  out.present = root.texts("present");
  out.read_only = root.texts("read_only");
  if (auto files = root.maybe_table("files")) {
    for (const std::string& name : files->keys())
      out.files.emplace_back(name, with_data_folder(files->required_text(name)));
  }
  for (TomlTable& edit : root.tables("edit")) {
    out.edits.push_back(
        {edit.required_text("file"), edit.required_text("replace"), edit.required_text("by")});
  }
  for (TomlTable& link : root.tables("link")) {
    out.links.push_back(
        {link.required_text("name"), link.required_text("target"),
         link.required_choice<bool>("kind", {{"hard", true}, {"symbolic", false}})});
  }
  document.finish();
  return out;
}

}  // namespace trueaxis::testing
