// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "platform/files.hpp"

namespace trueaxis {

/// A file that is whole or not there: it is written next to its place and renamed by `commit`; what
/// is not committed is removed, what a killed run left by the next one. A link keeps pointing to
/// its file, a device or pipe is written as it is, "-" is standard output. A command writes through
/// `Outputs`, which opens these.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// @throws InputError when the place cannot be written; so does every other call.
  void write(std::string_view text);
  void close();   ///< everything is on its way to the disk
  void commit();  ///< closes and renames

 private:
  [[noreturn]] void fail(const std::string& why) const;
  std::string path_, place_, beside_;
  platform::LockableFile
      lock_;  ///< held on the file next to the place: nobody writes one that is not locked
  std::ofstream file_;
};

/// All that a command reads and all that it may write. `check` compares them before anything is
/// written; then all is written or nothing. A file that is read is never written, by whatever name
/// it goes. An existing file that is not an earlier result of the same kind is replaced only with
/// `force`.
///
///     Outputs outputs(force);
///     outputs.reads(stream);
///     outputs.may_write(json, "trueaxis.fit");
///     outputs.check();
///     …
///     outputs.write(json, text);
///     outputs.commit();
class Outputs {
 public:
  explicit Outputs(bool force = false) : force_(force) {}
  ~Outputs();
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;

  /// A file that the command reads, "-" for standard input.
  void reads(const std::string& path);
  /// The folder of the results: `commit` makes it where the folder above it is there.
  void into(const std::string& folder);
  /// A file that the command may write, "-" for standard output; an empty path is a result that
  /// nobody asked for. `schema` is what it will begin with, without the version ("trueaxis.fit");
  /// empty: whoever writes it looks himself at what is there.
  void may_write(const std::string& path, const std::string& schema);
  /// The same for a file of the folder of the results.
  void may_write_in_folder(const std::string& name, const std::string& schema);
  /// A file that whoever gets it then changes, a job, or whose place may hold measured data, a
  /// stream: one that is there, not empty and not `content` already is replaced only with `force`.
  /// A job says no schema.
  void may_begin(const std::string& path, std::string content, const std::string& schema = "");
  std::string in_folder(const std::string& name) const;  ///< its path

  const std::vector<std::string>& inputs() const { return inputs_; }  ///< all that is read
  std::vector<std::string> places() const;                            ///< all that may be written

  /// @throws InputError with every place that must not or cannot be written.
  void check();
  /// Makes the folder of the results now, for what must be on disk before the end.
  void make_folder();

  /// A file that was named before, to be written in pieces. Nothing is at its place yet.
  OutputFile& open(const std::string& path);
  /// The same at once; nothing is done for an empty path.
  void write(const std::string& path, std::string_view content);
  /// What is at a place that was named, and that this run does not write, gets another name when
  /// the results are in theirs: it may be the user's.
  /// @returns that name; empty: nothing of its schema is there
  std::string set_aside(const std::string& path);
  /// Removes a file as long as it holds what an earlier run wrote (content_hash()), likewise;
  /// false: it was changed, is a link or an input, and stays.
  bool remove_unchanged(const std::string& path, const std::string& hash);
  /// Every file into its place, in the order in which they were opened. @throws InputError
  void commit();

 private:
  struct Place {
    std::string path, schema;
    std::optional<std::string> begins{};  ///< what a file that is then changed begins as
  };
  std::string objection(const Place& place) const;
  std::string of_folder() const;
  void remove_left_over(const Place& place) const;

  bool force_, checked_ = false, made_folder_ = false;
  std::vector<std::string> inputs_;
  std::string folder_;
  std::vector<Place> places_;
  struct Earlier {
    std::string path, new_name;  ///< empty: to be removed
  };
  std::vector<Earlier> earlier_;
  std::deque<OutputFile> files_;
};

/// The schema that the file at `path` says of itself, without its version: "trueaxis.fit", or ""
/// for a file that TrueAxis did not write or that is not there. In JSON it is the first member, in
/// CSV a comment line `# schema: …` (a stream: `##`, which is not metadata), in HTML the meta tag
/// `generator`, in Markdown a comment, in a control's own format a comment line `// schema: …`, `;
/// schema: …` or `( schema: …`.
std::string schema_of_file(const std::string& path);

/// The same of the first bytes of a file.
std::string schema_in(std::string_view head);

}  // namespace trueaxis
