// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <new>

#include "math/sincos.hpp"
#include "model/normal_matrix.hpp"
#include "platform/memory.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t huge_page = std::size_t{2} << 20;
constexpr std::size_t cache_line = 64;

}  // namespace

ColumnBuffer::ColumnBuffer(std::size_t size) : size_(size) {
  const std::size_t alignment = size * sizeof(double) >= huge_page ? huge_page : cache_line;
  const std::size_t bytes = (size * sizeof(double) + alignment - 1) / alignment * alignment;
  void* memory = platform::allocate_aligned(alignment, bytes == 0 ? alignment : bytes);
  if (memory == nullptr) throw std::bad_alloc();
  data_.reset(static_cast<double*>(memory));
}

void ColumnBuffer::Free::operator()(double* data) const { platform::free_aligned(data); }

struct PreparedStream::Angles {
  ColumnBuffer cosine, sine;
};

PreparedStream::~PreparedStream() = default;

PreparedStream::PreparedStream(const ProbeStream& stream)
    : source_(stream),
      reading_(stream.reading_mm),
      position_(stream.position_mm),
      angles_(std::make_unique<Angles>(
          Angles{ColumnBuffer(stream.size()), ColumnBuffer(stream.size())})) {
  expects(stream.size() > 0, "readings");
  expects(stream.c_rad.size() == stream.size(), "C for every reading");
  expects(position_.empty() || position_.size() == stream.size(),
          "a position for every reading, or none");
  sincos(stream.c_rad, angles_->sine.view(), angles_->cosine.view());
  if (position_.empty()) zeros_.assign(block_size, 0.0);

  const std::size_t last = blocks() - 1, begin = last * block_size;
  if (filled(last) == block_size) return;
  tail_.resize(4 * block_size);
  for (std::size_t i = 0; i < block_size; ++i) {
    const std::size_t j = std::min(begin + i, size() - 1);
    tail_[block_size + i] = angles_->cosine.data()[j];
    tail_[2 * block_size + i] = angles_->sine.data()[j];
    tail_[3 * block_size + i] = position_.empty() ? 0.0 : position_[j];
  }
  reload_readings();
}

void PreparedStream::reload_readings() {
  expects(source_.size() == size(), "as many readings as before");
  reading_ = source_.reading_mm;
  if (tail_.empty()) return;
  const std::size_t begin = (blocks() - 1) * block_size;
  for (std::size_t i = 0; i < block_size; ++i) tail_[i] = reading_[std::min(begin + i, size() - 1)];
}

std::size_t PreparedStream::filled(std::size_t index) const {
  return std::min(block_size, size() - index * block_size);
}

ReadingBlock PreparedStream::block(std::size_t index) const {
  if (!tail_.empty() && index + 1 == blocks()) {
    return {tail_.data(), tail_.data() + block_size, tail_.data() + 2 * block_size,
            tail_.data() + 3 * block_size};
  }
  const std::size_t begin = index * block_size;
  return {reading_.data() + begin, angles_->cosine.data() + begin, angles_->sine.data() + begin,
          position_.empty() ? zeros_.data() : position_.data() + begin};
}

}  // namespace trueaxis
