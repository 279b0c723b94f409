// SPDX-License-Identifier: Apache-2.0
#include "base/threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

namespace trueaxis::testing {
namespace {

TEST(Threads, EveryIndexOnceOnAnyNumber) {
  for (const int threads : {0, 1, 2, 3, 16}) {
    for (const std::size_t count : {0U, 1U, 7U, 1000U}) {
      std::vector<std::atomic<int>> seen(count);
      for_each_index(count, threads, [&](std::size_t i) { ++seen[i]; });
      for (const std::atomic<int>& times : seen) EXPECT_EQ(times, 1) << threads << ", " << count;
    }
  }
}

TEST(Threads, NoMoreThanThereIsWorkFor) {
  EXPECT_EQ(threads_for(8, 3), 3U);
  EXPECT_EQ(threads_for(2, 3), 2U);
  EXPECT_EQ(threads_for(2, 0), 1U);
  EXPECT_GE(threads_for(0, 1000), 1U);
}

TEST(Threads, TheLeastThatThrowsIsThrown) {
  for (const int threads : {1, 2, 3, 16}) {
    for (int run = 0; run < 50; ++run) {
      try {
        for_each_index(200, threads, [](std::size_t i) {
          if (i % 10 == 7) throw std::runtime_error(std::to_string(i));
        });
        FAIL() << "nothing thrown on " << threads;
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "7") << threads;
      }
    }
  }
}

TEST(Threads, EachMakesItsOwn) {
  std::atomic<std::size_t> made = 0, done = 0;
  for_each_index_with(100, 3, [&]() -> IndexedWork {
    ++made;
    return [&](std::size_t) { ++done; };
  });
  EXPECT_EQ(made, 3U);
  EXPECT_EQ(done, 100U);
}

}  // namespace
}  // namespace trueaxis::testing
