// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "trueaxis/base/error.hpp"
#include "trueaxis/math/sincos.hpp"
#include "trueaxis/model/normal_matrix.hpp"

namespace trueaxis {

PreparedStream::PreparedStream(const ProbeStream& stream)
    : reading_(stream.reading_mm),
      position_(stream.position_mm),
      cos_(stream.size()),
      sin_(stream.size()) {
  expects(stream.size() > 0, "readings");
  expects(stream.c_rad.size() == stream.size(), "C for every reading");
  expects(position_.empty() || position_.size() == stream.size(),
          "a position for every reading, or none");
  sincos(stream.c_rad, sin_, cos_);
  if (position_.empty()) zeros_.assign(block_size, 0.0);

  const std::size_t last = blocks() - 1, begin = last * block_size;
  if (filled(last) == block_size) return;
  tail_.resize(4 * block_size);
  for (std::size_t i = 0; i < block_size; ++i) {
    const std::size_t j = std::min(begin + i, size() - 1);
    tail_[i] = reading_[j];
    tail_[block_size + i] = cos_[j];
    tail_[2 * block_size + i] = sin_[j];
    tail_[3 * block_size + i] = position_.empty() ? 0.0 : position_[j];
  }
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
  return {reading_.data() + begin, cos_.data() + begin, sin_.data() + begin,
          position_.empty() ? zeros_.data() : position_.data() + begin};
}

}  // namespace trueaxis
