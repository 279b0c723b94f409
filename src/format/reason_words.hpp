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

/// Several, one after the other; what two of them say occurs once.
std::string words_of(const Reasons& reasons, std::string_view between, Spoken references = {});

/// The same as data, and `words` with it.
Json reason_object(const Reason& reason, Spoken references);
Json reasons_array(const Reasons& reasons, Spoken references);

/// The template of a code. {left:um:.2g} is the number `left` in µm, {left.U:um:.2g} its U, and
/// {effect} a name. The places {ref}, {name}, {file} are of the first reference and {name2},
/// {file2} of the second. The lists {parts:, } and {remedies:, } are other reasons, {@code} the
/// template of another code. A part in <…> is dropped if a place in it has nothing to fill it.
std::string_view template_of(ReasonCode code);

}  // namespace trueaxis
