// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "format/json.hpp"
#include "trueaxis/reason.hpp"

namespace trueaxis {

/// A reference as a sentence names it.
struct SpokenReference {
  std::string name, file;
};
using Spoken = std::span<const SpokenReference>;

/// A reason in words.
std::string words_of(const Reason& reason, Spoken references = {});

/// Several, one after the other; what two of them say is said once.
std::string words_of(const Reasons& reasons, std::string_view between, Spoken references = {});

/// The same as data, and `words` with it.
Json reason_object(const Reason& reason, Spoken references);
Json reasons_array(const Reasons& reasons, Spoken references);

/// What a code is worded from. {left:um:.2g} is the number `left` in µm, {left.U:um:.2g} its U,
/// {effect} a name, {ref}, {name}, {file} the first reference and {name2}, {file2} the second,
/// {parts:, } and {remedies:, } other reasons, {@code} what another code is worded from. <…> is
/// left out where a place in it has nothing to stand there.
std::string_view template_of(ReasonCode code);

}  // namespace trueaxis
