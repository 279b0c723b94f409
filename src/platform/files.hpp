// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

/// What differs between operating systems, once for each: `…_posix.cpp` and `…_windows.cpp`. Paths
/// and all other text are UTF-8. What fails leaves its reason in `errno`.
namespace trueaxis::platform {

/// As std::fopen reads the bytes of a file; null: it cannot be opened.
std::FILE* open_to_read(const std::string& path);

/// What tells an open or existing file from every other, however it is called.
struct FileStatus {
  bool regular = false;
  std::uint64_t device = 0, number = 0;
};

std::optional<FileStatus> status_of(const std::string& path);  ///< nothing: it is not there
std::optional<FileStatus> status_of_input();                   ///< of standard input
std::optional<FileStatus> status_of_output();                  ///< of standard output

bool may_write(const std::string& path);       ///< whether a file may be written
bool may_write_in(const std::string& folder);  ///< whether files may be made in a folder

std::string process_id();

/// A file that processes may lock against each other; closed at the end, which unlocks it.
class LockableFile {
 public:
  enum class Lock { held, taken, impossible };

  LockableFile() = default;  ///< none
  ~LockableFile();
  LockableFile(LockableFile&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  LockableFile& operator=(LockableFile&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }

  static LockableFile make(const std::string& path);        ///< EEXIST: it is there already
  static LockableFile existing(const std::string& path);    ///< to be locked only
  static LockableFile for_append(const std::string& path);  ///< made where it is not there

  bool is_open() const { return descriptor_ >= 0; }
  Lock lock();            ///< at once: without waiting for whoever has it
  bool is_there() const;  ///< false: it was removed since
  bool append(std::string_view bytes);
  bool cut_to(std::uint64_t size);

 private:
  explicit LockableFile(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

}  // namespace trueaxis::platform
