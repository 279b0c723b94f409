// SPDX-License-Identifier: Apache-2.0
#include <sys/mman.h>

#include <cstdlib>

#include "platform/memory.hpp"

namespace trueaxis::platform {

void* allocate_aligned(std::size_t alignment, std::size_t bytes) {
  void* memory = std::aligned_alloc(alignment, bytes);
  constexpr std::size_t huge_page = std::size_t{2} << 20;
  if (memory != nullptr && alignment >= huge_page)
    madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: without it, small pages
  return memory;
}

void free_aligned(void* memory) { std::free(memory); }

}  // namespace trueaxis::platform
