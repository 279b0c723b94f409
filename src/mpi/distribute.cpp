// SPDX-License-Identifier: Apache-2.0
#include "mpi/distribute.hpp"

#include <mpi.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "mpi/own_share.hpp"
#include "study/sweep/files/sweep_journal.hpp"

namespace trueaxis::mpi {
namespace {

using namespace study;

constexpr int work_tag = 1, result_tag = 2;
constexpr int blocks_ahead = 2;                            // a rank never waits for rank 0 to look
constexpr auto look_every = std::chrono::milliseconds(1);  // a tenth of a block
using Message = std::array<std::uint64_t, 3>;              // a block; one of no repeats lets go

int rank_count() {
  int count = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  return count;
}

void send(const Block& block, int rank) {
  const Message message{block.cell, block.first_repeat, block.count};
  MPI_Send(message.data(), static_cast<int>(message.size()), MPI_UINT64_T, rank, work_tag,
           MPI_COMM_WORLD);
}

/// A result that has arrived, and its rank; nothing if none has.
std::optional<std::pair<BlockResult, int>> arrived() {
  int there = 0, size = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, result_tag, MPI_COMM_WORLD, &there, &status);
  if (there == 0) return std::nullopt;
  MPI_Get_count(&status, MPI_BYTE, &size);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  MPI_Recv(bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, result_tag, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return std::pair(decode(bytes), status.MPI_SOURCE);
}

}  // namespace

void distribute(const Sweep& sweep, const std::vector<Block>& blocks,
                const std::function<void(BlockResult&&)>& finished) {
  std::atomic<std::size_t> next = 0;
  const auto hand_out = [&](int rank) {
    const std::size_t i = next++;
    if (i < blocks.size()) send(blocks[i], rank);
  };
  for (int ahead = 0; ahead < blocks_ahead; ++ahead) {
    for (int rank = 1; rank < rank_count(); ++rank) hand_out(rank);
  }
  OwnShare own(
      [&sweep] {
        const auto worker = std::make_shared<Worker>(sweep);
        return [worker](const Block& block) { return worker->run(block); };
      },
      blocks, next);
  for (std::size_t done = 0; done < blocks.size();) {
    bool anything = false;
    for (BlockResult& result : own.take()) {
      finished(std::move(result));
      ++done;
      anything = true;
    }
    if (auto result = arrived()) {
      hand_out(result->second);
      finished(std::move(result->first));
      ++done;
      anything = true;
    }
    if (!anything) std::this_thread::sleep_for(look_every);
  }
  for (int rank = 1; rank < rank_count(); ++rank) send({}, rank);
}

void serve(const Sweep& sweep) {
  Worker worker(sweep);
  while (true) {
    Message message{};
    for (int there = 0; there == 0;) {  // a blocking receive would keep the core busy
      MPI_Iprobe(0, work_tag, MPI_COMM_WORLD, &there, MPI_STATUS_IGNORE);
      if (there == 0) std::this_thread::sleep_for(look_every / 10);
    }
    MPI_Recv(message.data(), static_cast<int>(message.size()), MPI_UINT64_T, 0, work_tag,
             MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    const Block block{message[0], message[1], message[2]};
    if (block.count == 0) return;
    const std::string bytes = encode(worker.run(block));
    MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, 0, result_tag, MPI_COMM_WORLD);
  }
}

std::string agree_on(std::string of_rank_0) {
  auto size = static_cast<int>(of_rank_0.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, MPI_COMM_WORLD);
  of_rank_0.resize(static_cast<std::size_t>(size));
  MPI_Bcast(of_rank_0.data(), size, MPI_CHAR, 0, MPI_COMM_WORLD);
  return of_rank_0;
}

}  // namespace trueaxis::mpi
