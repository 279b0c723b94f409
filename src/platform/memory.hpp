// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace trueaxis::platform {

/// Memory aligned to a power of two, of large pages where the system gives them; null: there is
/// none.
void* allocate_aligned(std::size_t alignment, std::size_t bytes);
void free_aligned(void* memory);

}  // namespace trueaxis::platform
