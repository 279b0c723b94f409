// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// Whether a key in small letters is one of a set-up: "setup.2.reindex".
bool csv_is_setup_key(std::string_view key);

/// Takes "setup.2.reindex", "70 deg" into `set_ups`. @returns what is wrong and what to write
/// instead, empty where nothing is.
std::string csv_take_setup(std::string_view key, std::string_view value,
                           std::map<int, SetUp>& set_ups);

/// Number of the set-up that a key which was taken is of.
int csv_setup_number(std::string_view key);

/// Makes the metadata of set-ups say what the stream's set-ups say; `stated` is what they said.
void csv_put_setups(const ProbeStream& stream, const std::map<int, SetUp>& stated,
                    std::map<std::string, std::string>& metadata);

}  // namespace trueaxis
