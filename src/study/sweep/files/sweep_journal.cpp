// SPDX-License-Identifier: Apache-2.0
#include "study/sweep/files/sweep_journal.hpp"

#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <utility>

#include "base/build_id.hpp"
#include "format/file.hpp"
#include "platform/files.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace study {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Block, cell, first_repeat, count)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Bound, kind, missing, sd, covariance)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CellFacts, readings, truth, bound, bound_spread, hidden)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BlockResult, block, quantities, error, u, failures, found, facts,
                                   why, seconds)

}  // namespace study

namespace {

using namespace study;

constexpr std::string_view record_mark = "TXBLOCK1";

/// Cell and first repeat.
using Place = std::pair<std::size_t, std::size_t>;
Place place_of(const Block& block) { return {block.cell, block.first_repeat}; }

/// "trueaxis sweep journal 3 <hash of the input> <version> <build>\n": what a block's numbers
/// depend on.
std::string head_of(const Sweep& sweep) {
  return "trueaxis sweep journal 3 " + sweep.input_hash + ' ' + TRUEAXIS_VERSION + ' ' + build_id +
         '\n';
}

/// Why a journal that does not begin with head_of() is refused.
std::string refusal(std::string_view journal, const Sweep& sweep) {
  const std::string same_sweep = "trueaxis sweep journal 3 " + sweep.input_hash + ' ';
  if (!journal.starts_with(same_sweep))
    return "is of another sweep (its file or scenario has changed since) or of an older version: "
           "choose another folder with -o, or delete this one";
  const std::string_view rest = journal.substr(same_sweep.size());
  return "was begun by another build of TrueAxis (" + std::string(rest.substr(0, rest.find('\n'))) +
         "; this is " + TRUEAXIS_VERSION + ' ' + build_id +
         "), and results of two must not mix: continue with that build, choose another folder with "
         "-o, or delete this one";
}

std::string as_bytes(std::uint64_t number) {
  return {reinterpret_cast<const char*>(&number), sizeof number};
}

/// Mark, length, payload, checksum of all three.
std::string record_of(const BlockResult& result) {
  const std::string payload = encode(result);
  std::string record(record_mark);
  record += as_bytes(payload.size()) + payload;
  return record + as_bytes(XXH3_64bits(record.data(), record.size()));
}

/// The payload of a whole record at the beginning of `bytes`, or nothing; `size` is the record's.
std::string_view whole_record(std::string_view bytes, std::size_t& size) {
  const std::size_t head = record_mark.size() + sizeof(std::uint64_t);
  if (bytes.size() < head || !bytes.starts_with(record_mark)) return {};
  std::uint64_t length = 0, checksum = 0;
  std::memcpy(&length, bytes.data() + record_mark.size(), sizeof length);
  if (length > bytes.size() - head || bytes.size() - head - length < sizeof checksum) return {};
  std::memcpy(&checksum, bytes.data() + head + length, sizeof checksum);
  if (XXH3_64bits(bytes.data(), head + length) != checksum) return {};
  size = head + length + sizeof checksum;
  return bytes.substr(head, length);
}

}  // namespace

struct SweepJournal::Impl {
  std::string path;
  platform::LockableFile file;
  std::vector<BlockResult> finished;

  [[noreturn]] void fail(const char* what) const {
    throw InputError(path, std::string("cannot be ") + what + " (" + std::strerror(errno) +
                               "): name a folder that can be written with -o");
  }

  void append(std::string_view bytes) {
    if (!file.append(bytes)) fail("written");
  }

  void lock() {
    if (file.lock() == platform::LockableFile::Lock::held) return;
    throw InputError(path,
                     "another process is running this sweep: wait for it, or choose another "
                     "folder with -o");
  }

  /// Reads what is whole; what follows it was torn and is removed.
  void read(const Sweep& sweep) {
    const std::string head = head_of(sweep), bytes = read_file(path);
    const std::string_view all = bytes;
    if (!all.starts_with(head) && !std::string_view(head).starts_with(all))
      throw InputError(path, refusal(all, sweep));
    std::size_t at = std::min(head.size(), all.size());
    if (at == head.size()) {
      std::map<Place, std::size_t> open;  // blocks that no record has finished, and their counts
      for (const Block& block : blocks_of(sweep)) open[place_of(block)] = block.count;
      std::size_t size = 0;
      for (auto payload = whole_record(all.substr(at), size); !payload.empty();
           payload = whole_record(all.substr(at), size)) {
        BlockResult result = decode(payload);
        at += size;
        const auto of = open.find(place_of(result.block));
        if (of == open.end() || of->second != result.block.count) continue;
        open.erase(of);
        finished.push_back(std::move(result));
      }
    }
    const bool begun = at >= head.size();
    if (!file.cut_to(begun ? at : 0)) fail("written");
    if (!begun) append(head);
  }
};

SweepJournal::SweepJournal(const std::string& folder, const Sweep& sweep)
    : impl_(std::make_unique<Impl>()) {
  impl_->path = (std::filesystem::path(folder) / "journal.bin").string();
  impl_->file = platform::LockableFile::for_append(impl_->path);
  if (!impl_->file.is_open()) impl_->fail("opened");
  impl_->lock();
  impl_->read(sweep);
}

SweepJournal::~SweepJournal() = default;

std::vector<BlockResult> SweepJournal::take_finished() { return std::move(impl_->finished); }

void SweepJournal::append(const BlockResult& result) { impl_->append(record_of(result)); }

std::string encode(const BlockResult& result) {
  std::string bytes;
  nlohmann::json::to_cbor(result, bytes);
  return bytes;
}

BlockResult decode(std::string_view bytes) {
  try {
    return nlohmann::json::from_cbor(bytes);
  } catch (const nlohmann::json::exception&) {
    throw InputError("block", "is not a result of a block");
  }
}

std::vector<Block> blocks_to_do(const Sweep& sweep, const std::vector<BlockResult>& finished) {
  std::set<Place> done;
  for (const BlockResult& result : finished) done.insert(place_of(result.block));
  std::vector<Block> blocks = blocks_of(sweep);
  std::erase_if(blocks, [&](const Block& block) { return done.contains(place_of(block)); });
  return blocks;
}

}  // namespace trueaxis
