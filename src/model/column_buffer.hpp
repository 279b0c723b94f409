// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>

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

}  // namespace trueaxis
