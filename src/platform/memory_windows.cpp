// SPDX-License-Identifier: Apache-2.0
#include <malloc.h>

#include "platform/memory.hpp"

namespace trueaxis::platform {

void* allocate_aligned(std::size_t alignment, std::size_t bytes) {
  return ::_aligned_malloc(bytes, alignment);
}

void free_aligned(void* memory) { ::_aligned_free(memory); }

void keep_freed_memory() {}  // its heap does

}  // namespace trueaxis::platform
