// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/reason.hpp"

#include <array>
#include <string_view>
#include <utility>

namespace trueaxis {
namespace {

/// The name of a constant, out of the compiler's text for this function.
template <ReasonCode code>
constexpr std::string_view name_of() {
  constexpr std::string_view type = "ReasonCode::";
  std::string_view text = __PRETTY_FUNCTION__;
  text.remove_prefix(text.rfind(type) + type.size());
  return text.substr(0, text.find_first_of(";]"));
}
static_assert(name_of<ReasonCode::part_slipped>() == "part_slipped");

}  // namespace

const char* to_string(ReasonCode code) {
  static const auto ids = []<std::size_t... i>(std::index_sequence<i...>) {
    return std::array{std::string(name_of<static_cast<ReasonCode>(i)>())...};
  }
  (std::make_index_sequence<reason_codes>());
  return ids[static_cast<std::size_t>(code)].c_str();
}

const ReasonNumber* Reason::number(const char* name) const {
  for (const ReasonNumber& one : numbers)
    if (std::string_view(one.name) == name) return &one;
  return nullptr;
}

}  // namespace trueaxis
