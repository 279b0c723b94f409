// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

struct zip;

namespace trueaxis {

/// A zip archive in memory; members are unpacked when they are asked for, up to a limit.
class ZipArchive {
 public:
  /// @throws InputError if the bytes are not a whole archive
  ZipArchive(std::string path, std::string_view bytes);
  ~ZipArchive();
  ZipArchive(const ZipArchive&) = delete;
  ZipArchive& operator=(const ZipArchive&) = delete;

  std::vector<std::string> names() const;
  bool has(const std::string& name) const;
  /// @throws InputError where it is not there, broken (its CRC), or larger than what is read at
  /// once
  std::string member(const std::string& name);

 private:
  std::string path_;
  zip* archive_ = nullptr;
  std::size_t unpacked_ = 0;
};

/// The archive of these members, the same bytes at any time.
std::string zip_of(const std::vector<std::pair<std::string, std::string>>& members);

}  // namespace trueaxis
