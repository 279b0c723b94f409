// SPDX-License-Identifier: Apache-2.0
#include "format/file.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "trueaxis/error.hpp"

namespace trueaxis {

constexpr std::uintmax_t largest_at_once = std::uintmax_t{1} << 33;

std::string read_file(const std::string& path) {
  if (path == "-") return {std::istreambuf_iterator<char>(std::cin), {}};
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw InputError(path, "is a folder: name a file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path, std::string("cannot be read (") + std::strerror(errno) + ")");
  std::string text;
  std::error_code no_size;  // of a pipe; and what has one may have more by now
  if (const auto size = std::filesystem::file_size(path, no_size);
      !no_size && size < largest_at_once) {
    text.resize(size);
    in.read(text.data(), static_cast<std::streamsize>(size));
    text.resize(static_cast<std::size_t>(in.gcount()));
  }
  text.append(std::istreambuf_iterator<char>(in), {});
  return text;
}

std::string content_hash(std::string_view bytes) {
  return fmt::format("xxh3-64:{:016x}", XXH3_64bits(bytes.data(), bytes.size()));
}

namespace {

namespace fs = std::filesystem;

std::optional<FileIdentity> of_file(const struct stat& status) {
  if (!S_ISREG(status.st_mode)) return std::nullopt;
  return FileIdentity{status.st_dev, status.st_ino, {}};
}

/// Of a file there is, or of a place for one; "-" is the open file `descriptor`.
std::optional<FileIdentity> identity(const std::string& path, int descriptor) {
  struct stat status {};
  if (path == "-")
    return ::fstat(descriptor, &status) == 0 ? of_file(status) : std::optional<FileIdentity>();
  const std::string place = link_target(path);
  if (::stat(place.c_str(), &status) == 0) return of_file(status);
  const fs::path folder = fs::path(place).parent_path();
  if (::stat(folder.empty() ? "." : folder.c_str(), &status) != 0)
    return FileIdentity{0, 0, fs::absolute(place).lexically_normal().string()};
  return FileIdentity{status.st_dev, status.st_ino, fs::path(place).filename().string()};
}

}  // namespace

std::optional<FileIdentity> identity_of_input(const std::string& path) {
  return identity(path, STDIN_FILENO);
}

std::optional<FileIdentity> identity_of_output(const std::string& path) {
  return identity(is_standard_output(path) ? "-" : path, STDOUT_FILENO);
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

}  // namespace trueaxis
