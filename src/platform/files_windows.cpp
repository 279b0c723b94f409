// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <io.h>

#include "platform/files.hpp"
#include "platform/windows.hpp"

namespace trueaxis::platform {
namespace {

// Others may open, rename and remove what is open here, as they may everywhere else.
constexpr DWORD shared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

HANDLE opened(const std::string& path, DWORD access, DWORD how, DWORD flags) {
  const HANDLE file =
      ::CreateFileW(wide(path).c_str(), access, shared, nullptr, how, flags, nullptr);
  if (file == INVALID_HANDLE_VALUE) set_errno();
  return file;
}

int descriptor_of(HANDLE file, int flags) {
  return file == INVALID_HANDLE_VALUE ? -1
                                      : ::_open_osfhandle(reinterpret_cast<std::intptr_t>(file),
                                                          flags | _O_BINARY | _O_NOINHERIT);
}

HANDLE handle_of(int descriptor) { return reinterpret_cast<HANDLE>(::_get_osfhandle(descriptor)); }

std::optional<FileStatus> status_of_handle(HANDLE file) {
  if (file == INVALID_HANDLE_VALUE || file == nullptr) return std::nullopt;
  BY_HANDLE_FILE_INFORMATION is{};
  if (::GetFileType(file) != FILE_TYPE_DISK || ::GetFileInformationByHandle(file, &is) == 0)
    return FileStatus{};
  return FileStatus{(is.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) == 0, is.dwVolumeSerialNumber,
                    (std::uint64_t{is.nFileIndexHigh} << 32U) | is.nFileIndexLow};
}

}  // namespace

std::FILE* open_to_read(const std::string& path) {
  const int file = descriptor_of(
      opened(path, GENERIC_READ, OPEN_EXISTING, FILE_FLAG_SEQUENTIAL_SCAN), _O_RDONLY);
  return file < 0 ? nullptr : ::_fdopen(file, "rb");
}

std::optional<FileStatus> status_of(const std::string& path) {
  const HANDLE file = opened(path, 0, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS);
  const std::optional<FileStatus> status = status_of_handle(file);
  if (file != INVALID_HANDLE_VALUE) ::CloseHandle(file);
  return status;
}

std::optional<FileStatus> status_of_input() {
  return status_of_handle(::GetStdHandle(STD_INPUT_HANDLE));
}

std::optional<FileStatus> status_of_output() {
  return status_of_handle(::GetStdHandle(STD_OUTPUT_HANDLE));
}

bool may_write(const std::string& path) {
  const HANDLE file = opened(path, GENERIC_WRITE, OPEN_EXISTING, 0);
  if (file == INVALID_HANDLE_VALUE) return false;
  ::CloseHandle(file);
  return true;
}

bool may_write_in(const std::string& folder) {
  const HANDLE file = opened(folder, FILE_ADD_FILE, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS);
  if (file == INVALID_HANDLE_VALUE) return false;
  ::CloseHandle(file);
  return true;
}

std::string process_id() { return std::to_string(::GetCurrentProcessId()); }

LockableFile::~LockableFile() {
  if (is_open()) ::_close(descriptor_);
}

LockableFile LockableFile::make(const std::string& path) {
  return LockableFile(descriptor_of(opened(path, GENERIC_WRITE, CREATE_NEW, 0), _O_WRONLY));
}

LockableFile LockableFile::existing(const std::string& path) {
  return LockableFile(descriptor_of(opened(path, GENERIC_READ, OPEN_EXISTING, 0), _O_RDONLY));
}

LockableFile LockableFile::for_append(const std::string& path) {
  return LockableFile(
      descriptor_of(opened(path, GENERIC_READ | GENERIC_WRITE, OPEN_ALWAYS, 0), _O_RDWR));
}

LockableFile::Lock LockableFile::lock() {
  OVERLAPPED at{};
  at.OffsetHigh = 0x7fffffff;  // after every byte: a lock keeps others from reading what it covers
  if (::LockFileEx(handle_of(descriptor_), LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY, 0,
                   1, 0, &at) != 0)
    return Lock::held;
  return ::GetLastError() == ERROR_LOCK_VIOLATION ? Lock::taken : Lock::impossible;
}

bool LockableFile::is_there() const {
  FILE_STANDARD_INFO is{};
  return ::GetFileInformationByHandleEx(handle_of(descriptor_), FileStandardInfo, &is, sizeof is) !=
             0 &&
         is.DeletePending == 0;
}

bool LockableFile::append(std::string_view bytes) {
  if (::_lseeki64(descriptor_, 0, SEEK_END) < 0) return false;
  while (!bytes.empty()) {
    constexpr std::size_t most = std::size_t{1} << 30U;
    const int done =
        ::_write(descriptor_, bytes.data(), static_cast<unsigned>(std::min(bytes.size(), most)));
    if (done < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(done));
  }
  return true;
}

bool LockableFile::cut_to(std::uint64_t size) {
  return ::_chsize_s(descriptor_, static_cast<std::int64_t>(size)) == 0;
}

}  // namespace trueaxis::platform
