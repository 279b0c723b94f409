// SPDX-License-Identifier: Apache-2.0
#include "model/column_buffer.hpp"

#include <sys/mman.h>

#include <cstdlib>
#include <new>

namespace trueaxis {
namespace {

constexpr std::size_t huge_page = std::size_t{2} << 20;
constexpr std::size_t cache_line = 64;

}  // namespace

ColumnBuffer::ColumnBuffer(std::size_t size) : size_(size) {
  const std::size_t alignment = size * sizeof(double) >= huge_page ? huge_page : cache_line;
  const std::size_t bytes = (size * sizeof(double) + alignment - 1) / alignment * alignment;
  void* memory = std::aligned_alloc(alignment, bytes == 0 ? alignment : bytes);
  if (memory == nullptr) throw std::bad_alloc();
  if (alignment == huge_page)
    madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: without it, small pages
  data_.reset(static_cast<double*>(memory));
}

void ColumnBuffer::Free::operator()(double* data) const { std::free(data); }

}  // namespace trueaxis
