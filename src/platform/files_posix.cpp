// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "platform/files.hpp"

namespace trueaxis::platform {
namespace {

std::optional<FileStatus> as_status(int failed, const struct stat& status) {
  if (failed != 0) return std::nullopt;
  return FileStatus{S_ISREG(status.st_mode), status.st_dev, status.st_ino};
}

std::optional<FileStatus> status_of_descriptor(int descriptor) {
  struct stat status {};
  return as_status(::fstat(descriptor, &status), status);
}

}  // namespace

std::FILE* open_to_read(const std::string& path) { return std::fopen(path.c_str(), "rbe"); }

std::optional<FileStatus> status_of(const std::string& path) {
  struct stat status {};
  return as_status(::stat(path.c_str(), &status), status);
}

std::optional<FileStatus> status_of_input() { return status_of_descriptor(STDIN_FILENO); }

std::optional<FileStatus> status_of_output() { return status_of_descriptor(STDOUT_FILENO); }

bool may_write(const std::string& path) { return ::access(path.c_str(), W_OK) == 0; }

bool may_write_in(const std::string& folder) { return ::access(folder.c_str(), W_OK | X_OK) == 0; }

std::string process_id() { return std::to_string(::getpid()); }

LockableFile::~LockableFile() {
  if (is_open()) ::close(descriptor_);
}

LockableFile LockableFile::make(const std::string& path) {
  return LockableFile(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
}

LockableFile LockableFile::existing(const std::string& path) {
  return LockableFile(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
}

LockableFile LockableFile::for_append(const std::string& path) {
  return LockableFile(::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
}

LockableFile::Lock LockableFile::lock() {
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return Lock::held;
  return errno == EWOULDBLOCK ? Lock::taken : Lock::impossible;
}

bool LockableFile::is_there() const {
  struct stat status {};
  return ::fstat(descriptor_, &status) == 0 && status.st_nlink > 0;
}

bool LockableFile::append(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::write(descriptor_, bytes.data(), bytes.size());
    if (done < 0 && errno != EINTR) return false;
    if (done > 0) bytes.remove_prefix(static_cast<std::size_t>(done));
  }
  return true;
}

bool LockableFile::cut_to(std::uint64_t size) {
  return ::ftruncate(descriptor_, static_cast<off_t>(size)) == 0;
}

}  // namespace trueaxis::platform
