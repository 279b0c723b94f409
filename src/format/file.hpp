// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <string_view>

namespace trueaxis {

/// The whole file, or standard input for "-". @throws InputError when it cannot be read.
std::string read_file(const std::string& path);

/// "xxh3-64:<16 hex digits>" of `bytes`.
std::string content_hash(std::string_view bytes);

/// What tells a file from every other, however it is called: its device and its number there. Of
/// one that is not there yet, those of its folder, and its name.
struct FileIdentity {
  dev_t device = 0;
  ino_t number = 0;
  std::string name;
  bool operator==(const FileIdentity&) const = default;
};

/// Of the file that is read at `path`, "-" for standard input. Nothing for what writing does not
/// lose: a device, a pipe, a folder.
std::optional<FileIdentity> identity_of_input(const std::string& path);

/// Of the file that would be written at `path`, "-" for standard output; nothing as above.
std::optional<FileIdentity> identity_of_output(const std::string& path);

/// The place that `path` leads to: every link followed, one to a file that is not there too.
std::string link_target(const std::string& path);

/// "-", or another name of it.
bool is_standard_output(const std::string& path);

}  // namespace trueaxis
