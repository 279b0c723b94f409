// SPDX-License-Identifier: Apache-2.0
#include "base/threads.hpp"

#include <gtest/gtest.h>
#include <pthread.h>

#include <atomic>
#include <functional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "mpi/own_share.hpp"

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

/// The system gives no thread whose stack is half of all addresses.
TEST(Threads, WhereTheSystemGivesNoMoreTheOthersDoTheWork) {
  pthread_attr_t usual, huge;
  ASSERT_EQ(pthread_getattr_default_np(&usual), 0);
  ASSERT_EQ(pthread_attr_init(&huge), 0);
  ASSERT_EQ(pthread_attr_setstacksize(&huge, std::size_t{1} << 46U), 0);
  ASSERT_EQ(pthread_setattr_default_np(&huge), 0);
  EXPECT_THROW(std::thread([] {}).join(), std::system_error);
  std::atomic<std::size_t> done = 0;
  for_each_index(100, 4, [&](std::size_t) { ++done; });
  EXPECT_EQ(done, 100U);
  ASSERT_EQ(pthread_setattr_default_np(&usual), 0);
  pthread_attr_destroy(&huge);
  pthread_attr_destroy(&usual);
}

/// The thread of rank 0 hands on what is thrown, by a block or by what makes its worker.
TEST(Threads, OfTheOwnShareOfASweepWhatIsThrownIsHandedOn) {
  const std::vector<study::Block> blocks(3);
  const auto first_thrown = [&](std::function<mpi::OwnShare::Run()> make) {
    std::atomic<std::size_t> next = 0;
    mpi::OwnShare share(std::move(make), blocks, next);
    try {
      while (true) share.take();
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(first_thrown([]() -> mpi::OwnShare::Run { throw std::runtime_error("no worker"); }),
            "no worker");
  EXPECT_EQ(first_thrown([]() -> mpi::OwnShare::Run {
              return [](const study::Block&) -> study::BlockResult {
                throw std::runtime_error("no block");
              };
            }),
            "no block");
}

}  // namespace
}  // namespace trueaxis::testing
