// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "format/json.hpp"

namespace trueaxis {

/// A result as HTML that needs no script: a section a member, objects as tables of name and value,
/// arrays of objects as tables with a row each, what lies deeper folded. A quantity is written with
/// its unit and u. Columns of charts (more than 16 numbers) are counted, not listed.
std::string plain_tables(const Json& result);

}  // namespace trueaxis
