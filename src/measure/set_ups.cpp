// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

const char* to_string(SaidBy said_by) {
  static constexpr const char* words[] = {"nobody", "stream", "option", "job"};
  return words[static_cast<std::size_t>(said_by)];
}
namespace {

SetUp stated(const std::vector<SetUp>& setups, int number) {
  const auto at = std::ranges::find(setups, number, &SetUp::number);
  if (at != setups.end()) return *at;
  SetUp as_first;
  as_first.number = number;
  return as_first;
}

}  // namespace

SetUp set_up_of(const ProbeStream& stream, std::size_t reading) {
  return stated(stream.setups, stream.setup.empty() ? 1 : stream.setup[reading]);
}

std::vector<SetUp> list_set_ups(const ProbeStream& stream) {
  if (stream.setup.empty()) return {stated(stream.setups, 1)};
  std::vector<int> numbers;  // runs of one number are long
  for (const int number : stream.setup) {
    if (numbers.empty() || numbers.back() != number) numbers.push_back(number);
  }
  std::ranges::sort(numbers);
  const auto repeated = std::ranges::unique(numbers);
  numbers.erase(repeated.begin(), repeated.end());
  std::vector<SetUp> list;
  for (const int number : numbers) list.push_back(stated(stream.setups, number));
  return list;
}

}  // namespace trueaxis
