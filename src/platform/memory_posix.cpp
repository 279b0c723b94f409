// SPDX-License-Identifier: Apache-2.0
#include <malloc.h>
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

void keep_freed_memory() {
  // Where glibc's own thresholds, which rise with what is freed, end.
  constexpr int most = 32 << 20;
  mallopt(M_MMAP_THRESHOLD, most);
  mallopt(M_TRIM_THRESHOLD, 2 * most);
}

}  // namespace trueaxis::platform
