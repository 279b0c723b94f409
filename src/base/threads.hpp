// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

namespace trueaxis {

/// Threads for `asked` (0: as many as there are) and `count` pieces of work: at least 1.
std::size_t threads_for(int asked, std::size_t count);

using IndexedWork = std::function<void(std::size_t)>;

/// Calls work(i) once for each i < count on `threads` threads (0: as many as there are), handed out
/// in order; before each it looks whether the work is to end (stop.hpp). If some throw, the rest
/// is left and the exception of the least i is thrown again, the same on any number of threads.
void for_each_index(std::size_t count, int threads, const IndexedWork& work);

/// As above; each thread makes a work of its own, for what it keeps between its pieces.
void for_each_index_with(std::size_t count, int threads, const std::function<IndexedWork()>& make);

}  // namespace trueaxis
