// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace trueaxis {

struct FileContent {
  std::string path;
  std::string_view content;
};

/// Writes every file beside its place and, when all could be written, renames them into place in
/// this order; "-" is standard output.
/// @throws InputError when a place cannot be written; no half-written file is left.
void write_files(std::span<const FileContent> files);

/// The same for one file.
void write_file(const std::string& path, std::string_view content);

/// The whole file, or standard input for "-". @throws InputError when it cannot be read.
std::string read_file(const std::string& path);

/// "xxh3-64:<16 hex digits>" of `bytes`.
std::string content_hash(std::string_view bytes);

}  // namespace trueaxis
