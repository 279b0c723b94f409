// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace trueaxis {

/// An open file, or standard input for "-", read from its beginning to its end.
/// @throws InputError where it cannot be opened, and where reading it fails on the way
class ByteSource {
 public:
  explicit ByteSource(const std::string& path);
  /// Up to `room` bytes; 0 at the end.
  std::size_t read(char* to, std::size_t room);
  std::size_t size() const { return size_; }  ///< 0 where it is not known

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::string path_;
  std::unique_ptr<std::FILE, Close> own_;  ///< none: standard input
  std::size_t size_ = 0;
};

/// The whole file, or standard input for "-". @throws InputError as ByteSource does
std::string read_file(const std::string& path);

/// "xxh3-64:<16 hex digits>" of `bytes`.
std::string content_hash(std::string_view bytes);

/// What tells a file from every other, however it is called: its device and its number there. If it
/// does not exist yet, those of its folder, and its name.
struct FileIdentity {
  std::uint64_t device = 0, number = 0;
  std::string name;
  bool operator==(const FileIdentity&) const = default;
};

/// The identity of the file that is read at `path`, "-" for standard input. Nothing for what
/// writing does not lose: a device, a pipe, a folder.
std::optional<FileIdentity> identity_of_input(const std::string& path);

/// The identity of the file that would be written at `path`, "-" for standard output; nothing as
/// above.
std::optional<FileIdentity> identity_of_output(const std::string& path);

/// The place that `path` leads to: every link followed, one to a file that is not there too.
std::string link_target(const std::string& path);

/// "-", or another name of it.
bool is_standard_output(const std::string& path);

/// The text of a path, with slashes in every system: a result has the same bytes on each.
std::string path_text(const std::filesystem::path& path);

/// The path of what the file at `file` calls `name`: from its folder on, and as short as possible.
std::string path_next_to(const std::string& file, const std::string& name);

}  // namespace trueaxis
