// SPDX-License-Identifier: Apache-2.0
#include "format/output_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <utility>

#include "trueaxis/error.hpp"

namespace trueaxis {

namespace fs = std::filesystem;

OutputFile::OutputFile(const std::string& path) : path_(path), place_(path) {
  if (path == "-") return;
  std::error_code error;
  if (fs::is_symlink(path, error)) {
    const fs::path target = fs::canonical(path, error);
    if (!error) place_ = target.string();
  }
  const fs::file_status status = fs::status(place_, error);
  if (fs::is_directory(status)) fail("it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    file_.open(place_, std::ios::binary);
  } else {
    const fs::path folder = fs::path(place_).parent_path();
    if (!folder.empty()) fs::create_directories(folder, error);
    beside_ = place_ + ".part" + std::to_string(::getpid());
    file_.open(beside_, std::ios::binary);
  }
  if (!file_) {
    beside_.clear();
    fail(error ? error.message() : std::strerror(errno));
  }
}

OutputFile::~OutputFile() {
  std::error_code ignored;
  if (!beside_.empty()) fs::remove(beside_, ignored);
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)),
      place_(std::move(other.place_)),
      beside_(std::exchange(other.beside_, {})),
      file_(std::move(other.file_)) {}

void OutputFile::write(std::string_view text) {
  std::ostream& out = path_ == "-" ? std::cout : file_;
  if (!out.write(text.data(), static_cast<std::streamsize>(text.size())))
    fail(std::strerror(errno));
}

void OutputFile::close() {
  if (path_ == "-") {
    if (!std::cout.flush()) fail(std::strerror(errno));
  } else if (file_.is_open()) {
    file_.close();
    if (!file_) fail(std::strerror(errno));
  }
}

void OutputFile::commit() {
  close();
  if (beside_.empty()) return;
  std::error_code error;
  fs::rename(beside_, place_, error);
  if (error) fail(error.message());
  beside_.clear();
}

void OutputFile::fail(const std::string& why) const {
  const std::string name = path_ == "-" ? "standard output" : path_;
  throw InputError(name, "cannot be written (" + why + "): name a place that can be written");
}

}  // namespace trueaxis
