// SPDX-License-Identifier: Apache-2.0
#include "format/output_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <utility>

#include "format/file_identity.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {

namespace fs = std::filesystem;

OutputFile::OutputFile(const std::string& path)
    : path_(is_standard_output(path) ? "-" : path), place_(link_target(path_)) {
  if (path_ == "-") return;
  std::error_code error;
  const fs::file_status status = fs::status(place_, error);
  if (fs::is_directory(status)) fail("it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    file_.open(place_, std::ios::binary);
  } else {
    beside_ = place_ + ".part" + std::to_string(::getpid());
    while (fs::exists(beside_, error)) beside_ += '_';
    file_.open(beside_, std::ios::binary);
  }
  if (!file_) {
    beside_.clear();
    fail(std::strerror(errno));
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
