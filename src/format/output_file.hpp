// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <string>
#include <string_view>

namespace trueaxis {

/// A file that is whole or not there: it is written beside its place and renamed by `commit`; what
/// is not committed is removed. A link keeps pointing to its file, a device or pipe is written as
/// it is, "-" is standard output. A command writes through `Outputs`, which opens these.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// @throws InputError when the place cannot be written; so does every other call.
  void write(std::string_view text);
  void close();   ///< everything is on its way to the disk
  void commit();  ///< closes and renames

 private:
  [[noreturn]] void fail(const std::string& why) const;
  std::string path_, place_, beside_;
  std::ofstream file_;
};

}  // namespace trueaxis
