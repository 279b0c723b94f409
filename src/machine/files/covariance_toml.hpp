// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "format/toml_reader.hpp"
#include "trueaxis/machine.hpp"

namespace trueaxis {

/// The table [covariance] of an errors file (docs/machine.md) into `errors`, whose terms give up
/// the u that it has. Complains of amounts that are none or twice, of a matrix that is none of a
/// covariance, of a u that is another one than the matrix', and, unless `large_errors`, of one that
/// no error of a machine has.
void read_covariance(TomlTable& root, const Machine& machine, bool large_errors,
                     ErrorModel& errors);

/// What `read_covariance` reads back; "" where there is none.
std::string covariance_toml(const ErrorCovariance& covariance);

}  // namespace trueaxis
