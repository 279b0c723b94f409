// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace trueaxis::platform {

/// Memory aligned to a power of two, of large pages where the system gives them; null: there is
/// none.
void* allocate_aligned(std::size_t alignment, std::size_t bytes);
void free_aligned(void* memory);

/// Memory that is freed is kept for what asks next: pages given back and taken again cost a tenth
/// of a short command.
void keep_freed_memory();

}  // namespace trueaxis::platform
