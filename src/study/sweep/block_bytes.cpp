// SPDX-License-Identifier: Apache-2.0
#include "study/sweep/block_bytes.hpp"

#include <cstring>
#include <type_traits>

#include "trueaxis/error.hpp"

namespace trueaxis::study {
namespace {

class Writer {
 public:
  template <class Number>
  void number(Number value) {
    static_assert(std::is_trivially_copyable_v<Number>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class List>
  void list(const List& values) {
    number(std::uint64_t{values.size()});
    bytes_.append(reinterpret_cast<const char*>(values.data()),
                  values.size() * sizeof(typename List::value_type));
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  template <class Number>
  void number(Number& value) {
    take(&value, sizeof value);
  }
  template <class List>
  void list(List& values) {
    std::uint64_t size = 0;
    number(size);
    if (size > rest_.size() / sizeof(typename List::value_type)) broken();
    values.resize(size);
    take(values.data(), size * sizeof(typename List::value_type));
  }
  void finish() const {
    if (!rest_.empty()) broken();
  }

 private:
  [[noreturn]] static void broken() { throw InputError("block", "is no result of a block"); }
  void take(void* to, std::size_t size) {
    if (size > rest_.size()) broken();
    if (size > 0) std::memcpy(to, rest_.data(), size);
    rest_.remove_prefix(size);
  }
  std::string_view rest_;
};

/// One order of members for both directions.
template <class Stream, class Result>
void pass_through(Stream& stream, Result& result) {
  stream.number(result.block.cell);
  stream.number(result.block.first_repeat);
  stream.number(result.block.count);
  stream.number(result.quantities);
  stream.number(result.seconds);
  stream.list(result.error);
  stream.list(result.u);
  stream.list(result.outcome);
  stream.list(result.found);
  stream.list(result.why);
}
template <class Stream, class Facts>
void pass_facts_through(Stream& stream, Facts& facts) {
  stream.number(facts.readings);
  stream.list(facts.truth);
  stream.number(facts.bound.kind);
  stream.number(facts.bound.missing);
  stream.list(facts.bound.sd);
  stream.list(facts.bound.covariance);
  stream.list(facts.bound_spread);
  stream.number(facts.hidden);
}

}  // namespace

std::string encode(const BlockResult& result) {
  Writer writer;
  pass_through(writer, result);
  writer.number(static_cast<std::uint8_t>(result.facts.size()));
  for (const CellFacts& facts : result.facts) pass_facts_through(writer, facts);
  return writer.take();
}

BlockResult decode(std::string_view bytes) {
  Reader reader(bytes);
  BlockResult result;
  pass_through(reader, result);
  std::uint8_t count = 0;
  reader.number(count);
  result.facts.resize(count);
  for (CellFacts& facts : result.facts) pass_facts_through(reader, facts);
  reader.finish();
  return result;
}

}  // namespace trueaxis::study
