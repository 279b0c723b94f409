// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "surface/surface.hpp"
#include "trueaxis/probe_stream.hpp"

namespace trueaxis {
/// A column of doubles that is written before it is read: not zeroed, and large ones on huge pages,
/// because faulting in small pages costs more than computing what goes into them.
class ColumnBuffer {
 public:
  ColumnBuffer() = default;
  explicit ColumnBuffer(std::size_t size);

  std::span<double> view() const { return {data_.get(), size_}; }
  double* data() const { return data_.get(); }

 private:
  struct Free {
    void operator()(double* data) const;
  };
  std::unique_ptr<double[], Free> data_;
  std::size_t size_ = 0;
};

/// A stream as the kernels read it: views of its columns, sin C and cos C computed once.
/// The stream must outlive it.
class PreparedStream {
 public:
  explicit PreparedStream(const ProbeStream& stream);
  ~PreparedStream();
  PreparedStream(const PreparedStream&) = delete;
  PreparedStream& operator=(const PreparedStream&) = delete;

  /// Takes the readings of the source anew: they may be other numbers, at the same C and position.
  void reload_readings();

  const ProbeStream& source() const { return source_; }
  std::size_t size() const { return reading_.size(); }
  std::size_t blocks() const { return (size() + block_size - 1) / block_size; }
  /// Readings of a block; the last one is filled up with copies of the last reading.
  ReadingBlock block(std::size_t index) const;
  /// How many readings of a block are real.
  std::size_t filled(std::size_t index) const;

 private:
  const ProbeStream& source_;
  std::span<const double> reading_, position_;
  struct Angles;
  std::unique_ptr<Angles> angles_;    ///< cos C and sin C
  std::vector<double> zeros_, tail_;  ///< position of a stream without Z; the padded last block
};

}  // namespace trueaxis
