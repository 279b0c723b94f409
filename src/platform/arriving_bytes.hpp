// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace trueaxis::platform {

/// Bytes that another program is still writing: a growing file, standard input ("-"), or the output
/// of a program that is started.
class ArrivingBytes {
 public:
  static ArrivingBytes of_file(const std::string& path);
  static ArrivingBytes of_program(const std::string& command);
  ~ArrivingBytes();
  ArrivingBytes(ArrivingBytes&&) noexcept;

  bool is_open() const;
  /// Whether read() returns at once; waits up to `milliseconds` for it.
  bool wait(int milliseconds) const;
  /// Up to `room` bytes; 0: there is no more, of a file for now.
  std::size_t read(char* to, std::size_t room);

 private:
  struct Impl;
  explicit ArrivingBytes(Impl impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace trueaxis::platform
