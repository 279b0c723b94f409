// SPDX-License-Identifier: Apache-2.0
#include "format/file.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "platform/files.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {

namespace {

[[noreturn]] void cannot_be_read(const std::string& path) {
  throw InputError(path, std::string("cannot be read (") + std::strerror(errno) +
                             "): name a file that can be read");
}

}  // namespace

ByteSource::ByteSource(const std::string& path) : path_(path) {
  if (path == "-") return;
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status)) throw InputError(path, "is a folder: name a file");
  own_.reset(platform::open_to_read(path));
  if (!own_) cannot_be_read(path);
  if (!std::filesystem::is_regular_file(status)) return;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error) size_ = size;
}

std::size_t ByteSource::read(char* to, std::size_t room) {
  std::FILE* const file = own_ ? own_.get() : stdin;
  const std::size_t got = std::fread(to, 1, room, file);
  if (std::ferror(file) != 0) cannot_be_read(path_);
  return got;
}

std::string read_file(const std::string& path) {
  constexpr std::size_t largest_at_once = std::size_t{1} << 33U, more = std::size_t{1} << 20U;
  ByteSource source(path);
  std::string text(std::min(source.size(), largest_at_once) + 1, '\0');  // a byte shows the end
  std::size_t filled = 0;
  while (const std::size_t got = source.read(text.data() + filled, text.size() - filled)) {
    filled += got;
    if (filled == text.size()) text.resize(filled + std::max(filled / 2, more));
  }
  text.resize(filled);
  return text;
}

std::string content_hash(std::string_view bytes) {
  return fmt::format("xxh3-64:{:016x}", XXH3_64bits(bytes.data(), bytes.size()));
}

namespace {

namespace fs = std::filesystem;

using Status = std::optional<platform::FileStatus>;

std::optional<FileIdentity> of_file(const Status& status) {
  if (!status || !status->regular) return std::nullopt;
  return FileIdentity{status->device, status->number, {}};
}

/// The identity of a file, or of a place for one.
std::optional<FileIdentity> of_place(const std::string& path) {
  const std::string place = link_target(path);
  if (const Status status = platform::status_of(place)) return of_file(status);
  const fs::path folder = fs::path(place).parent_path();
  const Status status = platform::status_of(folder.empty() ? "." : folder.string());
  if (!status) return FileIdentity{0, 0, fs::absolute(place).lexically_normal().string()};
  return FileIdentity{status->device, status->number, fs::path(place).filename().string()};
}

}  // namespace

std::optional<FileIdentity> identity_of_input(const std::string& path) {
  return path == "-" ? of_file(platform::status_of_input()) : of_place(path);
}

std::optional<FileIdentity> identity_of_output(const std::string& path) {
  return is_standard_output(path) ? of_file(platform::status_of_output()) : of_place(path);
}

std::string link_target(const std::string& path) {
  fs::path place = path;
  std::error_code error;
  for (int links = 0; links < 40 && fs::is_symlink(place, error); ++links) {
    const fs::path to = fs::read_symlink(place, error);
    if (error) break;
    place = place.parent_path() / to;  // an absolute one replaces all
  }
  return place.string();
}

bool is_standard_output(const std::string& path) {
  return path == "-" || path == "/dev/stdout" || path == "/dev/fd/1";
}

namespace fs = std::filesystem;

std::string path_text(const fs::path& path) {
  std::string text = path.string();
  constexpr auto separator = static_cast<char>(fs::path::preferred_separator);
  std::ranges::replace(text, separator, '/');
  return text;
}

std::string path_next_to(const std::string& file, const std::string& name) {
  const fs::path path = fs::path(file).parent_path() / name;
  const std::string shortest = path_text(path.lexically_normal());
  // A path of the network begins with two, of which lexically_normal leaves one.
  const bool of_network = path_text(path).starts_with("//") && !shortest.starts_with("//");
  return of_network ? '/' + shortest : shortest;
}

}  // namespace trueaxis
